// Figures on a plate: the bands cover what they say, the picture is to scale, and what is missing is named.
#include "reports/plate_figure.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/bands.hpp"
#include "runner/panel.hpp"
#include "tests/drawn.hpp"
#include "tests/folder.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(plate_figure)

namespace {

namespace fs = std::filesystem;
using diptych::tests::contents;
using diptych::tests::drawn;
using diptych::tests::Folder;
using diptych::tests::holds;
using diptych::tests::Path;
using diptych::tests::scripted;
using namespace diptych::reports;

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

/// Draws again as a user does: the same picture, and gnuplot has nothing to say. (In a locale without a degree sign it
/// says so.)
template <class AnyFigure>
void draws_again_in_silence(const AnyFigure& figure, const fs::path& directory) {
  const std::string words = (directory / "words").string(), svg = contents(directory / (figure.id + ".svg"));
  const std::string command =
      "LC_ALL=C.UTF-8 gnuplot \"" + (directory / (figure.id + ".gp")).string() + "\" > \"" + words + "\" 2>&1";
  BOOST_TEST(std::system(command.c_str()) == 0);
  BOOST_TEST(contents(words) == "");
  BOOST_TEST((contents(directory / (figure.id + ".svg")) == svg));
  fs::remove(words);
}

const double nan_value = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// A map of f at the nodes.
template <class F>
PlateFigure::Map map_of(int nx, int ny, double width, double height, F&& f) {
  PlateFigure::Map map;
  map.nx = nx;
  map.ny = ny;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) map.nodes.push_back(f(width * i / nx, height * j / ny));
  return map;
}

/// Area inside a ring, positive if it runs anticlockwise.
double area(const Line& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.x.size(); ++i) {
    const std::size_t k = (i + 1) % ring.x.size();
    sum += ring.x[i] * ring.y[k] - ring.x[k] * ring.y[i];
  }
  return sum / 2;
}

double area(const std::vector<Line>& rings) {
  double sum = 0;
  for (const Line& ring : rings) sum += area(ring);
  return sum;
}

PlateFigure::Contour quarter(const std::string& label, const std::string& kind, double radius) {
  PlateFigure::Contour contour{label, radius, kind, {Line{}}};
  for (int i = 0; i <= 30; ++i) {
    const double angle = std::acos(-1.0) / 60 * i;
    contour.lines[0].x.push_back(radius * std::cos(angle));
    contour.lines[0].y.push_back(radius * std::sin(angle));
  }
  return contour;
}

/// FEM, MPM and their difference at so many times.
PlateFigure example(int times = 2) {
  PlateFigure figure;
  figure.looks = diptych::runner::looks();
  figure.id = "fig13";
  figure.title = "Damage C_d on mesh_II: 'σ' & <it's> {b} @ ^ \\ `date` $x \"q\"";
  figure.notes = {"Reconstructed parameters: ε_v1 = 0.002, K_IC, V_d,max, 1/λ_2, a_long_name, ΔC_d = 1"};
  figure.x_label = "x [m]";
  figure.y_label = "y [m]";
  figure.width = 1;
  figure.height = 1.5;
  figure.columns = 3;
  for (int t = 0; t < times; ++t)
    for (const char* method : {"FEM", "MPM", "FEM − MPM"}) {
      PlateFigure::Panel panel;
      panel.label = std::string(method) + ", t = " + std::to_string(t) + " ms";
      const bool fem = method == std::string("FEM"), mpm = method == std::string("MPM");
      panel.map = map_of(10, 15, 1, 1.5, [&](double x, double y) {
        const double r = std::hypot(x, y);
        return fem ? 0.4 - 0.2 * r : mpm ? 0.39 - 0.2 * r : 0.01 * std::cos(3 * r);
      });
      panel.map->max = fem || mpm ? 0.4 : 0.01;
      panel.map->min = fem || mpm ? 0 : -0.01;
      panel.map->label = fem || mpm ? "C_d [-]" : "difference of C_d [-]";
      panel.map->diverging = !fem && !mpm;
      for (const double r : {0.3, 0.6}) {
        if (!mpm) panel.contours.push_back(quarter(fem ? "level " + std::to_string(r).substr(0, 3) : "", "fem", r));
        if (!fem)
          panel.contours.push_back(quarter(mpm ? "level " + std::to_string(r).substr(0, 3) : "", "mpm", 0.9 * r));
      }
      figure.panels.push_back(panel);
    }
  return figure;
}

