#include "runner/run/runner.hpp"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "runner/input/messages.hpp"
#include "runner/run/deadline.hpp"
#include "runner/run/doubt.hpp"
#include "runner/run/sharing.hpp"

namespace diptych::runner {
namespace {

/// The file and the line of the Courant number that the run has.
std::string place_of_courant(const Case& whole, const Leaf& leaf) {
  for (const Axes& block : whole.axes)
    if (block.line > 0 && contains(block.method, leaf.method) &&
        std::find(block.cells.begin(), block.cells.end(), leaf.cells) != block.cells.end() &&
        std::find(block.courant.begin(), block.courant.end(), leaf.courant) != block.courant.end())
      return fmt::format("{}:{}", whole.path.string(), block.line);
  return whole.path.string();
}

void refuse_unstable(const Case& whole, const Leaf& leaf, const Outlook& ahead) {
  if (whole.allow_unstable) return;
  constexpr double most = 1e12;
  const TimeStep& step = ahead.step;
  if (!(ahead.duration / step.asked <= most))
    throw InputError(fmt::format("{}: axes.courant: {} needs {:g} steps; allowed: at most {:g} steps",
                                 place_of_courant(whole, leaf), leaf.courant, ahead.duration / step.asked, most));
  if (!(step.asked > step.limit * (1 + round_off))) return;  // so it is where the panel knows no limit
  throw InputError(fmt::format(
      "{}: axes.courant: {} for {} with {} cells is a time step of {:.6g}, above the limit {:.6g} (Courant {:.6g}); "
      "allowed are values up to the limit, an [[axes]] of its own for each limit, or [run] allow_unstable = true to "
      "see it blow up",
      place_of_courant(whole, leaf), leaf.courant, leaf.method, leaf.cells, step.asked, step.limit,
      step.limit / step.unit));
}

struct Task {
  std::size_t which, slot;  ///< case, and run of it
  Leaf leaf;
  std::shared_ptr<const Case> c;  ///< as the leaf has it
  TimeStep step{};
  double work = 0;  ///< about as many updates of unknowns
  double steps = 0, seconds = 0;
  std::string refused = {};  ///< why it may not be run, nor any other
  std::string broken = {};   ///< why it alone cannot be
  std::string words = {};    ///< all that its run can see
  std::vector<Task> same{};  ///< of other cases, which get its results, too
};

/// Tasks that make the same run go with the first of them.
void share(std::vector<Task>& tasks, const Running& running) {
  std::map<std::string, std::size_t> first;
  std::vector<Task> made;
  for (Task& task : tasks) {
    task.words = words_of_run(*task.c, task.leaf, running);
    const auto [place, is_new] = first.try_emplace(task.words, made.size());
    if (is_new || running.wanted)
      made.push_back(std::move(task));
    else
      made[place->second].same.push_back(std::move(task));
  }
  tasks = std::move(made);
}

/// Whether a record of the run would be taken for it. One whose bits a gate wants compared is made again, whatever the
/// store has: that it comes out the same is what is asked. Not so of a shard, which judges nothing and goes on where it
/// was.
bool may_be_kept_already(const Task& task, const Running& running) {
  if (!running.keeping || running.keeping->fresh || running.limit_seconds) return false;
  if (running.keeping->only || running.shard) return true;
  return std::none_of(task.c->gates.begin(), task.c->gates.end(), [&](const GateSpec& gate) {
    return gate.quantity.starts_with("bits.") && matches(gate.where, task.leaf);
  });
}

/// What the tasks will take whose runs are not kept.
Ahead all_ahead(const std::vector<Task>& tasks, const Running& running) {
  Ahead all;
  double longest = 0;
  for (const Task& task : tasks) {
    if (may_be_kept_already(task, running) && running.keeping->store.has(task.words)) continue;
    ++all.runs;
    all.steps += task.steps;
    all.most_steps = std::max(all.most_steps, task.steps);
    all.seconds += task.seconds;
    longest = std::max(longest, task.seconds);
  }
  all.seconds = std::max(all.seconds / running.threads, longest);
  return all;
}

std::optional<reports::Run> run_made_before(const Task& task, const Running& running) {
  if (!may_be_kept_already(task, running)) return {};
  auto run = running.keeping->store.find(task.words);
  if (run) ++running.keeping->found;
  return run;
}

void keep_run(const Task& task, const reports::Run& run, Keeping& keeping) {
  if (!worth_keeping(run)) return;
  try {
    keeping.store.keep(task.words, run);
    ++keeping.kept;
  } catch (const std::exception& problem) {
    const std::lock_guard<std::mutex> lock(keeping.telling);
    if (!keeping.trouble) keeping.trouble = problem.what();
  }
}

/// Cases as they are told of, each with a run a leaf that is not made yet, and a task for each of these.
std::vector<reports::Case> described(const std::vector<Case>& cases, const Running& running, std::vector<Task>& tasks) {
  std::vector<reports::Case> results;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    reports::Case result;
    result.id = c.id;
    result.title = c.title;
    result.why = c.why;
    result.claim = c.claim;
    result.path = c.path.string();
    result.time_unit = c.time_unit;
    result.units = c.units;
    const auto judged = [&](const Leaf& leaf) {
      return std::any_of(c.gates.begin(), c.gates.end(), [&](const GateSpec& g) { return matches(g.where, leaf); });
    };
    for (const Leaf& leaf : leaves(c)) {
      if (running.judged_only && !judged(leaf)) continue;
      tasks.push_back({i, result.runs.size(), leaf, case_of(c, leaf)});
      result.runs.push_back(describe(*tasks.back().c, leaf));
    }
    results.push_back(std::move(result));
  }
  return results;
}

/// One by one and in order, so that what comes first is begun first.
template <class Act>
void for_each(std::size_t count, const Running& running, const Act& act) {
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(0, running.threads, [&](int) {
    for (std::size_t k = next++; k < count && !(running.cancelled && *running.cancelled); k = next++) act(k);
  });
}

/// Finds what lies ahead of each task. Throws InputError where one may not be run.
void look_ahead(std::vector<Task>& tasks, const std::vector<Case>& cases, const std::vector<reports::Case>& results,
                const Running& running) {
  for_each(tasks.size(), running, [&](std::size_t t) {
    Task& task = tasks[t];
    Outlook ahead;
    try {
      ahead = outlook(*task.c, task.leaf);
      refuse_unstable(cases[task.which], task.leaf, ahead);
    } catch (const InputError& problem) {
      task.refused = problem.what();
    } catch (const std::exception& problem) {
      task.broken = problem.what();
    }
    task.step = ahead.step;
    const int unknowns = results[task.which].runs[task.slot].unknowns;
    task.work = ahead.updates(unknowns);
    task.steps = ahead.steps();
    task.seconds = ahead.seconds(unknowns);
  });
  for (const Task& task : tasks)
    if (!task.refused.empty()) throw InputError(task.refused);
}

}  // namespace

