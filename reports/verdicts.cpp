#include "reports/verdicts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace diptych::reports {
namespace {

/// How far outside of its band, in half widths; infinite for what is no number.
double outside(const Check& check) {
  const double middle = (check.low + check.high) / 2, half = (check.high - check.low) / 2;
  if (!std::isfinite(check.judged)) return HUGE_VAL;
  if (std::isfinite(middle)) return (std::abs(check.judged - middle) - half) / std::max(half, std::abs(middle) * 1e-15);
  const double edge = std::isfinite(check.low) ? check.low : check.high;
  return std::abs(check.judged - edge) / std::max(std::abs(edge), 1e-300);
}

std::string why_not_passed(const Gate& gate) {
  const Check* worst = nullptr;
  for (const Check& check : gate.checks)
    if (!check.passed && (!worst || outside(check) > outside(*worst))) worst = &check;
  if (gate.verdict != Verdict::fail || !worst) return gate.message;
  return fmt::format("{}: {:.6g} is not in [{:.6g}, {:.6g}]", worst->what, worst->judged, worst->low, worst->high);
}

/// The features that were active in some run of the case; a scene without any is "plain".
std::set<std::string> features_of(const Case& data) {
  std::set<std::string> features;
  for (const Run& run : data.runs) features.insert(run.features.begin(), run.features.end());
  if (features.empty()) features.insert("(none)");
  return features;
}

}  // namespace

std::string failures_text(const std::vector<Case>& cases) {
  std::string out;
  for (const Case& data : cases) {
    for (const Gate& gate : data.gates) {
      if (gate.verdict == Verdict::pass) continue;
      out += fmt::format("{:8} {}/{}\n         {}\n         {}:{}\n", to_string(gate.verdict), gate.case_id, gate.id,
                         why_not_passed(gate), data.path, gate.line);
    }
  }
  return out;
}

std::string verified_text(const std::vector<Case>& cases) {
  std::map<std::string, std::map<std::string, int>> passed;
  std::set<std::string> kinds;
  for (const Case& data : cases) {
    for (const std::string& feature : features_of(data)) {
      auto& of_feature = passed[feature];
      for (const Gate& gate : data.gates) {
        kinds.insert(gate.kind);
        of_feature[gate.kind] += gate.verdict == Verdict::pass;
      }
    }
  }
  if (kinds.empty()) return {};
  std::string out = fmt::format("{:28}", "gates passed, where active:");
  for (const std::string& kind : kinds) out += fmt::format(" {:>10}", kind);
  out += '\n';
  for (const auto& [feature, of_kind] : passed) {
    out += fmt::format("{:28}", feature);
    for (const std::string& kind : kinds) {
      const auto count = of_kind.find(kind);
      const bool none = count == of_kind.end() || count->second == 0;
      out += fmt::format(" {:>10}", none ? "-" : std::to_string(count->second));
    }
    out += '\n';
  }
  return out + "A dash is what no gate verifies in this way.\n";
}

std::string durations_text(const std::vector<Case>& cases, int most) {
  struct Took {
    double seconds = 0;
    std::string text;
  };
  std::vector<Took> all;
  for (const Case& data : cases) {
    Took took;
    const Run* slowest = nullptr;
    for (const Run& run : data.runs) {
      took.seconds += run.wall_seconds;
      if (!slowest || run.wall_seconds > slowest->wall_seconds) slowest = &run;
    }
    if (!slowest) continue;
    took.text = fmt::format("{:8.2f} s  {}  {} runs, the slowest {:.2f} s: {}\n", took.seconds, data.id,
                            data.runs.size(), slowest->wall_seconds, slowest->label());
    all.push_back(took);
  }
  std::stable_sort(all.begin(), all.end(), [](const Took& a, const Took& b) { return a.seconds > b.seconds; });
  std::string out;
  for (std::size_t i = 0; i < all.size() && i < static_cast<std::size_t>(std::max(most, 0)); ++i) out += all[i].text;
  return out;
}

}  // namespace diptych::reports
