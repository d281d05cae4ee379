// Figures: the script and the data carry every number, and a failing gnuplot is noticed.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/figure.hpp"
#include "runner/panel.hpp"
#include "tests/drawn.hpp"
#include "tests/folder.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(figures)

namespace {

namespace fs = std::filesystem;
using diptych::tests::contents;
using diptych::tests::drawn;
using diptych::tests::Folder;
using diptych::tests::holds;
using diptych::tests::Path;
using namespace diptych::reports;

/// A program called gnuplot that does what the text says.
Path stub(const Folder& folder, const std::string& body) {
  const fs::path program = folder.path / "gnuplot";
  std::ofstream(program) << "#!/bin/sh\n" << body << "\n";
  ::chmod(program.c_str(), 0755);
  return Path(folder.path.string() + ":/usr/bin:/bin");
}

/// A step and two ringing answers to it.
Figure example(int panels = 2, int points = 40) {
  Figure figure;
  figure.looks = diptych::runner::looks();
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

const double nan_value = std::numeric_limits<double>::quiet_NaN();

void add(Curve& curve, double x, double y) {
  curve.x.push_back(x);
  curve.y.push_back(y);
}

/// Two bars of length 0.5 in 0 <= x <= 1.5, the right one a mirror image: each has its own level of stress.
Figure two_bars(int particles = 50) {
  Figure figure = example(1);
  figure.x_max = 1.5;
  figure.panels[0].series[0].curve = {{0, 0.5, nan_value, 1, 1.5}, {-0.5, -0.5, nan_value, 0.5, 0.5}};
  for (Figure::Series* series : {&figure.panels[0].series[1], &figure.panels[0].series[2]}) {
    series->curve = {};
    for (int i = 0; i < particles; ++i) add(series->curve, 0.5 * (i + 0.5) / particles, -0.5);
    add(series->curve, nan_value, nan_value);
    for (int i = 0; i < particles; ++i) add(series->curve, 1 + 0.5 * (i + 0.5) / particles, 0.5);
  }
  return figure;
}

/// Where two particles are that meet at x = 0.75, t = 0.25 and fly apart at t = 0.26; x over t, times from the list.
Curve paths(const std::vector<double>& times) {
  Curve curve;
  for (const double side : {-1.0, 1.0}) {
    if (!curve.x.empty()) add(curve, nan_value, nan_value);
    for (const double t : times) add(curve, 0.75 + side * (std::max(0.0, 0.25 - t) + std::max(0.0, t - 0.26)), t);
  }
  return curve;
}

/// The whole flight, and the contact magnified. The series come in the wrong order on purpose.
Figure motion_diagram() {
  std::vector<double> times;
  for (int i = 0; i <= 4000; ++i) times.push_back(i / 8000.0);
  Figure figure;
  figure.looks = diptych::runner::looks();
  figure.id = "fig4";
  figure.title = "Motion";
  figure.x_label = "position x [m]";
  figure.y_label = "time t [s]";
  figure.x_max = 1.5;
  figure.y_min = 0;
  figure.y_max = 0.5;
  figure.motion = true;
  const Figure::Series mpm{"MPM", "mpm", paths(times)}, fem{"FEM", "fem", paths(times)},
      exact{"exact", "exact", paths({0, 0.25, 0.26, 0.5})};
  figure.panels.resize(2);
  figure.panels[0].label = "whole flight";
  figure.panels[1].label = "contact";
  for (Figure::Panel& panel : figure.panels) panel.series = {mpm, fem, exact};
  figure.panels[1].x_range = {{0.7, 0.8}};
  figure.panels[1].y_range = {{0.245, 0.265}};
  return figure;
}

/// One element of a panel's plot command: "lines ls 2", and its points as gnuplot reads them.
struct Drawing {
  std::string style;
  Curve points;
  std::size_t breaks() const {
    return static_cast<std::size_t>(std::count_if(points.x.begin(), points.x.end(), [](double x) { return x != x; }));
  }
};
std::vector<Drawing> drawings(const std::string& script, int panel) {
  std::vector<Drawing> all;
  std::istringstream in(script.substr(script.find("# Panel " + std::to_string(panel) + "\n")));
  std::string line;
  while (std::getline(in, line) && !line.starts_with("plot ")) {
  }
  for (std::size_t at = 0; (at = line.find("with ", at)) != std::string::npos;) {
    at += 5;
    all.push_back({line.substr(at, line.find(", ", at) - at), {}});
  }
  for (Drawing& one : all)
    while (std::getline(in, line) && line != "e") {
      const std::size_t blank = line.find(' ');
      add(one.points, std::stod(line.substr(0, blank)), std::stod(line.substr(blank)));
    }
  return all;
}

/// The lines of one colour in a picture, without the legend's sample [px].
std::vector<Curve> lines_in(const std::string& svg, const std::string& colour) {
  std::vector<Curve> lines;
  for (std::size_t at = 0; (at = svg.find("<path stroke='" + colour + "'", at)) != std::string::npos; ++at) {
    const std::size_t from = svg.find("d='", at) + 3;
    std::istringstream in(svg.substr(from, svg.find('\'', from) - from));
    char letter = 0, comma = 0;
    double x = 0, y = 0;
    while (in >> letter && letter != 'Z' && in >> x >> comma >> y) {
      if (letter == 'M') lines.emplace_back();
      add(lines.back(), x, y);
    }
  }
  std::erase_if(lines, [](const Curve& c) { return c.x.size() == 2 && c.y[0] == c.y[1] && c.x[1] - c.x[0] < 36; });
  return lines;
}
/// The script's part for one panel, up to its data.
std::string panel_of(const std::string& script, int panel) {
  const std::size_t from = script.find("# Panel " + std::to_string(panel) + "\n");
  const std::size_t next = script.find("# Panel ", from + 1), plot = script.find("\nplot ", from);
  const std::size_t end = script.find("\nunset label", plot), stop = std::min(next, script.find("\n\n", end));
  return script.substr(from, plot + 6 - from) + script.substr(end, stop + 1 - end);
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? nan_value : std::stod(text.substr(at + words.size()));
}

/// Words that the script puts on the page, where (shares of the page) and whether they end there.
struct Label {
  std::string text;
  double x = 0, y = 0;
  bool right = false;
};
std::vector<Label> labels_in(const std::string& script) {
  std::vector<Label> all;
  std::istringstream in(script);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find("' at screen ");
    if (!line.starts_with("set label '") || at == std::string::npos || at == 11) continue;
    Label label{line.substr(11, at - 11), 0, 0, line.find(" right ", at) != std::string::npos};
    char comma = 0;
    std::istringstream(line.substr(at + 12)) >> label.x >> comma >> label.y;
    all.push_back(label);
  }
  return all;
}

/// Ends of upright lines that leave a panel, and of bars: x as on the axis, y as a share of the page.
struct Arrow {
  double x = 0, y = 0;
  bool upright = false;
};
std::vector<Arrow> arrows_in(const std::string& script) {
  std::vector<Arrow> all;
  std::istringstream in(script);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("set arrow from ") || !holds(line, "screen")) continue;
    const std::size_t to = line.find(" to "), screen = line.find("screen ", to);
    all.push_back({std::stod(line.substr(to + 4)), std::stod(line.substr(screen + 7)), holds(line, ",graph 1 to ")});
  }
  return all;
}

