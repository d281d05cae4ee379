#include "reports/ablation_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reports/csv.hpp"
#include "reports/json.hpp"
#include "reports/text.hpp"
#include "reports/trade_table.hpp"

namespace diptych::reports {
namespace {

constexpr std::size_t text_width = 120;

std::string number_or_dash(double value, const char* format = "{:.4g}") {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

/// Two digits, and no more than four before the point.
std::string short_number(double value) {
  if (value >= 9999.5) return fmt::format("{:.0e}", value);
  return value >= 9.95 ? fmt::format("{:.0f}", value) : fmt::format("{:.2g}", value);
}

/// Of the scale, in percent.
std::string part_words(double value) {
  if (std::isnan(value)) return "-";
  return value <= AblatedQuantity::round_off ? "0" : short_number(100 * value) + " %";
}

std::string times_words(double times) {
  return std::isnan(times) ? "-"
         : times > 9999    ? ">9999"
         : times < 9.95    ? fmt::format("{:.3g}", times)
                           : short_number(times);
}

/// Text in lines of at most so many characters, all but the first with so many spaces before them.
std::string folded(const std::string& text, std::size_t indent) {
  std::string out, line;
  std::size_t room = text_width;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, end - from);
    if (!line.empty() && characters(line) + 1 + characters(word) > room) {
      out += line + '\n' + std::string(indent, ' ');
      room = text_width - indent;
      line = word;
    } else {
      line += (line.empty() && from == 0 ? "" : " ") + word;
    }
    from = end + 1;
  }
  return out + line + '\n';
}

/// The one of each quantity that changes most by its uncertainty; where that is not known, that changes most.
std::vector<const AblatedQuantity*> most_of_each(const Ablation& ablation) {
  std::vector<const AblatedQuantity*> rows;
  const auto more = [](const AblatedQuantity& a, const AblatedQuantity& b) {
    if (std::isnan(a.times()) != std::isnan(b.times())) return std::isnan(b.times());
    if (std::isnan(a.times())) return a.change > b.change || (std::isnan(b.change) && !std::isnan(a.change));
    return a.times() > b.times();
  };
  for (const AblatedQuantity& one : ablation.quantities) {
    const auto own = std::find_if(rows.begin(), rows.end(),
                                  [&](const AblatedQuantity* row) { return row->quantity == one.quantity; });
    if (own == rows.end())
      rows.push_back(&one);
    else if (more(one, **own))
      *own = &one;
  }
  return rows;
}

std::string where_words(const AblatedQuantity& one, const std::string& unit) {
  return one.quantity + (std::isnan(one.time) ? "" : fmt::format(" at t = {:g} {}", one.time, unit));
}

/// "as many updates", "1/80 of the updates", "1.5 times the updates".
std::string ratio_words(double ratio, const char* of) {
  if (std::abs(ratio - 1) < 5e-3) return fmt::format("as many {}", of);
  if (ratio < 0.75) return fmt::format("1/{:.3g} of the {}", 1 / ratio, of);
  return fmt::format("{:.3g} times the {}", ratio, of);
}

std::string cost_words_of(const Ablation& one) {
  std::string text;
  if (one.stands.work() > 0) text = ratio_words(one.changed.work() / one.stands.work(), "updates");
  if (one.stands.timed.rounds > 0 && one.changed.timed.rounds > 0)
    text += ", " + ratio_words(one.changed.timed.seconds / one.stands.timed.seconds, "seconds") +
            fmt::format(" ({} against {})", time_words(one.changed.timed, " s"), time_words(one.stands.timed, " s"));
  return text;
}

/// "its L2 error goes from 1 % to 3 %", where both are known.
std::string error_words_of(const AblatedQuantity& one) {
  if (!one.field || std::isnan(one.stands) || std::isnan(one.changed)) return "";
  return fmt::format(", its error goes from {} to {}", part_words(one.stands), part_words(one.changed));
}

/// What can be read only as the scene stands: it is told, and decides nothing.
std::string gone_words_of(const Ablation& one) {
  std::vector<std::string> gone;
  for (const AblatedQuantity& q : one.quantities)
    if (std::isnan(q.change) && std::isnan(q.changed) && (q.field || std::abs(q.stands) > 0) &&
        std::find(gone.begin(), gone.end(), q.quantity) == gone.end())
      gone.push_back(q.quantity);
  std::string all;
  for (const std::string& name : gone) all += (all.empty() ? "; gone with it: " : ", ") + name;
  return all;
}

std::string verdict_words(const Ablation& one, const std::string& unit) {
  const Ruling ruling = ruling_of(one);
  const std::string cost = cost_words_of(one), paid = (cost.empty() ? "" : "; " + cost) + gone_words_of(one);
  const auto most = [&] {
    return fmt::format("{} changes by {}, {} times its uncertainty{}", where_words(*ruling.most, unit),
                       part_words(ruling.most->change), times_words(ruling.most->times()),
                       error_words_of(*ruling.most));
  };
  if (one.aid && !std::isnan(ruling.left)) {
    const std::string all = fmt::format(
        "errors and uncertainties become {} times as large in the median ({} of {} fall); at best, {} from {} to "
        "{}",
        times_words(ruling.left), ruling.exceeded, ruling.quantities, where_words(*ruling.most, unit),
        part_words(ruling.most->uncertainty), part_words(ruling.most->uncertainty_changed));
    return (ruling.need == Need::required ? "NOTICED: " : "not noticed: ") + all + paid;
  }
  switch (ruling.need) {
    case Need::required:
      return fmt::format("{}{} ({} of {} quantities notice){}", one.added ? "NOTICED: " : "required: ", most(),
                         ruling.exceeded, ruling.quantities, paid);
    case Need::not_required:
      return fmt::format("{}: at most, {}{}", one.added ? "not noticed" : "NOT REQUIRED HERE: " + one.says, most(),
                         paid);
    case Need::no_difference:
      if (one.status == "idle") return "not noticed: " + one.message;
      return fmt::format("{}: {}: nothing changes{}", one.added ? "not noticed" : "NOT REQUIRED HERE", one.says, paid);
    case Need::not_known: return "not known: something changes, and how uncertain it is takes another mesh" + paid;
    case Need::not_run: break;
  }
  return one.status + (one.message.empty() ? "" : ": " + one.message);
}

std::string table_of(const Ablation& one, const std::string& unit) {
  std::string out =
      folded(fmt::format("{}: {} {}: {}", one.run, one.added ? "with" : "without", one.part, one.says), 4);
  const std::vector<const AblatedQuantity*> rows = most_of_each(one);
  std::size_t widest = 8;
  for (const AblatedQuantity* row : rows) widest = std::max(widest, characters(row->quantity));
  const auto line = [&](const std::string& quantity, const std::vector<std::string>& cells, const std::string& last) {
    out += "    " + to_left(quantity, widest);
    for (const std::string& cell : cells) out += to_right(cell, 13);
    out += "  " + last + '\n';
  };
  line("quantity",
       {"t [" + unit + "]", "as it stands", one.added ? "with" : "without", "change", "uncertainty",
        one.aid ? "with it" : "times"},
       "known by");
  for (const AblatedQuantity* row : rows) {
    const auto value = [&](double number) { return row->field ? part_words(number) : number_or_dash(number); };
    line(row->quantity,
         {number_or_dash(row->time), value(row->stands), value(row->changed), part_words(row->change),
          part_words(row->uncertainty), one.aid ? part_words(row->uncertainty_changed) : times_words(row->times())},
         row->known_by.empty() ? "-" : row->known_by);
  }
  return out + '\n';
}

/// What all runs together say: a part is required, or noticed, where one run says so.
std::string summary_of(const AblationStudy& study, bool added) {
  std::array<std::vector<std::string>, 4> parts;  // yes, no, there is no such scene, not told
  for (const Ablation& part : study.tried) {
    if (part.added != added) continue;
    bool yes = false, no = false, none = true;
    for (const Ablation& one : study.tried) {
      if (one.added != added || one.part != part.part) continue;
      const Need need = ruling_of(one).need;
      yes = yes || need == Need::required;
      no = no || need == Need::not_required || need == Need::no_difference;
      none = none && (one.status == "kept" || one.status == "not tried" || one.status == "refused");
    }
    std::vector<std::string>& names = parts[yes ? 0 : no ? 1 : none ? 2 : 3];
    if (std::find(names.begin(), names.end(), part.part) == names.end()) names.push_back(part.part);
  }
  const auto list = [](const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return all.empty() ? "nothing" : all;
  };
  return folded(fmt::format("{}: {}; {}: {}; {}: {}; not known: {}", added ? "Its result would notice" : "Required",
                            list(parts[0]), added ? "would not" : "not required here", list(parts[1]),
                            added ? "not tried" : "kept", list(parts[2]), list(parts[3])),
                2);
}

}  // namespace