bool worth_keeping(const reports::Run& run) {
  return run.status == "completed" || run.status == "unstable" || run.status == "left-grid";
}

bool Shard::has(const std::string& words) const {
  return hash_of(words) % static_cast<std::uint64_t>(of) == static_cast<std::uint64_t>(number - 1);
}

int threads_within(int threads, std::size_t runs, int unknowns) {
  constexpr int worth = 10'000;  // unknowns of a thread: with fewer the others wait for each other as long as they work
  const std::size_t spare = static_cast<std::size_t>(threads) / std::max<std::size_t>(runs, 1);
  return std::clamp(unknowns / worth, 1, std::max(1, static_cast<int>(spare)));
}

std::vector<reports::Case> run_cases(const std::vector<Case>& cases, const Running& running) {
  std::vector<Task> tasks;
  std::vector<reports::Case> results = described(cases, running, tasks);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(running.threads));
  // Of each case as it stands and of each variant, which may have an exact solution of its own.
  std::map<std::pair<std::size_t, std::string>, std::string> doubts;
  std::vector<std::pair<const Case*, std::string*>> doubted;
  for (const Task& task : tasks) {
    const auto [doubt, is_new] = doubts.try_emplace({task.which, task.leaf.variant});
    if (is_new) doubted.emplace_back(task.c.get(), &doubt->second);
  }
  look_ahead(tasks, cases, results, running);
  share(tasks, running);
  if (running.shard) {
    const auto of_others = [&](const Task& task) { return !running.shard->has(task.words); };
    for (const Task& task : tasks) {
      if (!of_others(task)) continue;
      results[task.which].runs[task.slot].status = "left out";
      for (const Task& other : task.same) results[other.which].runs[other.slot].status = "left out";
    }
    std::erase_if(tasks, of_others);
  }
  std::size_t total = 0;
  for (const Task& task : tasks) total += 1 + task.same.size();
  if (running.ahead && !(running.cancelled && *running.cancelled)) running.ahead(all_ahead(tasks, running));
  for_each(doubted.size(), running, [&](std::size_t k) {
    try {
      *doubted[k].second = doubt_exact(*doubted[k].first);
    } catch (const std::exception& problem) {  // its own case's trouble, and no other's
      *doubted[k].second = std::string("the exact solution's own test came to no end: ") + problem.what();
    }
  });
  std::stable_sort(tasks.begin(), tasks.end(), [&](const Task& a, const Task& b) {
    return running.cheapest_first ? a.work < b.work : a.work > b.work;
  });

  std::mutex telling;
  std::size_t done = 0;
  // Each run writes its own slot and has the same bits with any number of threads of its own, so neither their number
  // nor their order can touch a bit.
  for_each(tasks.size(), running, [&](std::size_t t) {
    const Task& task = tasks[t];
    reports::Run& run = results[task.which].runs[task.slot];
    const auto wanted = [&] {
      const std::lock_guard<std::mutex> lock(telling);
      return !running.wanted || running.wanted(task.which, task.leaf);
    };
    if (!task.broken.empty()) {
      run.status = "error";
      run.message = task.broken;
    } else if (!wanted()) {
      run.status = "left out";
    } else if (auto before = run_made_before(task, running)) {
      before->case_id = run.case_id;
      run = std::move(*before);
    } else if (running.keeping && running.keeping->only) {
      run.status = "missing";
    } else {
      try {
        Running one = running;
        one.threads_a_run = threads_within(running.threads, tasks.size(), run.unknowns);
        std::optional<Deadline> deadline;
        if (running.limit_seconds) one.cancelled = deadline.emplace(*running.limit_seconds, running.cancelled).stop();
        run = run_leaf(*task.c, task.leaf, task.step, one);
        if (deadline && deadline->passed() && run.status == "cancelled") {
          run.status = "timed out";
          run.message = fmt::format("stopped after {:g} s at step {} of about {:.0f}", *running.limit_seconds,
                                    run.steps, task.steps);
        }
      } catch (const std::exception& problem) {
        run.status = "error";
        run.message = problem.what();
      }
      if (running.keeping) keep_run(task, run, *running.keeping);
    }
    const auto hand_over = [&](const Task& to, reports::Run& result) {
      if (const std::string& doubt = doubts.at({to.which, to.leaf.variant}); !doubt.empty()) result.invalid = doubt;
      const std::lock_guard<std::mutex> lock(telling);
      if (running.finished && result.status != "left out") running.finished(to.which, result);
      if (running.progress) running.progress(++done, total);
    };
    for (const Task& other : task.same) {
      reports::Run& copy = results[other.which].runs[other.slot];
      const std::string id = copy.case_id;
      copy = run;
      copy.case_id = id;
      hand_over(other, copy);
    }
    hand_over(task, run);
  });
  return results;
}

std::vector<PlannedRun> plan_runs(const std::vector<Case>& cases, const Running& running) {
  std::vector<Task> tasks;
  const std::vector<reports::Case> results = described(cases, running, tasks);
  look_ahead(tasks, cases, results, running);
  share(tasks, running);
  std::vector<PlannedRun> planned;
  for (const Task& task : tasks) {
    if (running.shard && !running.shard->has(task.words)) continue;
    const reports::Run& run = results[task.which].runs[task.slot];
    planned.push_back({run.case_id, run.label(), task.words, task.work});
  }
  return planned;
}

}  // namespace diptych::runner