ProblemFigure problem() {
  ProblemFigure figure;
  figure.id = "fig12";
  figure.title = "Plate";
  figure.width = 1;
  figure.height = 1.5;
  figure.width_label = "L_x = 1.0 m";
  figure.height_label = "L_y = 1.5 m";
  figure.nx = 10;
  figure.ny = 15;
  figure.sides[0] = {"roller", "", false, "u_x = 0"};
  figure.sides[2] = {"roller", "", false, "u_y = 0"};
  figure.sides[3] = {"platen", "700 MPa, ramp 50 µs", true, "rigid, frictionless"};
  figure.weak_radius = 0.1;
  figure.weak_label = "weak zone";
  figure.annotations = {{0.3, 0.7, "E = 50 GPa"}};
  return figure;
}

/// Every number that follows `key` in the script.
std::vector<double> numbers_after(const std::string& script, const std::string& key) {
  std::vector<double> found;
  for (std::size_t at = 0; (at = script.find(key, at)) != std::string::npos;) {
    at += key.size();
    found.push_back(std::strtod(script.c_str() + at, nullptr));
  }
  return found;
}

std::string panel_of(const std::string& script, int panel) {
  const std::size_t from = script.find("# Panel " + std::to_string(panel) + "\n");
  return script.substr(from, script.find("# Panel " + std::to_string(panel + 1) + "\n") - from);
}

}  // namespace

// ---- bands

BOOST_AUTO_TEST_CASE(region_of_a_linear_field_is_exact) {
  // All numbers are sums of powers of two, so areas are exact.
  const auto map = map_of(8, 4, 2, 1, [](double x, double) { return x; });
  for (const double level : {0.25, 0.3125, 1.0, 1.75}) BOOST_TEST(area(region_above(map, 2, 1, level)) == 2 - level);
  BOOST_TEST(area(region_above(map, 2, 1, -infinity)) == 2.0);
  BOOST_TEST(region_above(map, 2, 1, -infinity).size() == 1U);
  BOOST_TEST(region_above(map, 2, 1, 2.5).empty());
  const auto tilted = map_of(8, 8, 1, 1, [](double x, double y) { return x + y; });
  BOOST_TEST(area(region_above(tilted, 1, 1, 1.5)) == 0.125);
  BOOST_TEST(area(region_above(tilted, 1, 1, 0.625)) == 1 - 0.1953125);
}

BOOST_AUTO_TEST_CASE(holes_run_the_other_way) {
  const auto map =
      map_of(8, 8, 1, 1, [](double x, double y) { return std::max(std::abs(x - 0.5), std::abs(y - 0.5)); });
  const std::vector<Line> rings = region_above(map, 1, 1, 0.25);
  BOOST_TEST_REQUIRE(rings.size() == 2U);
  std::array<double, 2> areas{area(rings[0]), area(rings[1])};
  std::sort(areas.begin(), areas.end());
  const double hole = 0.25 - 4 * 0.5 * 0.125 * 0.125;  // straight within a cell, so the corners are cut
  BOOST_TEST(areas[0] == -hole);
  BOOST_TEST(areas[1] == 1.0);
  // As one polygon: the cuts run both ways and add nothing.
  BOOST_TEST(area(joined(rings)) == 1 - hole);
  const Line polygon = joined(rings);
  BOOST_TEST(polygon.x.size() == rings[0].x.size() + rings[1].x.size() + 3);
}