std::string ablation_text(const AblationStudy& study) {
  std::string out = fmt::format("{}: {}\n", study.case_id, study.title);
  for (const std::string& note : study.notes) out += folded("  " + note, 4);
  out += '\n';
  std::size_t widest = 0;
  bool any = false;
  for (const Ablation& one : study.tried) {
    widest = std::max(widest, characters(one.part));
    if (!one.completed() || ruling_of(one).need == Need::no_difference) continue;
    out += table_of(one, study.time_unit);
    any = true;
  }
  if (any)
    out += folded(
               "change, uncertainty: parts of the quantity's largest value or of the exact solution's scale; of a "
               "field the L2 norm of the difference, and its L2 error where it is known; of each quantity the time "
               "at which it changes most by its uncertainty; times: change over uncertainty; with it: the uncertainty "
               "with what was added",
               0) +
           '\n';
  for (const bool added : {false, true}) {
    std::string run;
    for (const Ablation& one : study.tried) {
      if (one.added != added) continue;
      if (one.run != run) {
        run = one.run;
        out += (added ? "Added, one at a time: " : "Taken off, one at a time: ") + run + '\n';
      }
      out += folded("  " + to_left(one.part, widest) + "  " + verdict_words(one, study.time_unit), widest + 4);
    }
  }
  return out + summary_of(study, false) + summary_of(study, true);
}

