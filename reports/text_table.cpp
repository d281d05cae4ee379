#include <fmt/core.h>

#include <algorithm>

#include "reports/table_grids.hpp"
#include "reports/tables.hpp"
#include "reports/text.hpp"

namespace diptych::reports {
namespace {

constexpr std::size_t widest_line = 150;

/// Breaks at spaces so that lines starting `indent` columns in stay within the page.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::size_t used = indent;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find_first_of(" \n", at);
    if (end == std::string::npos) end = text.size();
    const std::string word = text.substr(at, end - at);
    if (used > indent && used + 1 + characters(word) > widest_line) {
      out += "\n" + std::string(indent, ' ');
      used = indent;
    } else if (used > indent) {
      out += ' ';
      ++used;
    }
    out += word;
    used += characters(word);
    at = end + 1;
  }
  return out;
}

std::string text_of(const Grid& grid) {
  std::vector<std::size_t> widths;
  for (const std::string& head : grid.heads) widths.push_back(characters(head));
  for (const Row& row : grid.rows)
    for (std::size_t i = 0; i < row.cells.size(); ++i) widths[i] = std::max(widths[i], characters(row.cells[i]));

  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) text += "  " + to_right(cells[i], widths[i]);
    return text;
  };
  std::string out = "  " + wrapped(grid.title, 2) + "\n" + line(grid.heads) + "\n";
  std::size_t rule = 0;
  for (const std::size_t width : widths) rule += width + 2;
  out += "  " + std::string(rule - 2, '-') + "\n";
  for (const Row& row : grid.rows) {
    const std::string cells = line(row.cells);
    out += cells;
    if (!row.remark.empty()) out += "  " + wrapped(row.remark, characters(cells) + 2);
    out += "\n";
  }
  if (!grid.foot.empty()) out += "  " + grid.foot + "\n";
  return out + "\n";
}

}  // namespace

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
  return printable(out);
}

}  // namespace diptych::reports
