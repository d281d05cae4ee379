// The command line: CLI11 reads it, commands.cpp does it.
#include <gsl/gsl_errno.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "reports/text.hpp"
#include "runner/app/case_file.hpp"
#include "runner/app/commands.hpp"
#include "runner/judge/gates.hpp"
#include "runner/trade/over.hpp"

namespace {

std::atomic<bool> cancelled{false};

// The first Ctrl-C lets the runs at work stop between two steps and keeps what is finished; the second kills.
void on_signal(int number) {
  cancelled = true;
  std::signal(number, SIG_DFL);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace diptych::runner;
  // GSL's handler is one for the whole process and would end it: here, before there are threads, and nowhere else.
  gsl_set_error_handler_off();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGHUP, on_signal);
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is no reason to lose what was to be written elsewhere

  CLI::App app{"Diptych: FEM and MPM side by side, judged against exact solutions and against each other"};
  app.name("diptych");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text());
  Options options;
  int status = usage;

  const auto add_threads = [&](CLI::App* command) {
    command->add_option("-j,--jobs", options.threads, "threads; the results do not depend on it")
        ->check(CLI::Range(1, 1024));
  };
  const auto add_yes = [&](CLI::App* command) {
    command->add_flag("--yes", options.yes, "also begin what takes more than an hour, by a rough estimate");
  };
  const auto add_out = [&](CLI::App* command) {
    command->add_option("--out", options.out, "directory for results")->capture_default_str();
  };
  const auto add_store = [&](CLI::App* command) {
    command
        ->add_option("--store", options.store,
                     "folder in which runs are kept and looked for before they are made; 'none': nowhere; 'store' in "
                     "the directory for results, out, without it")
        ->envname("DIPTYCH_STORE");
    command->add_flag("--fresh", options.fresh, "make every run anew, whatever the store has");
  };
  const auto add_cases = [&](CLI::App* command, bool required) {
    auto* option =
        command->add_option("CASE", options.selectors, "case file, id, or pattern over ids; CASE/GATE for one gate");
    if (required) option->required();
  };

  auto* paper = app.add_subcommand("paper", "write the paper's figures, their data and tables, and judge their cases");
  paper->add_option("FIGURE", options.selectors, "fig1, fig2, fig3, ...; all without one");
  add_out(paper);
  add_yes(paper);
  add_threads(paper);
  add_store(paper);
  paper->callback([&] { status = paper_command(options, cancelled); });

  auto* test = app.add_subcommand("test", "unit tests, gates and planted defects");
  test->add_option("PART", options.selectors,
                   "unit, gates, teeth (the planted defects), cli; all of these without one; recipes, lint");
  test->add_option("-R", options.pattern, "only the tests whose names this regular expression fits");
  test->add_flag("--quick", options.quick, "leave out planted defects and slow gates");
  test->add_flag("--targets", options.targets)->group("");  // for the launcher
  add_threads(test);
  test->callback([&] { status = test_command(options); });

  auto* run = app.add_subcommand("run", "run cases and print convergence tables");
  add_cases(run, true);
  add_out(run);
  bool ledger = false;
  run->add_flag("--ledger", ledger, "also write every step's energies, work, loss and momentum (CSV)");
  run->add_option("--only", options.only,
                  "only runs with this label, 'fem N=100 C=0.5', or pattern over labels, without figures; may be given "
                  "again")
      ->allow_extra_args(false);
  run->add_flag("--fields", options.fields,
                "also write all fields at the sample times: of plates VTU and PVD, for ParaView, of bars CSV");
  add_yes(run);
  add_threads(run);
  add_store(run);
  run->callback([&] {
    options.books = ledger ? diptych::Books::lines : diptych::Books::sums;  // its tables show them
    status = run_command(options, cancelled);
  });

  const auto add_trade = [&](CLI::App* command) {
    add_cases(command, true);
    command
        ->add_option(
            "--over", options.over,
            std::string("more values of an axis or a parameter, courant=0.1:0.9:9, cells=20,40, particles=1,2, "
                        "method=fem; values instead of a key of the case's file, diffusion.scheme=rkl2; "
                        "threads=1,2 of plates, timed. Settings of one scene are compared: what differs in ") +
                numerical_keys + " alone; any other key makes another scene. May be given again")
        ->allow_extra_args(false);
    command->add_option("--scene", options.scene,
                        "variant, swept parameters and changed keys, as runs are labelled; the first without it");
    command->add_option("--quantity", options.quantity,
                        "what is looked at: stress.L2, probe.ID, contact.duration, gauge.ID.arrival");
    command->add_option("--time", options.time, "a sample time, in the case's unit; the last without it");
    command->add_option("--by", options.by,
                        "what is paid in: seconds, updates or bytes; seconds without it, where runs are timed");
    command->add_option("--rounds", options.rounds, "in which every run is timed; 0: not at all")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command->add_option("--limit-seconds", options.limit, "a run that takes longer is stopped, a point \"timed out\"")
        ->check(CLI::PositiveNumber);
    add_threads(command);
    add_store(command);
  };
  auto* trade = app.add_subcommand("trade", "every setting of a case, its error against its cost");
  add_trade(trade);
  add_out(trade);
  trade->footer("Example: diptych trade bar.step.fixed-free --over courant=0.5:0.95:4 --quantity stress.L1");
  trade->callback([&] { status = trade_command(options, cancelled); });

  auto* pick = app.add_subcommand("pick", "the cheapest measured setting of a case that is near enough");
  add_trade(pick);
  pick->add_option("--error", options.error, "at most: 1% or 0.01, of the quantity's scale")->required();
  pick->add_option("--seconds", options.seconds, "at most, on one thread")->check(CLI::PositiveNumber);
  pick->add_option("--memory", options.memory, "at most, of the solver's arrays: 512k, 100M, 1G");
  pick->footer("Example: diptych pick bar.step.fixed-free --error 10% --quantity stress.L1 --time 1.7");
  pick->callback([&] { status = pick_command(options, cancelled); });

  auto* stability =
      app.add_subcommand("stability", "the largest stable time step, load or speed of each setting, beside theory");
  add_cases(stability, true);
  stability
      ->add_option("--over", options.over,
                   "more values of an axis, a parameter or any key of the case: material.nu=0.3,0.49, "
                   "position=0.1:0.9:9 (a cell's one particle), particles=1,2, cells=10,20; the coarsest mesh stands "
                   "for all unless cells are given; may be given again")
      ->allow_extra_args(false);
  stability
      ->add_option(
          "--limit-of", options.limit_of,
          "KEY=LEAST:MOST: under the case's own loads, instead of about rest, up to which courant, parameter or "
          "key of the case runs are stable")
      ->allow_extra_args(false);
  stability->add_option("--at-most", options.at_most,
                        "QUANTITY=NUMBER, probe.ID=0.5: with --limit-of, a run beyond it counts as unstable");
  stability
      ->add_option("--steps", options.steps,
                   "of each look-ahead; growth that it does not show is not seen. 2000 without it; with --limit-of up "
                   "to the case's last sample time")
      ->check(CLI::Range(20L, 1'000'000L));
  stability
      ->add_option("--within", options.within, "part of theory by which a limit may be off; else the status is not 0")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_out(stability);
  add_threads(stability);
  stability->footer(
      "Examples: diptych stability plate.stability --over material.nu=0.3,0.49,0.4999,0.4999999999\n"
      "          diptych stability impact.speed --limit-of courant=0.01:2 --over v0=1,30,60,90");
  stability->callback([&] { status = stability_command(options, cancelled); });

  auto* ablate =
      app.add_subcommand("ablate", "what each feature of a case is worth beside how uncertain its numbers are");
  add_cases(ablate, true);
  ablate->add_option("--scene", options.scene,
                     "variant and swept parameters, as runs are labelled; the first without it");
  ablate->add_option("--cells", options.cells, "of the mesh on which is compared; as fine as is cheap without it")
      ->check(CLI::Range(1, 1'000'000));
  int rounds = 0;
  ablate->add_option("--rounds", rounds, "in which the compared runs are timed; 0: not at all")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  add_out(ablate);
  add_threads(ablate);
  add_store(ablate);
  ablate->footer("Example: diptych ablate impact.hardening --cells 100");
  ablate->callback([&] {
    options.rounds = rounds;
    status = ablate_command(options, cancelled);
  });

  auto* bench = app.add_subcommand("bench", "how quick the solvers' loops are, beside what the memory gives");
  bench->add_option("SCENE", options.selectors, "of those below; all without one");
  bench->add_flag("--off", options.off,
                  "instead, what features cost a scene that does not use them: bits, bytes and time beside the scene "
                  "with the feature, one thread; the status is 10 for bits and bytes");
  bench->add_flag("--strict-time", options.strict_time, "with --off: also for more than 2 % of time")->needs("--off");
  bench
      ->add_option("--method", options.methods,
                   "ids of methods, as cases have them; the usual one of each family without it")
      ->delimiter(',');
  bench->add_option("--points", options.points, "about so many elements or particles: 1e4,1e5,1e6")
      ->delimiter(',')
      ->check(CLI::Range(10.0, 1e8))
      ->capture_default_str();
  bench->add_option("--threads", options.counts, "1,2: of plates; one, and all there are, without it")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024));
  bench->add_option("--rounds", options.rounds, "of which the median is shown")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  bench->add_option("--json", options.json, "also write what was measured to this file (JSON lines)");
  bench->footer(diptych::runner::bench_footer);
  bench->callback([&] { status = bench_command(options, cancelled); });

  auto* gate = app.add_subcommand("gate", "run and judge; 0 only if every declared gate was judged and passed");
  add_cases(gate, false);
  gate->add_flag("--quick", options.quick, "leave out the gates marked slow, and say which");
  gate->add_flag("--fail-fast", options.fail_fast, "make no further runs for a gate that has failed");
  gate->add_flag("--failed", options.failed, "only the gates that did not pass when they were judged last");
  gate->add_flag("-q", options.quiet, "only what did not pass, and the verdict");
  gate->add_flag("-v", options.verbose, "of every gate formula, numbers, prediction and band, as explain has them");
  gate->add_option("--durations", options.durations, "also the N cases that took longest")
      ->check(CLI::Range(1, 10'000));
  gate->add_option("--json", options.json, "also write results to this file (JSON lines)");
  gate->add_option("--junit", options.junit, "also write verdicts to this file (JUnit XML)");
  add_yes(gate);
  add_threads(gate);
  add_store(gate);
  gate->callback([&] { status = gate_command(options, cancelled); });

  auto* explain = app.add_subcommand("explain", "formula, numbers, prediction and margin of a gate");
  explain->add_option("GATE", options.selectors, "CASE/GATE")->required();
  add_yes(explain);
  add_threads(explain);
  add_store(explain);
  explain->callback([&] { status = explain_command(options, cancelled); });

  auto* list = app.add_subcommand("list", "cases and their gates");
  add_cases(list, false);
  list->add_flag("--declarations", options.declarations, "every key of scenes and gates, as in cases/gates.lock");
  list->callback([&] { status = list_command(options); });

  const auto add_shard = [&](CLI::App* command) {
    command->add_option(
        "--shard", options.shard,
        "2/3: only make and keep the second of three parts of the runs; which run is in which part does "
        "not change when cases are added");
    command->add_flag("--dry-run", options.dry_run, "with --shard: only tell which runs those are, and their cost");
  };
  add_shard(run);
  add_shard(gate);
  gate->add_option("--from", options.from, "judge what this store has, and make no run");

  auto* merge = app.add_subcommand("merge", "bring the stores of several machines together");
  merge->add_option("DIR", options.selectors, "stores; together they must have every run that gate needs")->required();
  merge->add_option("--case", options.merged_cases, "of these cases, as gate has them; all without it")
      ->allow_extra_args(false);
  merge->add_option("--out", options.out, "the store to write")->required();
  add_threads(merge);
  merge->footer("Example: diptych merge part1 part2 part3 --out all, then diptych gate --from all");
  merge->callback([&] { status = merge_command(options); });

  auto* store = app.add_subcommand("store", "what is kept of runs that were made");
  store->add_option(
      "WHAT", options.selectors,
      "list; verify: read every record, and name those that are not whole; prune: remove those, and those of "
      "other builds of the program");
  store->add_option("--store", options.store, "its folder; 'store' in the directory for results without it")
      ->envname("DIPTYCH_STORE");
  add_out(store);
  store->add_flag("--all", options.all, "prune: remove all of it");
  store->footer("Example: diptych store verify");
  store->callback([&] { status = store_command(options); });

  auto* show = app.add_subcommand("show", "a case's scene, runs and gates");
  add_cases(show, true);
  show->callback([&] { status = show_command(options); });

  // CLI11 would only say that some command is needed.
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    const std::string near = nearest(argv[1], commands);
    std::fprintf(stderr, "no command '%s'%s; 'diptych --help' names them\n", argv[1],
                 near.empty() ? "" : (" (did you mean '" + near + "'?)").c_str());
    return usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    status = app.exit(error) == 0 ? all_passed : usage;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", diptych::reports::printable(error.what()).c_str());
    return usage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "diptych: %s\n", diptych::reports::printable(error.what()).c_str());
    return unstable_or_error;
  }
  // A verdict that could not be written was not given.
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    std::perror("diptych: standard output");
    return unstable_or_error;
  }
  return status;
}
