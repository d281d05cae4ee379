// A case without each of its features and with what it lacks: what is then said of each.
#include "runner/ablate/ablate.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <set>

#include "reports/ablation_table.hpp"
#include "runner/ablate/lacking.hpp"
#include "runner/ablate/readings.hpp"
#include "runner/ablate/revised.hpp"
#include "runner/app/case_file.hpp"
#include "runner/app/catalogue.hpp"
#include "tests/case_text.hpp"
#include "tests/folder.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(ablate)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;
using reports::AblatedQuantity;
using reports::Ablation;
using reports::AblationStudy;
using reports::Need;
using reports::ruling_of;
namespace tt = boost::test_tools;

namespace {

const std::string end_of_file = gate("near", "invariant", "energy.drift", "max = 1.0\n");

/// A case of a file of its own, which is read anew with changes.
struct Written {
  explicit Written(const std::string& text) : file(folder.path / "t.toml") { std::ofstream(file) << text; }
  Case read() const { return read_case(file); }
  AblationStudy study(AblationPlan plan = {}) const { return runner::ablate(read(), plan, {}); }
  Folder folder;
  std::filesystem::path file;
};

const Ablation& named(const AblationStudy& study, const std::string& part) {
  for (const Ablation& one : study.tried)
    if (one.part == part) return one;
  BOOST_FAIL("nothing was tried of " + part);
  throw std::logic_error("");
}

const AblatedQuantity& quantity(const Ablation& one, const std::string& name) {
  for (const AblatedQuantity& q : one.quantities)
    if (q.quantity == name) return q;
  BOOST_FAIL("nothing is said of " + name);
  throw std::logic_error("");
}

void expect_in(const std::string& said, const std::vector<std::string>& wanted) {
  for (const std::string& part : wanted) BOOST_TEST(holds(said, part), "wanted '" + part + "' in\n" + said);
}

/// A step that compresses the bar, smoothed by viscosity.
std::string struck(const std::string& more, const std::string& cells = "40, 80, 160, 320") {
  return head("t", "code-verification", "paper") + paper_bar +
         "[[load]]\nat = \"right\"\nhistory = \"step\"\ntraction = -1.0\n"
         "[viscosity]\nform = \"linear-quadratic\"\nc1 = 0.5\nc2 = 0.0\n"
         "[model]\nfeatures = [\"elastic\", \"viscosity\"]\n" +
         more + axes({"fem"}, cells, "0.4") + sampled("0.5");
}

/// Behind the front, where it rings without viscosity.
const std::string behind = "probes = [{ id = \"behind\", field = \"stress\", at = { value = 0.7, unit = \"L\" } }]\n";

AblatedQuantity made(const std::string& name, double change, double uncertainty) {
  AblatedQuantity one;
  one.quantity = name;
  one.time = 1;
  one.stands = 2;
  one.changed = 2 + change;
  one.change = change;
  one.uncertainty = uncertainty;
  one.known_by = "4 meshes";
  return one;
}

Ablation made(const std::vector<AblatedQuantity>& quantities) {
  Ablation one;
  one.part = "viscosity";
  one.says = "taken out";
  one.run = "fem N=10 C=0.5";
  one.status = one.stands.status = one.changed.status = "completed";
  one.stands.element_steps = 100;
  one.changed.element_steps = 50;
  one.quantities = quantities;
  return one;
}

PointValues line(const std::vector<double>& x, const std::vector<double>& values, const std::vector<double>& y = {}) {
  return {"stress", x, y.empty() ? std::vector<double>(x.size(), 1) : y, {values}, {1}, y.empty()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_feature_is_required_where_a_change_exceeds_its_uncertainty) {
  BOOST_TEST((ruling_of(made({made("a", 0.1, 0.2), made("b", 0.3, 0.2)})).need == Need::required));
  BOOST_TEST(ruling_of(made({made("a", 0.1, 0.2), made("b", 0.3, 0.2)})).most->quantity == "b");
  BOOST_TEST(ruling_of(made({made("a", 0.1, 0.2), made("b", 0.3, 0.2)})).exceeded == 1);
  BOOST_TEST((ruling_of(made({made("a", 0.1, 0.2), made("b", 0.1, 0.2)})).need == Need::not_required));
  BOOST_TEST((ruling_of(made({made("a", 0, 0.2), made("b", 1e-15, 0)})).need == Need::no_difference));
  // What is not known is not taken for nothing.
  const double unknown = std::nan("");
  BOOST_TEST((ruling_of(made({made("a", 0.1, 0.2), made("b", 0.1, unknown)})).need == Need::not_known));
  BOOST_TEST((ruling_of(made({made("a", 0.3, 0.2), made("b", 0.1, unknown)})).need == Need::required));
  BOOST_TEST((ruling_of(made({made("a", unknown, 0.2)})).need == Need::not_known));
  BOOST_TEST((ruling_of(made({})).need == Need::not_known));
  // Nothing is as certain as that: a change beyond round-off of what is known to round-off is one.
  BOOST_TEST((ruling_of(made({made("a", 1e-6, 0)})).need == Need::required));
}

BOOST_AUTO_TEST_CASE(what_takes_the_scene_no_farther_from_the_exact_solution_is_not_required) {
  AblatedQuantity field = made("stress", 0.3, 0.2);
  field.field = true;
  field.stands = 0.2;
  field.changed = 0.1;
  BOOST_TEST((ruling_of(made({field})).need == Need::not_required));
  field.changed = 0.4;
  BOOST_TEST((ruling_of(made({field})).need == Need::required));
}

BOOST_AUTO_TEST_CASE(an_aid_is_noticed_where_uncertainties_fall) {
  AblatedQuantity falls = made("a", 0.1, 0.2), rises = made("b", 0.01, 0.2);
  falls.uncertainty_changed = 0.05;
  rises.uncertainty_changed = 0.4;
  Ablation aid = made({falls, rises});
  aid.aid = aid.added = true;
  BOOST_TEST((ruling_of(aid).need == Need::required));
  BOOST_TEST(ruling_of(aid).left == std::sqrt(0.5), tt::tolerance(1e-12));  // (1/4 · 2)^½
  BOOST_TEST(ruling_of(aid).most->quantity == "a");
  aid.quantities[1].uncertainty_changed = 0.8;
  BOOST_TEST((ruling_of(aid).need == Need::not_required));  // (1/4 · 4)^½
  // The median: one that happens to vanish decides nothing.
  AblatedQuantity vanishes = falls;
  vanishes.uncertainty_changed = 0;
  aid.quantities = {vanishes, rises, rises};
  BOOST_TEST(ruling_of(aid).left == 2, tt::tolerance(1e-12));
  // What moves the result by more than was uncertain has not made it certain, unless it is known to be nearer.
  aid.quantities = {falls};
  BOOST_TEST((ruling_of(aid).need == Need::required));
  aid.quantities[0].change = 0.3;
  BOOST_TEST((ruling_of(aid).need == Need::not_required));
  aid.quantities[0].field = true;
  BOOST_TEST((ruling_of(aid).need == Need::required));
  // Of what is not known to half its size nothing is said, and so of nothing.
  aid.quantities[0].uncertainty = 0.6;
  BOOST_TEST((ruling_of(aid).need == Need::not_known));
  aid.quantities.clear();
  BOOST_TEST((ruling_of(aid).need == Need::not_known));
  aid.quantities = {made("a", 0, 0.2)};
  BOOST_TEST((ruling_of(aid).need == Need::no_difference));
}

BOOST_AUTO_TEST_CASE(everything_tried_is_told) {
  AblationStudy study;
  study.case_id = "t";
  study.time_unit = "L/c";
  study.tried = {made({made("probe.tip", 0.3, 0.2)})};
  study.tried.push_back(made({}));
  study.tried.back().part = "convection";
  study.tried.back().status = "unstable";
  study.tried.back().message = "it grows";
  study.tried.push_back(made({made("probe.tip", 0.1, 0.2)}));
  study.tried.back().part = "contact";
  study.tried.back().added = true;
  expect_in(reports::ablation_text(study),
            {"required: probe.tip at t = 1 L/c changes by 30 %, 1.5 times its uncertainty (1 of 1 quantities notice);\n"
             "              1/2 of the updates",
             "convection  unstable: it grows", "not noticed: at most, probe.tip", "Taken off, one at a time: fem N=10",
             "Added, one at a time: fem N=10"});
  expect_in(reports::ablation_csv(study),
            {"viscosity,off,taken out,completed,,100,50,,,probe.tip,1,0,2,2.3,1,0.3,0.2,,4 meshes",
             "convection,off,taken out,unstable,it grows,100,50,,,,,,,,,,,,", "contact,added,"});
  expect_in(reports::ablation_json(study, {}),
            {"\"part\":\"convection\"", "\"status\":\"unstable\"", "\"verdict\":\"not run\"",
             "\"verdict\":\"required\"", "\"verdict\":\"not required\"", "\"stands\":2.0,\"changed\":2.3"});
  for (const std::string& one : lines(reports::ablation_text(study))) BOOST_TEST(one.size() <= 124u, one);
}

BOOST_AUTO_TEST_CASE(every_feature_of_every_case_has_a_row) {
  std::set<std::string> rows;
  for (const FeatureRow& row : feature_rows()) rows.insert(row.id);
  BOOST_TEST(rows.size() == feature_rows().size());
  std::set<std::string> declared;
  for (const Case& c : all_cases())
    for (const Leaf& leaf : leaves(c))
      for (const std::string& feature : features_of(c, leaf)) declared.insert(feature);
  for (const std::string& feature : declared) BOOST_TEST(rows.contains(feature), "no row for " << feature);
  BOOST_TEST(declared.size() > 10u);
}

BOOST_AUTO_TEST_CASE(every_feature_of_a_case_can_be_taken_off_or_it_says_why) {
  // Each shipped case that is the first of its set of features, in its first setting.
  std::set<std::string> seen;
  for (const Case& c : all_cases()) {
    const AblatedSetting setting = settings_of(c, "", 0).front();
    const Leaf& leaf = setting.leaf;
    for (const std::string& feature : features_of(c, leaf)) {
      if (!seen.insert(listed(features_of(c, leaf)) + " without " + feature).second) continue;
      const Revision revision = find_feature(feature)->without(*case_of(c, leaf), leaf);
      if (!revision.impossible.empty()) continue;
      Revision bare = revision;
      if (revision.another_exact && (c.plate ? c.plate->exact.solution : c.exact.solution) != "none")
        bare.changes.push_back({"exact", {}});
      const std::string problem =
          message_of([&] { revised(c, leaf, {setting.meshes.back()}, bare, "without " + feature); });
      BOOST_TEST(problem == "", c.id << " without " << feature << ": " << problem);
      if (!problem.empty()) continue;
      const Case other = revised(c, leaf, {setting.meshes.back()}, bare, "");
      const Names left = features_of(other, leaves(other).front());
      for (const std::string& gone : revision.drops) BOOST_TEST(!contains(left, gone), c.id << " without " << gone);
    }
  }
  BOOST_TEST(seen.size() > 20u);
}

BOOST_AUTO_TEST_CASE(viscosity_is_required_behind_a_front_and_not_where_it_only_smears) {
  const Written rings(struck("") + behind + end_of_file);
  const AblationStudy study = rings.study();
  const Ablation& viscosity = named(study, "viscosity");
  BOOST_TEST_REQUIRE(viscosity.status == "completed", viscosity.message);
  BOOST_TEST((ruling_of(viscosity).need == Need::required), reports::ablation_text(study));
  const AblatedQuantity& probe = quantity(viscosity, "probe.behind");
  BOOST_TEST(probe.known_by == "4 meshes");
  BOOST_TEST(std::abs(probe.stands + 1) < 0.01);   // smooth with it
  BOOST_TEST(std::abs(probe.changed + 1) > 0.01);  // rings without
  BOOST_TEST(probe.times() > 1);
  BOOST_TEST(named(study, "elastic").status == "kept");
  // Against the exact step it only takes the result farther away.
  const Written smears(struck("[exact]\nsolution = \"bar-wave\"\n") + end_of_file);
  const AblationStudy other = smears.study();
  BOOST_TEST((ruling_of(named(other, "viscosity")).need == Need::not_required), reports::ablation_text(other));
  const AblatedQuantity& stress = quantity(named(other, "viscosity"), "stress");
  BOOST_TEST(stress.known_by == "exact");
  BOOST_TEST(stress.changed < stress.stands);
}

BOOST_AUTO_TEST_CASE(what_a_scene_lacks_is_asked) {
  const std::string plain =
      without(struck("[exact]\nsolution = \"bar-wave\"\n"), {"[viscosity]", "form =", "c1 =", "c2 ="});
  const Written bar(replaced(plain, "\"elastic\", \"viscosity\"", "\"elastic\"") + end_of_file);
  const AblationStudy study = bar.study();
  const Ablation& viscosity = named(study, "viscosity");
  BOOST_TEST((viscosity.added && viscosity.aid));
  BOOST_TEST(viscosity.status == "completed");
  BOOST_TEST(!std::isnan(ruling_of(viscosity).left));
  // FEM's mesh goes with the material.
  BOOST_TEST(named(study, "finite displacements").status == "not tried");
}

BOOST_AUTO_TEST_CASE(two_bars_that_close_and_never_meet_lack_contact) {
  const std::string text = head("t", "robustness", "paper") +
                           "[material]\nmodel = \"elastic\"\nE = 1e4\nrho = 1.0\n"
                           "[[bar]]\nlength = 0.5\nvelocity = 1.0\n"
                           "[[bar]]\ngap = { value = 0.1, unit = \"m\" }\nlength = 0.5\nvelocity = -1.0\n"
                           "[supports]\nleft = \"free\"\nright = \"free\"\n"
                           "[model]\nfeatures = [\"contact\", \"elastic\"]\n" +
                           axes({"mpm-musl"}, "10, 20", "0.2") + "[sample]\ntimes = { unit = \"s\", at = [0.055] }\n" +
                           end_of_file;
  const Written bars(text);
  const AblationStudy study = bars.study();
  const Ablation& contact = [&]() -> const Ablation& {
    for (const Ablation& one : study.tried)
      if (one.part == "contact" && one.added) return one;
    throw std::logic_error(reports::ablation_text(study));
  }();
  BOOST_TEST(contact.status == "completed", contact.message);
  BOOST_TEST((ruling_of(contact).need == Need::required), reports::ablation_text(study));
  // Taken off: the first bar flies alone, as it does here beside one that it never meets.
  const Ablation& alone = named(study, "contact");
  BOOST_TEST((!alone.added && alone.status == "completed"), alone.message);
  BOOST_TEST((ruling_of(alone).need == Need::no_difference), reports::ablation_text(study));
}

BOOST_AUTO_TEST_CASE(bonded_bars_that_would_part_lack_a_contact_that_lets_go) {
  const Written bars(head("t", "robustness", "paper") +
                     "[material]\nmodel = \"elastic\"\nE = 1e4\nrho = 1.0\n"
                     "[[bar]]\nlength = 0.5\nvelocity = 1.0\n"
                     "[[bar]]\nlength = 0.5\nvelocity = -1.0\n"
                     "[supports]\nleft = \"free\"\nright = \"free\"\n[contact]\nfem = \"bonded\"\n"
                     "[model]\ndisplacements = \"finite\"\nfeatures = [\"contact\", \"convection\", \"elastic\"]\n" +
                     axes({"fem"}, "10, 20", "1.0") + "[sample]\ntimes = { unit = \"L/c\", at = [5.5] }\n" +
                     end_of_file);
  const AblationStudy study = bars.study();
  const auto added = std::find_if(study.tried.begin(), study.tried.end(),
                                  [](const Ablation& one) { return one.added && one.part == "contact"; });
  BOOST_TEST_REQUIRE((added != study.tried.end()));
  BOOST_TEST((ruling_of(*added).need == Need::required), reports::ablation_text(study));
}

BOOST_AUTO_TEST_CASE(a_strip_does_for_a_plate_that_does_not_vary_along_a_side) {
  const auto stretched = [](const std::string& velocity) {
    return head("t", "robustness") + plate("1.0", "1.0") + elastic("1e4", "0.3", "1.0") +
           supports("driven", "driven", "driven", "driven") + "velocity = " + velocity +
           "\n[initial]\nvelocity = " + velocity + "\n[model]\nfeatures = [\"elastic\"]\n" +
           axes({"fem", "mpm-musl"}, "4", "0.4") +
           "[sample]\ntimes = { unit = \"s\", at = [0.05] }\n"
           "probes = [{ id = \"corner\", reads = \"stress-xx\", at = [1.0, 1.0] }]\n" +
           end_of_file;
  };
  const Written plate(stretched("[\"1e-3*x\", \"0\"]"));
  const AblationStudy study = plate.study();
  for (const Ablation& one : study.tried) {
    if (one.part != "cells along y") continue;
    BOOST_TEST(one.status == "completed", one.message);
    BOOST_TEST((ruling_of(one).need == Need::no_difference), reports::ablation_text(study));
    expect_in(one.says, {"one row of cells instead of 4", "plate.rows = 1"});
    BOOST_TEST(quantity(one, "stress").change < 1e-12);
    BOOST_TEST(quantity(one, "probe.corner").stands > 0);
    BOOST_TEST(quantity(one, "probe.corner").change < 1e-12);
  }
  // 4 × 4 cells of 4 triangles, 25 + 16 nodes; a row: 16 triangles, 10 + 4 nodes. Particles: 64 and 25 nodes, 16
  // and 10.
  BOOST_TEST(study.tried[1].changed.work() / study.tried[1].stands.work() == 30.0 / 105, tt::tolerance(1e-12));
  BOOST_TEST(named(study, "viscosity").status == "idle");  // nothing is compressed
  expect_in(reports::ablation_text(study), {"not noticed: it never acts", "NOT REQUIRED HERE: a strip of one row of"});
  const Ablation& across = named(study, "cells along x");
  BOOST_TEST(across.status == "kept");
  expect_in(across.message, {"vary along x", "displacement"});
  // The same seen from the side.
  const Written turned(stretched("[\"0\", \"1e-3*y\"]"));
  const AblationStudy other = turned.study();
  BOOST_TEST(named(other, "cells along y").status == "kept");
  BOOST_TEST((ruling_of(named(other, "cells along x")).need == Need::no_difference), reports::ablation_text(other));
}

BOOST_AUTO_TEST_CASE(damage_goes_with_its_diffusion_and_its_probes) {
  const Written rock_plate(
      head("t", "robustness") + plate("1.0", "1.0") + rock + reference_damage +
      "[diffusion]\nT_d = 0.01\nlambda1 = 500\nlambda2 = 0.01\nrupture_strain = 0.01\n"
      "source = \"everywhere\"\n" +
      supports("roller", "free", "roller", "platen") +
      "[[load]]\nat = \"top\"\nhistory = \"ramp\"\ntraction = 700e6\n"
      "rise = { value = 50e-6, unit = \"s\" }\n"
      "[model]\nfeatures = [\"damage\", \"diffusion\", \"platen\"]\n" +
      axes({"fem"}, "4, 8", "0.5") +
      "[sample]\ntimes = { unit = \"s\", at = [0.2e-3] }\n"
      "probes = [{ id = \"largest\", reads = \"largest\" }, { id = \"platen\", reads = \"platen\" }]\n" +
      end_of_file);
  const AblationStudy study = rock_plate.study();
  const Ablation& damage = named(study, "damage");
  BOOST_TEST_REQUIRE(damage.status == "completed", damage.message);
  BOOST_TEST(quantity(damage, "probe.largest").stands > 0);
  BOOST_TEST(std::isnan(quantity(damage, "probe.largest").changed));
  BOOST_TEST(std::isfinite(quantity(damage, "probe.platen").change));
  expect_in(reports::ablation_text(study), {"gone with it: probe.largest"});
  BOOST_TEST(quantity(damage, "stress").known_by == "2 meshes");
  BOOST_TEST(named(study, "diffusion").status == "completed");
  BOOST_TEST(named(study, "platen").status == "completed");
  BOOST_TEST(named(study, "a finer time step").status == "completed");
  // What the program has no scene for is said, with the reader's reason.
  BOOST_TEST(named(study, "viscosity").status == "not tried");
}

BOOST_AUTO_TEST_CASE(a_scene_of_a_variant_is_its_own_file) {
  const Written plate_file(head("t", "robustness") + plate("1.0", "1.0") + elastic("1e4", "0.3", "1.0") +
                           supports("roller", "free", "roller", "free") +
                           "[[load]]\nat = \"right\"\nhistory = \"step\"\ntraction = \"-1.0\"\n"
                           "[model]\nfeatures = [\"elastic\"]\n"
                           "[[variant]]\nid = \"viscous\"\nsays = \"s\"\n"
                           "set = { viscosity = { form = \"york\", c1 = 0.4, c2 = 0.0 }, \"plate.height\" = 0.5 }\n" +
                           axes({"fem"}, "4, 8", "0.2") + "variant = [\"\", \"viscous\"]\n" +
                           "[sample]\ntimes = { unit = \"s\", at = [0.005] }\n" + end_of_file);
  const Case c = plate_file.read();
  const AblatedSetting setting = settings_of(c, "viscous", 0).front();
  BOOST_TEST((setting.meshes == std::vector{4, 8}));
  BOOST_TEST((features_of(c, setting.leaf) == Names{"elastic", "viscosity"}));
  const Case scene = revised(c, setting.leaf, {8}, {}, "");
  BOOST_TEST(scene.variants.empty());
  BOOST_TEST(scene.plate->height == 0.5);
  BOOST_TEST(scene.plate->viscosity.value().c1 == 0.4);
  AblationPlan plan;
  plan.scene = "viscous";
  const AblationStudy study = plate_file.study(plan);
  BOOST_TEST(named(study, "viscosity").status == "completed", named(study, "viscosity").message);
  BOOST_TEST(!named(study, "viscosity").added);
  plan.scene = "vicsous";
  expect_in(message_of([&] { plate_file.study(plan); }), {"--scene", "\"viscous\"", "did you mean"});
}

BOOST_AUTO_TEST_CASE(the_mesh_is_as_fine_as_is_cheap) {
  const Written bar(struck("") + end_of_file);
  BOOST_TEST((settings_of(bar.read(), "", 0).front().meshes == std::vector{40, 80, 160, 320}));
  BOOST_TEST((settings_of(bar.read(), "", 160).front().meshes == std::vector{40, 80, 160}));
  AblationPlan plan;
  plan.budget = 1e4;
  const AblationStudy study = bar.study(plan);
  expect_in(named(study, "viscosity").run, {"fem N=40 C=0.4"});
  BOOST_TEST_REQUIRE(study.notes.size() == 1u);
  expect_in(study.notes[0], {"--cells 320"});
  // One mesh says nothing about its uncertainty: half as many cells say a little.
  const Written single(struck("", "40") + behind + end_of_file);
  BOOST_TEST((settings_of(single.read(), "", 0).front().meshes == std::vector{20, 40}));
  BOOST_TEST(quantity(named(single.study(), "viscosity"), "probe.behind").known_by == "2 meshes");
}

BOOST_AUTO_TEST_CASE(fields_are_compared_at_their_places) {
  // The fine points beside a coarse one are equally near: their mean.
  BOOST_TEST(runner::l2_distance(line({1, 3}, {1, 3}), line({0.5, 1.5, 2.5, 3.5}, {0.5, 1.5, 2.5, 3.5})) < 1e-15);
  BOOST_TEST(runner::l2_distance(line({1, 3}, {1, 3}), line({1, 3}, {1, 5})) == std::sqrt(2.0), tt::tolerance(1e-15));
  // Bars are told apart, and one that the other lacks is passed over.
  const PointValues two = line({1, 3}, {1, 3}, {1, 1}), far = line({1, 3}, {1, 3}, {1, 2});
  BOOST_TEST(runner::l2_distance(two, far) < 1e9);
  PointValues first = line({1, 3, 1, 3}, {1, 3, 7, 7}), other = line({1, 3}, {1, 3});
  first.y = {1, 1, 2, 2};
  BOOST_TEST(runner::l2_distance(first, other) < 1e-15);
  // Regardless of y: a strip beside a plate, one of whose four points differs.
  const PointValues plate = {"stress", {0, 1, 0, 1}, {0, 0, 9, 9}, {{5, 6, 5, 7}}, {1}};
  const PointValues strip = {"stress", {0, 1}, {0, 0}, {{5, 6}}, {1}};
  BOOST_TEST(runner::l2_distance(plate, strip, Axis::y) == 0.5, tt::tolerance(1e-15));
  BOOST_TEST(std::isnan(runner::l2_distance(plate, {"stress", {0}, {0}, {{1}, {1}}, {1, 1}})));
}

BOOST_AUTO_TEST_SUITE_END()
