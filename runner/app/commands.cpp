#include "runner/app/commands.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>
#include <set>

#include "reports/files.hpp"
#include "reports/page.hpp"
#include "reports/tables.hpp"
#include "reports/verdicts.hpp"
#include "reports/vtu.hpp"
#include "runner/app/case_file.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/failed_gates.hpp"
#include "runner/app/keeping.hpp"
#include "runner/app/provenance.hpp"
#include "runner/app/showing.hpp"
#include "runner/draw/figure_kinds.hpp"
#include "runner/input/build.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/judge/gates.hpp"
#include "runner/run/runner.hpp"

namespace diptych::runner {
namespace {

/// Runs, judges every gate that could be judged, and makes the figures.
enum class Purpose { judge, show };  // what no gate speaks of is run only to be shown

/// The gates as far as they are known while the runs go on. A gate on single numbers that one run fails has failed,
/// whatever the others say.
class Failed {
 public:
  explicit Failed(const std::vector<Case>& cases) : cases_(cases) {
    for (const Case& c : cases) {
      gates_.emplace_back(c.gates.size());
      leaves_.emplace_back(c);
    }
  }
  void take(std::size_t which, const reports::Run& run) {
    const Case& c = cases_[which];
    for (std::size_t g = 0; g < c.gates.size(); ++g) {
      if (gates_[which][g] || !of_single_numbers(c.gates[g])) continue;
      reports::Gate gate = judge(c, leaves_[which], c.gates[g], {run});
      if (gate.verdict == reports::Verdict::fail) gates_[which][g] = std::move(gate);
    }
  }
  bool wanted(std::size_t which, const Leaf& leaf) const {
    const Case& c = cases_[which];
    for (std::size_t g = 0; g < c.gates.size(); ++g)
      if (!gates_[which][g] && matches(c.gates[g].where, leaf)) return true;
    return false;
  }
  const std::optional<reports::Gate>& gate(std::size_t which, std::size_t g) const { return gates_[which][g]; }

