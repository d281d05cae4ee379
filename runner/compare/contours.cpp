#include "runner/compare/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace diptych::runner {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t no_edge = std::numeric_limits<std::size_t>::max();

struct Point {
  double x = 0, y = 0;

  bool operator==(const Point&) const = default;
};

std::size_t columns(const NodalMap& m) { return static_cast<std::size_t>(m.nx) + 1; }
std::size_t rows(const NodalMap& m) { return static_cast<std::size_t>(m.ny) + 1; }
double at(const NodalMap& m, std::size_t i, std::size_t j) { return m.value[j * columns(m) + i]; }

void check_map(const NodalMap& m) {
  if (m.nx < 1 || m.ny < 1 || !(m.hx > 0) || !(m.hy > 0) || m.value.size() != columns(m) * rows(m))
    throw std::invalid_argument(
        "nodal map: needs at least one cell each way, cells of positive size and one value a node");
}

/// Edges of the grid: first the horizontal ones row by row, then the vertical ones.
struct Edges {
  const NodalMap& map;
  double level;

  std::size_t horizontal(std::size_t i, std::size_t j) const { return j * (columns(map) - 1) + i; }
  std::size_t vertical(std::size_t i, std::size_t j) const { return horizontal(0, rows(map)) + j * columns(map) + i; }
  std::size_t count() const { return vertical(0, rows(map) - 1); }

  /// Where the level crosses an edge whose ends lie on two sides of it.
  Point crossing(std::size_t edge) const {
    const bool upright = edge >= horizontal(0, rows(map));
    const std::size_t local = upright ? edge - horizontal(0, rows(map)) : edge;
    const std::size_t width = upright ? columns(map) : columns(map) - 1;
    const std::size_t i = local % width, j = local / width;
    const double from = at(map, i, j), to = upright ? at(map, i, j + 1) : at(map, i + 1, j);
    const double part = (level - from) / (to - from);
    const double x = static_cast<double>(i) + (upright ? 0 : part), y = static_cast<double>(j) + (upright ? part : 0);
    return {x * map.hx, y * map.hy};
  }
};

/// The line that starts at an edge. Points that fall on a node from several edges count once.
Polyline follow(const Edges& edges, std::vector<std::size_t>& next, std::size_t start) {
  std::vector<Point> points;
  std::size_t edge = start;
  bool closed = false;
  do {
    const Point p = edges.crossing(edge);
    if (points.empty() || !(points.back() == p)) points.push_back(p);
    edge = std::exchange(next[edge], no_edge);
    closed = edge == start;
  } while (edge != no_edge && !closed);
  if (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  Polyline line;
  line.closed = closed;
  for (const Point& p : points) {
    line.x.push_back(p.x);
    line.y.push_back(p.y);
  }
  return line;
}

/// Part of a triangle's area where a linear field of these corner values exceeds the level.
double part_above(std::array<double, 3> corner, double level) {
  std::sort(corner.begin(), corner.end());
  const auto [low, middle, high] = corner;
  if (level >= high) return 0;
  if (level < low) return 1;
  if (level < middle) return 1 - (level - low) / (middle - low) * ((level - low) / (high - low));
  return (high - level) / (high - middle) * ((high - level) / (high - low));
}

struct Piece {
  Point from, to;

  double length() const { return std::hypot(to.x - from.x, to.y - from.y); }
  Point at(double part) const { return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)}; }
};

std::vector<Piece> pieces(const std::vector<Polyline>& lines) {
  std::vector<Piece> result;
  for (const Polyline& line : lines) {
    const std::size_t n = line.x.size();
    if (line.y.size() != n) throw std::invalid_argument("polyline: x and y differ in length");
    const auto point = [&](std::size_t i) { return Point{line.x[i % n], line.y[i % n]}; };
    if (n == 1) result.push_back({point(0), point(0)});
    for (std::size_t i = 0; i + 1 < n + (line.closed && n > 2 ? 1 : 0); ++i) result.push_back({point(i), point(i + 1)});
  }
  return result;
}

bool any_nan(const std::vector<Piece>& all) {
  return std::any_of(all.begin(), all.end(), [](const Piece& p) { return std::isnan(p.length()); });
}

double distance(const Point& p, const Piece& piece) {
  const double dx = piece.to.x - piece.from.x, dy = piece.to.y - piece.from.y, square = dx * dx + dy * dy;
  const double along = (p.x - piece.from.x) * dx + (p.y - piece.from.y) * dy;
  const Point nearest = piece.at(square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0);
  return std::hypot(p.x - nearest.x, p.y - nearest.y);
}

