#include "runner/draw/figure_kinds.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>

#include "runner/draw/figure_kind.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {

// Each stands in a file of its name.
FigureKind profiles_kind(), motion_kind();  // of bars
FigureKind contours_kind(), problem_kind(), history_kind(), convergence_kind(), rupture_kind(), choices_kind(),
    agreement_kind(), gauges_kind(), failure_kind();  // of plates

Registry<FigureKind>& figure_kinds() {
  static Registry<FigureKind> rows(
      {
          profiles_kind(),
          motion_kind(),
          contours_kind(),
          problem_kind(),
          history_kind(),
          convergence_kind(),
          rupture_kind(),
          choices_kind(),
          agreement_kind(),
          gauges_kind(),
          failure_kind(),
      },
      "a kind of figure");
  return rows;
}

namespace {

std::vector<const FigureKind*> kinds_of(const Case& c) {
  const auto scenes = c.plate ? FigureKind::Scenes::plates : FigureKind::Scenes::bars;
  std::vector<const FigureKind*> kinds;
  for (const FigureKind& kind : figure_kinds())
    if (kind.scenes == scenes) kinds.push_back(&kind);
  return kinds;
}

/// Notes each key that belongs to other kinds of figures of this scene.
void refuse_keys_of_other_figures(Table& t, const FigureSpec& figure, const Case& c) {
  std::map<std::string, Names> owners;
  for (const FigureKind* kind : kinds_of(c))
    for (const std::string& key : kind->keys) owners[key].push_back(kind->id);
  for (const auto& [key, kinds] : owners) t.applies(key, "kind", figure.kind, kinds);
}

/// { fem = 1.0, mpm-musl = 0.1 }: a Courant number for each method that is drawn.
void read_courants(Table& t, FigureSpec& figure) {
  t.table("courant", [&](Table& each) {
    for (const std::string& method : figure.methods)
      figure.courants[method] = figure.courant = each.need(method, positive());
    for (const auto& entry : each.entries()) {
      const Place place = each.place(entry.key);
      if (!figure.methods.empty() && !contains(figure.methods, entry.key))
        place.refuse("a method that is not drawn", joined(figure.methods), suggestion(entry.key, figure.methods));
    }
  });
}

void read_drawn_parameters(Table& t, FigureSpec& figure, const Axes& axes, const Case& c) {
  t.maybe_table("parameters", [&](Table& p) {
    const auto given = read_values(p, c);
    among_swept(t.place("parameters"), given, c);
    for (const auto& [name, values] : given) {
      figure.parameters[name] = values.empty() ? 0 : values.front();
      if (values.size() > 1) p.place(name).refuse(words(values), "one value, for the runs to draw");
    }
  });
  for (const auto& [name, values] : axes.parameters) {
    if (figure.parameters.contains(name) || name == figure.over) continue;
    if (values.size() > 1)
      t.place("parameters")
          .say("missing " + words(name) + ", which is swept; allowed: one value of it, " + joined(values));
    else
      figure.parameters[name] = values.front();
  }
}

/// Which runs are drawn. Returns whether they are named without a mistake.
bool read_runs(Table& t, FigureSpec& figure, bool of_one_mesh, const Axes& axes, const Case& c) {
  // An axis with one value need not be named again.
  const auto one_of_axis = [&](const char* key, const auto& rule, const auto& axis) {
    if (t.has(key) || axis.size() > 1) return t.need(key, rule);
    return axis.empty() ? std::decay_t<decltype(axis[0])>{} : axis[0];  // empty: the axes' own mistake
  };
  if (of_one_mesh) figure.cells = one_of_axis("cells", number_of_cells(), axes.cells);
  figure.methods = t.get("methods", set_of(one_of(methods_of(c))), axes.method);
  const std::size_t before = t.mistakes();
  if (const Node* courant = t.place("courant").node; courant && courant->as<Node::Entries>())
    read_courants(t, figure);
  else
    figure.courant = one_of_axis("courant", positive(), axes.courant);
  const bool one_set = t.has("particles") || axes.particles.size() == 1;
  if (one_set) figure.particles = one_of_axis("particles", particles(), axes.particles);
  read_drawn_parameters(t, figure, axes, c);

  bool good =
      (figure.cells > 0 || !of_one_mesh) && figure.courant > 0 && !figure.particles.empty() && t.mistakes() == before;
  if (figure.cells > 0) good &= among(t.place("cells"), std::vector{figure.cells}, axes.cells, "axes.cells");
  for (const std::string& method : figure.methods) {
    if (figure.courant_of(method) > 0)
      good &= among(t.place("courant"), std::vector{figure.courant_of(method)}, axes.courant, "axes.courant");
  }
  good &= among(t.place("methods"), figure.methods, axes.method, "axes.method");
  if (!figure.particles.empty() && std::any_of(figure.methods.begin(), figure.methods.end(),
                                               [](const std::string& m) { return panel(m).particles; }))
    good &= among(t.place("particles"), std::vector<std::vector<double>>{figure.particles}, axes.particles,
                  "axes.particles");
  return good;
}

/// Each method's run must be one of the axes'.
void check_runs(Table& t, const FigureSpec& figure, const Case& c) {
  const std::vector<Leaf> runs = leaves(c);
  for (const std::string& method : figure.methods) {
    const Leaf leaf{method, figure.cells, figure.courant_of(method),
                    panel(method).particles ? figure.particles : std::vector<double>{}, figure.parameters};
    if (!runs.empty() && std::find(runs.begin(), runs.end(), leaf) == runs.end())
      t.place("methods").refuse(
          fmt::format("{} with cells = {}, courant = {}{}{}", words(method), leaf.cells, words(leaf.courant),
                      leaf.particles.empty() ? "" : ", particles = " + words(leaf.particles),
                      leaf.parameters.empty() ? "" : ", " + parameters_label(leaf.parameters)),
          "a run of the axes");
  }
}

}  // namespace

