#include "analytic/bar_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analytic/bar_wave.hpp"
#include "analytic/plastic_impact.hpp"
#include "analytic/standing_mode.hpp"

namespace diptych::analytic {
namespace {

using Misfits = std::vector<std::string>;

bool perfectly_plastic(const ImpactBar& bar) { return std::isfinite(bar.yield_stress) && bar.tangent_modulus == 0; }

/// Of solutions for one elastic bar that is at rest before it is loaded.
Misfits misfits_of_one_bar(const BarSetting& s, bool carries_loads, const char* start) {
  Misfits found;
  const auto note = [&](bool present, const std::string& what, const std::string& why) {
    if (present)
      found.push_back("together with " + what + "; " + why +
                      "; allowed: leave that out, or give solution = \"expressions\"");
  };
  note(s.laws.front() != "elastic", "material.model = \"" + s.laws.front() + "\"", "its waves are elastic");
  note(s.bars.size() > 1 || s.flies, "several bars or a bar with a velocity",
       "it knows one bar, at rest before it is loaded (\"impact\" knows the others)");
  note(s.body_force, "[body_force]", "it knows no body force");
  note(!carries_loads && !s.loads.empty(), "[[load]]", "its ends carry no traction");
  note(s.starts_otherwise, "[initial]", start);
  if (carries_loads)
    for (const std::string& history : s.loads)
      note(history == "expression", "a load of history = \"expression\"", "its loads are step, ramp and impulse");
  return found;
}

Misfits misfits_of_wave(const BarSetting& s) {
  Misfits found = misfits_of_one_bar(s, true, "its bar starts from rest");
  const auto pulls = [](const BarEnd& end) {
    return std::any_of(end.traction.kinks.begin(), end.traction.kinks.end(),
                       [](const Traction::Kink& kink) { return kink.jump != 0 || kink.slope != 0; });
  };
  const bool given = std::find(s.loads.begin(), s.loads.end(), "expression") != s.loads.end();
  if (!pulls(s.left) && !pulls(s.right) && !given)
    found.push_back("without a load; allowed: at least one [[load]] with a traction other than 0");
  return found;
}

Misfits misfits_of_mode(const BarSetting& s) {
  return misfits_of_one_bar(s, false, "the mode itself sets the initial velocity");
}

/// Of solutions for bars that fly, strike and yield.
Misfits misfits_of_bars(const BarSetting& s) {
  Misfits found;
  for (const std::string& law : s.curved)
    found.push_back("together with material.model = \"" + law +
                    "\"; allowed: models whose curve of first loading is straight or bilinear");
  if (s.body_force) found.push_back("together with [body_force]; allowed: no body force");
  if (s.starts_otherwise) found.push_back("together with [initial]; allowed: bars with one velocity each");
  return found;
}

Misfits misfits_of_impact(const BarSetting& s) {
  Misfits found = misfits_of_bars(s);
  if (std::any_of(s.bars.begin(), s.bars.end(), perfectly_plastic))
    found.push_back(
        "together with E_t = 0; allowed: \"plastic-impact\": without hardening no front carries the plastic strain, "
        "which is a delta on the face");
  for (const std::string& history : s.loads)
    if (history == "ramp" || history == "expression")
      found.push_back("together with a load of history = \"" + history + "\"; allowed: steps and impulses");
  return found;
}

Misfits misfits_of_plastic(const BarSetting& s) {
  Misfits found = misfits_of_bars(s);
  const auto note = [&](bool present, const char* what, const char* allowed) {
    if (present) found.push_back(std::string("together with ") + what + "; allowed: " + allowed);
  };
  const auto alike = [](const ImpactBar& a, const ImpactBar& b) {
    return a.length == b.length && a.youngs_modulus == b.youngs_modulus && a.density == b.density &&
           a.yield_stress == b.yield_stress;
  };
  const bool equal =
      s.bars.size() == 2 && perfectly_plastic(s.bars[0]) && perfectly_plastic(s.bars[1]) && alike(s.bars[0], s.bars[1]);
  note(!equal, "other bars", "two equal bars with E_t = 0");
  note(equal && !(s.bars[0].velocity > s.bars[1].velocity), "bars that do not close in",
       "a first bar faster than the second");
  note(s.bonded, "contact.fem = \"bonded\"", "bars that part");
  note(!s.loads.empty() || s.left.fixed || s.right.fixed, "loads or supports", "free ends");
  return found;
}

std::unique_ptr<ExactSolution> make_wave(const BarSetting& s) {
  const ImpactBar& bar = s.bars.front();
  return std::make_unique<BarWave>(BarWave::Parameters{bar.youngs_modulus, bar.density, bar.length, s.left, s.right});
}

std::unique_ptr<ExactSolution> make_mode(const BarSetting& s) {
  const ImpactBar& bar = s.bars.front();
  return std::make_unique<StandingMode>(
      StandingMode::Parameters{bar.youngs_modulus, bar.density, bar.length, s.left.fixed, s.right.fixed,
                               static_cast<int>(s.parameters.at("mode")), s.parameters.at("amplitude")});
}

std::unique_ptr<ExactSolution> make_impact(const BarSetting& s) {
  const ImpactBar& first = s.bars.front();
  // Fields live up to half a step after the last time that is asked for.
  const double until = s.until * (1 + 1e-9) + first.length / std::sqrt(first.youngs_modulus / first.density);
  return std::make_unique<BarImpact>(BarImpact::Parameters{s.bars, s.left, s.right, until, s.bonded});
}

std::unique_ptr<ExactSolution> make_plastic(const BarSetting& s) {
  const ImpactBar &a = s.bars[0], &b = s.bars[1];
  return std::make_unique<PlasticImpact>(PlasticImpact::Parameters{
      a.youngs_modulus, a.density, a.yield_stress, a.length, b.begin - a.length, a.velocity, b.velocity});
}

}  // namespace

const std::vector<BarSolution>& bar_solutions() {
  using Rule = SolutionParameter::Rule;
  static const std::vector<BarSolution> all{
      {"bar-wave", {}, false, misfits_of_wave, make_wave},
      {"standing-mode", {{"mode", Rule::whole}, {"amplitude", Rule::not_zero}}, false, misfits_of_mode, make_mode},
      {"impact", {}, true, misfits_of_impact, make_impact},
      {"plastic-impact", {}, true, misfits_of_plastic, make_plastic},
  };
  return all;
}

}  // namespace diptych::analytic
