#include "runner/run/plate_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hinge/material/bifurcation.hpp"
#include "reports/vtu.hpp"
#include "runner/compare/contours.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/run/instants.hpp"

namespace diptych::runner {
namespace {

const material::TensileDamage& damage_of(const Case& c) { return c.plate->cracking()->law; }

/// Mean of the cells around each node.
std::vector<double> cells_to_nodes(const diffusion::Grid& grid, const std::vector<double>& cells) {
  std::vector<double> nodes;
  for (int j = 0; j <= grid.ny; ++j) {
    for (int i = 0; i <= grid.nx; ++i) {
      double sum = 0, count = 0;
      for (int cj = std::max(0, j - 1); cj <= std::min(grid.ny - 1, j); ++cj) {
        for (int ci = std::max(0, i - 1); ci <= std::min(grid.nx - 1, i); ++ci) {
          sum += cells[static_cast<std::size_t>(cj) * static_cast<std::size_t>(grid.nx) + static_cast<std::size_t>(ci)];
          ++count;
        }
      }
      nodes.push_back(sum / count);
    }
  }
  return nodes;
}

/// The least over the cells, of their mean strains. The tangent follows the strain where the local model is being
/// loaded: where C_d is that of eq. 23a now. NaN where a strain is; the whole solid's 1 where no cell is in tension.
material::Bifurcation least_bifurcation(const Case& c, const PlateSnapshot& snapshot) {
  const material::TensileDamage& law = damage_of(c);
  const diffusion::Evolution& evolution = c.plate->cracking()->evolution;
  material::Bifurcation least{1, 0};
  for (std::size_t cell = 0; cell < snapshot.crack_density.size(); ++cell) {
    const double volumetric = snapshot.volumetric_strain[cell], crack_density = snapshot.crack_density[cell];
    const bool follows = !evolution.diffusion && evolution.rate == diffusion::Rate::reference && volumetric > 0 &&
                         crack_density < evolution.cap &&
                         crack_density <= law.crack_density(volumetric, evolution.reference_rate) * (1 + 1e-9);
    const double rate = follows ? law.exponent * crack_density / volumetric : 0;
    const auto found = material::bifurcation(law, snapshot.strain[cell], crack_density, rate);
    if (!(found.least_ratio >= least.least_ratio)) least = found;
    if (std::isnan(found.least_ratio)) return found;
  }
  return least;
}

double component_at(const PlateProbe& probe, const PlateSnapshot& snapshot) {
  const auto dash = probe.reads.find('-');
  const std::string name = probe.reads.substr(0, dash), part = probe.reads.substr(dash + 1);
  const PointField& field = name == "stress"     ? snapshot.stress
                            : name == "velocity" ? snapshot.velocity
                                                 : snapshot.displacement;
  const std::size_t k = name == "stress" ? (part == "xx" ? 0 : part == "yy" ? 1 : 2) : (part == "x" ? 0 : 1);
  double nearest = std::numeric_limits<double>::infinity(), value = std::nan("");
  for (std::size_t p = 0; p < field.x.size(); ++p) {
    const double distance = std::hypot(field.x[p] - probe.x, field.y[p] - probe.y);
    if (distance >= nearest) continue;
    nearest = distance;
    value = field.component[k][p];
  }
  return value;
}

/// Order in which two records hold the same places, the second one's x counted from the other side where mirrored.
std::vector<std::size_t> by_place(const PointField& field, bool mirror) {
  const auto [left, right] = std::minmax_element(field.x.begin(), field.x.end());
  const double from = field.x.empty() ? 0 : *left + *right;
  std::vector<std::size_t> order(field.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto round = [](double v) { return static_cast<float>(v); };  // places may differ in their last bits
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double xa = mirror ? from - field.x[a] : field.x[a], xb = mirror ? from - field.x[b] : field.x[b];
    return std::pair(round(field.y[a]), round(xa)) < std::pair(round(field.y[b]), round(xb));
  });
  return order;
}

}  // namespace