/// Two stacked histories; the first has time windows, of which two overlap and one leaves the panel, and predictions.
Figure histories() {
  Figure figure = example(2);
  figure.id = "fig5";
  figure.x_max = 7;
  figure.y_max = 5;
  figure.panels[0].label = "longitudinal";
  figure.panels[1].label = "lateral";
  for (Figure::Panel& panel : figure.panels)
    for (Figure::Series& series : panel.series) {
      series.curve = {};
      for (int i = 0; i < 70; ++i) add(series.curve, 0.1 * i, i < 9 || i > 49 ? 0 : 4.25);
    }
  figure.panels[0].spans = {{1.1, 2.3, "window 1: behind the shock", "intact"},
                            {2.8, 4.6, "window 2: behind the failure wave", "failed"},
                            {4.3, 5.4, "window 3", "release"},
                            {5.6, 7.5, "window 4", "intact"}};
  figure.panels[0].marks = {{0.9, "shock", true}, {2.6, "failure wave", true}, {4.25, "plateau", false}};
  return figure;
}

const std::string fem_colour = "rgb(  8,  48, 107)", exact_colour = "rgb(198, 198, 198)";

}  // namespace

BOOST_AUTO_TEST_CASE(script_data_and_picture) {
  const Folder folder;
  Figure figure = example();
  figure.panels[0].series[1].curve.y[3] = 0.1 + 0.2;
  const bool picture = drawn(figure, folder.path / "new");
  const std::string script = contents(folder.path / "new" / "fig1.gp");
  const std::string csv = contents(folder.path / "new" / "fig1.csv");
  BOOST_TEST(holds(script, "3.0000000000000004e-01"));
  BOOST_TEST(holds(script, "noenhanced"));
  BOOST_TEST(holds(script, "σ & <it''s> `date` $x \"q\"'"));
  BOOST_TEST(script.ends_with("# end of fig1\n"));
  BOOST_TEST(csv.starts_with("# figure: fig1\n# title: Stress along"));
  BOOST_TEST(holds(csv, "# note: Our choice: C = 0.5 and one particle a cell\n"));
  BOOST_TEST(holds(csv, "# y: stress [Pa]\npanel,series,x,y\n"));
  BOOST_TEST(holds(csv, "\"t = 0 L/c, \"\"front\"\"\",FEM,0.0875,0.30000000000000004\n"));
  if (!picture) return;
  const std::string svg = contents(folder.path / "new" / "fig1.svg");
  BOOST_TEST(holds(svg, "mesh_II, σ &amp; &lt;it's> `date` $x \"q\""));
  BOOST_TEST(holds(svg, "@x 100 %d"));
  BOOST_TEST(holds(svg, "t = 1 L/c"));
  BOOST_TEST(std::distance(fs::directory_iterator(folder.path / "new"), fs::directory_iterator()) == 3);
}

