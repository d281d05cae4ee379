#include "reports/off_table.hpp"

#include <fmt/core.h>

#include <limits>

#include "reports/json.hpp"

namespace diptych::reports {
namespace {

const char* word_of(OffRow::Kind kind) {
  if (kind == OffRow::Kind::zero) return "zero";
  return kind == OffRow::Kind::idle ? "idle" : "books";
}

const char* word_of(OffRow::Time time) {
  if (time == OffRow::Time::quick) return "quick";
  return time == OffRow::Time::slow ? "SLOW" : "UNSURE";
}

std::string verdict_of(const OffRow& row) {
  if (!row.same_bits) return "FAIL: other bits";
  if (row.bytes > row.least + row.rim) return "FAIL: bytes that the scene does not need";
  if (!row.exact()) return "FAIL: bytes for nothing";
  return row.time() == OffRow::Time::quick ? "PASS" : word_of(row.time());
}

}  // namespace

double OffRow::off_ratio() const {
  if (kind == Kind::zero) return ratio.seconds;
  if (kind == Kind::idle) return std::numeric_limits<double>::quiet_NaN();
  return 1 + (ratio.seconds - 1) / (glance - 1);
}

double OffRow::off_spread() const {
  return kind == Kind::books ? ratio.spread * ratio.seconds / (glance - 1) / off_ratio() : ratio.spread;
}

OffRow::Time OffRow::time() const {
  if (kind == Kind::idle) return Time::quick;
  if (off_ratio() * (1 - off_spread()) > allowed) return Time::slow;
  return off_ratio() <= allowed && off_spread() <= allowed - 1 ? Time::quick : Time::unsure;
}

std::string off_text(const std::vector<OffRow>& rows) {
  std::string out =
      fmt::format("{:<12} {:<6} {:<10} {:>8} {:<6} {:<5} {:>8} {:>8} {:>8} {:>8} {:>7}  verdict\n", "feature", "scene",
                  "method", "points", "second", "bits", "B/point", "more", "ratio", "spread", "off");
  for (const OffRow& row : rows) {
    out += fmt::format("{:<12} {:<6} {:<10} {:>8} {:<6} ", row.feature, row.scene, row.method, row.points,
                       word_of(row.kind));
    if (!row.trouble.empty()) {
      out += row.trouble + '\n';
      continue;
    }
    const std::string off =
        row.kind == OffRow::Kind::idle ? "-" : fmt::format("{:+.1f} %", 100 * (row.off_ratio() - 1));
    out += fmt::format("{:<5} {:>8.1f} {:>8.2f} {:>8.3f} {:>6.1f} % {:>7}  {}\n", row.same_bits ? "same" : "OTHER",
                       row.bytes, row.more, row.ratio.seconds, 100 * row.ratio.spread, off, verdict_of(row));
  }
  return out +
         fmt::format(
             "second: the run beside the one without the feature: zero, it is written and is nothing; idle, it is "
             "there and does\nnothing yet; books, every step is in them. B/point: of the first; more: the second's "
             "beyond it. ratio: of a step's time,\nsecond over first, a median of interleaved pairs, with half "
             "their interquartile range. off: what a scene without the\nfeature pays, at most 2 %: the ratio of "
             "zero; of books, 1/{:.0f} of what they cost, for one step in {:.0f} is watched without\nthem; of idle "
             "nothing is measured: the scene without it holds no byte beyond those that it needs.\n"
             "SLOW: more than 2 %, and by more than the spread; UNSURE: the machine was too busy to tell.\n",
             OffRow::glance - 1, OffRow::glance);
}

std::string off_json(const std::vector<OffRow>& rows, const Provenance& made_by) {
  std::string out;
  for (const OffRow& row : rows) {
    Json one{{"type", "off"},          {"feature", row.feature},      {"scene", row.scene},
             {"method", row.method},   {"second", word_of(row.kind)}, {"points", row.points},
             {"trouble", row.trouble}, {"rounds", row.ratio.rounds}};
    Numbers numbers(one);
    if (row.trouble.empty()) {
      one["same_bits"] = row.same_bits;
      one["exact"] = row.exact();
      if (row.kind != OffRow::Kind::idle) one["time"] = word_of(row.time());
      numbers.put("bytes_per_point", row.bytes);
      numbers.put("needed_per_point", row.least);
      numbers.put("more_per_point", row.more);
      numbers.put("ratio", row.ratio.seconds);
      numbers.put("spread", row.ratio.spread);
      if (row.kind != OffRow::Kind::idle) numbers.put("off_ratio", row.off_ratio());
    }
    numbers.finish();
    out += json_line(one);
  }
  return out + json_line({{"type", "provenance"}, {"env", env_of(made_by)}});
}

}  // namespace diptych::reports
