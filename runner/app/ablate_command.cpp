// The command ablate.
#include <fmt/core.h>

#include <algorithm>

#include "reports/ablation_table.hpp"
#include "reports/files.hpp"
#include "runner/ablate/ablate.hpp"
#include "runner/app/catalogue.hpp"
#include "runner/app/commands.hpp"
#include "runner/app/keeping.hpp"
#include "runner/app/provenance.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/gates.hpp"

namespace diptych::runner {

int ablate_command(const Options& options, const std::atomic<bool>& cancelled) {
  const Case c = select_one_case(options.selectors);
  prepare(options.out);
  AblationPlan plan;
  plan.scene = options.scene;
  plan.cells = options.cells;
  plan.rounds = options.rounds;
  Running running{threads_of(options), &cancelled};
  running.progress = progress();
  const auto keeping = keeping_of(options);
  running.keeping = keeping.get();
  const reports::AblationStudy study = ablate(c, plan, running);
  tell_kept(keeping.get());
  print("{}", reports::ablation_text(study));
  const auto folder = options.out / "ablate";
  reports::write_file(folder / (study.case_id + ".csv"), reports::ablation_csv(study));
  reports::write_file(folder / (study.case_id + ".json"), reports::ablation_json(study, provenance()));
  print("{}\n", (folder / (study.case_id + ".{csv,json}")).string());
  const bool stopped = std::any_of(study.tried.begin(), study.tried.end(), [](const reports::Ablation& one) {
    return one.stands.status == "cancelled" || one.status == "cancelled";
  });
  return stopped || cancelled ? unstable_or_error : all_passed;
}

}  // namespace diptych::runner
