#include "analytic/plane_solutions.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/diffusion_exact.hpp"
#include "analytic/plane_modes.hpp"
#include "analytic/plate_impact.hpp"

namespace diptych::analytic {
namespace {

using Misfits = std::vector<std::string>;

bool all_are(const PlaneSetting& s, const char* support) {
  return std::all_of(s.supports.begin(), s.supports.end(), [&](const std::string& one) { return one == support; });
}

/// Sides that are wrong themselves have been reported.
bool square(const PlaneSetting& s) {
  return !(s.width > 0 && s.height > 0) || std::abs(s.width - s.height) <= 1e-12 * s.width;
}

Misfits none(const PlaneSetting&) { return {}; }

Misfits misfits_of_lame(const PlaneSetting& s) {
  Misfits found;
  if (!all_are(s, "free")) found.push_back("of a plate that is held; allowed: with four free sides");
  if (!square(s)) found.push_back("of a rectangle; allowed: on a square: width = height");
  return found;
}

Misfits misfits_of_p_wave(const PlaneSetting& s) {
  if (all_are(s, "roller")) return {};
  return {"of a plate held otherwise; allowed: with four sides on rollers"};
}

Misfits misfits_of_roller(const PlaneSetting& s) {
  Misfits found = misfits_of_p_wave(s);
  if (!square(s)) found.push_back("of a rectangle; allowed: on a square: width = height");
  return found;
}

Misfits misfits_of_impact(const PlaneSetting& s) {
  Misfits found;
  if (!s.strike) found.push_back("without a flyer; allowed: with [flyer]");
  if (!s.elastic) found.push_back("of a solid that fails; allowed: of an elastic one");
  if (s.supports != std::array<std::string, 4>{"free", "free", "roller", "roller"})
    found.push_back("of a plate held otherwise; allowed: with the left and right sides free and the others on rollers");
  return found;
}

Misfits misfits_of_source(const PlaneSetting& s) {
  if (s.corner_rate != 0) return {};
  return {"without one; allowed: with diffusion.corner_rate other than 0"};
}

const std::vector<SolutionParameter> of_modes{
    {"mode", SolutionParameter::Rule::whole},
    {"amplitude", SolutionParameter::Rule::not_zero},
    {"start", SolutionParameter::Rule::choice, {"displaced", "moving"}},
};

SquareMode on_square(const PlaneSetting& s) {
  return {*s.medium, s.width, static_cast<int>(s.parameters.at("mode")), s.parameters.at("amplitude"),
          s.parameters.at("start") == 0};
}
RectangleMode on_rectangle(const PlaneSetting& s) {
  return {*s.medium,
          s.width,
          s.height,
          static_cast<int>(s.parameters.at("mode")),
          s.parameters.at("amplitude"),
          s.parameters.at("start") == 0};
}

std::unique_ptr<PlaneSolution> make_lame(const PlaneSetting& s) { return std::make_unique<LameMode>(on_square(s)); }
std::unique_ptr<PlaneSolution> make_roller(const PlaneSetting& s) { return std::make_unique<RollerMode>(on_square(s)); }
std::unique_ptr<PlaneSolution> make_p_wave(const PlaneSetting& s) {
  return std::make_unique<StandingPWave>(on_rectangle(s));
}
std::unique_ptr<PlaneSolution> make_s_wave(const PlaneSetting& s) {
  return std::make_unique<StandingSWave>(on_rectangle(s));
}
std::unique_ptr<PlaneSolution> make_impact(const PlaneSetting& s) {
  return std::make_unique<PlateImpact>(
      PlateImpact::Parameters{*s.medium, s.width, s.height, s.strike->face, s.strike->velocity});
}
std::unique_ptr<PlaneSolution> make_source(const PlaneSetting& s) {
  return std::make_unique<CornerSource>(CornerSource::Parameters{s.corner_rate, s.diffusivity});
}
std::unique_ptr<PlaneSolution> make_front(const PlaneSetting& s) {
  return std::make_unique<FaceFront>(FaceFront::Parameters{s.width, s.height, s.diffusivity, s.profile, 1});
}

}  // namespace

const std::vector<PlaneSolutionRow>& plane_solutions() {
  using Scene = PlaneSolutionRow::Scene;
  static const std::vector<PlaneSolutionRow> all{
      {"lame-mode", of_modes, Scene::solid, misfits_of_lame, make_lame},
      {"roller-mode", of_modes, Scene::solid, misfits_of_roller, make_roller},
      {"p-wave", of_modes, Scene::solid, misfits_of_p_wave, make_p_wave},
      {"s-wave", of_modes, Scene::solid, none, make_s_wave},
      {"plate-impact", {}, Scene::solid, misfits_of_impact, make_impact},
      {"corner-source",
       {{"core", SolutionParameter::Rule::positive}},
       Scene::diffusion,
       misfits_of_source,
       make_source},
      {"face-front", {}, Scene::front, none, make_front},
  };
  return all;
}

}  // namespace diptych::analytic
