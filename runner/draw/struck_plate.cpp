#include "runner/draw/struck_plate.hpp"

#include <fmt/core.h>

#include <cmath>

#include "runner/compare/gauges.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

std::string model_words(const PlateSpec& plate) {
  const auto* failure = plate.failing();
  if (!failure) return "Elastic";
  const char* profile = failure->spread.profile == diffusion::Profile::falling    ? "d0 (1 − V_d/V_d,max)"
                        : failure->spread.profile == diffusion::Profile::constant ? "d0"
                                                                                  : "d0 V_d/V_d,max";
  return fmt::format("Reconstructed model R1: d = {}, d0 = {:g} m²/s, f_max = {:g}, threshold {:g} GPa", profile,
                     failure->spread.diffusivity, failure->law.most_converted, failure->law.threshold / 1e9);
}

}  // namespace

void need_gauges(Table& t, const Case& c, const FigureSpec& figure) {
  if (c.gauges.empty()) t.place("kind").refuse(words(figure.kind) + " without a gauge", "with sample.gauges");
}

PlateSpec plate_of(const Case& c, const std::string& variant, int cells) {
  Leaf leaf;
  leaf.cells = cells;
  leaf.variant = variant;
  return *with_parameters(c, leaf).plate;
}

std::string viscosity_words(const PlateSpec& plate) {
  if (!plate.viscosity) return "no artificial viscosity";
  return fmt::format("artificial viscosity of eq. 21 with c1 = {:g}, c2 = {:g}, λ = {:g}, g = {:.4g} cells",
                     plate.viscosity->c1, plate.viscosity->c2, plate.viscosity->bulk, plate.viscosity->length);
}

double measure(const reports::Run* run, const std::string& name) {
  if (!run) return std::nan("");
  const auto found = run->measures.find(name);
  return found == run->measures.end() ? std::nan("") : found->second;
}

std::vector<std::string> struck_notes(const Case& c, const FigureSpec& spec, const PlateSpec& plate) {
  const double speed = plate.flyer->velocity;
  const ImpactTheory theory = impact_theory(plate, c.gauges.front().from_face);
  std::vector<std::string> notes{
      fmt::format("{}; flyer {:g} mm at {:g} m/s: σ_x = ½ρc_L v = {:.3f} GPa", words_of(plate),
                  plate.flyer->thickness * 1e3, speed, theory.plateau / 1e9),
      fmt::format("{}; {}", model_words(plate), viscosity_words(plate)),
      fmt::format(
          "{} cells of {:g} mm across; four triangles (FEM), particles at ξ, η = {} (MPM) a cell; Courant number {:g}",
          spec.cells, plate.width / spec.cells * 1e3, particles_label(spec.particles), spec.courant)};
  if (!spec.choices.empty()) notes.push_back("Reconstructed parameters: " + spec.choices);
  return notes;
}

}  // namespace diptych::runner