 private:
  const std::vector<Case>& cases_;
  std::vector<Leaves> leaves_;
  std::vector<std::vector<std::optional<reports::Gate>>> gates_;
};

Running running_for(const Options& options, Purpose purpose, const std::atomic<bool>& cancelled) {
  Running running{threads_of(options), &cancelled, options.books, options.fields, purpose == Purpose::judge};
  running.progress = progress();
  return running;
}

/// A store that lacks a run cannot be judged. Throws InputError with those that it lacks.
void require_all(const std::vector<reports::Case>& results, const Options& options) {
  std::vector<std::string> missing;
  for (const auto& result : results)
    for (const auto& run : result.runs)
      if (run.status == "missing") missing.push_back(run.case_id + ": " + run.label());
  if (missing.empty()) return;
  throw InputError(some_of(fmt::format("{}: has no record, made by this build of the program, of {} runs:",
                                       options.from.string(), missing.size()),
                           missing));
}

std::vector<reports::Case> measure_cases(const std::vector<Case>& cases, const Options& options, Purpose purpose,
                                         const std::atomic<bool>& cancelled) {
  const bool judge_only = purpose == Purpose::judge;
  Running running = running_for(options, purpose, cancelled);
  const auto keeping = keeping_of(options);
  running.keeping = keeping.get();
  running.ahead = warning_of(options, !judge_only);
  Failed failed(cases);
  if (options.fail_fast) {
    running.cheapest_first = true;
    running.wanted = [&](std::size_t which, const Leaf& leaf) { return failed.wanted(which, leaf); };
    running.finished = [&](std::size_t which, const reports::Run& run) { failed.take(which, run); };
  }
  auto results = run_cases(cases, running);
  tell_kept(keeping.get());
  require_all(results, options);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Leaves leaves(cases[i]);
    if (!options.only.empty()) continue;  // gates and figures speak of all runs
    for (std::size_t g = 0; g < cases[i].gates.size(); ++g) {
      const GateSpec& gate = cases[i].gates[g];
      if (const auto& known = failed.gate(i, g))
        results[i].gates.push_back(*known);
      else if (!cancelled || all_made(cases[i], gate, results[i].runs))
        results[i].gates.push_back(judge(cases[i], leaves, gate, results[i].runs));
    }
    if (!judge_only) add_figures(cases[i], results[i]);
  }
  return results;
}

void print_gate(const reports::Gate& gate) {
  const auto bits = [](const reports::Check& check) { return check.low == check.high; };
  std::string margin = gate.message;
  if (gate.verdict == reports::Verdict::pass) {
    const bool to_the_bit = std::all_of(gate.checks.begin(), gate.checks.end(), bits);
    margin = to_the_bit ? "exactly" : fmt::format("{:4.0f} % headroom", 100 * gate.headroom());
  }
  print("{:8} {}/{}  {}  {}\n", to_string(gate.verdict), gate.case_id, gate.id, gate.formula, margin);
}

/// Prints the verdict's last line and returns the exit status.
int finish(const std::vector<Case>& cases, const std::vector<reports::Case>& results, int left_out, bool whole,
           bool stopped) {
  int declared = 0;
  for (const Case& c : cases) declared += static_cast<int>(c.gates.size());
  Summary outcome = sum_up(results, declared, left_out);
  if (stopped) {
    outcome.exit_code = unstable_or_error;
    outcome.verdict = "ERROR";
  }
  const auto differences = differences_from_lock(cases, whole);
  if (!differences.empty()) {
    print("\nThe gates are not those of cases/gates.lock:\n");
    for (const auto& line : differences) print("  {}\n", line);
    print("If that is meant: ./diptych list --declarations > cases/gates.lock\n");
    outcome.exit_code = invalid;
    outcome.verdict = "INVALID";
  }
  print("DIPTYCH-VERDICT {} gates={}/{} passed={} left_out={}\n", outcome.verdict, outcome.judged, outcome.declared,
        outcome.passed, outcome.left_out);
  return outcome.exit_code;
}

/// What failed is kept for --failed; where it cannot be, the verdict is the same.
void note_failed(const std::vector<reports::Case>& results, const Options& options) {
  if (options.store == "none" || !options.from.empty()) return;
  try {
    note_failed_gates(store_of(options), results);
  } catch (const std::exception& problem) {
    tell("which gates failed could not be kept: {}\n", problem.what());
  }
}

/// Takes the gates marked slow away and returns their names.
std::vector<std::string> leave_out_slow(std::vector<Case>& cases) {
  std::vector<std::string> left_out;
  for (Case& c : cases) {
    std::erase_if(c.gates, [&](const GateSpec& gate) {
      if (gate.slow) left_out.push_back(c.id + "/" + gate.id);
      return gate.slow;
    });
  }
  std::erase_if(cases, [](const Case& c) { return c.gates.empty(); });
  return left_out;
}

bool was_cancelled(const reports::Case& result) {
  return std::any_of(result.runs.begin(), result.runs.end(),
                     [](const reports::Run& run) { return run.status == "cancelled"; });
}

/// What was stopped does not take the place of what was finished before.
void write_results(const std::vector<reports::Case>& results, const std::filesystem::path& file, bool stopped) {
  if (stopped && std::filesystem::exists(file))
    tell("{} stays as it was\n", file.string());
  else
    reports::write_file(file, reports::results_jsonl(results, provenance()));
}

void write_tables(const reports::Case& result, const std::filesystem::path& directory) {
  if (was_cancelled(result) && std::filesystem::exists(directory / (result.id + ".txt"))) return;
  reports::write_file(directory / (result.id + ".txt"), reports::text_table(result));
  reports::write_file(directory / (result.id + ".csv"), reports::csv_table(result));
  reports::write_file(directory / (result.id + ".tex"), reports::latex_table(result));
}

void write_ledgers(const reports::Case& result, const std::filesystem::path& directory) {
  for (const auto& run : result.runs) {
    std::string name = run.label();
    std::replace(name.begin(), name.end(), ' ', '_');
    reports::write_file(directory / (name + ".csv"), reports::ledger_csv(run));
  }
  print("{}\n", directory.string());
}

/// Of a plate's run one collection for each kind of points (mesh or particles, and cells), of a bar's one table.
void write_fields(const reports::Case& result, const std::filesystem::path& directory) {
  for (const auto& run : result.runs) {
    std::string name = run.label();
    std::replace(name.begin(), name.end(), ' ', '_');
    std::map<std::string, std::vector<std::pair<double, std::string>>> collections;
    for (std::size_t s = 0; s < run.samples.size(); ++s) {
      for (const auto& piece : run.samples[s].files) {
        const std::string file = fmt::format("{}.{}.{:04}.vtu", name, piece.name, s);
        reports::write_vtu(directory / file, piece.mesh, piece.arrays);
        collections[piece.name].emplace_back(run.samples[s].time, file);
      }
    }
    for (const auto& [kind, steps] : collections) {
      const auto path = directory / fmt::format("{}.{}.pvd", name, kind);
      reports::write_pvd(path, steps);
      print("{}\n", path.string());
    }
    if (run.samples.empty()) continue;
    for (const auto& points : run.samples.front().bar_points) {
      const auto path = directory / fmt::format("{}.{}.csv", name, points.kind);
      reports::write_file(path, reports::bar_fields_csv(result, run, points.kind));
      print("{}\n", path.string());
    }
  }
}

bool any_cancelled(const std::vector<reports::Case>& results) {
  std::size_t done = 0, total = 0;
  for (const auto& result : results) {
    for (const auto& run : result.runs) {
      ++total;
      done += run.status != "cancelled";
    }
  }
  if (done < total) tell("stopped on request: {} of {} runs were finished and are kept\n", done, total);
  return done < total;
}

bool all_completed(const std::vector<Case>& cases, const std::vector<reports::Case>& results) {
  bool good = true;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const auto& run : results[i].runs) {
      const bool meant = cases[i].allow_unstable && run.status == "unstable";
      if ((run.status == "completed" && run.invalid.empty()) || meant) continue;
      good = false;
      tell("{}: {}: {} {}\n", run.case_id, run.label(), run.status, run.invalid.empty() ? run.message : run.invalid);
    }
  }
  return good;
}