double distance(const Point& p, const std::vector<Piece>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& other : others) least = std::min(least, distance(p, other));
  return least;
}

/// Largest distance of a point of `lines` from `others`. The distance from one straight piece is convex along another,
/// so on a piece from p to q no point is farther from `others` than the least over them of the larger one at p and q.
/// Where that could still be more than what was found, the piece is halved.
double farthest(const std::vector<Piece>& lines, const std::vector<Piece>& others, double tolerance) {
  double found = 0;
  for (const Piece& piece : lines) found = std::max({found, distance(piece.from, others), distance(piece.to, others)});
  std::vector<Piece> open = lines;
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    double bound = std::numeric_limits<double>::infinity();
    for (const Piece& other : others)
      bound = std::min(bound, std::max(distance(piece.from, other), distance(piece.to, other)));
    if (bound <= found + tolerance) continue;
    const Point middle = piece.at(0.5);
    found = std::max(found, distance(middle, others));
    open.push_back({piece.from, middle});
    open.push_back({middle, piece.to});
  }
  return found;
}

double mean_from(const std::vector<Piece>& lines, const std::vector<Piece>& others) {
  const double gauss = 0.5 / std::numbers::sqrt3;
  double sum = 0, length = 0;
  for (const Piece& piece : lines) {
    const double near = distance(piece.at(0.5 - gauss), others), far = distance(piece.at(0.5 + gauss), others);
    sum += piece.length() * (near + far) / 2;
    length += piece.length();
  }
  return length > 0 ? sum / length : distance(lines.front().from, others);
}

/// Of both sets, for a tolerance.
double extent(const std::vector<Piece>& a, const std::vector<Piece>& b) {
  Point low = a.front().from, high = low;
  for (const auto* all : {&a, &b}) {
    for (const Piece& piece : *all) {
      for (const Point& p : {piece.from, piece.to}) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
  }
  return std::hypot(high.x - low.x, high.y - low.y);
}

}  // namespace

NodalMap map_of(const reports::PlateFields& f, const std::string& field) {
  return {f.nx, f.ny, f.width / f.nx, f.height / f.ny, field == "damage" ? f.damage : f.crack_density};
}

std::vector<Polyline> contour(const NodalMap& map, double level) {
  check_map(map);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!finite(level) || !std::all_of(map.value.begin(), map.value.end(), finite)) return {};
  const Edges edges{map, level};
  std::vector<std::size_t> next(edges.count(), no_edge);
  std::vector<bool> entered(edges.count(), false);
  const auto join = [&](std::size_t from, std::size_t to) {
    next[from] = to;
    entered[to] = true;
  };
  for (std::size_t j = 0; j + 1 < rows(map); ++j) {
    for (std::size_t i = 0; i + 1 < columns(map); ++i) {
      // Corners and the edges after them, counter-clockwise from the lower left.
      const std::array corner{at(map, i, j), at(map, i + 1, j), at(map, i + 1, j + 1), at(map, i, j + 1)};
      const std::array edge{edges.horizontal(i, j), edges.vertical(i + 1, j), edges.horizontal(i, j + 1),
                            edges.vertical(i, j)};
      const auto above = [&](std::size_t k) { return corner[k % 4] > level; };
      // Going round, the contour goes into the cell where the border turns from above to below: above is on its left.
      std::vector<std::size_t> in, out;
      for (std::size_t k = 0; k < 4; ++k) {
        if (above(k) && !above(k + 1)) in.push_back(k);
        if (!above(k) && above(k + 1)) out.push_back(k);
      }
      if (in.size() == 1) join(edge[in[0]], edge[out[0]]);
      if (in.size() == 2) {
        const bool bridged = (corner[0] + corner[1] + corner[2] + corner[3]) / 4 > level;
        for (const std::size_t k : in) join(edge[k], edge[(k + (bridged ? 1 : 3)) % 4]);
      }
    }
  }
  std::vector<Polyline> lines;
  for (const bool from_border : {true, false}) {
    for (std::size_t e = 0; e < edges.count(); ++e) {
      if (next[e] == no_edge || (from_border && entered[e])) continue;
      Polyline line = follow(edges, next, e);
      if (line.x.size() > 1) lines.push_back(std::move(line));  // a single node at the level has no contour
    }
  }
  return lines;
}