FigureSpec read_figure(Table& t, const Case& c) {
  FigureSpec figure;
  figure.id = t.need("id", id());
  if (!figure.id.empty()) t.rename("figure " + words(figure.id) + ": ");
  figure.title = t.get("title", text());
  figure.choices = t.get("choices", text());
  Names names;
  for (const FigureKind* kind : kinds_of(c)) names.push_back(kind->id);
  figure.kind = t.get("kind", one_of(names), names.front());
  refuse_keys_of_other_figures(t, figure, c);
  const FigureKind& kind = *figure_kinds().find(figure.kind);
  const auto takes = [&](const char* key) { return contains(kind.keys, std::string(key)); };
  if (takes("times")) figure.times = read_times(t, c);
  if (takes("range")) figure.range = t.maybe("range", interval());
  if (kind.read) kind.read(t, c, figure);
  const bool good = read_runs(t, figure, takes("cells"), all_axes(c), c);
  if (good && kind.draws == FigureKind::Draws::its_runs) check_runs(t, figure, c);
  return figure;
}

void check_figures(const Place& figures, const Case& c) {
  for (const FigureSpec& figure : c.figures)
    if (const FigureKind* kind = figure_kinds().find(figure.kind); kind && kind->check) kind->check(figures, c, figure);
}

void add_figures(const Case& whole, reports::Case& result) {
  for (const FigureSpec& spec : whole.figures) {
    Case c = whole;
    for (const auto& [name, value] : spec.parameters) c.parameters[name] = value;
    figure_kinds().find(spec.kind)->add(c, spec, result);
  }
  for (auto& figure : result.figures) figure.looks = looks();
  for (auto& figure : result.plate_figures) figure.looks = looks();
}

void name_after_case(reports::Case& result) {
  const auto rename = [&](std::string& name) {
    if (!name.empty()) name = result.id + "." + name;
  };
  for (auto& figure : result.figures) rename(figure.id);
  for (auto& figure : result.problem_figures) rename(figure.id);
  for (auto& figure : result.plate_figures) rename(figure.id);
  for (auto& [name, page] : result.pages) {
    rename(name);
    for (auto& section : page.sections) {
      rename(section.picture);
      for (auto& row : section.rows) rename(row.picture);
    }
  }
}

}  // namespace diptych::runner