BOOST_AUTO_TEST_CASE(saddle_follows_its_middle) {
  PlateFigure::Map map;
  map.nodes = {1, 0, 0, 1};  // high at two opposite corners, 0.5 in the middle
  const std::vector<Line> one = region_above(map, 1, 1, 0.5), two = region_above(map, 1, 1, 0.75);
  BOOST_TEST(one.size() == 1U);
  BOOST_TEST(area(one) == 0.75);
  BOOST_TEST(two.size() == 2U);
  BOOST_TEST(area(two) == 2 * 0.5 * 0.25 * 0.25);
}

BOOST_AUTO_TEST_CASE(cells_that_touch_nan_are_left_out) {
  auto map = map_of(4, 4, 1, 1, [](double, double) { return 1; });
  map.nodes[2 * 5 + 2] = nan_value;
  for (const double level : {-infinity, 0.5}) {
    const std::vector<Line> rings = region_above(map, 1, 1, level);
    BOOST_TEST(area(rings) == 0.75);
    BOOST_TEST(rings.size() == 2U);
  }
  for (double& v : map.nodes) v = nan_value;
  BOOST_TEST(region_above(map, 1, 1, -infinity).empty());
}

BOOST_AUTO_TEST_CASE(colours_keep_their_order_in_grey) {
  const auto grey = [](const std::string& colour) {  // relative luminance (IEC 61966-2-1)
    BOOST_TEST_REQUIRE(colour.size() == 7U);
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = std::stoi(colour.substr(1 + 2 * c, 2), nullptr, 16) / 255.0;
      sum += std::array{0.2126, 0.7152, 0.0722}[c] * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return sum;
  };
  for (const double top : {0.3, 0.4, 0.5, 0.5625, 1.0, 7.0, 1e-9, 2e5}) {
    PlateFigure::Map map;
    map.max = top;
    const Bands bands = bands_of(map);
    BOOST_TEST_REQUIRE(bands.edges.size() == bands.colours.size() + 1);
    BOOST_TEST(bands.edges.front() == 0);
    BOOST_TEST(bands.edges.back() == top);
    BOOST_TEST((bands.colours.size() >= 10 && bands.colours.size() <= 20));
    for (std::size_t k = 0; k + 1 < bands.colours.size(); ++k)
      BOOST_TEST(grey(bands.colours[k]) > grey(bands.colours[k + 1]) * 1.04);

    map.diverging = true;
    map.min = -top;
    const Bands both = bands_of(map);
    const std::size_t n = both.colours.size(), middle = n / 2;
    BOOST_TEST_REQUIRE(n % 2 == 1U);
    BOOST_TEST(both.colours[middle] == "#ffffff");
    BOOST_TEST((both.edges[middle] < 0 && both.edges[middle + 1] > 0));
    for (std::size_t k = 0; k < middle; ++k) {
      BOOST_TEST(both.edges[k] == -both.edges[n - k]);
      BOOST_TEST(grey(both.colours[k]) < grey(both.colours[k + 1]));
      BOOST_TEST(grey(both.colours[n - 1 - k]) < grey(both.colours[n - 2 - k]));
    }
  }
  // Round steps where the range allows.
  PlateFigure::Map map;
  map.max = 0.3;
  BOOST_TEST(bands_of(map).colours.size() == 15U);
}

// ---- figures