Norms plane_error(const PointField& field, const analytic::PlaneSolution& exact, analytic::PlaneQuantity q,
                  double core) {
  const double scale = exact.scale(q);
  double sum = 0, sum1 = 0, sum2 = 0, largest = 0;
  bool nan = false;
  for (std::size_t p = 0; p < field.x.size(); ++p) {
    if (core > 0 && std::hypot(field.x[p], field.y[p]) < core) continue;
    const auto expected = exact.at(q, field.x[p], field.y[p], field.time);
    double square = 0;
    for (std::size_t k = 0; k < field.component.size(); ++k) {
      const double error = (field.component[k][p] - expected[k]) / scale;
      // The off-diagonal component of a stress counts twice, as in the tensor's own norm.
      square += (q == analytic::PlaneQuantity::stress && k == 2 ? 2 : 1) * error * error;
    }
    const double error = std::sqrt(square);
    nan = nan || std::isnan(error);
    sum += field.weight[p];
    sum1 += field.weight[p] * error;
    sum2 += field.weight[p] * square;
    largest = std::max(largest, error);
  }
  if (nan || !(sum > 0)) return {std::nan(""), std::nan(""), std::nan("")};
  return {sum1 / sum, std::sqrt(sum2 / sum), largest};
}

PointField nodes_as_points(const diffusion::Grid& grid, const std::vector<double>& values, double time) {
  PointField field;
  field.time = time;
  for (int j = 0; j <= grid.ny; ++j) {
    for (int i = 0; i <= grid.nx; ++i) {
      field.x.push_back(grid.nx * grid.hx * i / grid.nx);
      field.y.push_back(grid.ny * grid.hy * j / grid.ny);
      field.weight.push_back(node_area(grid, field.weight.size()));
    }
  }
  field.component = {values};
  return field;
}

reports::PlateFields damage_fields(const Case& c, const diffusion::Grid& grid, const PlateSnapshot& snapshot) {
  const diffusion::Evolution& evolution = c.plate->cracking()->evolution;
  reports::PlateFields drawn{grid.nx, grid.ny, c.plate->width, c.plate->height, {}, {}};
  drawn.crack_density = evolution.diffusion ? snapshot.concentration : cells_to_nodes(grid, snapshot.crack_density);
  if (evolution.diffusion)
    for (double& value : drawn.crack_density) value *= evolution.diffusion->crack_volume;  // eq. 27
  for (const double value : drawn.crack_density)
    drawn.damage.push_back(damage_of(c).damage(std::clamp(value, 0.0, evolution.cap)));
  return drawn;
}

reports::ProbeValue read_plate_probe(const Case& c, const diffusion::Grid& grid, const PlateProbe& probe,
                                     const PlateSnapshot& snapshot, const std::optional<reports::PlateFields>& damage,
                                     const reports::Curve& platen) {
  reports::ProbeValue value{probe.id, std::nan(""), {}};
  if (probe.reads == "platen") {
    value.value = at_instant(platen.x, platen.y, snapshot.time);
    return value;
  }
  if (probe.reads == "total" || probe.reads == "concentration") {
    const PointField nodes = nodes_as_points(grid, snapshot.concentration, snapshot.time);
    if (snapshot.concentration.empty()) return value;
    if (probe.reads == "total") {
      value.value = std::inner_product(nodes.weight.begin(), nodes.weight.end(), nodes.component[0].begin(), 0.0);
    } else {
      const auto i = static_cast<std::size_t>(std::lround(probe.x / grid.hx)),
                 j = static_cast<std::size_t>(std::lround(probe.y / grid.hy));
      value.value = snapshot.concentration[j * (static_cast<std::size_t>(grid.nx) + 1) + i];
    }
    return value;
  }
  if (!damage) {
    value.value = component_at(probe, snapshot);
    return value;
  }
  const NodalMap map = map_of(*damage, "crack-density");
  if (probe.reads == "radius") {
    value.value = radius_along(map, probe.level, probe.angle);
  } else if (probe.reads == "area") {
    value.value = area_above(map, probe.level);
  } else if (probe.reads == "largest") {
    value.value = *std::max_element(map.value.begin(), map.value.end());
  } else if (probe.reads == "acoustic-ratio") {
    value.value = least_bifurcation(c, snapshot).least_ratio;
  } else if (probe.reads == "acoustic-angle") {
    value.value = least_bifurcation(c, snapshot).angle * 180 / std::numbers::pi;
  } else {
    value.value = component_at(probe, snapshot);
  }
  return value;
}

