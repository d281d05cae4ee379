#include "reports/run_record.hpp"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <exception>
#include <sstream>
#include <stdexcept>

namespace diptych::reports {

// Each names all members of its type: with one more or one less it is no program.
template <class Archive>
void serialize(Archive& archive, FieldError& it) {
  auto& [field, time, scale, l1, l2, linf, predicted_l1, predicted_l2, predicted_linf] = it;
  archive(field, time, scale, l1, l2, linf, predicted_l1, predicted_l2, predicted_linf);
}

template <class Archive>
void serialize(Archive& archive, ProbeValue& it) {
  auto& [id, value, predicted] = it;
  archive(id, value, predicted);
}

template <class Archive>
void serialize(Archive& archive, Curve& it) {
  auto& [x, y] = it;
  archive(x, y);
}

template <class Archive>
void serialize(Archive& archive, PlateFields& it) {
  auto& [nx, ny, width, height, crack_density, damage] = it;
  archive(nx, ny, width, height, crack_density, damage);
}

template <class Archive>
void serialize(Archive& archive, VtuMesh& it) {
  auto& [x, y, connectivity, corners] = it;
  archive(x, y, connectivity, corners);
}

template <class Archive>
void serialize(Archive& archive, VtuArray& it) {
  auto& [name, components, values, on_cells] = it;
  archive(name, components, values, on_cells);
}

template <class Archive>
void serialize(Archive& archive, VtuPiece& it) {
  auto& [name, mesh, arrays] = it;
  archive(name, mesh, arrays);
}

template <class Archive>
void serialize(Archive& archive, BarPoints& it) {
  auto& [kind, bar, x, fields, exact] = it;
  archive(kind, bar, x, fields, exact);
}

template <class Archive>
void serialize(Archive& archive, Sample& it) {
  auto& [asked, time, errors, probes, curves, exact_curves, plate, files, bar_points] = it;
  archive(asked, time, errors, probes, curves, exact_curves, plate, files, bar_points);
}

template <class Archive>
void serialize(Archive& archive, LedgerLine& it) {
  auto& [time, kinetic, strain, dissipated, viscous, contact, scheme, work, lost, momentum, impulse] = it;
  archive(time, kinetic, strain, dissipated, viscous, contact, scheme, work, lost, momentum, impulse);
}

template <class Archive>
void serialize(Archive& archive, GaugeHistory& it) {
  auto& [id, from_face, time, xx, yy, dilatancy] = it;
  archive(id, from_face, time, xx, yy, dilatancy);
}

template <class Archive>
void serialize(Archive& archive, Run& it) {
  auto& [case_id, method, work_unit, cells, courant_asked, courant, particles, parameters, status, message, cell_size,
         unknowns, time_step, time_step_limit, steps, element_steps, particle_steps, node_steps, bytes, wall_seconds,
         features, finite, invalid, measures, samples, ledger, paths, exact_paths, path_origins, gauges, platen] = it;
  archive(case_id, method, work_unit, cells, courant_asked, courant, particles, parameters, status, message, cell_size,
          unknowns, time_step, time_step_limit, steps, element_steps, particle_steps, node_steps, bytes, wall_seconds,
          features, finite, invalid, measures, samples, ledger, paths, exact_paths, path_origins, gauges, platen);
}

std::string run_record(const Run& run) {
  std::ostringstream bytes(std::ios::binary);
  cereal::PortableBinaryOutputArchive(bytes, cereal::PortableBinaryOutputArchive::Options::LittleEndian())(run);
  return std::move(bytes).str();
}

Run run_of_record(const std::string& bytes) {
  std::istringstream in(bytes, std::ios::binary);
  Run run;
  try {
    cereal::PortableBinaryInputArchive(in, cereal::PortableBinaryInputArchive::Options::LittleEndian())(run);
  } catch (const std::exception& problem) {
    throw std::runtime_error(std::string("no record of a run: ") + problem.what());
  }
  if (in.peek() != std::istringstream::traits_type::eof())
    throw std::runtime_error("no record of a run: there is more behind it");
  return run;
}

}  // namespace diptych::reports