BOOST_AUTO_TEST_CASE(script_data_and_picture) {
  const Folder folder;
  PlateFigure figure = example();
  figure.panels[0].contours[0].lines[0].x[3] = 0.1 + 0.2;
  figure.panels[1].map->nodes[5] = 1.0 / 3;
  const bool picture = drawn(figure, folder.path / "new");
  const std::string script = contents(folder.path / "new" / "fig13.gp"),
                    csv = contents(folder.path / "new" / "fig13.csv");
  BOOST_TEST(holds(script, "\n0.30000000000000004 "));
  BOOST_TEST(script.ends_with("# end of fig13\n"));
  BOOST_TEST(holds(csv, "# note: Reconstructed parameters"));
  BOOST_TEST(holds(csv, "panel,part,label,line,x,y,value\n"));
  BOOST_TEST(holds(csv, "\"MPM, t = 0 ms\",map,C_d [-],,0.5,0,0.3333333333333333\n"));
  BOOST_TEST(holds(csv, "\"FEM, t = 0 ms\",fem,level 0.3,1,0.30000000000000004,"));
  BOOST_TEST(count(csv, ",map,") == 6 * 11 * 16);
  BOOST_TEST(count(csv, ",fem,") == 4 * 2 * 31);
  if (!picture) return;
  const std::string svg = contents(folder.path / "new" / "fig13.svg");
  BOOST_TEST(holds(svg, " on mesh_II: 'σ' &amp; &lt;it's> {b} @ ^ \\ `date` $x \"q\""));
  BOOST_TEST(std::distance(fs::directory_iterator(folder.path / "new"), fs::directory_iterator()) == 3);
  draws_again_in_silence(figure, folder.path / "new");
  const Folder other;
  drawn(figure, other.path);
  for (const char* name : {"fig13.gp", "fig13.csv", "fig13.svg"})
    BOOST_TEST((contents(folder.path / "new" / name) == contents(other.path / name)), name);
}

BOOST_AUTO_TEST_CASE(symbols_have_their_index_and_names_keep_their_bars) {
  const Folder folder;
  const std::string script = scripted(example(), folder.path);
  for (const char* part : {"C_{d}", "mesh\\_II", "ε_{v1}", "K_{IC}", "V_{d},max", "λ_{2}", "a\\_long\\_name", "ΔC_{d}"})
    BOOST_TEST(holds(script, part), part);
}

BOOST_AUTO_TEST_CASE(a_metre_is_as_long_across_as_up) {
  const Folder folder;
  for (const double height : {1.5, 0.4, 6.0}) {
    PlateFigure figure = example();
    figure.height = height;
    const std::string script = scripted(figure, folder.path);
    const std::size_t size = script.find("size ") + 5;
    const double page = std::strtod(script.c_str() + size, nullptr),
                 tall = std::strtod(script.c_str() + script.find(',', size) + 1, nullptr);
    const std::string panels = script.substr(script.find("# Panel 1\n"));
    const auto l = numbers_after(panels, "set lmargin at screen "), r = numbers_after(panels, "set rmargin at screen "),
               t = numbers_after(panels, "set tmargin at screen "), b = numbers_after(panels, "set bmargin at screen ");
    BOOST_TEST_REQUIRE(l.size() == 6U);
    for (std::size_t i = 0; i < 6; ++i) {
      const double across = (r[i] - l[i]) * page, up = (t[i] - b[i]) * tall / height;
      BOOST_TEST(std::abs(across - up) < 0.6 / height + 0.01);  // the page is a whole number of pixels
      BOOST_TEST(std::abs(across - (r[0] - l[0]) * page) < 0.01);
      BOOST_TEST((b[i] > 0 && t[i] < 1 && l[i] > 0 && r[i] < 1));
    }
    BOOST_TEST(l[0] == l[3]);
    BOOST_TEST(t[0] == t[2]);
  }
}

BOOST_AUTO_TEST_CASE(methods_differ_without_colour) {
  const Folder folder;
  if (!drawn(example(1), folder.path)) return;
  const std::string svg = contents(folder.path / "fig13.svg");
  int fem = 0, mpm = 0;
  for (std::size_t at = 0; (at = svg.find("<path stroke='rgb(", at)) != std::string::npos; ++at) {
    const std::string tag = svg.substr(at, svg.find("d='", at) - at);
    const bool dashed = holds(tag, "stroke-dasharray"), of_fem = holds(tag, "rgb(  8,  48, 107)"),
               of_mpm = holds(tag, "rgb(213,  94,   0)");
    if (of_fem || of_mpm) BOOST_TEST(dashed == of_mpm);
    fem += of_fem ? 1 : 0;
    mpm += of_mpm ? 1 : 0;
  }
  BOOST_TEST(fem == 5);  // two in each of two panels, one in the legend
  BOOST_TEST(mpm == 5);
}

