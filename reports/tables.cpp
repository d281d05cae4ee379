#include "reports/tables.hpp"

#include <fmt/core.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>

namespace diptych::reports {
namespace {

constexpr std::size_t widest_line = 150;

/// One of the three norms of a FieldError.
struct Norm {
  const char* name;
  double FieldError::*measured;
  std::optional<double> FieldError::*predicted;
};
const std::array<Norm, 3> norms{{{"L1", &FieldError::l1, &FieldError::predicted_l1},
                                 {"L2", &FieldError::l2, &FieldError::predicted_l2},
                                 {"Linf", &FieldError::linf, &FieldError::predicted_linf}}};

/// Runs that differ in the mesh alone, coarse to fine.
struct Group {
  std::vector<const Run*> runs;
  const Run& first() const { return *runs.front(); }
};

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

/// Fields compared at a time, in the order of first mention.
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

bool fits(double error) { return std::isfinite(error) && error > 0; }

/// Order between two neighbouring meshes: nothing where there is none (first row, zero error, same h), NaN where an
/// error is not finite.
std::optional<double> pair_order(const Run* coarse, const FieldError* coarse_error, const Run& fine,
                                 const FieldError& fine_error, const Norm& norm) {
  if (coarse == nullptr || coarse_error == nullptr) return std::nullopt;
  const double before = coarse_error->*norm.measured, after = fine_error.*norm.measured;
  if (!std::isfinite(before) || !std::isfinite(after)) return std::numeric_limits<double>::quiet_NaN();
  const double refinement = coarse->cell_size / fine.cell_size;
  if (!fits(before) || !fits(after) || !fits(refinement) || refinement == 1) return std::nullopt;
  return std::log(before / after) / std::log(refinement);
}

// ---- numbers as text

std::string number(double value, const char* format) {
  return std::isnan(value) ? "nan" : fmt::format(fmt::runtime(format), value);  // never "-nan"
}
std::string exponent(double value) { return number(value, "{:.3e}"); }
std::string fixed(double value) { return number(value, "{:.3f}"); }
std::string general(double value) { return number(value, "{:.6g}"); }
std::string order_text(const std::optional<double>& order) { return order ? fixed(*order) : "-"; }

std::string ratio_text(double ratio) {
  const double size = std::abs(ratio);
  return ratio == 0 || (size >= 1e-2 && size < 1e3) ? fixed(ratio) : number(ratio, "{:.1e}");
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

/// Unit of a quantity in the case's system. Cases in the paper's own units have no names for them.
std::string unit(const Case& data, const std::string& quantity) {
  if (data.units != "SI") return (data.units.empty() ? "case" : data.units) + " units";
  if (quantity == "stress") return "Pa";
  if (quantity == "velocity") return "m/s";
  return "m";
}

// ---- tables, before they are text or LaTeX

struct Row {
  std::vector<std::string> cells;
  std::string remark;  ///< stands in place of the cells after the first two
};

struct Grid {
  std::string title;
  std::vector<std::string> heads;
  std::vector<Row> rows;
  std::string foot;
};

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
           std::to_string(run->node_steps), std::to_string(run->bytes), number(run->wall_seconds, "{:.4g}")});
    } else {
      row.remark = remark(*run);
    }
    grid.rows.push_back(row);
  }
  return grid;
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
      const std::string spread = std::isnan(fit.standard_error) ? "n/a" : number(fit.standard_error, "{:.2g}");
      value = fmt::format("{} ± {}", fixed(fit.order), spread);
    } catch (const std::invalid_argument&) {
      // Too few levels, or an error that has no logarithm: "-" says so.
    }
    text += fmt::format("  {} {}", norm.name, value);
    if (&norm == &norms.back()) text += fmt::format("  ({} of {} runs)", sizes.size(), group.runs.size());
  }
  return text;
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

// ---- text

std::size_t columns(std::string_view text) {  // code points; nothing here is wide or combining
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Breaks at spaces so that lines starting `indent` columns in stay within the page.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::size_t used = indent;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find_first_of(" \n", at);
    if (end == std::string::npos) end = text.size();
    const std::string word = text.substr(at, end - at);
    if (used > indent && used + 1 + columns(word) > widest_line) {
      out += "\n" + std::string(indent, ' ');
      used = indent;
    } else if (used > indent) {
      out += ' ';
      ++used;
    }
    out += word;
    used += columns(word);
    at = end + 1;
  }
  return out;
}

