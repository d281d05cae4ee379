#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <stdexcept>

#include "reports/csv.hpp"
#include "reports/gnuplot.hpp"
#include "reports/plate_figure.hpp"
#include "reports/sheet.hpp"

namespace diptych::reports {
namespace {

using Side = ProblemFigure::Side;
enum : std::size_t { left_side, right_side, bottom_side, top_side };

// ---- sizes of the picture [px]

constexpr double page = 900, page_edge = 40, tallest = 540, widest = 380;
constexpr double roller = 5, roller_step = 34, hatch = 8, hatch_step = 8;  // of supports
constexpr double platen_gap = 8, platen_thickness = 14, overhang = 10;
constexpr double arrow_length = 36, arrow_gap = 5, arrow_step = 50;  // of loads
constexpr double text_line = 18, dimension_gap = 22, inset = 150, inset_gap = 60;

constexpr const char* ink = "lc rgb '#222222'";
constexpr const char* pale = "lc rgb '#8a8a8a'";
constexpr const char* load_ink = "lc rgb '#b2182b'";
constexpr const char* black_text = "textcolor rgb '#222222'";
constexpr const char* load_text = "textcolor rgb '#b2182b'";

/// A point on the page [px], from its upper left corner.
struct Point {
  double x = 0, y = 0;
};
Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }

/// A side of the plate on the page.
struct PageSide {
  Point corner, along, out;  ///< along and out have length 1; out points away from the plate
  double length = 0;
  Point at(double distance, double outwards) const { return corner + distance * along + outwards * out; }
};

double support_depth(const Side& side) {
  if (side.support == "roller") return 2 * roller + 2 + hatch;
  if (side.support == "fixed") return hatch;
  if (side.support == "platen") return platen_gap + platen_thickness;
  return side.support == "driven" ? 5 : 0;
}

double depth(const Side& side) {
  return support_depth(side) + (side.load.empty() ? 0 : arrow_gap + arrow_length + text_line + 4);
}

struct Layout {
  Heading heading;
  double pixels = 1, height = 0;          ///< pixels: of one unit of length
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;  ///< of the plate, y0 its top
  double insets = 0;                      ///< left edge of the insets
  std::array<PageSide, 4> runs;

  Point at(double x, double y) const { return {x0 + x * pixels, y1 - y * pixels}; }
};

Layout layout_of(const ProblemFigure& figure) {
  Layout layout;
  layout.heading = heading_of(figure.title, figure.notes, page - 2 * page_edge);
  const auto& sides = figure.sides;
  const double left_label = sides[left_side].label.empty() ? 0 : text_line;
  layout.pixels = std::min(tallest / figure.height, widest / figure.width);
  layout.x0 = std::max(page_edge + 20, 20 + text_line + dimension_gap + depth(sides[left_side]) + left_label);
  layout.x1 = layout.x0 + layout.pixels * figure.width;
  layout.y0 = margin + layout.heading.height() + 24 + depth(sides[top_side]);
  layout.y1 = layout.y0 + layout.pixels * figure.height;
  layout.insets = layout.x1 + std::max(inset_gap, depth(sides[right_side]) + 50);
  const double below = depth(sides[bottom_side]) + dimension_gap + text_line + 12;
  layout.height = std::max(layout.y1 + below, figure.insets ? layout.y0 + 2 * inset + 120 : 0);
  const double w = layout.x1 - layout.x0, h = layout.y1 - layout.y0;
  layout.runs[left_side] = {{layout.x0, layout.y1}, {0, -1}, {-1, 0}, h};
  layout.runs[right_side] = {{layout.x1, layout.y1}, {0, -1}, {1, 0}, h};
  layout.runs[bottom_side] = {{layout.x0, layout.y1}, {1, 0}, {0, 1}, w};
  layout.runs[top_side] = {{layout.x0, layout.y0}, {1, 0}, {0, -1}, w};
  return layout;
}

/// Shapes in pixels of the page; those that come in front lie in the order of their kinds: areas, texts, lines.
struct Canvas {
  std::ostream& gp;

