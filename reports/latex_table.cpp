#include <fmt/core.h>

#include <cstdint>
#include <map>
#include <string_view>

#include "reports/table_grids.hpp"
#include "reports/tables.hpp"

namespace diptych::reports {
namespace {

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

}  // namespace

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

}  // namespace diptych::reports
