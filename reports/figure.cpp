#include "reports/figure.hpp"

#include <fmt/core.h>

#include <cmath>
#include <ostream>
#include <stdexcept>

#include "reports/csv.hpp"
#include "reports/curve_frames.hpp"
#include "reports/curve_script.hpp"
#include "reports/gnuplot.hpp"
#include "reports/sheet.hpp"

namespace diptych::reports {
namespace {

std::string csv_of(const Figure& figure) {
  std::string out = csv_heading(figure.id, figure.title, figure.notes);
  out += csv_note("x", figure.x_label) + csv_note("y", figure.y_label);
  bool breaks = false;
  for (const Figure::Panel& panel : figure.panels) {
    if (!panel.x_label.empty()) out += csv_note("x of panel '" + panel.label + "'", panel.x_label);
    if (!panel.y_label.empty()) out += csv_note("y of panel '" + panel.label + "'", panel.y_label);
    for (const Figure::Span& span : panel.spans)
      out += csv_note("span of panel '" + panel.label + "'",
                      fmt::format("x from {} to {}{}{}: {}", span.from, span.to, span.kind.empty() ? "" : ", ",
                                  span.kind, span.label));
    for (const Figure::Mark& mark : panel.marks)
      out += csv_note("mark of panel '" + panel.label + "'",
                      fmt::format("{} = {}: {}", mark.vertical ? 'x' : 'y',
                                  (mark.vertical ? figure.x_powers : figure.y_powers) ? std::pow(10, mark.at) : mark.at,
                                  mark.label));
    for (const Figure::Series& series : panel.series) breaks = breaks || curves::broken(series.curve);
  }
  if (breaks) out += "# nan: a line ends here; the next row begins a new one\n";
  out += "panel,series,x,y\n";
  for (const Figure::Panel& panel : figure.panels)
    for (const Figure::Series& series : panel.series) {
      const std::string start = csv_field(panel.label) + "," + csv_field(series.label) + ",";
      for (std::size_t i = 0; i < series.curve.x.size(); ++i)
        out += start + csv_number(figure.x_powers ? std::pow(10, series.curve.x[i]) : series.curve.x[i]) + "," +
               csv_number(figure.y_powers ? std::pow(10, series.curve.y[i]) : series.curve.y[i]) + "\n";
    }
  return out;
}

void check_figure(const Figure& figure) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("figure '" + figure.id + "': " + why);
  };
  check_id(figure.id);
  if (figure.panels.empty()) refuse("no panels");
  const auto range = [&](double low, double high, const std::string& axis) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
      refuse(fmt::format("{} from {} to {} is no range", axis, low, high));
  };
  range(figure.x_min, figure.x_max, "x");
  range(figure.y_min, figure.y_max, "y");
  for (const Figure::Panel& panel : figure.panels) {
    if (panel.x_range) range((*panel.x_range)[0], (*panel.x_range)[1], "panel '" + panel.label + "', x");
    if (panel.y_range) range((*panel.y_range)[0], (*panel.y_range)[1], "panel '" + panel.label + "', y");
    for (const Figure::Span& span : panel.spans)
      if (!std::isfinite(span.from) || !std::isfinite(span.to) || !(span.from <= span.to))
        refuse(fmt::format("panel '{}', span '{}': from {} to {} is no range", panel.label, span.label, span.from,
                           span.to));
    for (const Figure::Mark& mark : panel.marks)
      if (!std::isfinite(mark.at))
        refuse(fmt::format("panel '{}', mark '{}': {} is no place", panel.label, mark.label, mark.at));
    for (const Figure::Series& series : panel.series)
      if (series.curve.x.size() != series.curve.y.size())
        refuse(fmt::format("panel '{}', series '{}': {} x but {} y", panel.label, series.label, series.curve.x.size(),
                           series.curve.y.size()));
  }
}

}  // namespace

Drawn draw(const Figure& figure, const std::filesystem::path& directory, std::string& message) {
  message.clear();
  check_figure(figure);
  return draw_files(
      figure.id, csv_of(figure), [&](std::ostream& gp) { curves::write_script(gp, figure); }, directory, message);
}

}  // namespace diptych::reports