  static std::string at(Point p) { return fmt::format("{:.2f},{:.2f}", p.x, p.y); }
  void line(Point a, Point b, const std::string& style) const {
    gp << "set arrow from " << at(a) << " to " << at(b) << " nohead front " << style << '\n';
  }
  void arrow(Point from, Point to, const std::string& style, const char* heads = "head") const {
    gp << "set arrow from " << at(from) << " to " << at(to) << ' ' << heads << " filled size 9,17 front " << style
       << '\n';
  }
  void area(const std::vector<Point>& corners, const std::string& style) const {
    gp << "set object polygon from ";
    for (const Point& p : corners) gp << at(p) << " to ";
    gp << at(corners.front()) << ' ' << style << '\n';
  }
  void box(Point a, Point b, const std::string& style) const { area({a, {b.x, a.y}, b, {a.x, b.y}}, style); }
  void circle(Point centre, double radius, const std::string& style) const {
    gp << "set object circle at " << at(centre) << fmt::format(" size {:.2f} ", radius) << style << '\n';
  }
  void marker(Point p, const std::string& style) const {
    gp << "set label '' at " << at(p) << " front point " << style << '\n';
  }
  void text(const std::string& words, Point p, const std::string& style) const {
    gp << "set label " << marked(words) << " at " << at(p) << " front " << style << '\n';
  }
  /// Text on white, from its left end or around its centre.
  void text_on_white(const std::string& words, Point p, bool centred, const std::string& style) const {
    const double w = static_cast<double>(characters(words)) * 6.3 + 6;
    const Point start{centred ? p.x - w / 2 : p.x - 3, p.y - 8};
    box(start, start + Point{w, 16}, "front fc rgb '#ffffff' fs solid noborder");
    text(words, p, (centred ? "center " : "left ") + style);
  }
};

/// Places along a length, evenly, about `step` apart and half a step from the ends.
std::vector<double> spread(double length, double step) {
  const int n = std::max(2, static_cast<int>(std::lround(length / step)));
  std::vector<double> places;
  for (int i = 0; i < n; ++i) places.push_back(length * (i + 0.5) / n);
  return places;
}

void draw_ground(const Canvas& canvas, const PageSide& run, double outwards) {
  canvas.line(run.at(0, outwards), run.at(run.length, outwards), std::string("lw 1.2 ") + ink);
  for (double s = hatch_step; s <= run.length + 1e-9; s += hatch_step)
    canvas.line(run.at(s, outwards), run.at(s - hatch, outwards + hatch), std::string("lw 0.7 ") + pale);
}

void draw_support(const Canvas& canvas, const PageSide& run, const Side& side) {
  const std::string outline = std::string(" border ") + ink + " lw 1.1";
  if (side.support == "roller") {
    for (const double s : spread(run.length, roller_step))
      canvas.circle(run.at(s, roller + 1), roller, "front fc rgb '#ffffff' fs solid" + outline);
    draw_ground(canvas, run, 2 * roller + 2);
  } else if (side.support == "fixed") {
    draw_ground(canvas, run, 0);
  } else if (side.support == "platen") {
    for (const double s : spread(run.length, roller_step / 2))  // frictionless
      canvas.circle(run.at(s, platen_gap / 2), platen_gap / 2 - 0.8, "front fc rgb '#ffffff' fs solid" + outline);
    const Point a = run.at(-overhang, platen_gap), b = run.at(run.length + overhang, platen_gap + platen_thickness);
    canvas.box(a, b, "front fc rgb '#9aa3ad' fs solid" + outline);
  } else if (side.support == "driven") {
    canvas.line(run.at(0, 3), run.at(run.length, 3), std::string("lw 4 ") + load_ink);
  }
}

void draw_load(const Canvas& canvas, const PageSide& run, const Side& side, bool upright) {
  if (side.load.empty()) return;
  const double near = support_depth(side) + arrow_gap, far = near + arrow_length;
  for (const double s : spread(run.length, arrow_step))
    canvas.arrow(run.at(s, side.outward ? near : far), run.at(s, side.outward ? far : near),
                 std::string("lw 1.6 ") + load_ink);
  canvas.text(side.load, run.at(run.length / 2, far + text_line / 2 + 3),
              std::string("center ") + (upright ? "" : "rotate by 90 ") + "font ',13' " + load_text);
}

/// What a support is called: right of a side that lies, along one that stands.
void draw_support_label(const Canvas& canvas, const PageSide& run, const Side& side, bool upright) {
  if (side.label.empty()) return;
  const double middle = side.support == "platen" ? platen_gap + platen_thickness / 2 : support_depth(side) / 2;
  if (upright)
    canvas.text(side.label, run.at(run.length + overhang + 8, middle), std::string("left font ',12' ") + black_text);
  else
    canvas.text(side.label, run.at(run.length / 2, depth(side) + text_line / 2 + 1),
                std::string("center rotate by 90 font ',12' ") + black_text);
}

void draw_dimension(const Canvas& canvas, const PageSide& run, double outwards, const std::string& label,
                    bool upright) {
  const std::string thin = std::string("lw 0.8 ") + pale;
  for (const double s : {0.0, run.length}) canvas.line(run.at(s, outwards - 9), run.at(s, outwards + 6), thin);
  canvas.arrow(run.at(0, outwards), run.at(run.length, outwards), std::string("lw 1 ") + ink, "heads");
  canvas.text(label, run.at(run.length / 2, outwards + text_line / 2 + 4),
              std::string("center ") + (upright ? "" : "rotate by 90 ") + "font ',13' " + black_text);
}

std::vector<Point> quarter(const Layout& layout, double radius) {
  std::vector<Point> arc;
  for (int i = 0; i <= 48; ++i) {
    const double angle = std::numbers::pi / 2 * i / 48;
    arc.push_back(layout.at(radius * std::cos(angle), radius * std::sin(angle)));
  }
  return arc;
}

void draw_weak_zone(const Canvas& canvas, const Layout& layout, const ProblemFigure& figure) {
  if (!(figure.weak_radius > 0)) return;
  std::vector<Point> sector = quarter(layout, figure.weak_radius);
  const Point on_arc = sector[sector.size() / 2];
  sector.push_back(layout.at(0, 0));
  canvas.area(sector, "back fc rgb '#f4b183' fs solid border lc rgb '#b35806' lw 1.4");
  if (figure.weak_label.empty()) return;
  const Point words = on_arc + Point{46, -52};
  canvas.line(on_arc, words + Point{-5, 2}, "lw 0.9 lc rgb '#b35806'");
  canvas.text_on_white(figure.weak_label, words, false, "font ',12' textcolor rgb '#7f3b08'");
}

/// A cell on the plate that an inset magnifies, and the lines from one to the other.
void draw_magnified(const Canvas& canvas, const Layout& layout, const ProblemFigure& figure, int column, int row,
                    Point corner) {
  const double w = figure.width / figure.nx, h = figure.height / figure.ny;
  const Point low = layout.at(column * w, row * h), high = layout.at((column + 1) * w, (row + 1) * h);
  canvas.box(low, high, std::string("front fs empty border lw 1.6 ") + ink);
  const std::string thin = std::string("lw 0.7 dt (4,4) ") + pale;
  canvas.line({high.x, high.y}, corner, thin);
  canvas.line({high.x, low.y}, corner + Point{0, inset}, thin);
}

void draw_insets(const Canvas& canvas, const Layout& layout, const ProblemFigure& figure) {
  const Point fem{layout.insets, layout.y0 + 34}, mpm{layout.insets, layout.y0 + 34 + inset + 66};
  const int column = std::max(0, figure.nx - 2);
  draw_magnified(canvas, layout, figure, column, std::max(0, static_cast<int>(0.75 * figure.ny)), fem);
  draw_magnified(canvas, layout, figure, column, std::max(0, static_cast<int>(0.4 * figure.ny)), mpm);
  const std::string outline = std::string(" border ") + ink + " lw 1.4";
  const auto corners = [](Point p) {
    return std::array<Point, 4>{p, p + Point{inset, 0}, p + Point{inset, inset}, p + Point{0, inset}};
  };
  const auto node = [&](Point p) { canvas.marker(p, "pt 7 ps 0.9 lc rgb '#08306b'"); };
  const auto words = [&](Point p, const std::vector<std::string>& lines) {
    double y = p.y;
    for (const std::string& text : lines)
      for (const std::string& line : lines_of(text, page - 14 - p.x, 6.6)) {
        canvas.text(line, {p.x, y}, std::string("left font ',12' ") + black_text);
        y += label_line;
      }
  };
  const auto title = [&](const std::string& text, Point p) {
    canvas.text(text, p + Point{0, -14}, std::string("left font ',13' ") + black_text);
  };

  title("FEM: one cell", fem);
  const Point middle = fem + Point{inset / 2, inset / 2};
  const auto of_fem = corners(fem), of_mpm = corners(mpm);
  canvas.box(fem, of_fem[2], "front fc rgb '#dce6f2' fs solid" + outline);
  for (const Point& p : of_fem) canvas.line(p, middle, std::string("lw 1.1 ") + ink);
  for (const Point& p : of_fem) node(p);
  node(middle);
  words(of_fem[1] + Point{20, 26}, {"four triangles of constant strain"});
  node(of_fem[1] + Point{24, inset - 26});
  words(of_fem[1] + Point{36, inset - 26}, {"node"});

  title("MPM: one cell", mpm);
  canvas.box(mpm, of_mpm[2], "front fc rgb '#ffffff' fs solid" + outline);
  for (const Point& p : of_mpm) node(p);
  const auto particle = [&](Point p) { canvas.marker(p, "pt 7 ps 1.7 lc rgb '#d55e00'"); };
  for (const double x : {0.25, 0.75})
    for (const double y : {0.25, 0.75}) particle(mpm + Point{x * inset, y * inset});
  words(of_mpm[1] + Point{20, 26}, {"four particles on a grid"});
  node(of_mpm[1] + Point{24, inset - 50});
  words(of_mpm[1] + Point{39, inset - 50}, {"node of the grid"});
  particle(of_mpm[1] + Point{24, inset - 26});
  words(of_mpm[1] + Point{39, inset - 26}, {"particle"});
}

/// Lines of the mesh, as segments parted by blank lines.
void write_mesh(std::ostream& gp, const Layout& layout, const ProblemFigure& figure) {
  const double w = figure.width / figure.nx, h = figure.height / figure.ny;
  const auto segment = [&](Point a, Point b) { gp << Canvas::at(a) << '\n' << Canvas::at(b) << "\n\n"; };
  gp << "$cells << EOD\n";
  for (int i = 1; i < figure.nx; ++i) segment(layout.at(i * w, 0), layout.at(i * w, figure.height));
  for (int j = 1; j < figure.ny; ++j) segment(layout.at(0, j * h), layout.at(figure.width, j * h));
  gp << "EOD\n";
  if (!figure.triangles) return;
  gp << "$triangles << EOD\n";
  for (int j = 0; j < figure.ny; ++j)
    for (int i = 0; i < figure.nx; ++i) {
      segment(layout.at(i * w, j * h), layout.at((i + 1) * w, (j + 1) * h));
      segment(layout.at((i + 1) * w, j * h), layout.at(i * w, (j + 1) * h));
    }
  gp << "EOD\n";
}

void write_script(std::ostream& gp, const ProblemFigure& figure) {
  const Layout layout = layout_of(figure);
  const Canvas canvas{gp};
  const auto lies = [](std::size_t side) { return side == bottom_side || side == top_side; };
  begin_page(gp, figure.id, page, layout.height, true);
  gp << "# Change the looks here.\n"
     << "set style line 1 lw 0.8 lc rgb '#c4c4c4'  # cells\n"
     << "set style line 2 lw 0.5 lc rgb '#dadada'  # triangles\n"
     << "set style line 3 lw 2 lc rgb '#222222'  # plate\n\n"
     << "# Units are pixels from the upper left corner of the page.\n"
     << "set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"
     << "unset border; unset tics; unset key; set datafile separator ','\n"
     << fmt::format("set xrange [0:{:.0f}]; set yrange [{:.0f}:0]\n", page, layout.height);
  write_heading(layout.heading, [&](const std::string& line, double y, const char* style) {
    canvas.text(line, {page_edge, y}, style);
  });
  write_mesh(gp, layout, figure);
  draw_weak_zone(canvas, layout, figure);
  for (std::size_t side = 0; side < 4; ++side) {
    draw_support(canvas, layout.runs[side], figure.sides[side]);
    draw_load(canvas, layout.runs[side], figure.sides[side], lies(side));
    draw_support_label(canvas, layout.runs[side], figure.sides[side], lies(side));
  }
  const Side &bottom = figure.sides[bottom_side], &left = figure.sides[left_side];
  draw_dimension(canvas, layout.runs[bottom_side], depth(bottom) + dimension_gap, figure.width_label, true);
  draw_dimension(canvas, layout.runs[left_side], depth(left) + (left.label.empty() ? 0 : text_line) + dimension_gap - 4,
                 figure.height_label, false);

  const double axis = std::max(0.22 * (layout.x1 - layout.x0), figure.weak_radius * layout.pixels + 36);
  const Point origin = layout.at(0, 0);
  for (const bool up : {false, true}) {
    const Point tip = origin + (up ? Point{0, -axis} : Point{axis, 0});
    canvas.arrow(origin, tip, std::string("lw 2.6 ") + ink);
    canvas.text_on_white(up ? figure.y_label : figure.x_label, tip + (up ? Point{13, 2} : Point{-2, -13}), true,
                         std::string("font ',14' ") + black_text);
  }
  for (const ProblemFigure::Note& note : figure.annotations)
    canvas.text_on_white(note.text, layout.at(note.x, note.y), false, std::string("font ',12' ") + black_text);
  if (figure.insets) draw_insets(canvas, layout, figure);

  gp << "$plate << EOD\n";
  for (const Point& p : {origin, layout.at(figure.width, 0), layout.at(figure.width, figure.height),
                         layout.at(0, figure.height), origin})
    gp << Canvas::at(p) << '\n';
  gp << "EOD\nplot " << (figure.triangles ? "$triangles with lines ls 2, " : "")
     << (figure.nx > 1 || figure.ny > 1 ? "$cells with lines ls 1, " : "") << "$plate with lines ls 3\nset output\n";
}

// ---- the data

std::string csv_of_problem(const ProblemFigure& figure) {
  std::string out = csv_heading(figure.id, figure.title, figure.notes);
  out += "part,quantity,value\n";
  const auto row = [&](const char* part, const char* quantity, const std::string& value) {
    out += std::string(part) + "," + quantity + "," + csv_field(value) + "\n";
  };
  row("plate", "width", csv_number(figure.width));
  row("plate", "height", csv_number(figure.height));
  row("cells", "across", fmt::format("{}", figure.nx));
  row("cells", "up", fmt::format("{}", figure.ny));
  row("cells", "triangles in each", figure.triangles ? "4" : "0");
  constexpr std::array<const char*, 4> names{"left", "right", "bottom", "top"};
  for (std::size_t side = 0; side < 4; ++side) {
    row(names[side], "support", figure.sides[side].support);
    row(names[side], "label", figure.sides[side].label);
    row(names[side], "load", figure.sides[side].load);
    if (!figure.sides[side].load.empty()) row(names[side], "arrows", figure.sides[side].outward ? "outward" : "inward");
  }
  row("weak zone", "radius", csv_number(figure.weak_radius));
  row("weak zone", "label", figure.weak_label);
  for (const ProblemFigure::Note& note : figure.annotations)
    row("note", fmt::format("at {} {}", note.x, note.y).c_str(), note.text);
  return out;
}

void check_problem(const ProblemFigure& figure) {
  check_id(figure.id);
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("figure '" + figure.id + "': " + why);
  };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  if (!positive(figure.width) || !positive(figure.height))
    refuse(fmt::format("{} by {} is no plate", figure.width, figure.height));
  if (figure.nx < 1 || figure.ny < 1 || figure.nx > 1000 || figure.ny > 1000)
    refuse(fmt::format("{} by {} cells cannot be drawn", figure.nx, figure.ny));
  if (!(figure.weak_radius >= 0) || figure.weak_radius > std::min(figure.width, figure.height))
    refuse(fmt::format("a weak zone of radius {} does not fit the plate", figure.weak_radius));
  constexpr std::array<const char*, 5> supports{"free", "roller", "fixed", "platen", "driven"};
  for (const Side& side : figure.sides)
    if (std::find(supports.begin(), supports.end(), side.support) == supports.end())
      refuse("no support is called '" + side.support + "'");
  for (const ProblemFigure::Note& note : figure.annotations)
    if (!std::isfinite(note.x) || !std::isfinite(note.y)) refuse("'" + note.text + "' has no place");
}

}  // namespace

Drawn draw(const ProblemFigure& figure, const std::filesystem::path& directory, std::string& message) {
  message.clear();
  check_problem(figure);
  return draw_files(
      figure.id, csv_of_problem(figure), [&](std::ostream& gp) { write_script(gp, figure); }, directory, message);
}

}  // namespace diptych::reports
