// [[figure]] of a case file.
#include <fmt/core.h>

#include <algorithm>

#include "runner/input/case_tables.hpp"
#include "runner/input/leaf.hpp"

namespace diptych::runner {
namespace {

/// What figures and pages of gauges have for themselves.
void read_gauge_figure(Table& t, FigureSpec& figure, const Case& c) {
  const auto of = [&](const char* key, const Names& kinds) { return t.applies(key, "kind", figure.kind, kinds); };
  Names gauges, figures;
  for (const GaugeSpec& gauge : c.gauges) gauges.push_back(gauge.id);
  if (of("gauges", {"gauges"})) figure.gauges = t.get("gauges", set_of(one_of(gauges)), gauges);
  if (of("variants", {"gauges"})) figure.variants = t.get("variants", set_of(one_of(variants_of(c))), {""});
  if (of("components", {"gauges"}))
    figure.components = t.need("components", set_of(one_of({"longitudinal", "lateral"})));
  if (of("time_range", {"gauges"})) figure.time_range = t.maybe("time_range", interval());
  if (of("bands", {"gauges"}))
    t.each("bands", [&](Table& b) {
      SpeedBand band;
      band.label = b.need("label", text());
      const auto speed = b.need("speed", one_or_set_of(positive()));  // one speed, or from the least to the largest
      if (!speed.empty()) band.speed = {speed.front(), speed.back()};
      if (speed.size() > 2 || !ascending(speed)) b.place("speed").refuse(words(speed), "one speed, or [least, most]");
      band.delay = b.get("delay", interval(not_negative()), {0, 0});
      figure.bands.push_back(band);
    });
  if (of("sections", {"failure"}))
    t.each("sections", [&](Table& s) {
      PageSection section;
      section.heading = s.need("heading", text());
      section.says = s.need("says", text());
      section.variants = s.need("variants", set_of(one_of(variants_of(c))));
      figure.sections.push_back(section);
    });
  if (of("pictures", {"failure"})) figure.pictures = t.get("pictures", set_of(id()));
  // What draws or tabulates histories of gauges needs them: a variant that keeps its flyer.
  const auto struck = [&](const Place& place, const Names& names) {
    for (const PlateVariant& variant : c.variants)
      if (contains(names, variant.id) && !variant.plate.flyer)
        place.refuse(words(variant.id) + ", a variant without a flyer", "variants with [flyer]");
  };
  struck(t.place("variants"), figure.variants);
  if (contains({"gauges", "failure"}, figure.kind) && gauges.empty())
    t.place("kind").refuse(words(figure.kind) + " without a gauge", "with sample.gauges");
}

}  // namespace

FigureSpec read_figure(Table& t, const Case& c) {
  FigureSpec figure;
  figure.id = t.need("id", id());
  if (!figure.id.empty()) t.rename("figure " + words(figure.id) + ": ");
  figure.title = t.get("title", text());
  figure.kind = t.get("kind", one_of(figure_kinds(c)), figure_kinds(c).front());
  const auto of = [&](const char* key, const Names& kinds) { return t.applies(key, "kind", figure.kind, kinds); };
  if (c.plate) {
    if (of("field", {"contours", "choices"}))
      figure.field = t.get("field", one_of({"crack-density", "damage"}), "crack-density");
    if (of("levels", {"contours", "choices"})) figure.levels = t.need("levels", set_of(positive()));
    Names swept, probes, largest;
    for (const auto& entry : all_axes(c).parameters) swept.push_back(entry.first);
    for (const PlateProbe& probe : c.plate_probes) {
      probes.push_back(probe.id);
      if (probe.reads == "largest") largest.push_back(probe.id);
    }
    if (of("over", {"rupture"})) figure.over = t.need("over", one_of(swept));
    if (of("probe", {"rupture"})) figure.probe = t.need("probe", one_of(largest));
    if (of("probes", {"convergence"})) figure.probes = t.need("probes", set_of(one_of(probes)));
    if (of("variant", {"convergence", "rupture"})) figure.variant = t.get("variant", one_of(variants_of(c)));
    read_gauge_figure(t, figure, c);
  } else if (of("field", {"profiles"})) {
    figure.field = t.get("field", one_of(fields), figure.field);
  }
  if (of("times", {"profiles", "contours", "choices", "convergence", "rupture"})) figure.times = read_times(t, c);
  if (figure.kind == "convergence" && figure.times.size() != 1)
    t.place("times").refuse(listed(figure.times), "one time of sample.times.at");
  if (of("captions", {"profiles"})) figure.captions = t.get("captions", list_of(text()));
  if (of("magnify", {"motion"})) figure.magnify = t.get("magnify", positive(), figure.magnify);
  if (of("zoom", {"motion"})) {
    t.maybe_table("zoom", [&](Table& z) { figure.zoom = Zoom{z.need("x", interval()), z.need("t", interval())}; });
  }
  const std::size_t instants = figure.times.empty() ? c.times.size() : figure.times.size();
  if (!figure.captions.empty() && instants > 0 && figure.captions.size() != instants)
    t.place("captions")
        .refuse(fmt::format("{} captions", figure.captions.size()),
                fmt::format("one for each of the {} times", instants));

  // An axis with one value need not be named again.
  const Axes axes = all_axes(c);
  const auto one_of_axis = [&](const char* key, const auto& rule, const auto& axis) {
    if (t.has(key) || axis.size() > 1) return t.need(key, rule);
    return axis.empty() ? std::decay_t<decltype(axis[0])>{} : axis[0];  // empty: the axes' own mistake
  };
  const Names of_all{"convergence", "rupture"};
  const bool of_all_meshes = contains(of_all, figure.kind);
  Names of_one_mesh = figure_kinds(c);
  std::erase_if(of_one_mesh, [&](const std::string& kind) { return contains(of_all, kind); });
  if (of("cells", of_one_mesh)) figure.cells = one_of_axis("cells", number_of_cells(), axes.cells);
  figure.choices = t.get("choices", text());
  figure.methods = t.get("methods", set_of(one_of(methods_of(c))), axes.method);
  const std::size_t before = t.mistakes();
  if (const Node* courant = t.place("courant").node; courant && courant->as<Node::Entries>()) {
    // { fem = 1.0, mpm-musl = 0.1 }: one for each method that is drawn
    t.table("courant", [&](Table& each) {
      for (const std::string& method : figure.methods)
        figure.courants[method] = figure.courant = each.need(method, positive());
      for (const auto& entry : each.entries()) {
        const Place place = each.place(entry.key);
        if (!figure.methods.empty() && !contains(figure.methods, entry.key))
          place.refuse("a method that is not drawn", joined(figure.methods), suggestion(entry.key, figure.methods));
      }
    });
  } else {
    figure.courant = one_of_axis("courant", positive(), axes.courant);
  }
  const bool one_set = t.has("particles") || axes.particles.size() == 1;
  if (one_set) figure.particles = one_of_axis("particles", particles(), axes.particles);
  if (of("range", {"profiles", "contours", "gauges"})) figure.range = t.maybe("range", interval());
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

  bool good =
      (figure.cells > 0 || of_all_meshes) && figure.courant > 0 && !figure.particles.empty() && t.mistakes() == before;
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
  const std::vector<Leaf> runs = leaves(c);
  if (contains({"problem", "convergence", "rupture", "agreement", "gauges", "failure"}, figure.kind))
    return figure;  // of no run, or of many
  for (const std::string& method : figure.methods) {
    const Leaf leaf{method, figure.cells, figure.courant_of(method),
                    panel(method).particles ? figure.particles : std::vector<double>{}, figure.parameters};
    if (good && !runs.empty() && std::find(runs.begin(), runs.end(), leaf) == runs.end())
      t.place("methods").refuse(
          fmt::format("{} with cells = {}, courant = {}{}{}", words(method), leaf.cells, words(leaf.courant),
                      leaf.particles.empty() ? "" : ", particles = " + words(leaf.particles),
                      leaf.parameters.empty() ? "" : ", " + parameters_label(leaf.parameters)),
          "a run of the axes");
  }
  return figure;
}

}  // namespace diptych::runner