std::string text_of(const Grid& grid) {
  std::vector<std::size_t> widths;
  for (const std::string& head : grid.heads) widths.push_back(columns(head));
  for (const Row& row : grid.rows)
    for (std::size_t i = 0; i < row.cells.size(); ++i) widths[i] = std::max(widths[i], columns(row.cells[i]));

  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += "  " + std::string(widths[i] - columns(cells[i]), ' ') + cells[i];
    return text;
  };
  std::string out = "  " + wrapped(grid.title, 2) + "\n" + line(grid.heads) + "\n";
  std::size_t rule = 0;
  for (const std::size_t width : widths) rule += width + 2;
  out += "  " + std::string(rule - 2, '-') + "\n";
  for (const Row& row : grid.rows) {
    const std::string cells = line(row.cells);
    out += cells;
    if (!row.remark.empty()) out += "  " + wrapped(row.remark, columns(cells) + 2);
    out += "\n";
  }
  if (!grid.foot.empty()) out += "  " + grid.foot + "\n";
  return out + "\n";
}

// ---- LaTeX

/// Characters that need a command: LaTeX's own, and those that its default fonts lack.
const std::map<std::uint32_t, std::string_view>& latex_commands() {
  static const std::map<std::uint32_t, std::string_view> commands{{U'\\', R"(\textbackslash{})"},
                                                                  {U'{', R"(\{)"},
                                                                  {U'}', R"(\})"},
                                                                  {U'$', R"(\$)"},
                                                                  {U'&', R"(\&)"},
                                                                  {U'#', R"(\#)"},
                                                                  {U'%', R"(\%)"},
                                                                  {U'_', R"(\_)"},
                                                                  {U'^', R"(\textasciicircum{})"},
                                                                  {U'~', R"(\textasciitilde{})"},
                                                                  {U'<', "$<$"},
                                                                  {U'>', "$>$"},
                                                                  {U'|', "$|$"},
                                                                  {U'"', "''"},
                                                                  {U'\n', " "},
                                                                  {U'\t', " "},
                                                                  {U'\r', " "},
                                                                  {U'±', R"($\pm$)"},
                                                                  {U'·', R"($\cdot$)"},
                                                                  {U'×', R"($\times$)"},
                                                                  {U'²', "$^2$"},
                                                                  {U'³', "$^3$"},
                                                                  {U'½', R"($\frac12$)"},
                                                                  {U'°', R"($^\circ$)"},
                                                                  {U'µ', R"($\mu$)"},
                                                                  {U'–', "--"},
                                                                  {U'—', "---"},
                                                                  {U'−', "$-$"},
                                                                  {U'…', R"(\ldots{})"},
                                                                  {U'√', R"($\surd$)"},
                                                                  {U'∞', R"($\infty$)"},
                                                                  {U'≤', R"($\leq$)"},
                                                                  {U'≥', R"($\geq$)"},
                                                                  {U'≈', R"($\approx$)"},
                                                                  {U'→', R"($\rightarrow$)"},
                                                                  {U'∂', R"($\partial$)"},
                                                                  {U'Δ', R"($\Delta$)"},
                                                                  {U'α', R"($\alpha$)"},
                                                                  {U'β', R"($\beta$)"},
                                                                  {U'γ', R"($\gamma$)"},
                                                                  {U'δ', R"($\delta$)"},
                                                                  {U'ε', R"($\varepsilon$)"},
                                                                  {U'κ', R"($\kappa$)"},
                                                                  {U'λ', R"($\lambda$)"},
                                                                  {U'μ', R"($\mu$)"},
                                                                  {U'ν', R"($\nu$)"},
                                                                  {U'ξ', R"($\xi$)"},
                                                                  {U'π', R"($\pi$)"},
                                                                  {U'ρ', R"($\rho$)"},
                                                                  {U'σ', R"($\sigma$)"},
                                                                  {U'τ', R"($\tau$)"},
                                                                  {U'φ', R"($\varphi$)"},
                                                                  {U'ω', R"($\omega$)"},
                                                                  {U'‖', R"($\|$)"}};
  return commands;
}

std::string latex_escaped(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto lead = static_cast<unsigned char>(text[at]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    std::uint32_t point = length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t i = 1; i < length && at + i < text.size(); ++i)
      point = (point << 6U) | (static_cast<unsigned char>(text[at + i]) & 0x3FU);
    const auto command = latex_commands().find(point);
    if (command != latex_commands().end())
      out += command->second;
    else if ((point >= 0x20 && point < 0x7F) || (point >= 0xC0 && point <= 0xFF))
      out += text.substr(at, length);
    else
      out += fmt::format("[U+{:04X}]", point);  // rather visible than a document that does not compile
    at += length;
  }
  return out;
}

