// One part of many runs, made on this machine; the parts, brought together.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "reports/files.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/keeping.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/gates.hpp"

namespace diptych::runner {
namespace {

std::optional<int> whole_number(const std::string& digits) {
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? std::optional(number) : std::nullopt;
}

int tell_shard(const std::vector<PlannedRun>& planned, const Keeping& keeping) {
  double kept = 0, all = 0;
  std::size_t there = 0;
  for (const PlannedRun& run : planned) {
    const bool found = !keeping.fresh && keeping.store.find(run.words);
    there += found;
    all += run.updates;
    if (found) kept += run.updates;
    print("{:7} {:40} {:44} {:9.2g} updates\n", found ? "kept" : "to make", run.case_id, run.label, run.updates);
  }
  print("{} runs, {} of them kept in {}; to make: {:.2g} of {:.2g} updates\n", planned.size(), there,
        keeping.store.folder().string(), all - kept, all);
  return all_passed;
}

/// What a merge may hold, by words: of each run a command of these cases makes, its case and label.
std::map<std::string, std::string> known_runs(const std::vector<Case>& cases, const Running& running) {
  std::map<std::string, std::string> known;
  for (const PlannedRun& run : plan_runs(cases, running)) known.emplace(run.words, run.case_id + ": " + run.label);
  return known;
}

}  // namespace

Shard shard_of(const std::string& text) {
  const auto slash = text.find('/');
  const auto number = whole_number(text.substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (!number || !of || *of < 1 || *number < 1 || *number > *of)
    throw InputError(fmt::format("--shard: found {}; allowed: 1/3, 2/3 or 3/3, for the parts of three", words(text)));
  return {*number, *of};
}

int make_shard(const std::vector<Case>& cases, Running running, const Options& options) {
  running.shard = shard_of(options.shard);
  const auto keeping = keeping_of(options);
  if (!keeping) throw InputError("--shard: found with --store none; allowed: with a folder, where its runs are kept");
  if (options.dry_run) return tell_shard(plan_runs(cases, running), *keeping);
  running.keeping = keeping.get();
  bool all = true;
  for (const reports::Case& result : run_cases(cases, running)) {
    for (const reports::Run& run : result.runs) {
      if (run.status == "left out" || worth_keeping(run)) continue;
      all = false;
      tell("{}: {}: {} {}\n", run.case_id, run.label(), run.status, run.message);
    }
  }
  print("shard {}: {} runs made and kept in {}, {} were there\n", options.shard, keeping->kept.load(),
        keeping->store.folder().string(), keeping->found.load());
  if (keeping->trouble) throw InputError("a run could not be kept: " + *keeping->trouble);
  return all ? all_passed : unstable_or_error;
}

int merge_command(const Options& options) {
  const auto cases = select_cases(options.merged_cases);
  Running of_gate{threads_of(options)}, of_run = of_gate;
  of_gate.judged_only = true;
  of_run.books = Books::sums;
  const auto needed = known_runs(cases, of_gate);
  auto known = known_runs(cases, of_run);
  known.insert(needed.begin(), needed.end());

  std::vector<std::string> damaged, foreign, lacking;
  std::map<std::string, std::filesystem::path> of_words;  // a record of each run
  std::map<std::string, std::string> builds;              // and a file of each
  for (const std::string& folder : options.selectors) {
    if (!std::filesystem::is_directory(folder))
      throw InputError(folder + ": is no folder; allowed: stores, out/store of each machine");
    for (const StoredRun& record : Store(folder, "").records()) {
      if (!record.damage.empty()) {
        damaged.push_back(record.file.string() + ": " + record.damage);
        continue;
      }
      builds.emplace(record.build, record.file.string());
      if (known.count(record.words) == 0)
        foreign.push_back(fmt::format("{}: {}: {}", record.file.string(), record.case_id, record.label));
      of_words.emplace(record.words, record.file);
    }
  }
  for (const auto& [run, name] : needed)
    if (of_words.count(run) == 0) lacking.push_back(name);
  std::vector<std::string> wrong;
  if (!damaged.empty()) wrong.push_back(some_of(fmt::format("{} records are not whole:", damaged.size()), damaged));
  if (builds.size() > 1) {
    std::vector<std::string> lines;
    for (const auto& [build, file] : builds) lines.push_back(file + ": " + build);
    wrong.push_back(some_of(fmt::format("{} builds made them; allowed: one:", builds.size()), lines));
  }
  if (!foreign.empty())
    wrong.push_back(some_of(fmt::format("{} runs are of none of these cases:", foreign.size()), foreign));
  if (!lacking.empty())
    wrong.push_back(some_of(fmt::format("{} of {} runs are lacking:", lacking.size(), needed.size()), lacking));
  if (!wrong.empty()) {
    for (const std::string& one : wrong) tell("{}\n", one);
    tell("not merged; nothing was written\n");
    return invalid;
  }
  const Store into(options.out, "");
  for (const auto& [run, file] : of_words) into.copy(file);
  print("{}: {} runs of {} stores\n", options.out.string(), of_words.size(), options.selectors.size());
  return all_passed;
}

}  // namespace diptych::runner