std::string ablation_csv(const AblationStudy& study) {
  std::string out = csv_note("case", study.case_id) + csv_note("title", study.title) +
                    csv_note("tried", "off: taken off the scene; added: to it") +
                    csv_note("stands, changed",
                             "the quantity as the scene stands and as changed; of a field its L2 "
                             "error, part of the scale, where the exact solution is known") +
                    csv_note("change, uncertainty", "parts of the scale; of a field the L2 norm of the difference") +
                    csv_line({"run",
                              "part",
                              "tried",
                              "says",
                              "status",
                              "message",
                              "updates_stands",
                              "updates_changed",
                              "seconds_stands",
                              "seconds_changed",
                              "quantity",
                              "time_" + study.time_unit,
                              "field",
                              "stands",
                              "changed",
                              "scale",
                              "change",
                              "uncertainty",
                              "uncertainty_changed",
                              "known_by"});
  for (const Ablation& one : study.tried) {
    const auto seconds = [](const TradePoint& point) {
      return point.timed.rounds > 0 ? csv_number(point.timed.seconds) : "";
    };
    const std::vector<std::string> head{one.run,
                                        one.part,
                                        one.added ? "added" : "off",
                                        one.says,
                                        one.status,
                                        one.message,
                                        csv_number(one.stands.work()),
                                        csv_number(one.changed.work()),
                                        seconds(one.stands),
                                        seconds(one.changed)};
    const auto number = [](double value) { return std::isnan(value) ? "" : csv_number(value); };
    for (const AblatedQuantity& q : one.quantities) {
      std::vector<std::string> cells = head;
      cells.insert(cells.end(), {q.quantity, number(q.time), q.field ? "1" : "0", number(q.stands), number(q.changed),
                                 number(q.scale), number(q.change), number(q.uncertainty),
                                 number(q.uncertainty_changed), q.known_by});
      out += csv_line(cells);
    }
    if (!one.quantities.empty()) continue;
    std::vector<std::string> cells = head;
    cells.resize(cells.size() + 10);
    out += csv_line(cells);
  }
  return out;
}

std::string ablation_json(const AblationStudy& study, const Provenance& made_by) {
  const auto name_of = [](Need need) {
    switch (need) {
      case Need::required: return "required";
      case Need::not_required: return "not required";
      case Need::no_difference: return "no difference";
      case Need::not_known: return "not known";
      case Need::not_run: break;
    }
    return "not run";
  };
  Json all{{"type", "ablation"},
           {"case", study.case_id},
           {"title", study.title},
           {"time_unit", study.time_unit},
           {"notes", study.notes}};
  all["tried"] = Json::array();
  for (const Ablation& one : study.tried) {
    Json item{{"run", one.run},
              {"part", one.part},
              {"added", one.added},
              {"says", one.says},
              {"status", one.status},
              {"message", one.message},
              {"verdict", name_of(ruling_of(one).need)},
              {"updates", {one.stands.work(), one.changed.work()}}};
    if (one.stands.timed.rounds > 0 && one.changed.timed.rounds > 0)
      item["seconds"] = {one.stands.timed.seconds, one.changed.timed.seconds};
    item["quantities"] = Json::array();
    for (const AblatedQuantity& q : one.quantities) {
      Json row{{"quantity", q.quantity}, {"field", q.field}, {"known_by", q.known_by}};
      // What is not known is left out.
      for (const auto& [key, value] : {std::pair{"time", q.time},
                                       {"stands", q.stands},
                                       {"changed", q.changed},
                                       {"scale", q.scale},
                                       {"change", q.change},
                                       {"uncertainty", q.uncertainty},
                                       {"uncertainty_changed", q.uncertainty_changed}})
        if (std::isfinite(value)) row[key] = value;
      item["quantities"].push_back(std::move(row));
    }
    all["tried"].push_back(std::move(item));
  }
  all["env"] = env_of(made_by);
  return json_line(all);
}

}  // namespace diptych::reports