std::string latex_number(const std::string& cell) {
  if (cell == "-") return "--";
  std::string out;
  for (const char c : cell) out += c == '-' ? std::string("$-$") : std::string(1, c);
  return out;
}

std::string latex_of(const Grid& grid) {
  const std::size_t count = grid.heads.size();
  std::string out = "\\noindent " + latex_escaped(grid.title) + "\\par\\nobreak\\smallskip\n";
  out += "\\begin{center}\\scriptsize\\setlength{\\tabcolsep}{2.5pt}\n\\begin{tabular}{@{}" + std::string(count, 'r') +
         "@{}}\n\\toprule\n";
  for (std::size_t i = 0; i < count; ++i) out += (i == 0 ? "" : " & ") + latex_escaped(grid.heads[i]);
  out += " \\\\\n\\midrule\n";
  for (const Row& row : grid.rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) out += (i == 0 ? "" : " & ") + latex_number(row.cells[i]);
    if (!row.remark.empty())
      out += fmt::format(" & \\multicolumn{{{}}}{{l@{{}}}}{{{}}}", count - row.cells.size(), latex_escaped(row.remark));
    out += " \\\\\n";
  }
  out += "\\bottomrule\n\\end{tabular}\n";
  if (!grid.foot.empty()) out += "\\par\\smallskip " + latex_escaped(grid.foot) + "\n";
  return out + "\\end{center}\n\n";
}

// ---- CSV

std::string quoted(const std::string& text) {  // RFC 4180
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string exact(double value) { return number(value, "{}"); }  // shortest text that reads back as the same double
std::string exact(const std::optional<double>& value) { return value ? exact(*value) : ""; }

std::string csv_line(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + quoted(cells[i]);
  return out + "\n";
}

}  // namespace

Fit fit_order(const std::vector<double>& cell_sizes, const std::vector<double>& errors) {
  if (cell_sizes.size() != errors.size())
    throw std::invalid_argument(
        fmt::format("order fit: {} cell sizes but {} errors", cell_sizes.size(), errors.size()));
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (!fits(cell_sizes[i]) || !fits(errors[i]))
      throw std::invalid_argument(fmt::format("order fit: h = {}, error = {}: both must be positive and finite",
                                              exact(cell_sizes[i]), exact(errors[i])));
  if (errors.empty() || std::all_of(cell_sizes.begin(), cell_sizes.end(), [&](double h) { return h == cell_sizes[0]; }))
    throw std::invalid_argument("order fit: needs at least two distinct cell sizes");

  std::vector<double> x, y;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    x.push_back(std::log(cell_sizes[i]));
    y.push_back(std::log(errors[i]));
  }
  double intercept = 0, slope = 0, cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
  const int status =
      gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &cov00, &cov01, &cov11, &squares);
  if (status != GSL_SUCCESS || !std::isfinite(slope))
    throw std::invalid_argument(fmt::format("order fit: {}", gsl_strerror(status)));
  // Two points leave no residual: GSL then divides zero by zero degrees of freedom.
  const double spread = x.size() > 2 ? std::sqrt(cov11) : std::numeric_limits<double>::quiet_NaN();
  return {slope, spread, static_cast<int>(x.size())};
}

/// What a run's books and probes say, where it has any: all there is to see of a case without an exact solution.
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
      row.cells.push_back(measure == run->measures.end() ? "-" : number(measure->second, "{:.3e}"));
    }
    for (const Sample& sample : run->samples)
      for (const ProbeValue& probe : sample.probes) row.cells.push_back(number(probe.value, "{:.6g}"));
    grid.rows.push_back(row);
  }
  return grid;
}

/// What came of an impact, measured / exact: empty where no bars met and nothing yielded.
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

std::string text_table(const Case& data) {
  std::string out = fmt::format("{}: {}\n", data.id, data.title);
  out += fmt::format("units {}, times in {}; L1, L2, Linf are errors over the bar divided by the stated scale;\n",
                     data.units, data.time_unit);
  out += "order from the row above (positive: converging); ratio = measured / predicted.\n\n";
  for (const Group& group : groups(data)) {
    out += "== " + group_title(group) + " ==\n" + text_of(cost_grid(data, group));
    if (const Grid books = books_grid(data, group); !books.rows.empty()) out += text_of(books);
    if (const Grid outcomes = outcome_grid(data, group); !outcomes.rows.empty()) out += text_of(outcomes);
    for (const double asked : times(group))
      for (const std::string& field : fields(group, asked)) out += text_of(error_grid(data, group, asked, field));
  }
  return out;
}

