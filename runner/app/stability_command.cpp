// The command stability.
#include <fmt/core.h>

#include <algorithm>

#include "reports/files.hpp"
#include "reports/stability_table.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/commands.hpp"
#include "runner/app/provenance.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/gates.hpp"
#include "runner/stability/stability.hpp"
#include "runner/stability/stability_figure.hpp"

namespace diptych::runner {

int stability_command(const Options& options, const std::atomic<bool>& cancelled) {
  const Case c = select_one_case(options.selectors);
  prepare(options.out);
  const reports::StabilityMap map = stability_map(
      c, {options.over, options.steps, threads_of(options), &cancelled, progress(), options.limit_of, options.at_most});
  if (cancelled) return unstable_or_error;  // what was stopped is neither stable nor unstable
  print("{}\n", reports::stability_text(map, options.within));
  const auto folder = options.out / "stability";
  reports::write_file(folder / (map.case_id + ".csv"), reports::stability_csv(map));
  reports::write_file(folder / (map.case_id + ".json"), reports::stability_json(map, provenance()));
  print("{}\n", (folder / (map.case_id + ".{csv,json}")).string());
  if (const auto figure = stability_figure(map)) {
    reports::Case drawn;
    drawn.figures.push_back(*figure);
    draw_figures({drawn}, folder, {});
  }
  print("{}\n", reports::stability_verdict(map, options.within));
  const auto all = [&](const auto& asked) { return std::all_of(map.limits.begin(), map.limits.end(), asked); };
  if (!all([](const reports::StabilityLimit& one) { return one.stable || one.unstable; })) return unstable_or_error;
  return all([&](const reports::StabilityLimit& one) { return one.agrees(options.within); }) ? all_passed : some_failed;
}

}  // namespace diptych::runner
