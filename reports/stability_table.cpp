#include "reports/stability_table.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "reports/csv.hpp"
#include "reports/json.hpp"
#include "reports/text.hpp"

namespace diptych::reports {
namespace {

std::string or_dash(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

/// Time steps to four decimals; loads and speeds to as many digits.
std::string size_words(double number) {
  constexpr double large = 1000;
  return number < large ? fmt::format("{:.4f}", number) : fmt::format("{:.5g}", number);
}

std::string limit_words(const StabilityMap& map, const StabilityLimit& one) {
  if (one.limit()) return size_words(*one.limit());
  if (one.stable) return fmt::format("none to {:g}", map.most);
  return one.unstable ? fmt::format("below {:.2g}", *one.unstable) : "error";
}

std::string csv_or_empty(const std::optional<double>& value) { return value ? csv_number(*value) : ""; }

}  // namespace

std::string stability_text(const StabilityMap& map, double within) {
  std::string out =
      fmt::format("{}: largest {} that is stable; look-ahead {}\n", map.case_id, map.number, map.look_ahead);
  std::size_t widest = 3;
  for (const StabilityLimit& one : map.limits) widest = std::max(widest, characters(one.label));
  const auto line = [&](const std::string& name, const std::string& limit, const std::string& between,
                        const std::string& theory, const std::string& ratio, const std::string& below,
                        const std::string& above) {
    return fmt::format("  {} {:>12} {:>17} {:>8} {:>7} {:>9} {:>9}", to_left(name, widest), limit, between, theory,
                       ratio, below, above);
  };
  out += line("run", "limit", "between", "theory", "ratio", "growth at", "and above") + '\n';
  for (const StabilityLimit& one : map.limits) {
    const std::string below = one.stable ? "faded" : "-", above = one.unstable ? "refused" : "-";
    const std::string between = one.limit() ? size_words(*one.stable) + ".." + size_words(*one.unstable) : "-";
    out += line(one.label, limit_words(map, one), between, one.theory ? size_words(*one.theory) : "-",
                or_dash(one.ratio(), "{:.4f}"), one.growth_below ? fmt::format("{:.1e}", *one.growth_below) : below,
                one.growth_above ? fmt::format("{:.1e}", *one.growth_above) : above);
    out += one.agrees(within) ? "\n" : "  OFF\n";
    if (!one.message.empty()) out += fmt::format("      {}\n", one.message);
  }
  return out + fmt::format("followed: {}\nunstable: {}\ngrowth: of amplitudes, per step\n", map.followed, map.unstable);
}

std::string stability_verdict(const StabilityMap& map, double within) {
  std::size_t known = 0, off = 0;
  for (const StabilityLimit& one : map.limits) {
    known += one.theory.has_value();
    off += !one.agrees(within);
  }
  const std::string head = fmt::format("{} limits, {} with a theory", map.limits.size(), known);
  if (known == 0) return head;
  if (off == 0) return fmt::format("{}, all within {:g} % of it", head, 100 * within);
  return fmt::format("{}, {} off by more than {:g} %", head, off, 100 * within);
}

std::string stability_csv(const StabilityMap& map) {
  std::string out = csv_note("case", map.case_id) + csv_note("title", map.title) + csv_note("number", map.number) +
                    csv_note("look-ahead", map.look_ahead) + csv_note("followed", map.followed) +
                    csv_note("unstable", map.unstable) +
                    csv_note("tried", "from " + csv_number(map.least) + " to " + csv_number(map.most)) +
                    csv_note("growth", "of amplitudes, per step") +
                    csv_line({"run", "setting", "method", map.axis.empty() ? "at" : map.axis, "limit", "stable",
                              "unstable", "growth_below", "growth_above", "theory", "ratio", "message"});
  for (const StabilityLimit& one : map.limits)
    out += csv_line({one.label, one.setting, one.method, csv_or_empty(one.at), csv_or_empty(one.limit()),
                     csv_or_empty(one.stable), csv_or_empty(one.unstable), csv_or_empty(one.growth_below),
                     csv_or_empty(one.growth_above), csv_or_empty(one.theory), csv_or_empty(one.ratio()), one.message});
  return out;
}

std::string stability_json(const StabilityMap& map, const Provenance& made_by) {
  Json all{{"type", "stability"},      {"case", map.case_id},     {"title", map.title},
           {"number", map.number},     {"axis", map.axis},        {"look_ahead", map.look_ahead},
           {"followed", map.followed}, {"unstable", map.unstable}};
  Numbers of_all(all);
  of_all.put("least", map.least);
  of_all.put("most", map.most);
  all["limits"] = Json::array();
  for (const StabilityLimit& one : map.limits) {
    Json item{{"run", one.label}, {"setting", one.setting}, {"method", one.method}, {"message", one.message}};
    Numbers numbers(item);
    numbers.put("at", one.at);
    numbers.put("limit", one.limit());
    numbers.put("stable", one.stable);
    numbers.put("unstable", one.unstable);
    numbers.put("growth_below", one.growth_below);
    numbers.put("growth_above", one.growth_above);
    numbers.put("theory", one.theory);
    numbers.put("ratio", one.ratio());
    of_all.also(numbers.finish());
    all["limits"].push_back(std::move(item));
  }
  of_all.finish();
  all["env"] = env_of(made_by);
  return json_line(all);
}

}  // namespace diptych::reports