BOOST_AUTO_TEST_CASE(same_bytes_again_and_by_hand) {
  const Folder folder, other;
  if (!drawn(example(), folder.path) || !drawn(example(), other.path)) return;
  for (const char* name : {"fig1.gp", "fig1.csv", "fig1.svg"})
    BOOST_TEST((contents(folder.path / name) == contents(other.path / name)), name);
  // As a user does it, from another folder: the picture lands beside the script.
  for (const char* locale : {"C", "C.UTF-8", "de_DE.UTF-8"}) {
    fs::remove(folder.path / "fig1.svg");
    const std::string command =
        "LC_ALL=" + std::string(locale) + " gnuplot \"" + (folder.path / "fig1.gp").string() + '"';
    BOOST_TEST(std::system((command + " 2>\"" + (folder.path / "words").string() + '"').c_str()) == 0);
    BOOST_TEST((contents(folder.path / "fig1.svg") == contents(other.path / "fig1.svg")), locale);
  }
}

BOOST_AUTO_TEST_CASE(many_panels_and_points) {
  const Folder folder;
  drawn(example(6, 500), folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  BOOST_TEST(holds(script, "MPM (marker at every 11th point)"));
  BOOST_TEST(holds(script, " pi 11 "));
  BOOST_TEST(holds(script, "# Panel 6\n"));
}

BOOST_AUTO_TEST_CASE(values_that_are_not_finite) {
  const Folder folder;
  Figure figure = example(3);
  const double infinity = std::numeric_limits<double>::infinity();
  figure.panels[0].series[2].curve.y[5] = nan_value;
  figure.panels[0].series[2].curve.y[6] = infinity;
  figure.panels[0].series[2].curve.y[7] = -1e300;
  for (double& y : figure.panels[1].series[2].curve.y) y = nan_value;
  figure.panels[2].series.clear();
  drawn(figure, folder.path);
  BOOST_TEST(holds(contents(folder.path / "fig1.gp"), " nan\n"));
  BOOST_TEST(holds(contents(folder.path / "fig1.gp"), "[no finite values: MPM]"));
  BOOST_TEST(holds(contents(folder.path / "fig1.csv"), ",nan\n"));
}

BOOST_AUTO_TEST_CASE(no_line_crosses_the_gap_between_two_bars) {
  const Folder folder;
  const bool picture = drawn(two_bars(), folder.path);
  const std::vector<Drawing> all = drawings(contents(folder.path / "fig1.gp"), 1);
  BOOST_TEST_REQUIRE(all.size() == 4U);
  BOOST_TEST(all[0].breaks() == 1U);
  BOOST_TEST(all[1].points.x.size() == 101U);
  BOOST_TEST(std::isnan(all[1].points.x[50]));
  BOOST_TEST(std::isnan(all[1].points.y[50]));
  const std::string csv = contents(folder.path / "fig1.csv");
  BOOST_TEST(holds(csv, "\n# nan: a line ends here; the next row begins a new one\npanel,series,x,y\n"));
  BOOST_TEST(holds(csv, "FEM,0.495,-0.5\n\"t = 0 L/c, \"\"front\"\"\",FEM,nan,nan\n"));
  if (!picture) return;
  const std::string svg = contents(folder.path / "fig1.svg");
  for (const std::string& colour : {fem_colour, exact_colour}) {
    const std::vector<Curve> lines = lines_in(svg, colour);
    BOOST_TEST_REQUIRE(lines.size() == 2U, colour);
    BOOST_TEST(lines[0].x.back() < 360);  // the plot begins at 88 px and 788 px show 1.5: the gap is 351 to 613
    BOOST_TEST(lines[1].x.front() > 605);
  }
}

BOOST_AUTO_TEST_CASE(each_bar_begins_with_a_marker) {
  const Folder folder;
  drawn(two_bars(200), folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  const std::vector<Drawing> all = drawings(script, 1);
  BOOST_TEST_REQUIRE(all.size() == 4U);
  BOOST_TEST(all[2].style == "lines ls 3");
  BOOST_TEST(all[2].points.x.size() == 401U);
  BOOST_TEST(all[2].breaks() == 1U);
  BOOST_TEST(all[3].style == "points ls 3");
  // 199 steps go over 261 px: markers 7.5 px apart are 5.7 points apart, the next odd number is 7.
  BOOST_TEST(holds(script, " pi 7 "));
  BOOST_TEST(holds(script, "'MPM (marker at every 7th point)'"));
  const Curve& marked = all[3].points;
  BOOST_TEST_REQUIRE(marked.x.size() == 58U);  // 200 / 7, rounded up, for each bar
  for (std::size_t i = 0; i < 29; ++i) {
    const double first = 0.5 * (7.0 * static_cast<double>(i) + 0.5) / 200;
    BOOST_TEST(std::abs(marked.x[i] - first) < 1e-12);
    BOOST_TEST(std::abs(marked.x[i + 29] - (1 + first)) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(motion_diagram_shows_the_flight_and_the_contact) {
  const Folder folder;
  const bool picture = drawn(motion_diagram(), folder.path);
  const std::string script = contents(folder.path / "fig4.gp");
  BOOST_TEST(holds(script, "set xrange [0:1.5]; set yrange [0:0.5]\nset format x '%g'; set format y '%g'\n"));
  BOOST_TEST(holds(script, "set xrange [0.7:0.8]; set yrange [0.245:0.265]\nset format x '%g'; set format y '%g'\n"));
  BOOST_TEST(holds(script, "rectangle from 0.7,0.245 to 0.8,0.265 "));  // in the first panel: what the second magnifies
  BOOST_TEST(script.find(" rectangle ") < script.find("# Panel 2\n"));
  BOOST_TEST(script.find(" rectangle ") == script.rfind(" rectangle "));
  BOOST_TEST(script.find("unset object") < script.find("# Panel 2\n"));
  BOOST_TEST(holds(script, "size 900,"));
  const auto margins = [&](int panel) {
    const std::size_t at = script.find("set tmargin", script.find("# Panel " + std::to_string(panel) + "\n"));
    return script.substr(at, script.find('\n', at) - at);
  };
  BOOST_TEST(margins(1) == margins(2));  // side by side
  for (const int panel : {1, 2}) {
    const std::vector<Drawing> all = drawings(script, panel);
    BOOST_TEST_REQUIRE(all.size() == 4U);
    // Exact below all, the line between markers below FEM's, markers above: so methods that agree can all be seen.
    BOOST_TEST(all[0].style == "lines ls 3");
    BOOST_TEST(all[1].style == "lines ls 1");
    BOOST_TEST(all[2].style == "lines ls 2");
    BOOST_TEST(all[3].style == "points ls 1");
    for (const std::size_t i : {0U, 1U, 2U}) BOOST_TEST(all[i].breaks() == 1U);
    BOOST_TEST(all[1].points.x.size() == 2U * 4001 + 1);
    BOOST_TEST(all[3].breaks() == 0U);
    // Markers of both particles at the same times, the first at the start, as far apart as a reader can tell.
    const Curve& marked = all[3].points;
    const std::size_t half = marked.y.size() / 2;
    BOOST_TEST(marked.y.size() == 2 * half);
    BOOST_TEST(marked.y[0] == 0.0);
    for (std::size_t i = 0; i < half; ++i) BOOST_TEST(marked.y[i] == marked.y[i + half]);
    const double pixels = 450 * (marked.y[1] - marked.y[0]) / (panel == 1 ? 0.5 : 0.02);  // upwards
    BOOST_TEST(pixels > 15);
    BOOST_TEST(pixels < 30);
  }
  if (!picture) return;
  // Every path of both panels is there, also the exact ones, of which the second panel holds the two kinks only.
  const std::string svg = contents(folder.path / "fig4.svg");
  for (const std::string& colour : {fem_colour, exact_colour}) {
    const std::vector<Curve> lines = lines_in(svg, colour);
    BOOST_TEST(lines.size() == 4U, colour);
    for (const Curve& line : lines) {
      const auto [low, high] = std::minmax_element(line.y.begin(), line.y.end());
      BOOST_TEST(std::abs(*high - *low - 450) < 2, colour);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_crosses_a_panel_without_a_point_in_it) {
  const Folder folder;
  Figure figure = motion_diagram();
  figure.panels.erase(figure.panels.begin());
  figure.panels[0].series = {{"exact", "exact", {{0, 1.5}, {0, 0.51}}}, {"FEM", "fem", {{0, 0.1}, {0.2, 0.3}}}};
  const bool picture = drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig4.gp");
  BOOST_TEST(holds(script, "'contact [outside the axes: FEM]'"));
  if (!picture) return;
  const std::vector<Curve> lines = lines_in(contents(folder.path / "fig4.svg"), exact_colour);
  BOOST_TEST_REQUIRE(lines.size() == 1U);
  BOOST_TEST(lines[0].x.back() - lines[0].x.front() > 400);
}

BOOST_AUTO_TEST_CASE(a_panel_that_magnifies_one_axis_alone_is_framed_too) {
  const Folder folder;
  Figure figure = motion_diagram();
  figure.panels[1].x_range.reset();
  drawn(figure, folder.path);
  BOOST_TEST(holds(contents(folder.path / "fig4.gp"), "rectangle from 0,0.245 to 1.5,0.265 "));
  figure.panels[1].x_range = {{0.7, 0.8}};
  figure.panels[1].y_range.reset();
  drawn(figure, folder.path);
  BOOST_TEST(holds(contents(folder.path / "fig4.gp"), "rectangle from 0.7,0 to 0.8,0.5 "));
  figure.panels[1].x_range.reset();  // the same axes: nothing is magnified
  drawn(figure, folder.path);
  BOOST_TEST(!holds(contents(folder.path / "fig4.gp"), "rectangle"));
}

BOOST_AUTO_TEST_CASE(methods_that_agree_take_turns_with_their_markers) {
  const Folder folder;
  Figure figure = motion_diagram();
  for (Figure::Panel& panel : figure.panels) {
    panel.series.push_back(panel.series[0]);
    panel.series.back().label = "MPM 2";
  }
  drawn(figure, folder.path);
  for (const int panel : {1, 2}) {
    const std::vector<Drawing> all = drawings(contents(folder.path / "fig4.gp"), panel);
    BOOST_TEST_REQUIRE(all.size() == 6U);
    const Curve &one = all[4].points, &other = all[5].points;
    const double share = (other.y[0] - one.y[0]) / (one.y[1] - one.y[0]);
    BOOST_TEST(share > 0.4);
    BOOST_TEST(share < 0.6);
  }
}

BOOST_AUTO_TEST_CASE(panels_with_axes_of_their_own) {
  const Folder folder;
  Figure figure = example(3);
  figure.panels[1].y_range = {{-7, 9}};
  figure.panels[2].x_label = "distance [mm]";
  figure.panels[2].y_label = "velocity [m/s]";
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  BOOST_TEST(holds(script, "set xrange [0:1]; set yrange [-1:2]\n"));
  BOOST_TEST(holds(script, "set xrange [0:1]; set yrange [-7:9]\n"));
  BOOST_TEST(script.rfind("set yrange [-1:2]") > script.find("# Panel 3"));
  BOOST_TEST(!holds(script, "set format x ''"));  // a label of its own without tick labels would be read for another's
  const auto times = [&](const std::string& words) {
    int count = 0;
    for (std::size_t at = 0; (at = script.find("set label '" + words + "'", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  BOOST_TEST(times("x / L [-]") == 2);
  BOOST_TEST(times("distance [mm]") == 1);
  BOOST_TEST(times("stress [Pa]") == 2);
  BOOST_TEST(times("velocity [m/s]") == 1);
  BOOST_TEST(holds(contents(folder.path / "fig1.csv"), "# y of panel 't = 2 L/c, \"front\"': velocity [m/s]\npanel,"));
}

BOOST_AUTO_TEST_CASE(a_plain_figure_has_nothing_of_motion_diagrams) {
  const Folder folder;
  drawn(example(3, 500), folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  for (const char* command : {"set clip", "object", "nan", "graph", "style line 109", "style line 110"})
    BOOST_TEST(!holds(script, command), command);
  BOOST_TEST(script.find("set xrange") == script.rfind("set xrange"));
  BOOST_TEST(holds(script, "set format x ''"));
  const std::vector<Drawing> all = drawings(script, 1);
  BOOST_TEST_REQUIRE(all.size() == 3U);
  BOOST_TEST(all[2].style == "linespoints ls 3");
  BOOST_TEST(!holds(contents(folder.path / "fig1.csv"), "nan"));
}

BOOST_AUTO_TEST_CASE(spans_and_marks_stand_at_their_numbers) {
  const Folder folder;
  const bool picture = drawn(histories(), folder.path);
  const std::string script = contents(folder.path / "fig5.gp");
  BOOST_TEST(holds(script, "set xrange [0:7]; set yrange [-1:5]\n"));  // no label lifts the axis
  const std::string first = panel_of(script, 1), second = panel_of(script, 2);
  for (const std::string range : {"1.1,graph 0 to 2.3", "2.8,graph 0 to 4.6", "4.3,graph 0 to 5.4", "5.6,graph 0 to 7"})
    BOOST_TEST(holds(first, "set object rectangle from " + range + ",graph 1 behind "), range);
  for (const std::string x : {"1.1", "2.3", "2.8", "4.6", "4.3", "5.4", "5.6"})  // not where the panel cuts one
    BOOST_TEST(holds(first, "set arrow from " + x + ",graph 0 to " + x + ",graph 1 nohead back ls 11"), x);
  BOOST_TEST(!holds(first, "set arrow from 7,"));
  BOOST_TEST(holds(first, "set arrow from 0.9,graph 0 to 0.9,graph 1 nohead front ls 109\n"));
  BOOST_TEST(holds(first, "set arrow from 2.6,graph 0 to 2.6,graph 1 nohead front ls 109\n"));
  BOOST_TEST(holds(first, "set arrow from graph 0,first 4.25 to graph 1,first 4.25 nohead front ls 109\n"));
  BOOST_TEST(first.find("behind") < first.find("\nplot "));
  BOOST_TEST(holds(first, "unset label; unset object; unset arrow\n"));
  for (const std::string word : {"object", "arrow"})
    BOOST_TEST(!holds(second, word), word);  // they are the first's alone
  // Told apart by dashes: one look for each kind, also of its bar, and one for marks.
  for (const std::string look : {"110 lw 1.1 lc rgb '#1f5f8b'  # edges of spans of kind 'intact'",
                                 "111 lw 1.1 lc rgb '#8a5a00' dt (9,4)  # edges of spans of kind 'failed'",
                                 "112 lw 1.1 lc rgb '#00604a' dt (2,3)  # edges of spans of kind 'release'",
                                 "109 lw 0.9 lc rgb '#333333' dt (10,3,2,3)  # marks"})
    BOOST_TEST(holds(script, "set style line " + look + "\n"), look);
  BOOST_TEST(!holds(script, "set style line 113 "));
  for (const auto& [x, ls] : {std::pair{"1.1", "110"}, {"2.8", "111"}, {"4.3", "112"}, {"5.6", "110"}}) {
    const std::size_t edge = first.find(std::string("set arrow from ") + x + ",graph 0");
    BOOST_TEST(first.substr(edge, first.find('\n', edge) - edge).ends_with(std::string(" ls ") + ls), x);
    const std::size_t bar = first.find(std::string("set arrow from ") + x + ",screen");
    BOOST_TEST_REQUIRE(bar != std::string::npos, x);
    BOOST_TEST(first.substr(bar, first.find('\n', bar) - bar).ends_with(std::string(",90 front ls ") + ls), x);
  }
  if (!picture) return;
  // 88 px to 876 px show 0 to 7: the first band goes from 211.8 px to 346.9 px, under the curves.
  const std::string svg = contents(folder.path / "fig5.svg");
  const std::string colour = "rgb( 86, 180, 233)";
  const std::size_t shade = svg.find("<polygon fill = '" + colour), last = svg.rfind("<polygon fill = '" + colour);
  BOOST_TEST_REQUIRE(shade != std::string::npos);
  std::istringstream in(svg.substr(svg.find("points = '", shade) + 10, 60));
  double x = 0;
  in >> x;
  BOOST_TEST(std::abs(x - 211.8) < 0.2);
  BOOST_TEST(shade != last);
  BOOST_TEST(lines_in(svg.substr(last), fem_colour).size() == 2U);  // drawn later: of this panel and of the next
}

BOOST_AUTO_TEST_CASE(labels_of_spans_and_marks_do_not_overlap) {
  const Folder folder;
  Figure figure = histories();
  figure.panels[0].spans.push_back({0, 0.4, "start", "intact"});  // under the panel's own label
  figure.panels[1].spans = figure.panels[0].spans;
  figure.panels[1].marks = figure.panels[0].marks;
  for (const double x : {0.95, 1.0, 6.7, 6.9})  // some so near to the right side that their words stand to the left
    figure.panels[0].marks.push_back({x, "arrival of a wave at " + std::to_string(x), true});
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig5.gp");
  const double height = number_after(script, "rounded size 900,");
  for (const int panel : {1, 2}) {
    const std::string text = panel_of(script, panel);
    const double top = (1 - number_after(text, "set tmargin at screen ")) * height;
    struct Words {
      double low, high, middle;
    };
    std::vector<Words> all;
    for (const Label& label : labels_in(text)) {
      if (label.text == figure.y_label || label.text == figure.x_label) continue;
      const double x = 900 * label.x, w = 6.0 * static_cast<double>(label.text.size());  // at most: they are ASCII
      all.push_back({label.right ? x - w : x, label.right ? x : x + w, (1 - label.y) * height});
      BOOST_TEST(all.back().low >= 88, label.text);
      BOOST_TEST(all.back().high <= 878, label.text);
      BOOST_TEST((all.back().middle < top || label.text == "plateau"), label.text);  // above what curves may reach
    }
    BOOST_TEST(all.size() == (panel == 1 ? 13U : 9U));
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        BOOST_TEST(
            (all[i].high <= all[k].low || all[k].high <= all[i].low || std::abs(all[i].middle - all[k].middle) >= 13));
    // The line of a mark goes on up to its own label, through no other's.
    for (const Arrow& arrow : arrows_in(text)) {
      if (!arrow.upright) continue;
      const double x = 88 + arrow.x / 7 * 788, end = (1 - arrow.y) * height;
      for (const Words& words : all) BOOST_TEST((x <= words.low || x >= words.high || words.middle <= end), arrow.x);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_label_of_a_plateau_avoids_curves) {
  const Folder folder;
  Figure figure = histories();
  figure.panels[0].spans.clear();
  figure.panels[0].marks = {{4.25, "plateau", false}};
  const auto place = [&] {
    drawn(figure, folder.path);
    for (const Label& label : labels_in(panel_of(contents(folder.path / "fig5.gp"), 1)))
      if (label.text == "plateau") return label.x;
    return nan_value;
  };
  BOOST_TEST(std::abs(900 * place() - (876 - 6 - 7 * 6.2)) < 0.1);  // the curve is at 0 there
  for (Figure::Series& series : figure.panels[0].series) {          // now it is at 4.25 from 0.9 to the end
    for (std::size_t i = 0; i < series.curve.x.size(); ++i) series.curve.y[i] = series.curve.x[i] < 0.9 ? 0 : 4.25;
    add(series.curve, 7, 4.25);
  }
  BOOST_TEST(900 * place() + 7 * 6.2 < 88 + 0.9 / 7 * 788);
  figure.panels[0].marks.push_back({4.3, "plateau too", false});
  Curve& everywhere = figure.panels[0].series[0].curve;
  for (int i = 0; i < 700; ++i) add(everywhere, 0.01 * i, i % 2 == 0 ? -1 : 5);
  drawn(figure, folder.path);
  BOOST_TEST(labels_in(panel_of(contents(folder.path / "fig5.gp"), 1)).size() == 3U);  // no room, but not lost
}

BOOST_AUTO_TEST_CASE(words_of_spans_and_marks_stay_as_they_are) {
  const Folder folder;
  Figure figure = histories();
  const std::string nasty = "σ_{xx}^2 @b {c} \\n `date` $x %d & <it's>";
  figure.panels[0].spans = {{1, 2, nasty + "\nspan", "k'i\nn_d"}};
  figure.panels[0].marks = {{3, nasty + " upright", true}, {2, nasty + " level", false}};
  const bool picture = drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig5.gp"), csv = contents(folder.path / "fig5.csv");
  const std::string in_quotes = "'σ_{xx}^2 @b {c} \\n `date` $x %d & <it''s> ";
  for (const std::string end : {"span'", "upright'", "level'"})
    BOOST_TEST(holds(script, "set label " + in_quotes + end + " at screen "), end);
  BOOST_TEST(holds(script, "  # edges of spans of kind 'k''i n_d'\n"));
  const std::string panel = " of panel 'longitudinal': ";
  BOOST_TEST(holds(csv, "# span" + panel + "x from 1 to 2, k'i n_d: " + nasty + " span\n"));
  BOOST_TEST(holds(csv, "# mark" + panel + "x = 3: " + nasty + " upright\n"));
  BOOST_TEST(holds(csv, "# mark" + panel + "y = 2: " + nasty + " level\n"));
  if (!picture) return;
  const std::string svg = contents(folder.path / "fig5.svg");
  for (const std::string end : {"span", "upright", "level"})
    BOOST_TEST(holds(svg, "σ_{xx}^2 @b {c} \\n `date` $x %d &amp; &lt;it's> " + end), end);
}

BOOST_AUTO_TEST_CASE(data_of_spans_and_marks) {
  const Folder folder;
  Figure figure = histories();
  figure.panels[1].spans = {{0.1 + 0.2, 0.5, "late", ""}};
  drawn(figure, folder.path);
  const std::string csv = contents(folder.path / "fig5.csv");
  BOOST_TEST(holds(csv,
                   "# span of panel 'longitudinal': x from 1.1 to 2.3, intact: window 1: behind the shock\n"
                   "# span of panel 'longitudinal': x from 2.8 to 4.6, failed: window 2: behind the failure wave\n"
                   "# span of panel 'longitudinal': x from 4.3 to 5.4, release: window 3\n"
                   "# span of panel 'longitudinal': x from 5.6 to 7.5, intact: window 4\n"
                   "# mark of panel 'longitudinal': x = 0.9: shock\n"
                   "# mark of panel 'longitudinal': x = 2.6: failure wave\n"
                   "# mark of panel 'longitudinal': y = 4.25: plateau\n"
                   "# span of panel 'lateral': x from 0.30000000000000004 to 0.5: late\n"
                   "panel,series,x,y\n"));
}

BOOST_AUTO_TEST_CASE(spans_and_marks_out_of_sight_are_named) {
  const Folder folder;
  Figure figure = histories();
  figure.panels[0].spans.push_back({7.5, 8, "late window", "intact"});
  figure.panels[0].spans.push_back({-3, -2, "", "early"});
  figure.panels[0].marks.push_back({9, "late wave", true});
  figure.panels[0].marks.push_back({-2, "low plateau", false});
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig5.gp");
  BOOST_TEST(holds(script, "'longitudinal [outside the axes: late window, early, late wave, low plateau]'"));
  for (const std::string number : {"7.5", "-3", "9", "-2"}) BOOST_TEST(!holds(script, "from " + number + ","), number);
  BOOST_TEST(!holds(script, "first -2"));
}

BOOST_AUTO_TEST_CASE(without_labels_there_is_no_room_for_them) {
  const Folder folder;
  Figure figure = histories();
  drawn(figure, folder.path);
  const double with = number_after(contents(folder.path / "fig5.gp"), "rounded size 900,");
  for (Figure::Span& span : figure.panels[0].spans) span.label.clear();
  for (Figure::Mark& mark : figure.panels[0].marks) mark.label.clear();
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig5.gp");
  BOOST_TEST(number_after(script, "rounded size 900,") == with - 2 * (2 * 18 + 4));  // two rows above each panel
  BOOST_TEST(holds(script, "rectangle from 1.1,"));
  BOOST_TEST(holds(script, "set arrow from 0.9,graph 0"));
  BOOST_TEST(!holds(script, "heads"));
  BOOST_TEST(labels_in(panel_of(script, 1)).size() == 1U);
}

BOOST_AUTO_TEST_CASE(thin_series_have_the_colour_of_their_method) {
  const Folder folder;
  Figure figure = example(1);
  for (const char* kind : {"fem-thin", "mpm-thin"}) {
    Figure::Series series = figure.panels[0].series[kind[0] == 'f' ? 1 : 2];
    series.kind = kind;
    series.label += " without viscosity";
    figure.panels[0].series.push_back(series);
  }
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  BOOST_TEST(holds(script, "set style line 2 lw 1.4 lc rgb '#08306b'  # 'FEM'\n"));
  BOOST_TEST(holds(script, "set style line 4 lw 0.8 lc rgb '#08306b' dt (14,6)  # 'FEM without viscosity'\n"));
  BOOST_TEST(holds(script, "set style line 3 lc rgb '#d55e00' pt 6 "));
  BOOST_TEST(holds(script, "set style line 5 lc rgb '#d55e00' pt 2 "));
  const std::vector<Drawing> all = drawings(script, 1);
  BOOST_TEST_REQUIRE(all.size() == 5U);
  BOOST_TEST(all[3].style == "lines ls 4");
  BOOST_TEST(all[4].style == "points ls 5");
}

BOOST_AUTO_TEST_CASE(a_long_name_in_the_legend_goes_on_below) {
  const Folder folder;
  Figure figure = example(1);
  drawn(figure, folder.path);
  const double before = number_after(contents(folder.path / "fig1.gp"), "rounded size 900,");
  std::string name = "FEM";
  for (int i = 0; i < 30; ++i) name += " with words";
  figure.panels[0].series[1].label = name;
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig1.gp");
  // 333 characters of 7 px need four lines of 747 px; one more for each entry beside it.
  BOOST_TEST(number_after(script, "rounded size 900,") == before + 5 * 20);
  for (const Label& label : labels_in(script.substr(0, script.find("# Panel 1\n"))))
    BOOST_TEST(label.text.size() * 7 < 800U, label.text);
}

BOOST_AUTO_TEST_CASE(missing_gnuplot_leaves_script_and_data) {
  const Folder folder, empty;
  std::ofstream(folder.path / "fig1.svg") << "an old picture";
  const Path nowhere(empty.path.string());
  std::string message;
  BOOST_TEST((draw(example(), folder.path, message) == Drawn::gnuplot_missing));
  BOOST_TEST(holds(message, "No such file"));
  BOOST_TEST(contents(folder.path / "fig1.gp").ends_with("# end of fig1\n"));
  BOOST_TEST(holds(contents(folder.path / "fig1.csv"), "panel,series,x,y"));
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
    BOOST_TEST(holds(message, trial.words), message);
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
  refused([](Figure& f) { f.panels[1].x_range = {{0.5, 0.5}}; });
  refused([](Figure& f) { f.panels[1].x_range = {{0.5, 0.4}}; });
  refused([](Figure& f) { f.panels[1].x_range = {{0, std::numeric_limits<double>::infinity()}}; });
  refused([](Figure& f) { f.panels[1].y_range = {{-std::numeric_limits<double>::infinity(), 1}}; });
  refused([](Figure& f) { f.panels[1].y_range = {{0, nan_value}}; });
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Figure::Span& span : {Figure::Span{0.5, 0.4, "", ""},
                                   {nan_value, 1, "", ""},
                                   {0, nan_value, "", ""},
                                   {0, infinity, "", ""},
                                   {-infinity, 1, "", ""}})
    refused([&](Figure& f) { f.panels[1].spans = {{0.2, 0.3, "", ""}, span}; });
  for (const double at : {nan_value, infinity, -infinity})
    for (const bool vertical : {true, false})
      refused([&](Figure& f) { f.panels[1].marks = {{0.2, "", true}, {at, "", vertical}}; });
  BOOST_TEST(folder.entries() == 0U);
  std::ofstream(folder.path / "file") << "x";
  BOOST_CHECK_THROW(draw(example(), folder.path / "file", message), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()
