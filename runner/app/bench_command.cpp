// The command bench.
#include <fmt/core.h>

#include <algorithm>
#include <thread>

#include "reports/bench_table.hpp"
#include "reports/files.hpp"
#include "reports/off_table.hpp"
#include "runner/app/commands.hpp"
#include "runner/app/provenance.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/gates.hpp"
#include "runner/panel.hpp"
#include "runner/trade/bench.hpp"
#include "runner/trade/bench_scenes.hpp"
#include "runner/trade/off.hpp"
#include "runner/trade/off_scenes.hpp"

namespace diptych::runner {
namespace {

Names usual_methods() {
  Names all;
  for (const std::string& id : panels_for(SceneKind::plate)) {
    if (panel(id).usual) all.push_back(id);
  }
  return all;
}

/// Bits and bytes are the same in every run of the program, and times are the machine's: these count if asked.
int off_command(const Options& options, const std::atomic<bool>& cancelled) {
  Names features;
  for (const OffPair& pair : off_pairs()) features.push_back(pair.feature);
  OffPlan plan{features, usual_methods(), options.points, options.rounds};
  if (!options.selectors.empty()) plan.features = options.selectors;
  if (!options.methods.empty()) plan.methods = options.methods;
  for (const std::string& feature : plan.features) require_one_of("bench --off", feature, features);
  for (const std::string& method : plan.methods) require_one_of("--method", method, panels_for(SceneKind::plate));
  if (options.counts.size() > 1 || (!options.counts.empty() && options.counts[0] != 1))
    throw InputError("--threads: found more than one; allowed with --off: 1");
  prepare_file("--json", options.json, {});
  const std::vector<reports::OffRow> rows = off(plan, &cancelled, progress());
  print("{}", reports::off_text(rows));
  if (!options.json.empty()) reports::write_file(options.json, reports::off_json(rows, provenance()));
  if (cancelled) return unstable_or_error;
  const auto all = [&](auto&& holds) { return std::all_of(rows.begin(), rows.end(), holds); };
  if (!all([](const reports::OffRow& row) { return row.trouble.empty(); })) return unstable_or_error;
  const bool quick = !options.strict_time ||
                     all([](const reports::OffRow& row) { return row.time() == reports::OffRow::Time::quick; });
  return quick && all([](const reports::OffRow& row) { return row.exact(); }) ? all_passed : some_failed;
}

}  // namespace

std::string bench_footer() {
  std::string out = "Example: diptych bench damage diffusion --points 1e5 --threads 1\n";
  for (const BenchScene& scene : bench_scenes()) out += fmt::format("\n  {:<10} {}", scene.id, scene.says);
  out += "\n\nExample: diptych bench --off viscosity books --points 1e5\n";
  for (const OffPair& pair : off_pairs()) out += fmt::format("\n  {:<10} {}", pair.feature, pair.says);
  return out;
}

int bench_command(const Options& options, const std::atomic<bool>& cancelled) {
  if (options.off) return off_command(options, cancelled);
  Names scenes;
  for (const BenchScene& scene : bench_scenes()) scenes.push_back(scene.id);
  BenchPlan plan{scenes, usual_methods(), options.points, options.counts, options.rounds};
  if (!options.selectors.empty()) plan.scenes = options.selectors;
  if (!options.methods.empty()) plan.methods = options.methods;
  for (const std::string& scene : plan.scenes) require_one_of("bench", scene, scenes);
  for (const std::string& method : plan.methods) require_one_of("--method", method, panels_for(SceneKind::plate));
  if (plan.threads.empty()) {
    const int all = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    plan.threads = {1};
    if (all > 1) plan.threads.push_back(all);
  }
  prepare_file("--json", options.json, {});
  const std::vector<reports::BenchRow> rows = bench(plan, &cancelled, progress());
  print("{}", reports::bench_text(rows));
  for (const BenchScene& scene : bench_scenes()) {
    const bool shown = std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.scene == scene.id; });
    if (shown || !contains(plan.scenes, scene.id)) continue;
    tell("{}: no row; {}\n", scene.id,
         scene.bars ? "bars run on one thread (--threads 1)" : "no asked method has particles");
  }
  if (!options.json.empty()) reports::write_file(options.json, reports::bench_json(rows, provenance()));
  return cancelled ? unstable_or_error : all_passed;
}

}  // namespace diptych::runner