std::string latex_table(const Case& data) {
  std::string out =
      "% Needs \\usepackage{booktabs} and lines of 16 cm. Times: asked, then reached; order: from the row above.\n";
  out += "\\subsection*{" + latex_escaped(data.id + ": " + data.title) + "}\n\n";
  for (const Group& group : groups(data)) {
    out += "\\subsubsection*{" + latex_escaped(group_title(group)) + "}\n\n" + latex_of(cost_grid(data, group));
    if (const Grid outcomes = outcome_grid(data, group); !outcomes.rows.empty()) out += latex_of(outcomes);
    for (const double asked : times(group))
      for (const std::string& field : fields(group, asked)) out += latex_of(error_grid(data, group, asked, field));
  }
  return out;
}

std::string csv_table(const Case& data) {
  const std::string length = "[" + unit(data, "length") + "]", time = "[" + data.time_unit + "]";
  const std::string seconds = data.units == "SI" ? "[s]" : "[" + data.units + " units]";
  std::string out = csv_line({"case",
                              "method",
                              "particles",
                              "parameters",
                              "cells",
                              "h " + length,
                              "unknowns",
                              "courant asked [-]",
                              "courant used [-]",
                              "time step " + seconds,
                              "time step limit " + seconds,
                              "steps",
                              "element steps",
                              "particle steps",
                              "node steps",
                              "bytes [B]",
                              "wall time [s]",
                              "status",
                              "message",
                              "time asked [" + data.time_unit + "]",
                              "time reached " + time,
                              "field",
                              "field time " + time,
                              "scale",
                              "scale unit",
                              "L1 [-]",
                              "L1 order [-]",
                              "L1 predicted [-]",
                              "L1 ratio [-]",
                              "L2 [-]",
                              "L2 order [-]",
                              "L2 predicted [-]",
                              "L2 ratio [-]",
                              "Linf [-]",
                              "Linf order [-]",
                              "Linf predicted [-]",
                              "Linf ratio [-]"});
  const std::size_t error_columns = 18;  // from "time asked" on

  for (const Group& group : groups(data)) {
    const Run* coarse = nullptr;
    for (const Run* run : group.runs) {
      const bool judged = has_numbers(*run);
      const std::string status = run->status == "completed" && !judged ? "invalid" : run->status;
      const std::string message = run->invalid.empty() || !run->message.empty() ? run->message : run->invalid;
      const std::vector<std::string> about{data.id,
                                           run->method,
                                           run->particles,
                                           run->parameters,
                                           std::to_string(run->cells),
                                           exact(run->cell_size),
                                           std::to_string(run->unknowns),
                                           exact(run->courant_asked),
                                           exact(run->courant),
                                           exact(run->time_step),
                                           exact(run->time_step_limit),
                                           std::to_string(run->steps),
                                           std::to_string(run->element_steps),
                                           std::to_string(run->particle_steps),
                                           std::to_string(run->node_steps),
                                           std::to_string(run->bytes),
                                           exact(run->wall_seconds),
                                           status,
                                           message};
      bool written = false;
      for (const Sample& sample : run->samples) {
        if (!judged) break;
        for (const FieldError& error : sample.errors) {
          std::vector<std::string> cells = about;
          cells.insert(cells.end(), {exact(sample.asked), exact(sample.time), error.field, exact(error.time),
                                     exact(error.scale), unit(data, error.field)});
          const FieldError* before = coarse == nullptr ? nullptr : error_of(*coarse, sample.asked, error.field);
          for (const Norm& norm : norms) {
            const double measured = error.*norm.measured;
            const std::optional<double>& expected = error.*norm.predicted;
            cells.insert(cells.end(), {exact(measured), exact(pair_order(coarse, before, *run, error, norm)),
                                       exact(expected), expected ? exact(measured / *expected) : ""});
          }
          out += csv_line(cells);
          written = true;
        }
      }
      if (!written) {
        std::vector<std::string> cells = about;
        cells.resize(about.size() + error_columns);
        out += csv_line(cells);
      }
      coarse = run;
    }
  }
  return out;
}

std::string ledger_csv(const Run& run) {
  std::string out = "time,kinetic,strain,dissipated,viscous,contact,scheme,work,lost,momentum,impulse\n";
  for (const LedgerLine& line : run.ledger) {
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", line.time, line.kinetic, line.strain, line.dissipated,
                       line.viscous, line.contact, line.scheme, line.work, line.lost, line.momentum, line.impulse);
  }
  return out;
}

}  // namespace diptych::reports
