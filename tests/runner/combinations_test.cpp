// Every feature of bars with every exact solution, figure and field: each runs and is drawn, or is refused in words.
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "runner/app/case_file.hpp"
#include "runner/input/messages.hpp"
#include "runner/run/runner.hpp"
#include "tests/case_figures.hpp"
#include "tests/case_text.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(combinations)

using namespace diptych;
using namespace diptych::runner;
using namespace diptych::tests;

namespace {

const std::string material_text = "[material]\nmodel = \"elastic\"\nE = 1e4\nrho = 1.0\n";

struct Scene {
  std::string what, text;
  std::vector<std::string> features;
};

const std::vector<Scene> scenes{
    {"one bar", material_text + "[bar]\nlength = 1.0\n", {}},
    {"two bars",
     material_text + "[[bar]]\nlength = 0.5\nvelocity = 1.0\n[[bar]]\ngap = { value = 0.5, unit = \"m\" }\n"
                     "length = 0.5\nvelocity = -1.0\n",
     {"contact"}},
};

const std::vector<std::string> fields{"stress", "velocity", "displacement"};

/// [exact] of each solution, and expressions of each set of fields.
std::vector<std::string> solutions() {
  std::vector<std::string> all{""};
  for (const char* name : {"bar-wave", "standing-mode\"\nmode = 1\namplitude = \"1e-3", "impact", "free-fall"})
    all.push_back(std::string("[exact]\nsolution = \"") + name + "\"\n");
  for (unsigned set = 1; set < 8; ++set) {
    std::string text = "[exact]\nsolution = \"expressions\"\n";
    for (unsigned k = 0; k < 3; ++k)
      if ((set >> k) & 1U) text += fields[k] + " = \"x*t\"\n";
    all.push_back(text);
  }
  return all;
}

std::string figures_text() {
  std::string text;
  for (const std::string& field : fields)
    text += "[[figure]]\nid = \"" + field + "\"\nkind = \"profiles\"\nfield = \"" + field + "\"\n";
  return text + "[[figure]]\nid = \"motion\"\nkind = \"motion\"\n";
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_runs_or_is_refused_in_words) {
  int ran = 0, refused = 0;
  for (const Scene& scene : scenes) {
    for (const bool finite : {false, true}) {
      for (const bool viscous : {false, true}) {
        for (const std::string& exact : solutions()) {
          std::string features = "\"elastic\"";
          for (const std::string& feature : scene.features) features += ", \"" + feature + '"';
          if (finite) features += ", \"convection\"";
          if (viscous) features += ", \"viscosity\"";
          const std::string text =
              head("x", "robustness", "paper") + scene.text + "[supports]\nleft = \"free\"\nright = \"free\"\n" +
              (viscous ? "[viscosity]\nform = \"york\"\nc1 = 0.1\nc2 = 0.0\nacts = \"always\"\n" : "") +
              "[model]\ndisplacements = \"" + (finite ? "finite" : "infinitesimal") + "\"\nfeatures = [" + features +
              "]\n" + exact + axes({"fem", "mpm-musl"}, "10", "0.1") + sampled("0.5, 1.0") +
              gate("closed", "invariant", "energy.closure", "max = 1.0\n") + figures_text();
          const std::string what =
              scene.what + (finite ? ", finite" : "") + (viscous ? ", viscous" : "") + ": " + exact;
          try {
            const Case c = parse_case(text, "x.toml");
            Running running{1, nullptr, Books::sums, true, false};
            std::vector<reports::Case> results = run_cases({c}, running);
            for (const reports::Run& run : results[0].runs)
              BOOST_TEST(run.status == "completed", what + ": " + run.label() + ": " + run.message);
            const reports::Case drawn = drawn_case(c, results[0].runs);
            BOOST_TEST(drawn.figures.size() == 4U, what);
            const bool moves = finite || scene.what == "two bars", no_places = !holds(exact, "displacement");
            const auto& stress = named(drawn.figures, "stress");
            const bool untold = moves && no_places && holds(exact, "stress =");
            BOOST_TEST(holds(listed(stress.notes), "gives no displacement") == untold, what);
            const bool shown = stress.panels[0].series[0].kind == "exact";
            if (holds(exact, "stress =")) BOOST_TEST(shown == !untold, what);
            ++ran;
          } catch (const InputError& error) {
            BOOST_TEST(holds(error.what(), "allowed: "), what + ": " + error.what());
            ++refused;
          }
        }
      }
    }
  }
  BOOST_TEST_MESSAGE(std::to_string(ran) + " ran, " + std::to_string(refused) + " were refused");
  BOOST_TEST(ran > 50);
  BOOST_TEST(refused > 5);
}

BOOST_AUTO_TEST_SUITE_END()