std::vector<reports::VtuPiece> vtu_fields(const diffusion::Grid& grid, bool elements, const PlateSnapshot& snapshot) {
  std::vector<reports::VtuPiece> pieces;
  const auto node = [&](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.nx + 1) + static_cast<std::size_t>(i);
  };
  const auto vectors = [&](const PointField& field, const char* name) {
    return reports::vtu_vector(name, field.component[0], field.component[1]);
  };
  if (!snapshot.displacement.x.empty()) {
    const auto& stress = snapshot.stress.component;
    reports::VtuPiece piece;
    piece.name = elements ? "mesh" : "particles";
    piece.mesh.x = snapshot.displacement.x;
    piece.mesh.y = snapshot.displacement.y;
    if (elements) {
      piece.mesh.corners = 3;
      std::size_t centre = grid.nodes();
      for (int j = 0; j < grid.ny; ++j) {
        for (int i = 0; i < grid.nx; ++i, ++centre) {
          const std::array<std::size_t, 4> corner{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
          for (std::size_t k = 0; k < 4; ++k)  // bottom, right, top, left
            piece.mesh.connectivity.insert(piece.mesh.connectivity.end(), {corner[k], corner[(k + 1) % 4], centre});
        }
      }
    }
    piece.arrays = {vectors(snapshot.displacement, "displacement"), vectors(snapshot.velocity, "velocity"),
                    reports::vtu_stress("stress", stress[0], stress[1], stress[2], elements)};
    pieces.push_back(std::move(piece));
  }
  reports::VtuPiece cells;
  cells.name = "cells";
  cells.mesh.corners = 4;
  for (int j = 0; j <= grid.ny; ++j) {
    for (int i = 0; i <= grid.nx; ++i) {
      cells.mesh.x.push_back(i * grid.hx);
      cells.mesh.y.push_back(j * grid.hy);
    }
  }
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      cells.mesh.connectivity.insert(cells.mesh.connectivity.end(),
                                     {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  const auto add = [&](const char* name, const std::vector<double>& values, bool on_cells) {
    if (!values.empty()) cells.arrays.push_back({name, {}, values, on_cells});
  };
  add("volumetric strain", snapshot.volumetric_strain, true);
  add("crack density", snapshot.crack_density, true);
  add("dilatancy", snapshot.dilatancy, true);
  add(snapshot.dilatancy.empty() ? "concentration" : "dilatancy of nodes", snapshot.concentration, false);
  if (!cells.arrays.empty()) pieces.push_back(std::move(cells));
  return pieces;
}

void measure_fields(const Case& c, const diffusion::Grid& grid, const PlateRecord& record, reports::Run& run) {
  double largest = 0;
  const auto look = [&](const std::vector<double>& values) {
    for (const double value : values) {
      run.finite = run.finite && std::isfinite(value);
      largest = std::max(largest, std::abs(value));
    }
  };
  double least = 0, most = 0, weight = 0;
  for (const PlateSnapshot& s : record.snapshots) {
    for (const PointField* field : {&s.displacement, &s.velocity, &s.stress})
      for (const auto& component : field->component) look(component);
    look(s.crack_density);
    look(s.dilatancy);
    look(s.concentration);
    for (const double value : s.concentration) {
      least = std::min(least, value);
      most = std::max(most, std::abs(value));
    }
    weight = std::accumulate(s.displacement.weight.begin(), s.displacement.weight.end(), 0.0);
  }
  run.measures["numbers.largest"] = largest;
  const double area = c.plate->width * c.plate->height;
  if (weight > 0) run.measures["area.error"] = weight / area - 1;
  if (record.snapshots.empty() || record.snapshots.back().concentration.empty()) return;
  double total = 0;
  const auto& values = record.snapshots.back().concentration;
  for (std::size_t k = 0; k < values.size(); ++k) total += values[k] * node_area(grid, k);
  if (std::isfinite(record.fed) && record.fed != 0) run.measures["concentration.balance"] = total / record.fed - 1;
  if (most > 0) run.measures["concentration.least"] = least / most;
}

Plate scaled(const Plate& plate, const PowersOfTwo& by) {
  Plate out = plate;
  out.width *= by.length;
  out.height *= by.length;
  auto& elastic = std::get<solid::Elastic>(out.solid).law;
  elastic.youngs_modulus *= by.modulus;
  elastic.density *= by.density;
  const double time = by.time(), velocity = by.velocity(), length = by.length;
  const auto times = [](const Vector& v, double factor) { return Vector{v[0] * factor, v[1] * factor}; };
  for (Edge& edge : out.edges) {
    for (auto* traction : {&edge.normal_traction, &edge.shear_traction})
      if (*traction)
        *traction = [f = *traction, time, stress = by.stress](double from, double to) {
          return f(from / time, to / time) * stress;
        };
    if (edge.velocity)
      edge.velocity = [f = edge.velocity, times, time, length, velocity](double x, double y, double t) {
        return times(f(x / length, y / length, t / time), velocity);
      };
  }
  if (plate.body_force)
    out.body_force = [f = plate.body_force, times, time, length, a = velocity / time](double x, double y, double t) {
      return times(f(x / length, y / length, t / time), a);
    };
  const auto initial = [&](const std::function<Vector(double, double)>& f, double factor) {
    return [f, times, length, factor](double x, double y) { return times(f(x / length, y / length), factor); };
  };
  if (out.impact) {
    out.impact->face *= length;
    out.impact->gap *= length;
    out.impact->velocity *= velocity;
  }
  for (Gauge& gauge : out.gauges) {
    gauge.x *= length;
    gauge.y *= length;
  }
  if (plate.initial_velocity) out.initial_velocity = initial(plate.initial_velocity, velocity);
  if (plate.initial_displacement) out.initial_displacement = initial(plate.initial_displacement, by.displacement());
  return out;
}

Plate mirrored(const Plate& plate) {
  Plate out = plate;
  const double width = plate.width;
  std::swap(out.edge(Side::left), out.edge(Side::right));
  for (const Side side : {Side::left, Side::right, Side::bottom, Side::top}) {
    Edge& edge = out.edge(side);
    if (edge.shear_traction && (side == Side::bottom || side == Side::top))
      edge.shear_traction = [f = edge.shear_traction](double from, double to) { return -f(from, to); };
    if (edge.velocity)
      edge.velocity = [f = edge.velocity, width](double x, double y, double t) {
        const Vector v = f(width - x, y, t);
        return Vector{-v[0], v[1]};
      };
  }
  const auto reversed = [width](const std::function<Vector(double, double)>& f) {
    return [f, width](double x, double y) {
      const Vector v = f(width - x, y);
      return Vector{-v[0], v[1]};
    };
  };
  if (plate.initial_velocity) out.initial_velocity = reversed(plate.initial_velocity);
  if (plate.initial_displacement) out.initial_displacement = reversed(plate.initial_displacement);
  if (plate.body_force)
    out.body_force = [f = plate.body_force, width](double x, double y, double t) {
      const Vector v = f(width - x, y, t);
      return Vector{-v[0], v[1]};
    };
  return out;
}

double differing(const PlateRecord& a, const PlateRecord& b, const PowersOfTwo& by, bool mirror) {
  double count = a.snapshots.size() == b.snapshots.size() && a.outcome == b.outcome ? 0 : 1;
  bool moved = false;
  const auto compare_numbers = [&](double first, double second) {
    if (!(first == second)) ++count;
    moved = moved || first != 0;
  };
  const auto compare = [&](const PointField& first, const PointField& second, double factor, std::size_t odd) {
    const auto one = by_place(first, false), other = by_place(second, mirror);
    if (one.size() != other.size()) ++count;
    for (std::size_t k = 0; k < first.component.size(); ++k) {
      const double sign = mirror && k == odd ? -1 : 1;
      for (std::size_t p = 0; p < std::min(one.size(), other.size()); ++p)
        compare_numbers(first.component[k][one[p]] * factor, sign * second.component[k][other[p]]);
    }
  };
  for (std::size_t s = 0; s < std::min(a.snapshots.size(), b.snapshots.size()); ++s) {
    const PlateSnapshot &first = a.snapshots[s], &second = b.snapshots[s];
    compare(first.displacement, second.displacement, by.displacement(), 0);
    compare(first.velocity, second.velocity, by.velocity(), 0);
    compare(first.stress, second.stress, by.stress, 2);
    if (mirror || by.length != 1) continue;
    if (!second.crack_density.empty() && first.crack_density.size() != second.crack_density.size()) ++count;
    for (std::size_t k = 0; k < std::min(first.crack_density.size(), second.crack_density.size()); ++k)
      compare_numbers(first.crack_density[k], second.crack_density[k]);
    for (std::size_t k = 0; k < std::min(first.concentration.size(), second.concentration.size()); ++k)
      compare_numbers(first.concentration[k], second.concentration[k]);
  }
  return moved ? count : std::nan("");  // zeros are equal to anything's zeros
}

}  // namespace diptych::runner