double area_above(const NodalMap& map, double level) {
  check_map(map);
  double cells = 0;
  for (std::size_t j = 0; j + 1 < rows(map); ++j) {
    for (std::size_t i = 0; i + 1 < columns(map); ++i) {
      const std::array corner{at(map, i, j), at(map, i + 1, j), at(map, i + 1, j + 1), at(map, i, j + 1)};
      const double centre = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
      if (std::isnan(centre) || std::isnan(level)) return nan_value;
      for (std::size_t k = 0; k < 4; ++k) cells += part_above({corner[k], corner[(k + 1) % 4], centre}, level) / 4;
    }
  }
  return cells * map.hx * map.hy;
}

double integral(const NodalMap& map) {
  check_map(map);
  double cells = 0;
  for (std::size_t j = 0; j < rows(map); ++j) {
    for (std::size_t i = 0; i < columns(map); ++i) {
      const double across = i == 0 || i + 1 == columns(map) ? 0.5 : 1, up = j == 0 || j + 1 == rows(map) ? 0.5 : 1;
      cells += across * up * at(map, i, j);
    }
  }
  return cells * map.hx * map.hy;
}

double radius_along(const NodalMap& map, double level, double angle_degrees) {
  check_map(map);
  if (!(angle_degrees >= 0 && angle_degrees <= 90) || std::isnan(level)) return nan_value;
  const double angle = angle_degrees * std::numbers::pi / 180;
  // In cells.
  const double right = std::cos(angle) / map.hx, up = angle_degrees == 0 ? 0 : std::sin(angle) / map.hy;
  std::size_t i = 0, j = 0;
  double s = 0;  // along the ray, where it enters the cell
  while (i + 1 < columns(map) && j + 1 < rows(map)) {
    const double a = at(map, i, j), b = at(map, i + 1, j), c = at(map, i, j + 1), d = at(map, i + 1, j + 1);
    if (!std::isfinite(a + b + c + d)) return nan_value;
    const double leave_x = static_cast<double>(i + 1) / right, leave_y = static_cast<double>(j + 1) / up;
    const double leave = std::min(leave_x, leave_y);
    // Along the ray a bilinear field is f + g t + q t² with t from the entry.
    const double x = std::clamp(s * right - static_cast<double>(i), 0.0, 1.0);
    const double y = std::clamp(s * up - static_cast<double>(j), 0.0, 1.0);
    const double f = (1 - y) * ((1 - x) * a + x * b) + y * ((1 - x) * c + x * d) - level;
    if (f <= 0) return s == 0 ? nan_value : s;
    const double g = right * ((1 - y) * (b - a) + y * (d - c)) + up * ((1 - x) * (c - a) + x * (d - b));
    const double q = right * up * (a - b - c + d);
    // The root at which it falls, (−g − √(g² − 4fq))/2q, in the form that does not cancel.
    const double square = g * g - 4 * f * q;
    if (square >= 0) {
      const double root = std::sqrt(square);
      const double t = g < 0 ? 2 * f / (root - g) : -(g + root) / (2 * q);
      if (t >= 0 && t <= leave - s) return s + t;
    }
    if (leave_x <= leave) ++i;
    if (leave_y <= leave) ++j;
    s = leave;
  }
  return nan_value;
}

double hausdorff(const std::vector<Polyline>& a, const std::vector<Polyline>& b) {
  const std::vector<Piece> first = pieces(a), second = pieces(b);
  if (first.empty() || second.empty() || any_nan(first) || any_nan(second)) return nan_value;
  const double tolerance = 1e-9 * extent(first, second);
  return std::max(farthest(first, second, tolerance), farthest(second, first, tolerance));
}

double mean_distance(const std::vector<Polyline>& a, const std::vector<Polyline>& b) {
  const std::vector<Piece> first = pieces(a), second = pieces(b);
  if (first.empty() || second.empty() || any_nan(first) || any_nan(second)) return nan_value;
  return (mean_from(first, second) + mean_from(second, first)) / 2;
}

NodalMap difference(const NodalMap& a, const NodalMap& b) {
  check_map(a);
  check_map(b);
  if (a.nx != b.nx || a.ny != b.ny || a.hx != b.hx || a.hy != b.hy)
    throw std::invalid_argument("nodal maps to be subtracted must have the same grid");
  NodalMap result = a;
  for (std::size_t i = 0; i < result.value.size(); ++i) result.value[i] -= b.value[i];
  return result;
}

}  // namespace diptych::runner
