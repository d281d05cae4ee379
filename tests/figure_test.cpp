// Figures: the script and the data carry every number, and a failing gnuplot is noticed.
#include "reports/figure.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

namespace fs = std::filesystem;
using namespace diptych::reports;

struct Folder {
  Folder() {
    std::string name = (fs::temp_directory_path() / "diptych figure's-XXXXXX").string();  // blanks and quotes welcome
    BOOST_TEST_REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
  fs::path path;
};

/// Another PATH for as long as it lives.
struct Path {
  explicit Path(const std::string& value) : before(std::getenv("PATH")) { ::setenv("PATH", value.c_str(), 1); }
  ~Path() { ::setenv("PATH", before.c_str(), 1); }
  std::string before;
};

/// A program called gnuplot that does what the text says.
Path stub(const Folder& folder, const std::string& body) {
  const fs::path program = folder.path / "gnuplot";
  std::ofstream(program) << "#!/bin/sh\n" << body << "\n";
  ::chmod(program.c_str(), 0755);
  return Path(folder.path.string() + ":/usr/bin:/bin");
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A step and two ringing answers to it.
Figure example(int panels = 2, int points = 40) {
  Figure figure;
  figure.id = "fig1";
  figure.title = "Stress along a bar: mesh_II, σ & <it's> `date` $x \"q\"";
  figure.notes = {"Our choice: C = 0.5\nand one particle a cell", "@x 100 %d"};
  figure.x_label = "x / L [-]";
  figure.y_label = "stress [Pa]";
  figure.y_max = 2;
  for (int p = 0; p < panels; ++p) {
    Figure::Series exact{"exact", "exact", {{0, 0.5, 0.5, 1}, {0, 0, 1, 1}}};
    Figure::Series fem{"FEM", "fem", {}}, mpm{"MPM", "mpm", {}};
    for (int i = 0; i < points; ++i) {
      const double x = (i + 0.5) / points;
      fem.curve.x.push_back(x);
      fem.curve.y.push_back(x < 0.5 ? 0 : 1 + 0.1 * std::sin(40 * x));
      mpm.curve.x.push_back(x);
      mpm.curve.y.push_back(x < 0.5 ? 0 : 1 + 0.1 * std::cos(40 * x));
    }
    figure.panels.push_back({"t = " + std::to_string(p) + " L/c, \"front\"", {exact, fem, mpm}});
  }
  return figure;
}

/// Draws with the gnuplot there is; false, with a message, where there is none.
bool drawn(const Figure& figure, const fs::path& directory) {
  std::string message;
  const Drawn result = draw(figure, directory, message);
  BOOST_TEST((result != Drawn::gnuplot_failed), message);
  if (result == Drawn::gnuplot_missing) BOOST_TEST_MESSAGE("gnuplot is missing: no picture was checked");
  return result == Drawn::yes;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(figures)

BOOST_AUTO_TEST_CASE(script_data_and_picture) {
  const Folder folder;
  Figure figure = example();
  figure.panels[0].series[1].curve.y[3] = 0.1 + 0.2;
  const bool picture = drawn(figure, folder.path / "new");
  const std::string script = contents(folder.path / "new" / "fig1.gp");
  const std::string csv = contents(folder.path / "new" / "fig1.csv");
  BOOST_TEST(has(script, "3.0000000000000004e-01"));
  BOOST_TEST(has(script, "noenhanced"));
  BOOST_TEST(has(script, "σ & <it''s> `date` $x \"q\"'"));
  BOOST_TEST(script.ends_with("# end of fig1\n"));
  BOOST_TEST(csv.starts_with("# figure: fig1\n# title: Stress along"));
  BOOST_TEST(has(csv, "# note: Our choice: C = 0.5 and one particle a cell\n"));
  BOOST_TEST(has(csv, "# y: stress [Pa]\npanel,series,x,y\n"));
  BOOST_TEST(has(csv, "\"t = 0 L/c, \"\"front\"\"\",FEM,0.0875,0.30000000000000004\n"));
  if (!picture) return;
  const std::string svg = contents(folder.path / "new" / "fig1.svg");
  BOOST_TEST(has(svg, "mesh_II, σ &amp; &lt;it's> `date` $x \"q\""));
  BOOST_TEST(has(svg, "@x 100 %d"));
  BOOST_TEST(has(svg, "t = 1 L/c"));
  BOOST_TEST(std::distance(fs::directory_iterator(folder.path / "new"), fs::directory_iterator()) == 3);
}

BOOST_AUTO_TEST_CASE(same_bytes_again_and_by_hand) {
  const Folder folder, other;
  if (!drawn(example(), folder.path) || !drawn(example(), other.path)) return;
  for (const char* name : {"fig1.gp", "fig1.csv", "fig1.svg"})
    BOOST_TEST((contents(folder.path / name) == contents(other.path / name)), name);
  // As a user does it, from another folder: the picture lands beside the script.
  fs::remove(folder.path / "fig1.svg");
  BOOST_TEST(std::system(("gnuplot \"" + (folder.path / "fig1.gp").string() + "\"").c_str()) == 0);
  BOOST_TEST((contents(folder.path / "fig1.svg") == contents(other.path / "fig1.svg")));
}

BOOST_AUTO_TEST_CASE(many_panels_and_points) {
  const Folder folder;
  drawn(example(6, 500), folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  BOOST_TEST(has(script, "MPM (marker at every 11th point)"));
  BOOST_TEST(has(script, " pi 11 "));
  BOOST_TEST(has(script, "# Panel 6\n"));
}

BOOST_AUTO_TEST_CASE(values_that_are_not_finite) {
  const Folder folder;
  Figure figure = example(3);
  const double nan_value = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  figure.panels[0].series[2].curve.y[5] = nan_value;
  figure.panels[0].series[2].curve.y[6] = infinity;
  figure.panels[0].series[2].curve.y[7] = -1e300;
  for (double& y : figure.panels[1].series[2].curve.y) y = nan_value;
  figure.panels[2].series.clear();
  drawn(figure, folder.path);
  BOOST_TEST(has(contents(folder.path / "fig1.gp"), " nan\n"));
  BOOST_TEST(has(contents(folder.path / "fig1.gp"), "[no finite values: MPM]"));
  BOOST_TEST(has(contents(folder.path / "fig1.csv"), ",nan\n"));
}

BOOST_AUTO_TEST_CASE(missing_gnuplot_leaves_script_and_data) {
  const Folder folder, empty;
  std::ofstream(folder.path / "fig1.svg") << "an old picture";
  const Path nowhere(empty.path.string());
  std::string message;
  BOOST_TEST((draw(example(), folder.path, message) == Drawn::gnuplot_missing));
  BOOST_TEST(has(message, "No such file"));
  BOOST_TEST(contents(folder.path / "fig1.gp").ends_with("# end of fig1\n"));
  BOOST_TEST(has(contents(folder.path / "fig1.csv"), "panel,series,x,y"));
  BOOST_TEST(!fs::exists(folder.path / "fig1.svg"));
  BOOST_TEST(folder.entries() == 2U);
}

BOOST_AUTO_TEST_CASE(failing_gnuplot_is_noticed) {
  struct Trial {
    std::string body, words;
  };
  const std::string name = "name=${3#*\\'}; name=${name%\\'}; ";  // of the picture, out of -e "output_file='...'"
  for (const Trial& trial : {Trial{"echo 'line 3: undefined function' >&2; exit 1", "line 3: undefined function"},
                             Trial{"exit 0", "no picture"}, Trial{"kill -9 $$", "signal 9"},
                             Trial{name + "echo '<svg>half' > \"$name\"", "incomplete"},
                             Trial{name + "echo '<svg></svg>' > \"$name\"; exit 3", "status 3"}}) {
    const Folder folder, programs;
    const Path path = stub(programs, trial.body);
    std::string message;
    BOOST_TEST((draw(example(), folder.path, message) == Drawn::gnuplot_failed), trial.body);
    BOOST_TEST(has(message, trial.words), message);
    BOOST_TEST(folder.entries() == 2U);  // script and data, no picture, no leftovers
  }
}

BOOST_AUTO_TEST_CASE(refuses_what_cannot_be_drawn) {
  const Folder folder;
  std::string message;
  const auto refused = [&](auto change) {
    Figure figure = example();
    change(figure);
    BOOST_CHECK_THROW(draw(figure, folder.path, message), std::invalid_argument);
  };
  refused([](Figure& f) { f.id = "../fig1"; });
  refused([](Figure& f) { f.id = ""; });
  refused([](Figure& f) { f.id = "a'b"; });
  refused([](Figure& f) { f.panels.clear(); });
  refused([](Figure& f) { f.y_max = f.y_min; });
  refused([](Figure& f) { f.x_max = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Figure& f) { f.panels[0].series[0].curve.x.pop_back(); });
  BOOST_TEST(folder.entries() == 0U);
  std::ofstream(folder.path / "file") << "x";
  BOOST_CHECK_THROW(draw(example(), folder.path / "file", message), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()