/// "fig3" means fig3 and fig3a, fig3b; "runaway" also runaway-tracked.
bool names_figure(const std::string& wanted, const std::string& id) {
  if (id == wanted || id.starts_with(wanted + '-')) return true;
  return id.size() == wanted.size() + 1 && id.rfind(wanted, 0) == 0 &&
         std::isalpha(static_cast<unsigned char>(id.back()));
}

}  // namespace

int run_command(const Options& options, const std::atomic<bool>& cancelled) {
  auto cases = select_cases(options.selectors);
  if (!options.only.empty()) keep_runs(cases, options.only);
  if (!options.shard.empty()) return make_shard(cases, running_for(options, Purpose::show, cancelled), options);
  prepare(options.out);
  auto results = measure_cases(cases, options, Purpose::show, cancelled);
  for (auto& result : results) name_after_case(result);  // two cases may call their figures the same
  const bool stopped = any_cancelled(results);
  // Results before tables, tables before pictures: what comes first is there whatever happens to the rest.
  write_results(results, options.out / "results.jsonl", stopped);
  for (const auto& result : results) write_tables(result, options.out / "tables");
  for (const auto& result : results) {
    print("{}\n", reports::text_table(result));
    print("{}\n", (options.out / "tables" / (result.id + ".{txt,csv,tex}")).string());
    if (options.fields) write_fields(result, options.out / "fields" / result.id);
    if (options.books == Books::lines) write_ledgers(result, options.out / "ledgers" / result.id);
  }
  const int undrawn = draw_figures(results, options.out / "figures", {});
  print("{}\n", (options.out / "results.jsonl").string());
  return all_completed(cases, results) && !stopped && undrawn == 0 ? all_passed : unstable_or_error;
}