BOOST_AUTO_TEST_CASE(levels_are_named_once) {
  const Folder folder;
  PlateFigure figure = example(1);
  for (PlateFigure::Contour& contour : figure.panels[2].contours)  // both methods' lines of one level
    contour.label = contour.lines[0].x[0] > 0.5 ? "outer" : "inner";
  const std::string script = scripted(figure, folder.path);
  for (const int panel : {1, 2})
    for (const char* level : {"level 0.3", "level 0.6"}) BOOST_TEST(count(panel_of(script, panel), level) == 1);
  for (const char* level : {"inner", "outer"}) BOOST_TEST(count(panel_of(script, 3), level) == 1);
  BOOST_TEST(!holds(panel_of(scripted(example(1), folder.path), 3), "level"));
  // The sign of the largest differences is written out.
  BOOST_TEST(holds(panel_of(script, 3), "'max +0.01'"));
  BOOST_TEST(holds(panel_of(script, 3), "'min −0.01'"));
  BOOST_TEST(!holds(panel_of(script, 1), "'max "));
}

BOOST_AUTO_TEST_CASE(crowded_levels_do_not_cover_each_other) {
  const Folder folder;
  PlateFigure figure = example(1);
  figure.panels.resize(1);
  figure.panels[0].contours.clear();
  for (int k = 0; k < 8; ++k)  // 5 px apart, the labels are 15 px high
    figure.panels[0].contours.push_back(quarter("r = " + std::to_string(k), "fem", 0.7 + 0.02 * k));
  const std::string panel = panel_of(scripted(figure, folder.path), 1);
  struct Box {
    double x0, y0, x1, y1;
  };
  std::vector<Box> boxes;
  std::istringstream in(panel);
  for (std::string line; std::getline(in, line);) {
    Box box{};
    if (std::sscanf(line.c_str(), "set object rectangle from screen %lf,%lf to screen %lf,%lf", &box.x0, &box.y0,
                    &box.x1, &box.y1) == 4)
      boxes.push_back(box);
  }
  BOOST_TEST(boxes.size() == 8U);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Box &a = boxes[i], &b = boxes[k];
      BOOST_TEST((a.x1 <= b.x0 || b.x1 <= a.x0 || a.y1 <= b.y0 || b.y1 <= a.y0));
    }
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_named) {
  const Folder folder;
  PlateFigure figure = example(1);
  figure.panels[0].contours[1].lines.clear();
  figure.panels[1].contours[0].lines[0].y.assign(31, nan_value);
  figure.panels[2].contours[0].lines.clear();  // FEM does not reach what MPM does
  figure.panels[2].contours[0].level = figure.panels[2].contours[1].level = 0.3;
  figure.panels[2].map->nodes[40] = nan_value;
  drawn(figure, folder.path);
  std::string script = contents(folder.path / "fig13.gp");
  std::string words;  // labels may be broken into lines
  for (const std::string& part : {panel_of(script, 1), panel_of(script, 2), panel_of(script, 3)}) {
    std::istringstream in(part);
    for (std::string line; std::getline(in, line);)
      if (line.starts_with("set label '")) words += line.substr(11, line.find("' at ") - 11) + " ";
  }
  BOOST_TEST(holds(words, "FEM, t = 0 ms [not reached: level 0.6]"));
  BOOST_TEST(holds(words, "MPM, t = 0 ms [not reached: level 0.3]"));
  BOOST_TEST(holds(words, "FEM − MPM, t = 0 ms [not reached: FEM 0.3] [grey: no value]"), words);
  BOOST_TEST(holds(panel_of(script, 3), "#c8c8c8"));
  BOOST_TEST(!holds(panel_of(script, 1), "#c8c8c8"));
}

