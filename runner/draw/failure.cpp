// The page on a failure wave: the model, what of it is certain and what is ours, what was measured, and what each of
// the variants named does to it. What it says of the model, with its sources, is the case file's.
#include <fmt/core.h>

#include <cmath>

#include "runner/draw/figure_kind.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/draw/prose.hpp"
#include "runner/draw/struck_plate.hpp"
#include "runner/input/case_tables.hpp"

namespace diptych::runner {
namespace {

/// What the model says, how far it is certain, and where it comes from.
struct Statement {
  std::string says, standing, source;
};

/// A table: what some variants do.
struct Comparison {
  std::string heading, says;
  std::vector<std::string> variants;  ///< "" is the case as it stands
};

struct Failure {
  std::vector<std::string> intro, model;  ///< paragraphs: under the title, and on the model
  std::vector<Statement> statements;      ///< on the model
  std::vector<Comparison> sections;
};

void read_failure(Table& t, const Case& c, FigureSpec& figure) {
  Failure options;
  options.intro = t.get("intro", list_of(prose(c)));
  options.model = t.get("model", list_of(prose(c)));
  t.each("statements", [&](Table& s) {
    Statement statement;
    statement.says = s.need("says", prose(c));
    statement.standing = s.need("standing", one_of({"certain", "reconstruction", "choice"}));
    statement.source = s.need("source", prose(c));
    options.statements.push_back(statement);
  });
  t.each("sections", [&](Table& s) {
    Comparison section;
    section.heading = s.need("heading", text());
    section.says = s.need("says", prose(c));
    section.variants = s.need("variants", set_of(one_of(variants_of(c))));
    options.sections.push_back(section);
  });
  figure.pictures = t.get("pictures", set_of(id()));
  need_gauges(t, c, figure);
  figure.options = options;
}

void check_failure(const Place& figures, const Case& c, const FigureSpec& page) {
  Names drawn;
  for (const FigureSpec& figure : c.figures)
    if (figure.kind == "gauges") drawn.push_back(figure.id);
  for (const std::string& picture : page.pictures)
    if (!contains(drawn, picture))
      figures.say("found " + words(picture) + " among the pictures of " + words(page.id) +
                  "; allowed: figures of kind gauges of this case, " + joined(drawn));
}

/// Of a table, in this unit.
std::string cell(double value, double unit = 1, int digits = 4) { return table_cell(value / unit, digits); }

std::vector<std::string> result_columns(const Case& c) {
  std::vector<std::string> columns;
  for (const GaugeSpec& gauge : c.gauges)
    columns.push_back(fmt::format("failure at {:g} mm [µs]", gauge.from_face * 1e3));
  columns.insert(columns.end(),
                 {"speed [km/s]", "delay [µs]", "ratio of arrivals", "σ_x late / elastic", "σ_y late / elastic"});
  return columns;
}

std::vector<std::string> results_of(const Case& c, const reports::Run* run) {
  std::vector<std::string> values;
  for (const GaugeSpec& gauge : c.gauges) values.push_back(cell(measure(run, "gauge." + gauge.id + ".failure"), 1e-6));
  values.push_back(cell(measure(run, "failure.speed"), 1e3));
  values.push_back(cell(measure(run, "failure.delay"), 1e-6));
  values.push_back(cell(measure(run, "failure.slowing")));
  for (const char* what : {".longitudinal", ".lateral"})
    values.push_back(cell(measure(run, "gauge." + c.gauges.front().id + what)));
  return values;
}

void draw_failure(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const auto& options = options_of<Failure>(spec);
  const PlateSpec plate = plate_of(c, "", spec.cells);
  reports::Page page;
  page.title = title_of(c, spec);
  page.intro = {c.why};
  page.intro.insert(page.intro.end(), options.intro.begin(), options.intro.end());
  for (const std::string& note : struck_notes(c, spec, plate)) page.intro.push_back(note + ".");
  reports::Page::Section model;
  model.heading = "The model, and what of it is certain";
  model.text = options.model;
  model.first = "Statement";
  model.columns = {"standing", "source"};
  for (const auto& [says, standing, source] : options.statements)
    model.rows.push_back({says, "", {standing, source}, "", "", false});
  if (!model.text.empty() || !model.rows.empty()) page.sections.push_back(std::move(model));
  for (const std::string& picture : spec.pictures) {
    reports::Page::Section section;
    section.picture = picture + ".svg";
    for (const FigureSpec& other : c.figures)
      if (other.id == picture) section.heading = title_of(c, other);
    section.caption = section.heading;
    page.sections.push_back(std::move(section));
  }
  for (const Comparison& part : options.sections) {
    reports::Page::Section section;
    section.heading = part.heading;
    section.text = {part.says};
    section.first = "Variant, method";
    section.columns = result_columns(c);
    section.columns.insert(section.columns.end(), {"diffusion: node updates a step", "µs a step, this run"});
    for (const std::string& variant : part.variants) {
      std::string says = "the scene of the figures";
      for (const PlateVariant& one : c.variants)
        if (one.id == variant) says = one.says;
      for (const std::string& method : spec.methods) {
        const reports::Run* run = find_run(result.runs, spec, method, variant);
        std::vector<std::string> values = results_of(c, run);
        values.push_back(run ? cell(measure(run, "diffusion.updates"), 1, 5) : "did not complete");
        values.push_back(run ? cell(run->wall_seconds / static_cast<double>(run->steps), 1e-6, 3) : "");
        section.rows.push_back(
            {fmt::format("{}, {}", says, name_of_method(method)), "", std::move(values), "", "", variant.empty()});
      }
    }
    page.sections.push_back(std::move(section));
  }
  result.pages.emplace_back(spec.id, std::move(page));
}

}  // namespace

FigureKind failure_kind() {
  return {.id = "failure",
          .scenes = FigureKind::Scenes::plates,
          .keys = {"intro", "model", "statements", "sections", "pictures", "cells"},
          .draws = FigureKind::Draws::what_there_is,
          .read = read_failure,
          .check = check_failure,
          .add = draw_failure};
}

}  // namespace diptych::runner