int gate_command(const Options& options, const std::atomic<bool>& cancelled) {
  if (options.failed && !options.selectors.empty())
    throw InputError("--failed: found with " + listed(options.selectors) + "; allowed: alone, or CASE without it");
  if (options.failed && options.store == "none")
    throw InputError("--failed: found with --store none; allowed: with a store, where it is kept what failed");
  const auto failed = options.failed ? failed_gates(store_of(options)) : Names{};
  if (options.failed)
    tell("{} gates did not pass when they were judged last{}\n", failed.size(),
         failed.empty() ? ": all are judged" : "");
  auto cases = select_cases(options.failed ? failed : options.selectors);
  const auto left_out = options.quick ? leave_out_slow(cases) : std::vector<std::string>{};
  if (!options.shard.empty()) return make_shard(cases, running_for(options, Purpose::judge, cancelled), options);
  prepare_file("--json", options.json, cases);
  prepare_file("--junit", options.junit, cases);
  if (!options.json.empty() && options.json.lexically_normal() == options.junit.lexically_normal())
    throw InputError("--junit: found " + words(options.junit.string()) + ", as --json is; allowed: a file of its own");
  const auto results = measure_cases(cases, options, Purpose::judge, cancelled);
  if (!options.json.empty()) reports::write_file(options.json, reports::results_jsonl(results, provenance()));
  if (!options.junit.empty()) reports::write_file(options.junit, reports::junit_xml(results));
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (const auto& gate : results[i].gates) {
      if (options.verbose)
        print("{}\n", explanation(cases[i], gate));
      else if (!options.quiet)
        print_gate(gate);
    }
  }
  if (!options.quiet)
    for (const std::string& gate : left_out) print("{:8} {}  slow\n", "LEFT OUT", gate);
  const bool stopped = any_cancelled(results);
  note_failed(results, options);
  if (options.durations > 0) print("\n{}", reports::durations_text(results, options.durations));
  if (!options.quiet) print("\n{}", reports::verified_text(results));
  if (const std::string failures = reports::failures_text(results); !failures.empty())
    print("\nNot passed (diptych gate --failed judges these again):\n{}", failures);
  const bool whole = options.selectors.empty() && !options.quick && failed.empty();
  return finish(cases, results, static_cast<int>(left_out.size()), whole, stopped);
}

int explain_command(const Options& options, const std::atomic<bool>& cancelled) {
  const auto cases = select_cases(options.selectors);
  const auto results = measure_cases(cases, options, Purpose::judge, cancelled);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const auto& gate : results[i].gates) print("{}\n", explanation(cases[i], gate));
  }
  int declared = 0;
  for (const Case& c : cases) declared += static_cast<int>(c.gates.size());
  return sum_up(results, declared, 0).exit_code;
}

int list_command(const Options& options) {
  const auto cases = select_cases(options.selectors);
  if (options.declarations) {
    print("{}", declarations(cases));
    return all_passed;
  }
  for (const Case& c : cases) {
    print("{}  {}{}\n", c.id, c.title,
          c.paper_figures.empty() ? "" : fmt::format("  [paper: Fig. {}]", listed(c.paper_figures)));
    for (const GateSpec& gate : c.gates)
      print("    {:24} {:10} {}{}\n", gate.id, gate.kind, gate.quantity, gate.slow ? "  (slow)" : "");
  }
  return all_passed;
}

