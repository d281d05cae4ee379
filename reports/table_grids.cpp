#include "reports/table_grids.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reports/order_fit.hpp"

namespace diptych::reports {
namespace {

/// Why a run shows no numbers.
std::string remark(const Run& run) {
  const bool completed = run.status == "completed";
  const std::string status = completed ? "invalid" : run.status.empty() ? "no status" : run.status;
  const std::string& why = completed || run.message.empty() ? run.invalid : run.message;
  return why.empty() ? status : status + ": " + why;
}

const Sample* sample_at(const Run& run, double asked) {
  for (const Sample& sample : run.samples)
    if (sample.asked == asked) return &sample;
  return nullptr;
}

bool has_logarithm(double error) { return std::isfinite(error) && error > 0; }

std::string formatted(double value, const char* format) {
  return std::isnan(value) ? "nan" : fmt::format(fmt::runtime(format), value);  // never "-nan"
}
std::string exponent(double value) { return formatted(value, "{:.3e}"); }
std::string fixed(double value) { return formatted(value, "{:.3f}"); }
std::string general(double value) { return formatted(value, "{:.6g}"); }
std::string order_text(const std::optional<double>& order) { return order ? fixed(*order) : "-"; }

std::string ratio_text(double ratio) {
  const double size = std::abs(ratio);
  return ratio == 0 || (size >= 1e-2 && size < 1e3) ? fixed(ratio) : formatted(ratio, "{:.1e}");
}

/// "0.5" or, where values differ, "0.498 to 0.502".
std::string span(const std::vector<double>& values) {
  if (values.empty()) return "-";
  for (const double value : values)
    if (std::isnan(value)) return "nan";
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::string from = general(*low), to = general(*high);
  return from == to ? from : from + " to " + to;
}

std::string fit_text(const Group& group, double asked, const std::string& field) {
  std::string text = "least-squares order:";
  for (const Norm& norm : norms) {
    std::vector<double> sizes, errors;
    for (const Run* run : group.runs)
      if (const FieldError* error = error_of(*run, asked, field)) {
        sizes.push_back(run->cell_size);
        errors.push_back(error->*norm.measured);
      }
    std::string value = "-";
    try {
      const Fit fit = fit_order(sizes, errors);
      const std::string spread = std::isnan(fit.standard_error) ? "n/a" : formatted(fit.standard_error, "{:.2g}");
      value = fmt::format("{} ± {}", fixed(fit.order), spread);
    } catch (const std::invalid_argument&) {
      // Too few levels, or an error that has no logarithm: "-" says so.
    }
    text += fmt::format("  {} {}", norm.name, value);
    if (&norm == &norms.back()) text += fmt::format("  ({} of {} runs)", sizes.size(), group.runs.size());
  }
  return text;
}

}  // namespace

std::vector<Group> groups(const Case& data) {
  std::vector<Group> found;
  for (const Run& run : data.runs) {
    const auto same = [&](const Group& g) {
      return g.first().method == run.method && g.first().particles == run.particles &&
             g.first().parameters == run.parameters && g.first().courant_asked == run.courant_asked;
    };
    const auto place = std::find_if(found.begin(), found.end(), same);
    if (place == found.end())
      found.push_back({{&run}});
    else
      place->runs.push_back(&run);
  }
  for (Group& group : found)
    std::stable_sort(group.runs.begin(), group.runs.end(),
                     [](const Run* a, const Run* b) { return a->cells < b->cells; });
  return found;
}

bool has_numbers(const Run& run) { return run.status == "completed" && run.invalid.empty(); }

const FieldError* error_of(const Run& run, double asked, const std::string& field) {
  const Sample* sample = has_numbers(run) ? sample_at(run, asked) : nullptr;
  if (sample == nullptr) return nullptr;
  for (const FieldError& error : sample->errors)
    if (error.field == field) return &error;
  return nullptr;
}

std::vector<double> times(const Group& group) {
  std::vector<double> found;
  for (const Run* run : group.runs)
    if (has_numbers(*run))
      for (const Sample& sample : run->samples) found.push_back(sample.asked);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::string> fields(const Group& group, double asked) {
  std::vector<std::string> found;
  for (const Run* run : group.runs) {
    const Sample* sample = has_numbers(*run) ? sample_at(*run, asked) : nullptr;
    if (sample == nullptr) continue;
    for (const FieldError& error : sample->errors)
      if (std::find(found.begin(), found.end(), error.field) == found.end()) found.push_back(error.field);
  }
  return found;
}

std::optional<double> pair_order(const Run* coarse, const FieldError* coarse_error, const Run& fine,
                                 const FieldError& fine_error, const Norm& norm) {
  if (coarse == nullptr || coarse_error == nullptr) return std::nullopt;
  const double before = coarse_error->*norm.measured, after = fine_error.*norm.measured;
  if (!std::isfinite(before) || !std::isfinite(after)) return std::numeric_limits<double>::quiet_NaN();
  const double refinement = coarse->cell_size / fine.cell_size;
  if (!has_logarithm(before) || !has_logarithm(after) || !has_logarithm(refinement) || refinement == 1)
    return std::nullopt;
  return std::log(before / after) / std::log(refinement);
}

std::string unit(const Case& data, const std::string& quantity) {
  if (data.units != "SI") return (data.units.empty() ? "case" : data.units) + " units";
  if (quantity == "stress") return "Pa";
  if (quantity == "velocity") return "m/s";
  return "m";
}

std::string group_title(const Group& group) {
  const Run& run = group.first();
  const std::string particles = run.particles.empty() ? "" : ", particles at " + run.particles + " in the cell";
  const std::string swept = run.parameters.empty() ? "" : ", " + run.parameters;
  return fmt::format("{}{}{}, Courant number {} asked", run.method, particles, swept, run.courant_asked);
}

Grid cost_grid(const Case& data, const Group& group) {
  Grid grid;
  grid.title = "Cost";
  grid.heads = {"cells",        "h [" + unit(data, "length") + "]",
                "unknowns",     "Courant used",
                "steps",        group.first().work_unit,
                "node-steps",   "bytes",
                "wall time [s]"};
  for (const Run* run : group.runs) {
    Row row{{std::to_string(run->cells), general(run->cell_size)}, {}};
    if (has_numbers(*run)) {
      const long work = run->element_steps + run->particle_steps;  // of its method one of them is 0
      row.cells.insert(
          row.cells.end(),
          {std::to_string(run->unknowns), general(run->courant), std::to_string(run->steps), std::to_string(work),
           std::to_string(run->node_steps), std::to_string(run->bytes), formatted(run->wall_seconds, "{:.4g}")});
    } else {
      row.remark = remark(*run);
    }
    grid.rows.push_back(row);
  }
  return grid;
}

Grid error_grid(const Case& data, const Group& group, double asked, const std::string& field) {
  std::vector<double> reached, own, scales;
  std::array<bool, norms.size()> predicted{};
  for (const Run* run : group.runs)
    if (const FieldError* error = error_of(*run, asked, field)) {
      reached.push_back(sample_at(*run, asked)->time);
      own.push_back(error->time);
      scales.push_back(error->scale);
      for (std::size_t n = 0; n < norms.size(); ++n)
        predicted[n] = predicted[n] || (error->*norms[n].predicted).has_value();
    }

  Grid grid;
  const bool exactly = span(reached) == span({asked});
  grid.title = fmt::format("{} at t = {} {}{}{}; errors divided by {} {}", field, asked, data.time_unit,
                           exactly ? "" : fmt::format(" (reached {})", span(reached)),
                           own == reached ? "" : fmt::format(", {} at its own level {}", field, span(own)),
                           span(scales), unit(data, field));
  grid.heads = {"cells", "h [" + unit(data, "length") + "]", "t [" + data.time_unit + "]"};
  for (std::size_t n = 0; n < norms.size(); ++n) {
    grid.heads.insert(grid.heads.end(), {norms[n].name, "order"});
    if (predicted[n]) grid.heads.insert(grid.heads.end(), {"predicted", "ratio"});
  }

  const Run* coarse = nullptr;
  const FieldError* coarse_error = nullptr;
  for (const Run* run : group.runs) {
    const FieldError* error = error_of(*run, asked, field);
    Row row{{std::to_string(run->cells), general(run->cell_size)}, {}};
    if (error == nullptr) {
      row.remark = has_numbers(*run) ? "no sample" : remark(*run);
    } else {
      row.cells.push_back(general(error->time));
      for (std::size_t n = 0; n < norms.size(); ++n) {
        const double measured = error->*norms[n].measured;
        row.cells.push_back(exponent(measured));
        row.cells.push_back(order_text(pair_order(coarse, coarse_error, *run, *error, norms[n])));
        if (!predicted[n]) continue;
        const std::optional<double>& expected = error->*norms[n].predicted;
        row.cells.push_back(expected ? exponent(*expected) : "-");
        row.cells.push_back(expected ? ratio_text(measured / *expected) : "-");
      }
    }
    grid.rows.push_back(row);
    coarse = run;
    coarse_error = error;
  }
  grid.foot = fit_text(group, asked, field);
  return grid;
}

Grid books_grid(const Case& data, const Group& group) {
  Grid grid;
  grid.title = "Books (parts of the largest energy and momentum) and probes";
  grid.heads = {"cells", "energy lost", "energy drift", "momentum drift"};
  const Run* shown = nullptr;
  for (const Run* run : group.runs)
    if (has_numbers(*run)) shown = run;
  if (!shown) return {};
  for (const Sample& sample : shown->samples)
    for (const ProbeValue& probe : sample.probes)
      grid.heads.push_back(fmt::format("{} at {} {}", probe.id, general(sample.asked), data.time_unit));
  for (const Run* run : group.runs) {
    if (!has_numbers(*run)) continue;
    Row row{{std::to_string(run->cells)}, {}};
    for (const char* name : {"energy.lost", "energy.drift", "momentum.drift"}) {
      const auto measure = run->measures.find(name);
      row.cells.push_back(measure == run->measures.end() ? "-" : formatted(measure->second, "{:.3e}"));
    }
    for (const Sample& sample : run->samples)
      for (const ProbeValue& probe : sample.probes) row.cells.push_back(formatted(probe.value, "{:.6g}"));
    grid.rows.push_back(row);
  }
  return grid;
}

Grid outcome_grid(const Case& data, const Group& group) {
  static constexpr std::array names{"contact.begin",    "contact.early",       "contact.end",
                                    "contact.duration", "contact.restitution", "plastic.work"};
  Grid grid;
  grid.title = "Impact, measured / exact (" + (data.units == "SI" ? std::string("SI") : data.units + " units") + ")";
  grid.heads = {"cells"};
  std::vector<std::string> shown;
  for (const char* name : names) {
    const auto has = [&](const Run* run) { return has_numbers(*run) && run->measures.count(name) > 0; };
    if (!std::any_of(group.runs.begin(), group.runs.end(), has)) continue;
    shown.emplace_back(name);
    grid.heads.emplace_back(name);
  }
  if (shown.empty()) return {};
  for (const Run* run : group.runs) {
    if (!has_numbers(*run)) continue;
    Row row{{std::to_string(run->cells)}, {}};
    for (const std::string& name : shown) {
      const auto value = run->measures.find(name), exact_value = run->measures.find(name + ".predicted");
      const bool known = value != run->measures.end(), predicted = exact_value != run->measures.end();
      row.cells.push_back(!known ? "-"
                                 : general(value->second) + " / " + (predicted ? general(exact_value->second) : "-"));
    }
    grid.rows.push_back(row);
  }
  return grid;
}

}  // namespace diptych::reports
