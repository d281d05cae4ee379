// The history of the platen's displacement.
#include <algorithm>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"

namespace diptych::runner {
namespace {

void draw_history(const Case& c, const FigureSpec& spec, reports::Case& result) {
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = plate_notes(c, spec);
  figure.x_label = "time t [ms]";
  figure.y_label = "displacement of the platen [mm]";
  figure.x_max = c.times.back() * 1e3;
  figure.y_min = figure.y_max = 0;
  reports::Figure::Panel panel;
  for (const std::string& method : spec.methods) {
    const reports::Run* run = find_run(result.runs, spec, method);
    if (!run) {
      figure.notes.push_back(method + " is missing: its run did not complete");
      continue;
    }
    reports::Curve curve = run->platen;
    for (double& t : curve.x) t *= 1e3;
    for (double& u : curve.y) {
      u *= 1e3;
      figure.y_min = std::min(figure.y_min, u);
      figure.y_max = std::max(figure.y_max, u);
    }
    panel.series.push_back({name_of_method(method), kind_of_method(method), std::move(curve)});
  }
  figure.panels.push_back(std::move(panel));
  const double margin = 0.05 * (figure.y_max - figure.y_min);
  figure.y_min -= margin > 0 ? margin : 1;
  figure.y_max += margin > 0 ? margin : 1;
  result.figures.push_back(std::move(figure));
}

}  // namespace

FigureKind history_kind() {
  return {.id = "history", .scenes = FigureKind::Scenes::plates, .keys = {"cells"}, .add = draw_history};
}

}  // namespace diptych::runner