BOOST_AUTO_TEST_CASE(maps_of_one_range_share_a_bar) {
  const Folder folder;
  const auto bars = [&](const PlateFigure& figure, const std::string& label) {
    const std::string script = scripted(figure, folder.path);
    return count(script.substr(0, script.find("# Panel 1\n")), "set label '" + label);
  };
  PlateFigure figure = example();
  BOOST_TEST(bars(figure, "C_{d}") == 1);
  BOOST_TEST(bars(figure, "difference") == 1);
  figure.panels[5].map->max = 0.02;  // another range at the second time: a bar for each
  figure.panels[5].map->min = -0.02;
  BOOST_TEST(bars(figure, "C_{d}") == 1);
  BOOST_TEST(bars(figure, "difference") == 2);
  figure.panels[1].map->max = figure.panels[4].map->max = 0.3;  // the methods apart
  BOOST_TEST(bars(figure, "C_{d}") == 2);
  drawn(figure, folder.path);
  // What lies beyond the range has a tip at its end.
  const std::string script = contents(folder.path / "fig13.gp");
  BOOST_TEST(count(script, "set object polygon") == 1);
}

BOOST_AUTO_TEST_CASE(lines_without_maps_and_breaks) {
  const Folder folder;
  PlateFigure figure = example(1);
  for (PlateFigure::Panel& panel : figure.panels) panel.map.reset();
  figure.panels[0].contours[0].lines[0].x[15] = nan_value;
  drawn(figure, folder.path);
  const std::string script = contents(folder.path / "fig13.gp");
  BOOST_TEST(!holds(script, "bands1"));
  BOOST_TEST(!holds(script, "nan"));
  const std::size_t from = script.find("$contour1_1 << EOD\n");
  const std::string block = script.substr(from, script.find("\nEOD\n", from) - from);
  BOOST_TEST(count(block, "\n\n") == 1);  // the break; another blank line ends the block
  figure.panels[1].contours.clear();
  figure.panels.resize(2);
  figure.columns = 5;  // more than there are
  drawn(figure, folder.path);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_drawn_is_refused) {
  const Folder folder;
  std::string message;
  const auto refused = [&](auto change) {
    PlateFigure figure = example(1);
    change(figure);
    BOOST_CHECK_THROW(draw(figure, folder.path, message), std::invalid_argument);
  };
  refused([](PlateFigure& f) { f.id = "../x"; });
  refused([](PlateFigure& f) { f.panels.clear(); });
  refused([](PlateFigure& f) { f.columns = 0; });
  refused([](PlateFigure& f) { f.width = 0; });
  refused([](PlateFigure& f) { f.height = nan_value; });
  refused([](PlateFigure& f) { f.panels[0].contours[0].kind = "sph"; });
  refused([](PlateFigure& f) { f.panels[0].contours[0].lines[0].x.pop_back(); });
  refused([](PlateFigure& f) { f.panels[0].map->nodes.pop_back(); });
  refused([](PlateFigure& f) { f.panels[0].map->max = f.panels[0].map->min; });
  refused([](PlateFigure& f) { f.panels[0].map->max = infinity; });
  refused([](PlateFigure& f) { f.panels[0].map->nx = 0; });
  const auto unsound = [&](auto change) {
    ProblemFigure figure = problem();
    change(figure);
    BOOST_CHECK_THROW(draw(figure, folder.path, message), std::invalid_argument);
  };
  unsound([](ProblemFigure& f) { f.id = ""; });
  unsound([](ProblemFigure& f) { f.height = -1; });
  unsound([](ProblemFigure& f) { f.ny = 0; });
  unsound([](ProblemFigure& f) { f.sides[1].support = "glued"; });
  unsound([](ProblemFigure& f) { f.weak_radius = 2; });
  unsound([](ProblemFigure& f) { f.weak_radius = nan_value; });
  unsound([](ProblemFigure& f) { f.annotations[0].x = nan_value; });
  BOOST_TEST(fs::is_empty(folder.path));
}

BOOST_AUTO_TEST_CASE(without_gnuplot_script_and_data_remain) {
  const Folder folder;
  std::ofstream(folder.path / "fig13.svg") << "old";
  const Path nowhere(folder.path.string());
  std::string message;
  BOOST_TEST((draw(example(1), folder.path, message) == Drawn::gnuplot_missing));
  BOOST_TEST(holds(message, "gnuplot"));
  BOOST_TEST(fs::exists(folder.path / "fig13.gp"));
  BOOST_TEST(fs::exists(folder.path / "fig13.csv"));
  BOOST_TEST(!fs::exists(folder.path / "fig13.svg"));
}

