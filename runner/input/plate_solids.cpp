#include "runner/input/plate_solids.hpp"

#include <limits>
#include <utility>

#include "runner/input/case_checks.hpp"
#include "runner/input/case_tables.hpp"

namespace diptych::runner {
namespace {

using Cone = std::optional<material::Compression>;

/// The value that a name of the list stands for, in the list's order.
template <class Value>
Value named(Table& t, const std::string& key, const std::vector<std::pair<std::string, Value>>& all, Value usual) {
  Names names;
  for (const auto& one : all) names.push_back(one.first);
  const std::string name = t.get(key, one_of(names));
  for (const auto& [other, value] : all)
    if (other == name) return value;
  return usual;
}

Rule<double> below(double bound, const Rule<double>& rule, const std::string& allowed) {
  return {[=](const Place& place) -> std::optional<double> {
            const auto value = rule.read(place);
            if (value && *value >= bound) return place.refuse_value(allowed);
            return value;
          },
          rule.missing};
}

// ---- [material] ----

PlateSolid read_elastic_plate(Table&, const material::PlaneElastic& elastic, const Cone& compression) {
  return solid::Elastic{elastic, compression};
}

PlateSolid read_cracking(Table& t, const material::PlaneElastic& elastic, const Cone& compression) {
  material::TensileDamage damage{elastic};
  damage.fracture_toughness = t.need("K_IC", positive());
  damage.flaw_density = t.need("k", positive());
  damage.exponent = t.need("m", positive());
  damage.beta = t.get("beta", not_negative(), damage.beta);
  damage.residual_stiffness = t.get("residual_stiffness", positive(), damage.residual_stiffness);
  damage.closure = t.get("closure", one_of({"volumetric", "whole"})) == "whole" ? material::Closure::whole
                                                                                : material::Closure::volumetric;
  damage.trace = t.get("volumetric", one_of({"mean", "trace"})) == "trace";
  return solid::Cracking{damage, {}, compression};
}

PlateSolid read_failing(Table& t, const material::PlaneElastic& elastic, const Cone& compression) {
  material::FailureWave failure{elastic, t.need("threshold", not_negative()), 0};
  failure.most_converted = t.must("f_max", not_negative()).value_or(0);
  if (failure.most_converted > 1)
    t.place("f_max").refuse(words(failure.most_converted), "0 to 1, a part of the shear energy");
  if (elastic.plane == material::Plane::stress) t.place("plane").refuse("\"stress\" of a failure wave", "\"strain\"");
  if (elastic.poissons_ratio <= 0)
    t.place("nu").refuse(words(elastic.poissons_ratio) + " of a failure wave",
                         "0 < nu < 0.5: the lateral stress is what its front is seen by");
  if (compression) t.place("compression").say("found beside a failure wave; allowed: without");
  return solid::Failing{failure};
}

// ---- [damage] and [diffusion] ----

void refuse_damage(Table& file) {
  if (file.has("damage"))
    file.place("damage").say("found beside an elastic material; allowed: with material.model = \"tensile-damage\"");
}

void read_damage(Table& t, Case& c) {
  diffusion::Evolution evolution;
  evolution.critical_strain = t.need("critical_strain", positive());
  evolution.damage_everywhere = t.get("shows", one_of({"where-critical", "everywhere"})) == "everywhere";
  if (!t.get("capped", flag(), true)) evolution.cap = std::numeric_limits<double>::infinity();
  evolution.heals = t.get("heals", flag(), evolution.heals);
  const std::string rate = t.need("rate", one_of({"reference", "tracked"}));
  evolution.rate = rate == "tracked" ? diffusion::Rate::tracked : diffusion::Rate::reference;
  if (t.applies("reference_rate", "rate", rate, {"reference"}))
    evolution.reference_rate = t.need("reference_rate", positive());
  if (t.applies("rate_floor", "rate", rate, {"tracked"}))
    evolution.rate_floor = t.get("rate_floor", positive(), evolution.rate_floor);
  c.plate->cracking()->evolution = evolution;
}

/// Of microcracks, driven by the strain (eqs. 25 to 28).
void read_diffusion(Table& t, Case& c) {
  diffusion::Diffusion d;
  d.characteristic_time = t.need("T_d", positive());
  d.mobility = t.need("lambda1", not_negative());
  d.floor = t.get("floor", not_negative(), d.floor);
  if (d.floor > 1) t.place("floor").refuse(words(d.floor), "0 to 1, a part of lambda1");
  d.crack_volume = t.need("lambda2", positive());
  d.rupture_strain = t.need("rupture_strain", positive());
  using diffusion::Source;
  const std::string source = t.need("source", one_of({"zone", "node", "everywhere"}));
  d.source = source == "node" ? Source::node : source == "everywhere" ? Source::everywhere : Source::zone;
  if (t.applies("radius", "source", source, {"zone"})) d.radius = t.need("radius", positive());
  d.per_crack_volume = t.get("per_crack_volume", flag(), d.per_crack_volume);
  d.saturates = t.get("saturates", flag(), d.saturates);
  d.clip_strain = t.get("clip_strain", flag(), d.clip_strain);
  d.scheme = read_scheme(t, d.scheme);
  d.reading = read_reading(t);
  d.drift = t.get("drift", not_negative(), d.drift);
  if (d.drift > 0 && d.scheme == diffusion::Scheme::crank_nicolson)
    t.place("drift").refuse(words(d.drift) + " with \"crank-nicolson\"",
                            "0: it does not damp what a stale factorisation gets wrong");
  if (auto* cracking = c.plate->cracking())
    cracking->evolution.diffusion = d;
  else
    t.say("found beside a material without damage; allowed: with material.model = \"tensile-damage\" and [damage]");
}

void read_dilatancy(Table& t, Case& c) {
  PlateSpec& plate = *c.plate;
  diffusion::Spread& spread = plate.failing()->spread;
  spread = read_spread(t);
  spread.drift = t.get("drift", not_negative(), 0);
  if (spread.drift > 0 && spread.scheme == diffusion::Scheme::crank_nicolson)
    t.place("drift").refuse(words(spread.drift) + " with \"crank-nicolson\"",
                            "0: it does not damp what a stale factorisation gets wrong");
  spread.keeps_largest = t.get("face_holds", one_of({"present", "largest"})) == "largest";
  if (!t.has("face")) return;
  plate.face = t.need("face", not_negative());
  if (plate.width > 0 && *plate.face > plate.width)
    t.place("face").refuse(words(*plate.face), "a place in the plate, 0 to " + words(plate.width) + " m");
}

void read_no_tables(Table& file, Case& c) {
  refuse_damage(file);
  file.maybe_table("diffusion", [&](Table& t) { read_diffusion(t, c); });  // which says that it does not belong here
}

void read_cracking_tables(Table& file, Case& c) {
  file.table("damage", [&](Table& t) { read_damage(t, c); });
  file.maybe_table("diffusion", [&](Table& t) { read_diffusion(t, c); });
}

void read_failing_tables(Table& file, Case& c) {
  refuse_damage(file);
  file.table("diffusion", [&](Table& t) { read_dilatancy(t, c); });
}

}  // namespace

const std::vector<PlateModel>& plate_models() {
  static const std::vector<PlateModel> models{
      {"elastic", solid::Elastic::feature, {}, read_elastic_plate, read_no_tables},
      {"tensile-damage",
       solid::Cracking::feature,
       {"K_IC", "k", "m", "beta", "residual_stiffness", "closure", "volumetric"},
       read_cracking,
       read_cracking_tables},
      {"failure-wave", solid::Failing::feature, {"threshold", "f_max"}, read_failing, read_failing_tables},
  };
  return models;
}

void read_plate_material(Table& t, Case& c) {
  Names names;
  for (const PlateModel& one : plate_models()) names.push_back(one.name);
  const std::string model = t.need("model", one_of(names));
  material::PlaneElastic elastic;
  elastic.youngs_modulus = t.need("E", positive());
  elastic.poissons_ratio = t.must("nu", below(0.5, any_number(), "-1 < nu < 0.5")).value_or(0);
  if (elastic.poissons_ratio <= -1) t.place("nu").refuse(words(elastic.poissons_ratio), "-1 < nu < 0.5");
  elastic.density = t.need("rho", positive());
  elastic.plane =
      t.need("plane", one_of({"strain", "stress"})) == "stress" ? material::Plane::stress : material::Plane::strain;
  Cone compression;
  t.maybe_table("compression", [&](Table& p) {
    compression = material::Compression{p.need("strength", not_negative()), p.need("slope", not_negative())};
    if (elastic.plane == material::Plane::stress)
      p.say("found in plane stress, where the plastic flow across the plane is not known; allowed: plane = \"strain\"");
  });
  c.plate->solid = solid::Elastic{elastic, compression};
  for (const PlateModel& one : plate_models()) {
    for (const std::string& key : one.keys) t.applies(key, "model", model, {one.name});
    if (one.name == model) c.plate->solid = one.read(t, elastic, compression);
  }
}

void read_solid_tables(Table& file, Case& c) {
  const std::string feature = feature_of(*c.plate->solid);
  for (const PlateModel& one : plate_models())
    if (one.feature == feature) one.read_tables(file, c);
}

diffusion::Scheme read_scheme(Table& t, diffusion::Scheme usual) {
  using diffusion::Scheme;
  return named<Scheme>(t, "scheme",
                       {{"forward-euler", Scheme::forward_euler},
                        {"sub-cycled", Scheme::sub_cycled},
                        {"rkl2", Scheme::rkl2},
                        {"backward-euler", Scheme::backward_euler},
                        {"crank-nicolson", Scheme::crank_nicolson}},
                       usual);
}

diffusion::Reading read_reading(Table& t) {
  using diffusion::Reading;
  return named<Reading>(t, "reading", {{"isotropic", Reading::isotropic}, {"radial", Reading::radial}},
                        Reading::isotropic);
}

diffusion::Spread read_spread(Table& t) {
  using diffusion::Profile;
  diffusion::Spread spread;
  spread.diffusivity = t.need("d0", not_negative());
  const std::string profile = t.need("profile", one_of({"falling", "constant", "rising"}));
  spread.profile = profile == "rising" ? Profile::rising : profile == "constant" ? Profile::constant : Profile::falling;
  spread.scheme = read_scheme(t, spread.scheme);
  return spread;
}

}  // namespace diptych::runner
