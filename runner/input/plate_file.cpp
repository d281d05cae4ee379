// The schema of a plate's tables as the program reads it, top to bottom as in cases/README.md.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analytic/plane_solutions.hpp"
#include "runner/input/case_checks.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/plate_build.hpp"
#include "runner/input/plate_corners.hpp"
#include "runner/input/plate_solids.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {
namespace {

/// The place of a name that one_of has let through; the first one's where it has not.
template <class Value>
Value in_order(const std::string& name, const Names& names) {
  const auto place = std::find(names.begin(), names.end(), name);
  return place == names.end() ? Value{} : static_cast<Value>(place - names.begin());
}

double seconds(Table& t, const std::string& key, const Rule<double>& number, bool needed) {
  const Rule<Measured> rule = with_unit({"s"}, number);
  return (needed ? t.must(key, rule) : t.maybe(key, rule)).value_or(Measured{0, "s"}).value;
}

/// Expressions of the given variables, one a component; all or none.
template <std::size_t n>
std::array<std::string, n> read_components(Table& t, const std::string& key, const Names& variables, const Case& c) {
  std::array<std::string, n> out;
  const Place place = t.place(key);
  if (!place.node) return out;
  const auto* list = place.node->as<Node::List>();
  if (!list || list->size() != n) {
    place.refuse_value(fmt::format("a list of {} expressions in quotes, one a component", n));
    return out;
  }
  bool good = true;
  for (std::size_t k = 0; k < n; ++k) {
    const Place entry = place.entry(k);
    const auto one = formula().read(entry);
    if (one) check_expression(entry, *one, variables, c);
    good = good && one;
    out[k] = one.value_or("");
  }
  return good ? out : std::array<std::string, n>{};
}

std::string read_formula(Table& t, const std::string& key, const Names& variables, const Case& c) {
  const std::string text = t.get(key, formula());
  check_expression(t.place(key), text, variables, c);
  return text;
}

void read_shape(Table& t, Case& c) {
  PlateSpec& plate = *c.plate;
  plate.width = t.need("width", positive());
  if (t.has("rows")) {
    plate.rows = t.need("rows", whole(1, 10'000));
    for (const char* key : {"height", "cell_aspect"})
      if (t.has(key))
        t.place(key).say("found beside rows; allowed: without it: rows of square cells make the height on every mesh");
    plate.height = plate.rows * plate.width / 100;  // of a mesh to try expressions on; each run has its own
    return;
  }
  plate.height = t.need("height", positive());
  plate.cell_aspect = t.get("cell_aspect", positive(), plate.cell_aspect);
  constexpr double longest = 1e6;
  if (plate.cell_aspect > longest || plate.cell_aspect * longest < 1)
    t.place("cell_aspect").refuse(words(plate.cell_aspect), "1e-6 to 1e6, the height of a cell over its width");
}

/// Of anything, in a scene without a material.
void read_pure_diffusion(Table& t, Case& c) {
  PureDiffusion d;
  const std::string law = t.get("law", one_of({"given", "dilatancy"}), "given");
  if (law == "dilatancy") {
    d.spread = read_spread(t);
    d.scheme = d.spread->scheme;
    for (const char* key : {"diffusivity", "rate", "corner_rate", "reading"})
      if (t.has(key)) t.place(key).say("found with law = \"dilatancy\"; allowed: d0, profile and scheme");
    c.plate->diffusion = d;
    return;
  }
  for (const char* key : {"d0", "profile"})
    if (t.has(key)) t.place(key).say("found without law = \"dilatancy\"; allowed: with it");
  d.diffusivity = t.must("diffusivity", constant_formula()).value_or("1");
  check_expression(t.place("diffusivity"), d.diffusivity, {"x", "y"}, c);
  d.rate = read_formula(t, "rate", {"x", "y", "t"}, c);
  d.corner_rate = t.get("corner_rate", any_number(), 0);
  d.scheme = read_scheme(t, d.scheme);
  d.reading = read_reading(t);
  c.plate->diffusion = d;
}

void read_plate_supports(Table& t, Case& c) {
  using Support = Edge::Support;
  for (std::size_t side = 0; side < 4; ++side) {
    c.plate->supports[side] = in_order<Support>(t.need(side_names[side], one_of(support_names)), support_names);
  }
  const auto& supports = c.plate->supports;
  const bool driven = std::find(supports.begin(), supports.end(), Support::driven) != supports.end();
  c.plate->drive = read_components<2>(t, "velocity", {"x", "y", "t"}, c);
  if (driven && !t.has("velocity"))
    t.place("velocity").say("missing; allowed: the velocity of driven sides, two expressions of x, y and t");
  if (!driven && t.has("velocity")) t.place("velocity").say("found without a driven side; allowed: with one");
  if (std::count(supports.begin(), supports.end(), Support::platen) > 1)
    t.say("found two platens; allowed: at most one");
}

void read_plate_load(Table& t, Case& c) {
  SideLoad load;
  const std::string at = t.need("at", one_of(side_names));
  load.side = in_order<Side>(at, side_names);
  const std::string direction = t.get("direction", one_of({"normal", "shear"}));
  load.shear = direction == "shear";
  load.history = t.need("history", one_of({"step", "ramp", "impulse", "expression"}));
  const Place traction = t.place("traction");
  if (load.history == "expression") {
    load.traction = t.need("traction", formula());
    check_expression(traction, load.traction, {"t"}, c);
  } else {
    load.traction = t.must("traction", constant_formula()).value_or("0");
    if (!check_constant(traction, load.traction, c)) load.traction = "0";
  }
  if (t.applies("start", "history", load.history, {"step", "ramp", "impulse"}))
    load.start = seconds(t, "start", not_negative(), false);
  if (t.applies("rise", "history", load.history, {"ramp"})) load.rise = seconds(t, "rise", positive(), true);
  if (t.applies("duration", "history", load.history, {"impulse"}))
    load.duration = seconds(t, "duration", positive(), true);
  if (at.empty() || (t.has("direction") && direction.empty())) return;
  using Support = Edge::Support;
  const Support support = c.plate->supports[static_cast<std::size_t>(load.side)];
  const bool held = support == Support::fixed || support == Support::driven ||
                    (load.shear ? support == Support::platen : support == Support::roller);
  if (held)
    t.place("at").refuse(fmt::format("a {} load on the {} side, which is held so", load.shear ? "shear" : "normal", at),
                         "loads on what is free to move");
  for (const SideLoad& other : c.plate->loads)
    if (other.side == load.side && other.shear == load.shear)
      t.place("at").refuse("a second load of this kind on the " + at + " side", "one of each direction on each side");
  c.plate->loads.push_back(load);
}

void read_plate_initial(Table& t, Case& c) {
  if (c.plate->solid) {
    c.plate->initial_velocity = read_components<2>(t, "velocity", {"x", "y"}, c);
    c.plate->initial_displacement = read_components<2>(t, "displacement", {"x", "y"}, c);
    if (c.plate->failing()) c.plate->initial_concentration = read_formula(t, "dilatancy", {"x", "y"}, c);
  } else if (!c.plate->diffusion || !c.plate->diffusion->spread) {
    c.plate->initial_concentration = read_formula(t, "concentration", {"x", "y"}, c);
  }
}

void read_flyer(Table& t, Case& c) {
  FlyerSpec flyer;
  flyer.thickness = t.need("thickness", positive());
  flyer.velocity = t.need("velocity", positive());
  const Measured gap = t.maybe("gap", with_unit({"m", "cells"}, not_negative())).value_or(Measured{0, "m"});
  flyer.gap = gap.value;
  flyer.gap_unit = gap.unit;
  const double width = c.plate->width;
  if (width > 0 && flyer.thickness >= width)
    t.place("thickness")
        .refuse(words(flyer.thickness), "less than the plate's width, " + words(width) + ": the rest is the target");
  using Support = Edge::Support;
  for (std::size_t side = 0; side < 4; ++side)
    if (c.plate->supports[side] == Support::driven || c.plate->supports[side] == Support::platen)
      t.say("found beside a driven side or a platen; allowed: free sides, rollers and fixed ones");
  c.plate->flyer = flyer;
}

/// Eq. 21; the other form stands in no plate yet.
void read_plate_viscosity(Table& t, Case& c) {
  material::Viscosity v;
  t.need("form", one_of({"york"}));
  v.c1 = t.need("c1", not_negative());
  v.c2 = t.need("c2", not_negative());
  v.bulk = t.get("bulk", positive(), v.bulk);
  v.length = t.get("length", positive(), v.length);
  v.always = t.get("acts", one_of({"compression", "always"})) == "always";
  if (!takes_viscosity(*c.plate->solid))
    t.say("found beside tensile damage or plasticity; allowed: with an elastic plate or a failure wave");
  c.plate->viscosity = v;
}

void read_plate_exact(Table& t, Case& c) {
  PlateExact& exact = c.plate->exact;
  using Scene = analytic::PlaneSolutionRow::Scene;
  const bool spreads = c.plate->diffusion && c.plate->diffusion->spread;
  const Scene scene = c.plate->solid ? Scene::solid : spreads ? Scene::front : Scene::diffusion;
  Names solutions;
  for (const analytic::PlaneSolutionRow& row : analytic::plane_solutions())
    if (row.scene == scene) solutions.push_back(row.name);
  solutions.push_back("expressions");
  exact.solution = t.need("solution", one_of(solutions, "without an exact solution leave out the whole table [exact]"));
  const auto of = [&](const char* key, const Names& owners) {
    return t.applies(key, "solution", exact.solution, owners);
  };
  exact.parameters = read_solution_parameters(t, exact.solution, analytic::plane_solutions(), {"core"});
  const Names xyt{"x", "y", "t"};
  if (of("displacement", {"expressions"})) exact.displacement = read_components<2>(t, "displacement", xyt, c);
  if (of("velocity", {"expressions"})) exact.velocity = read_components<2>(t, "velocity", xyt, c);
  if (of("stress", {"expressions"})) exact.stress = read_components<3>(t, "stress", xyt, c);
  if (of("concentration", {"expressions"})) exact.concentration = read_formula(t, "concentration", xyt, c);
  if (exact.solution == "expressions" && !t.has("displacement") && !t.has("velocity") && !t.has("stress") &&
      !t.has("concentration"))
    t.place("solution")
        .say(
            "found \"expressions\" without one; allowed: at least one of the keys displacement, velocity, stress, "
            "concentration");
  if (const analytic::PlaneSolutionRow* row = plane_solution_of(*c.plate))
    for (const std::string& misfit : row->misfits(plane_setting(*c.plate)))
      t.place("solution").say("found " + words(exact.solution) + " " + misfit);
}

/// What a variant may change: all that makes the scene.
void read_scene(Table& file, Case& c) {
  c.plate = PlateSpec{};
  file.table("plate", [&](Table& t) { read_shape(t, c); });
  file.maybe_table("material", [&](Table& t) { read_plate_material(t, c); });
  file.maybe_table("parameters", [&](Table& t) { read_parameters(t, c); });
  if (!c.plate->solid) {
    for (const char* key : {"supports", "damage", "load", "body_force", "flyer", "viscosity"})
      if (file.has(key)) file.place(key).say("found in a scene without [material]; allowed: with one");
    file.table("diffusion", [&](Table& t) { read_pure_diffusion(t, c); });
  } else {
    read_solid_tables(file, c);
    file.table("supports", [&](Table& t) { read_plate_supports(t, c); });
    file.maybe_table("flyer", [&](Table& t) { read_flyer(t, c); });
    file.maybe_table("viscosity", [&](Table& t) { read_plate_viscosity(t, c); });
    if (c.plate->flyer && c.plate->face)
      file.place("flyer").say("found beside diffusion.face; allowed: one of them: the flyer's face is the impact face");
    if (c.plate->flyer && file.has("initial"))
      file.place("initial").say("found beside [flyer], which sets the start; allowed: one of them");
    file.each("load", [&](Table& t) { read_plate_load(t, c); });
    file.maybe_table("body_force", [&](Table& t) {
      c.plate->body_force = read_components<2>(t, "acceleration", {"x", "y", "t"}, c);
    });
  }
  file.maybe_table("initial", [&](Table& t) { read_plate_initial(t, c); });
  file.maybe_table("exact", [&](Table& t) { read_plate_exact(t, c); });
  const bool mode = contains({"lame-mode", "roller-mode", "p-wave", "s-wave"}, c.plate->exact.solution);
  for (const char* key : {"initial", "load", "body_force"})
    if (mode && file.has(key))
      file.place(key).say("found beside " + words(c.plate->exact.solution) +
                          ", which sets its own start and is not loaded; allowed: without");
}

/// Another scene: the file's with some keys set or left out.
void read_variant(Table& t, Table& file, Case& c) {
  PlateVariant variant;
  variant.id = t.need("id", id());
  variant.says = t.need("says", text());
  Node scene = *file.itself().node;
  const Names allowed{"plate",     "material", "damage",     "diffusion", "supports", "flyer",
                      "viscosity", "load",     "body_force", "initial",   "exact"};
  const auto known = [&](const Place& place, const std::string& key) {
    if (contains(allowed, key.substr(0, key.find('.')))) return true;
    place.refuse(words(key), "keys of the scene's tables, like \"damage.rate\": " + joined(allowed));
    return false;
  };
  for (const std::string& key : t.get("without", set_of(text()))) {
    variant.changes.push_back({key});
    if (!known(t.place("without"), key)) continue;
    try {
      apply(variant.changes.back(), scene);
    } catch (const InputError&) {
      t.place("without").refuse(words(key) + ", which the scene lacks", "keys that it has");
    }
  }
  t.maybe_table("set", [&](Table& s) {
    for (const auto& entry : s.entries()) {
      variant.changes.push_back({entry.key, entry.value});
      if (!known(s.place(entry.key), entry.key)) continue;
      try {
        apply(variant.changes.back(), scene, entry.at);
      } catch (const InputError& problem) {
        s.place(entry.key).say(problem.what());
      }
    }
  });
  if (!t.has("set") && !t.has("without")) t.say("found no change; allowed: set or without");
  Case other = c;
  other.variants.clear();
  std::vector<Mistake> mistakes;
  Table whole({&mistakes, &scene, t.itself().at, "file"}, "variant " + words(variant.id) + ": ");
  read_scene(whole, other);
  for (const Mistake& one : mistakes) t.itself().mistakes->push_back(one);
  variant.plate = *other.plate;
  const auto same = [&](const PlateVariant& v) { return v.id == variant.id; };
  if (std::any_of(c.variants.begin(), c.variants.end(), same))
    t.place("id").refuse(words(variant.id) + " again", "an id of its own");
  c.variants.push_back(variant);
}

PlateProbe read_probe_of_plate(Table& t, const Case& c) {
  PlateProbe probe;
  probe.id = t.need("id", id());
  Names reads{"concentration", "total"};
  if (c.plate->solid) {
    reads = {"displacement-x", "displacement-y", "velocity-x", "velocity-y", "stress-xx", "stress-yy", "stress-xy"};
    const auto& supports = c.plate->supports;
    if (std::find(supports.begin(), supports.end(), Edge::Support::platen) != supports.end()) reads.push_back("platen");
    if (c.plate->cracking())
      reads.insert(reads.end(), {"radius", "area", "largest", "acoustic-ratio", "acoustic-angle"});
    if (diffuses(*c.plate->solid)) reads.insert(reads.end(), {"concentration", "total"});
  }
  probe.reads = t.need("reads", one_of(reads));
  const auto of = [&](const char* key, const Names& owners) { return t.applies(key, "reads", probe.reads, owners); };
  if (of("angle", {"radius"})) {
    probe.angle = t.need("angle", not_negative());
    if (probe.angle > 90) t.place("angle").refuse(words(probe.angle), "0 to 90 degrees");
  }
  if (of("level", {"radius", "area"})) probe.level = t.need("level", positive());
  Names at_a_place{"concentration"};
  for (const std::string& name : reads)
    if (name.find('-') != name.npos && !name.starts_with("acoustic")) at_a_place.push_back(name);
  if (of("at", at_a_place)) {
    const auto at = t.must("at", list_of(not_negative())).value_or(std::vector<double>{0, 0});
    const bool known = c.plate->width > 0 && c.plate->height > 0;  // reported already
    if (at.size() != 2 || (known && (at[0] > c.plate->width || at[1] > c.plate->height))) {
      t.place("at").refuse(words(at), "[x, y] in the plate [m]");
    } else {
      probe.x = at[0];
      probe.y = at[1];
    }
  }
  return probe;
}

GaugeSpec read_gauge(Table& t, const Case& c) {
  GaugeSpec gauge{t.need("id", id()), t.need("from_face", positive())};
  const PlateSpec& plate = *c.plate;
  if (!plate.flyer)
    t.place("from_face").say("found without [flyer]; allowed: with one: a gauge's place counts from the impact face");
  const auto check = [&](const PlateSpec& one, const std::string& of) {
    if (!one.flyer || !(one.width > 0) || one.flyer->thickness >= one.width) return;  // no target: refused already
    if (one.flyer->thickness + gauge.from_face > one.width)
      t.place("from_face")
          .refuse(words(gauge.from_face),
                  fmt::format("in the target{}, whose thickness is {:g} m", of, one.width - one.flyer->thickness));
  };
  check(plate, "");
  for (const PlateVariant& variant : c.variants) check(variant.plate, " of variant " + words(variant.id));
  return gauge;
}

void read_plate_sample(Table& t, Case& c) {
  t.table("times", [&](Table& s) {
    c.time_unit = s.need("unit", one_of({"s"}));
    c.times = s.need("at", list_of(positive()));
    if (ascending(c.times)) return;
    s.place("at").refuse(words(c.times), "times in ascending order, each once");
    c.times.clear();
  });
  c.plate_probes = read_each<PlateProbe>(t, "probes", c, read_probe_of_plate);
  c.gauges = read_each<GaugeSpec>(t, "gauges", c, read_gauge);
}

void check_plate_features(const Place& place, const Case& c) {
  if (c.features.empty()) return;
  const auto used = plate_features(c);
  for (const auto& [feature, key] : used)
    if (!contains(c.features, feature))
      place.say("missing " + words(feature) + ", which " + key + " switches on; allowed: exactly the features in use");
  for (const std::string& feature : c.features)
    if (!used.contains(feature))
      place.say("found " + words(feature) +
                ", which nothing in the scene switches on; allowed: exactly the features in use");
}

/// Meshes that fit into memory.
void check_meshes(const Place& place, const Case& c) {
  if (!(c.plate->width > 0) || !(c.plate->height > 0)) return;
  constexpr double most = 1e8;
  for (const int cells : all_axes(c).cells) {
    const double up =
        c.plate->rows > 0 ? c.plate->rows : c.plate->height * cells / (c.plate->width * c.plate->cell_aspect);
    if (!(up * cells <= most)) {  // before it is made a whole number
      place.say(fmt::format("found {} × {:g} cells; allowed: at most {:g}", cells, up, most));
    }
    const auto* cracking = c.plate->cracking();
    const auto* diffusion = cracking && cracking->evolution.diffusion ? &*cracking->evolution.diffusion : nullptr;
    const double cell = c.plate->width / cells, least = 1e-3 * cell;
    if (diffusion && diffusion->source == diffusion::Source::zone && diffusion->radius > 0 && diffusion->radius < least)
      place.say(fmt::format("found a source of radius {:g} on {} cells; allowed: at least {:g}, a thousandth of a cell",
                            diffusion->radius, cells, least));
  }
}

/// The impact face is a column of nodes on every mesh.
void check_face(const Place& place, const std::string& what, const PlateSpec& plate, const Case& c) {
  const auto face = plate.flyer ? std::optional(plate.flyer->thickness) : plate.face;
  if (!face || !(plate.width > 0)) return;
  for (const int cells : all_axes(c).cells) {
    const double column = *face * cells / plate.width;
    if (std::abs(column - std::round(column)) <= 1e-9 * cells) continue;
    place.refuse(fmt::format("{} at {:g} cells of the mesh of {} cells", what, column, cells),
                 "on a column of nodes on every mesh");
    return;
  }
}

/// What particles cannot take.
void check_particles(const AxesBlock& block, const Case& c) {
  const auto& methods = block.axes.method;
  const auto moving =
      std::find_if(methods.begin(), methods.end(), [](const std::string& method) { return panel(method).particles; });
  if (moving == methods.end()) return;
  const std::string family = panel(*moving).look.name;
  constexpr std::size_t most = 8;
  for (const auto& positions : block.axes.particles)
    if (positions.size() > most)
      block.method.say(
          fmt::format("found {0} × {0} particles in a cell; allowed: at most {1} × {1}", positions.size(), most));
  const auto& supports = c.plate->supports;
  const bool bound = std::any_of(supports.begin(), supports.end(), [](Edge::Support s) {
    return s == Edge::Support::driven || s == Edge::Support::platen;
  });
  if (c.convected && (bound || !c.plate->loads.empty()))
    block.method.say("found " + family +
                     " together with finite displacements and a load, a driven side or a platen; allowed: free sides, "
                     "rollers and fixed ones: the others stand on the grid, which the particles leave");
  if (c.convected && (c.plate->flyer || c.plate->viscosity || c.plate->failing()))
    block.method.say("found " + family +
                     " together with finite displacements and a flyer, a failure wave or viscosity; allowed: "
                     "\"infinitesimal\": the grid follows the material");
}

/// Expressions are tried at the sample times, which are read, and found wrong, only after the scene.
void peek_at_times(Table& file, Case& c) {
  const Node* sample = file.place("sample").node;
  if (!sample || !sample->as<Node::Entries>()) return;
  std::vector<Mistake> unheard;
  Table whole({&unheard, sample, sample->at, ""}, "");
  c.time_unit = "s";
  whole.maybe_table("times", [&](Table& t) { c.times = t.get("at", list_of(positive())); });
}

}  // namespace

void read_plate_case(Table& file, Case& c) {
  std::size_t before = file.mistakes();
  peek_at_times(file, c);
  read_scene(file, c);
  const bool scene_is_read = file.mistakes() == before;
  file.table("model", [&](Table& t) {
    c.convected = t.get("displacements", one_of({"infinitesimal", "finite"})) == "finite";
    if (c.plate->solid && t.has("pic")) {
      c.plate->pic = t.get("pic", not_negative());
      if (c.plate->pic > 1) t.place("pic").refuse(words(c.plate->pic), "0 (FLIP) to 1 (PIC)");
    }
    Names features{"elastic",      "damage",     "diffusion",  "compression-plasticity",
                   "platen",       "body-force", "convection", "pic",
                   "failure-wave", "impact",     "viscosity"};
    for (const PlateModel& model : plate_models())
      if (!contains(features, model.feature)) features.push_back(model.feature);
    c.features = t.need("features", set_of(one_of(features)));
    if (!c.changed.empty() && scene_is_read) {
      c.features.clear();
      for (const auto& used : plate_features(c)) c.features.push_back(used.first);
    }
    std::sort(c.features.begin(), c.features.end());
    if (scene_is_read) check_plate_features(t.place("features"), c);
    if (c.convected && c.plate->cracking())
      t.place("displacements").say("found \"finite\" beside damage; allowed: \"infinitesimal\", as in the paper");
  });
  if (scene_is_read) file.each("variant", [&](Table& t) { read_variant(t, file, c); });
  const double pic = c.plate->pic;
  for (PlateVariant& variant : c.variants) variant.plate.pic = pic;
  if (!scene_is_read) {  // their ids, so that [axes] is not blamed for naming them
    file.each("variant", [&](Table& t) {
      c.variants.push_back({t.get("id", id()), "", *c.plate});
      for (const char* key : {"says", "set", "without"}) t.place(key);
    });
  }
  const std::vector<AxesBlock> blocks = read_all_axes(file, c, methods_of(c), {{0.25, 0.75}});
  for (const AxesBlock& block : blocks) check_particles(block, c);
  file.table("sample", [&](Table& t) { read_plate_sample(t, c); });
  if (scene_is_read) {
    check_meshes(file.place("axes"), c);
    if (c.plate->solid) check_corners(file.place("supports"), c);
    const Place face = file.place(c.plate->flyer ? "flyer" : "diffusion");
    check_face(face, "the impact face", *c.plate, c);
    for (const PlateVariant& variant : c.variants)
      check_face(face, "the impact face of variant " + words(variant.id), variant.plate, c);
  }
}

}  // namespace diptych::runner