// ---- the drawing of the problem

BOOST_AUTO_TEST_CASE(problem_shows_its_supports_and_loads) {
  const Folder folder;
  drawn(problem(), folder.path);
  const std::string script = contents(folder.path / "fig12.gp"), csv = contents(folder.path / "fig12.csv");
  for (const char* text :
       {"'L_{x}\u200b = 1.0 m'", "'L_{y}\u200b = 1.5 m'", "'700 MPa, ramp 50 µs'", "'rigid, frictionless'",
        "'weak zone'", "'E = 50 GPa'", "'u_{x}\u200b = 0'", "'FEM: one cell'", "'MPM: one cell'"})
    BOOST_TEST(count(script, text) == 1, text);
  for (const char* row : {"plate,height,1.5\n", "cells,across,10\n", "top,support,platen\n", "top,arrows,outward\n",
                          "left,support,roller\n", "right,support,free\n", "weak zone,radius,0.1\n"})
    BOOST_TEST(holds(csv, row), row);

  // Arrows of the load: outwards here, towards the plate if it pushes. y counts downwards.
  const auto load_arrows = [](const std::string& text) {
    std::vector<std::array<double, 4>> found;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      std::array<double, 4> a{};
      if (holds(line, "#b2182b") && holds(line, " head ") &&
          std::sscanf(line.c_str(), "set arrow from %lf,%lf to %lf,%lf", &a[0], &a[1], &a[2], &a[3]) == 4)
        found.push_back(a);
    }
    return found;
  };
  const auto pull = load_arrows(script);
  ProblemFigure pushed = problem();
  pushed.sides[3].outward = false;
  const auto push = load_arrows(scripted(pushed, folder.path));
  BOOST_TEST_REQUIRE(pull.size() >= 4U);
  BOOST_TEST_REQUIRE(push.size() == pull.size());
  for (std::size_t i = 0; i < pull.size(); ++i) {
    BOOST_TEST(pull[i][1] > pull[i][3]);
    BOOST_TEST(push[i][1] == pull[i][3]);
    BOOST_TEST(push[i][3] == pull[i][1]);
  }
}

BOOST_AUTO_TEST_CASE(problem_is_to_scale) {
  const Folder folder;
  for (const double height : {1.5, 0.3, 4.0}) {
    ProblemFigure figure = problem();
    figure.height = height;
    figure.annotations.clear();
    figure.triangles = true;
    const std::string script = scripted(figure, folder.path);
    std::istringstream in(script.substr(script.find("$plate << EOD\n") + 14));
    std::array<double, 4> x{}, y{};
    char comma = 0;
    for (std::size_t i = 0; i < 4; ++i) in >> x[i] >> comma >> y[i];
    BOOST_TEST(std::abs((y[0] - y[2]) - height * (x[1] - x[0])) < 0.02 * (1 + height));  // written to 0.01 px
    const std::size_t cells = script.find("$cells << EOD\n"), triangles = script.find("$triangles << EOD\n");
    BOOST_TEST(count(script.substr(cells, script.find("EOD\n", cells + 14) - cells), "\n\n") == 9 + 14);
    BOOST_TEST(count(script.substr(triangles, script.find("EOD\n", triangles + 18) - triangles), "\n\n") == 2 * 150);
  }
}

BOOST_AUTO_TEST_CASE(every_support_on_every_side) {
  const Folder folder;
  for (const char* support : {"free", "roller", "fixed", "platen", "driven"}) {
    ProblemFigure figure = problem();
    for (ProblemFigure::Side& side : figure.sides) side = {support, "load", false, "label"};
    figure.insets = support == std::string("free");
    if (drawn(figure, folder.path)) draws_again_in_silence(figure, folder.path);
    BOOST_TEST(count(contents(folder.path / "fig12.gp"), "'load'") == 4);
  }
}

BOOST_AUTO_TEST_SUITE_END()
