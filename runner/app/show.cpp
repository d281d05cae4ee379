// What a case says, as the program has read it: `diptych show`.
#include <fmt/core.h>

#include <exception>
#include <string>
#include <vector>

#include "reports/text.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/commands.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/build.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/judge/gates.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {
namespace {

/// " for 1 L/c from 0 s": when a load acts.
std::string timing(const LoadSpec& load) {
  std::string text;
  if (load.history == "impulse") text += fmt::format(" for {:g} {}", load.duration.value, load.duration.unit);
  if (load.history == "ramp") text += fmt::format(" over {:g} {}", load.rise.value, load.rise.unit);
  if (load.start.value > 0) text += fmt::format(" from {:g} {}", load.start.value, load.start.unit);
  return text;
}

/// ", 1.2e+09 steps, about 3 min", or nothing where the run cannot be begun, which `run` explains.
std::string what_it_takes(const Case& c, const Leaf& leaf) {
  try {
    const auto own = case_of(c, leaf);
    const Outlook ahead = outlook(*own, leaf);
    return fmt::format(", {:.3g} steps, {}", ahead.steps(),
                       duration_words(ahead.seconds(describe(*own, leaf).unknowns)));
  } catch (const std::exception&) {
    return "";
  }
}

void show_runs(const Case& c) {
  const std::vector<Leaf> all = leaves(c);
  print("  runs       {}\n", all.size());
  for (const Leaf& leaf : all) {
    print("             {} {} cells, Courant {:g}{}{}{}\n", leaf.method, leaf.cells, leaf.courant,
          leaf.particles.empty() ? "" : ", particles at " + particles_label(leaf.particles),
          parameters_label(leaf).empty() ? "" : ", " + parameters_label(leaf), what_it_takes(c, leaf));
  }
}

void show_plate(const Case& c) {
  print("{}: {}\n  file       {}\n  claim      {}\n  why        {}\n  plate      {}\n", c.id, c.title,
        reports::printable(c.path.string()), c.claim, c.why, words_of(*c.plate));
  if (c.plate->solid) {
    print("  supports  ");
    for (std::size_t side = 0; side < 4; ++side)
      print(" {} {}{}", side_names[side], support_names[static_cast<std::size_t>(c.plate->supports[side])],
            side < 3 ? "," : "\n");
  }
  for (const SideLoad& load : c.plate->loads)
    print("  load       {} {} on the {} side, traction {}{}\n", load.history, load.shear ? "shear" : "normal",
          side_names[static_cast<std::size_t>(load.side)], load.traction,
          load.history == "ramp" ? fmt::format(", over {:g} s", load.rise) : "");
  if (const auto& flyer = c.plate->flyer)
    print("  flyer      {:g} m thick at {:g} m/s, a gap of {:g} {}\n", flyer->thickness, flyer->velocity, flyer->gap,
          flyer->gap_unit);
  for (const auto& [feature, key] : plate_features(c)) print("  uses       {}: {}\n", feature, key);
  for (const auto& [name, value] : c.parameters) print("  parameter  {} = {:g}\n", name, value);
  for (const PlateVariant& variant : c.variants) print("  variant    {}: {}\n", variant.id, variant.says);
  print("  exact      {}\n  features   {}\n  sampled    t = {} s\n", c.plate->exact.solution, listed(c.features),
        listed(c.times));
  show_runs(c);
  for (const PlateProbe& probe : c.plate_probes) print("  probe      {} {}\n", probe.id, probe.reads);
  for (const GaugeSpec& gauge : c.gauges)
    print("  gauge      {}, {:g} m from the impact face\n", gauge.id, gauge.from_face);
}

void show_bars(const Case& c) {
  const auto end_text = [](Support s) { return s == Support::fixed ? "fixed" : "free"; };
  print("{}: {}\n  file       {}\n  claim      {}\n  why        {}\n", c.id, c.title,
        reports::printable(c.path.string()), c.claim, c.why);
  for (std::size_t b = 0; b < c.bars.size(); ++b) {
    const BarSpec& bar = c.bars[b];
    print("  bar        {}, wave speed {:g}{}{}\n", words_of(bar), material::wave_speed(bar.material),
          b == 0 ? "" : fmt::format(", after a gap of {:g} {}", bar.gap.value, bar.gap.unit),
          bar.velocity.empty() ? "" : ", velocity " + bar.velocity);
  }
  print("  all        {} units, {}–{}, {} displacements\n", c.units, end_text(c.left), end_text(c.right),
        c.convected ? "finite" : "infinitesimal");
  for (const auto& [name, value] : c.parameters) print("  parameter  {} = {:g}\n", name, value);
  if (c.viscosity) print("  viscosity  {}\n", words_of(viscosity_of(c)));
  if (c.contact == Contact::bonded) print("  contact    bonded (FEM)\n");
  for (const LoadSpec& load : c.loads) {
    print("  load       {}{} on the {} end, {}, through the {}\n", load.history, timing(load),
          load.end == End::left ? "left" : "right",
          load.history == "expression" ? load.expression : fmt::format("traction {:g}", load.traction),
          load.transfer == Transfer::node ? "boundary node" : "boundary layer (eq. 16)");
  }
  if (!c.body_force.empty()) print("  body force {}\n", c.body_force);
  if (!c.initial_velocity.empty()) print("  velocity   {} at the start\n", c.initial_velocity);
  if (!c.initial_stress.empty()) print("  stress     {} at the start\n", c.initial_stress);
  if (c.exact.solution == "expressions") {
    print("  exact      stress {}; velocity {}; displacement {}\n", c.exact.stress, c.exact.velocity,
          c.exact.displacement);
  }
  print("  exact      {}\n  features   {}\n  sampled    t = {} {}{}\n", c.exact.solution, listed(c.features),
        listed(c.times), c.time_unit, c.from_contact ? " from contact" : "");
  show_runs(c);
  for (const Probe& probe : c.probes) {
    print("  probe      {} {} at {:g} {}\n", probe.id, probe.field, probe.at.value, probe.at.unit);
  }
}

}  // namespace

int show_command(const Options& options) {
  for (const Case& c : select_cases(options.selectors)) {
    if (c.plate)
      show_plate(c);
    else
      show_bars(c);
    for (const GateSpec& gate : c.gates)
      print("  gate       {:24} {}\n{:38}{}\n", gate.id, words(gate.declaration), "", gate.reason);
    for (const FigureSpec& figure : c.figures) print("  figure     {}\n", figure.id);
  }
  return all_passed;
}

}  // namespace diptych::runner