int paper_command(const Options& options, const std::atomic<bool>& cancelled) {
  auto cases = all_cases();
  std::set<std::string> known, wanted;
  for (const Case& c : cases) {
    for (const FigureSpec& f : c.figures) known.insert(f.id);
  }
  for (const std::string& name : options.selectors) {
    const std::size_t before = wanted.size();
    for (const std::string& id : known) {
      if (names_figure(name, id)) wanted.insert(id);
    }
    if (wanted.size() == before) {
      throw InputError(fmt::format("no figure '{}'; there are: {}", name, listed(known)));
    }
  }
  if (options.selectors.empty()) wanted = known;
  for (const Case& c : cases) {  // a page and the pictures on it go together
    for (const FigureSpec& f : c.figures) {
      const auto asked = [&](const std::string& id) { return wanted.count(id) > 0; };
      if (!asked(f.id) && std::none_of(f.pictures.begin(), f.pictures.end(), asked)) continue;
      if (f.pictures.empty()) continue;
      wanted.insert(f.id);
      wanted.insert(f.pictures.begin(), f.pictures.end());
    }
  }
  std::erase_if(cases, [&](const Case& c) {
    return std::none_of(c.figures.begin(), c.figures.end(),
                        [&](const FigureSpec& f) { return wanted.count(f.id) > 0; });
  });
  const auto out = options.out / "paper";
  prepare(out);
  const auto results = measure_cases(cases, options, Purpose::show, cancelled);
  const bool stopped = any_cancelled(results);
  write_results(results, out / "results.jsonl", stopped);
  for (const auto& result : results) write_tables(result, out / "tables");
  const int undrawn = draw_figures(results, out / "figures", wanted);
  for (const auto& result : results) {
    for (const char* ending : {".txt", ".csv", ".tex"}) print("{}\n", (out / "tables" / (result.id + ending)).string());
  }
  print("{}\n", (out / "results.jsonl").string());
  for (const auto& result : results) {
    for (const auto& gate : result.gates) print_gate(gate);
  }
  const int status = finish(cases, results, 0, false, stopped);
  if (status != all_passed) return status;
  return stopped || undrawn > 0 ? unstable_or_error : all_passed;
}

int test_command(const Options& options) {
  const std::vector<std::string> parts{"unit", "gates", "teeth", "cli", "recipes", "lint"};
  std::vector<std::string> chosen = options.selectors;
  // Recipes and lint are for those who change the program.
  if (chosen.empty()) chosen.assign(parts.begin(), parts.end() - 2);
  for (const std::string& part : chosen) {
    if (contains(parts, part)) continue;
    throw InputError(
        fmt::format("no part of the tests is called '{}'; there are {}{}", part, listed(parts), hint_of(part, parts)));
  }
  if (options.quick) {
    std::erase(chosen, "teeth");
    std::replace(chosen.begin(), chosen.end(), std::string("gates"), std::string("quick"));
    if (chosen.empty()) throw InputError("test teeth --quick: planted defects are what --quick leaves out");
  }
  const auto has = [&](const char* part) { return contains(chosen, part); };
  if (options.targets) {
    print("{}\n", has("unit") && has("teeth") ? "unit_tests planted"
                  : has("unit")               ? "unit_tests"
                  : has("teeth")              ? "planted"
                                              : "");
    return all_passed;
  }
  if (options.quick) print("LEFT OUT  planted defects, and the gates that are marked slow\n");
  std::vector<std::string> words{"ctest",
                                 "--test-dir",
                                 build_directory().string(),
                                 "--output-on-failure",
                                 "-L",
                                 "^(" + listed(chosen, "|") + ")$",
                                 "--no-tests=error",
                                 "-j",
                                 std::to_string(threads_of(options))};
  if (!options.pattern.empty()) words.insert(words.end(), {"-R", options.pattern});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(stdout);
  execvp("ctest", arguments.data());
  throw InputError("ctest could not be started; ./diptych test installs and builds what it needs");
}

std::string version_text() {
  const auto p = provenance();
  return fmt::format("diptych {} ({}{}), {}, flags{}, {}", p.version, p.commit, p.dirty ? ", changed" : "", p.compiler,
                     p.flags, p.os);
}

}  // namespace diptych::runner
