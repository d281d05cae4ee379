// What the command line does, once it is read. Each command returns the process's exit status.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hinge/scene/scene.hpp"

namespace diptych::runner {

struct Options {
  std::vector<std::string> selectors;
  std::filesystem::path out = "out";
  std::filesystem::path json, junit;
  std::filesystem::path store;            ///< where runs are kept; empty: "store" in `out`; "none": nowhere
  std::filesystem::path from;             ///< gate: a store; what is not in it is not made
  std::string shard;                      ///< run, gate: "2/3"; empty: all
  bool dry_run = false;                   ///< with a shard: only tell
  bool fresh = false;                     ///< make all runs anew, whatever the store has
  std::vector<std::string> merged_cases;  ///< merge: whose runs; empty: of all cases
  bool all = false;                       ///< store prune: all of it
  int threads = 0;                        ///< 0: all there are
  bool quick = false;
  bool yes = false;        ///< run, gate, explain, paper: also what takes more than an hour
  bool fail_fast = false;  ///< gate: no further runs for a gate that has failed
  bool failed = false;     ///< gate: only gates that did not pass when they were judged last
  bool quiet = false;      ///< gate: only what failed, and the verdict
  bool verbose = false;    ///< gate: the numbers of every gate
  int durations = 0;       ///< gate: tell of so many cases, the slowest
  bool declarations = false;
  std::vector<std::string> only;  ///< run: the labels of the runs to make; empty: all of them
  bool fields = false;            ///< run: also write all fields at the sample times
  Books books = Books::off;       ///< kept of every run, beside what gates ask for
  std::vector<std::string> over;  ///< trade, pick, stability: more values of the axes
  std::string scene;              ///< trade, pick: variant and parameters, "plane-stress v0=0.1"; empty: the first
  std::string quantity;           ///< trade, pick: "stress.L2"; empty: the first
  std::optional<double> time;     ///< trade, pick: the sample time; none: the last
  std::string by;                 ///< trade, pick: what is paid in; empty: seconds where runs are timed, else updates
  int rounds = 5;                 ///< trade, pick, bench: in which runs are timed
  std::string error;              ///< pick: at most, "1%"
  std::optional<double> seconds;  ///< pick: at most
  std::optional<double> limit;    ///< trade, pick: of each run, which is then stopped [s]
  std::string memory;             ///< pick: at most, "1G"
  int cells = 0;                  ///< ablate: of the mesh on which is compared; 0: as fine as is cheap
  std::vector<std::string> methods;           ///< bench: ids of panels; empty: FEM and MPM, MUSL
  std::vector<double> points{1e4, 1e5, 1e6};  ///< bench: about so many elements or particles
  std::vector<int> counts;                    ///< bench: numbers of threads; empty: one, and all there are
  bool off = false;                           ///< bench: what features cost where they are off
  bool strict_time = false;                   ///< bench --off: the status is not 0 for times, too
  std::optional<long> steps;                  ///< stability: of each look-ahead; none: see StabilityPlan
  std::string limit_of, at_most;              ///< stability: what is sought instead of the step, and within what
  double within = 0.01;                       ///< stability: part of theory by which a limit may be off
  std::string pattern;                        ///< test: only the tests whose names it fits
  bool targets = false;                       ///< test: only name what must be built for them
};

int run_command(const Options&, const std::atomic<bool>& cancelled);
int gate_command(const Options&, const std::atomic<bool>& cancelled);
int explain_command(const Options&, const std::atomic<bool>& cancelled);
int trade_command(const Options&, const std::atomic<bool>& cancelled);
int pick_command(const Options&, const std::atomic<bool>& cancelled);
int bench_command(const Options&, const std::atomic<bool>& cancelled);
int ablate_command(const Options&, const std::atomic<bool>& cancelled);
std::string bench_footer();  ///< of its help: an example, and the scenes that there are
int stability_command(const Options&, const std::atomic<bool>& cancelled);
int list_command(const Options&);
int show_command(const Options&);
int store_command(const Options&);
int merge_command(const Options&);
int paper_command(const Options&, const std::atomic<bool>& cancelled);
int test_command(const Options&);
std::string version_text();

}  // namespace diptych::runner
