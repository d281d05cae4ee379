#include "reports/bands.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>

namespace diptych::reports {
namespace {

using Colour = std::array<double, 3>;

// Lightness falls evenly from 97 to 18 (CIE L*), so the order of the colours survives in grey.
constexpr std::array<Colour, 9> rising{{{253, 247, 220},
                                        {196, 229, 167},
                                        {117, 209, 154},
                                        {38, 184, 161},
                                        {0, 155, 162},
                                        {0, 127, 157},
                                        {0, 100, 151},
                                        {0, 71, 137},
                                        {7, 41, 99}}};
constexpr std::array<Colour, 9> two_sided{{{14, 69, 140},
                                           {54, 111, 191},
                                           {114, 157, 222},
                                           {180, 203, 238},
                                           {255, 255, 255},
                                           {238, 191, 169},
                                           {221, 132, 101},
                                           {192, 71, 53},
                                           {143, 15, 29}}};

std::string colour_at(const std::array<Colour, 9>& points, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * 8;
  const auto low = static_cast<std::size_t>(std::min(7.0, place));
  const double part = place - static_cast<double>(low);
  std::array<long, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::lround((1 - part) * points[low][c] + part * points[low + 1][c]);
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// 0 for a step that is easily read off, more for others.
int roughness(double step) {
  const double leading = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  const auto is = [&](double value) { return std::abs(leading - value) < 1e-6; };
  if (is(1) || is(2) || is(5)) return 0;
  return is(2.5) || is(4) ? 1 : is(3) || is(6) || is(8) || is(1.5) ? 2 : 3;
}

/// How many steps to take through `range`, from least to most, near the wanted number if equally round.
int steps_for(double range, int least, int most, int wanted) {
  int best = wanted;
  const auto worse = [&](int n) { return std::pair(roughness(range / n), std::abs(n - wanted)); };
  for (int n = least; n <= most; ++n)
    if (worse(n) < worse(best)) best = n;
  return best;
}

}  // namespace

Bands bands_of(const PlateFigure::Map& map) {
  Bands bands;
  if (map.diverging) {
    const double middle = (map.min + map.max) / 2, half = (map.max - map.min) / 2;
    const int n = steps_for(half, 5, 10, 8);
    for (int k = -n; k <= n; ++k)
      if (k != 0) bands.edges.push_back(middle + half * k / n);
    for (int k = 1 - n; k < n; ++k) bands.colours.push_back(colour_at(two_sided, 0.5 + 0.5 * k / (n - 1)));
    return bands;
  }
  const int n = steps_for(map.max - map.min, 10, 20, 14);
  for (int k = 0; k <= n; ++k) bands.edges.push_back(map.min + (map.max - map.min) * k / n);
  for (int k = 0; k < n; ++k) bands.colours.push_back(colour_at(rising, static_cast<double>(k) / (n - 1)));
  return bands;
}

std::vector<Line> region_above(const PlateFigure::Map& map, double width, double height, double level) {
  // Each cell contributes the outline of its own part; what two cells share runs both ways and cancels.
  const std::int64_t across = map.nx + 1;
  const auto value = [&](std::int64_t node) { return map.nodes[static_cast<std::size_t>(node)]; };
  // A point is a node (3 n), or lies on the side from node n to the right (3 n + 1) or upwards (3 n + 2).
  std::map<std::int64_t, std::vector<std::int64_t>> next;
  const auto add = [&](std::int64_t from, std::int64_t to) {
    const auto back = next.find(to);
    if (back != next.end()) {
      const auto same = std::find(back->second.begin(), back->second.end(), from);
      if (same != back->second.end()) {
        back->second.erase(same);
        if (back->second.empty()) next.erase(back);
        return;
      }
    }
    next[from].push_back(to);
  };
  for (std::int64_t j = 0; j < map.ny; ++j)
    for (std::int64_t i = 0; i < map.nx; ++i) {
      const std::int64_t n = j * across + i;
      const std::array<std::int64_t, 4> corner{n, n + 1, n + across + 1, n + across};
      const std::array<std::int64_t, 4> side{3 * n + 1, 3 * (n + 1) + 2, 3 * (n + across) + 1, 3 * n + 2};
      std::array<bool, 4> in{};
      double sum = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        in[c] = value(corner[c]) >= level;
        sum += value(corner[c]);
      }
      if (std::isnan(sum)) continue;
      std::vector<std::int64_t> outline;
      for (std::size_t c = 0; c < 4; ++c) {
        if (in[c]) outline.push_back(3 * corner[c]);
        if (in[c] != in[(c + 1) % 4]) outline.push_back(side[c]);
      }
      const bool saddle = in[0] == in[2] && in[1] == in[3] && in[0] != in[1];
      if (saddle && sum / 4 < level) {  // two corners apart
        for (std::size_t c = 0; c < 4; ++c)
          if (in[c]) {
            add(side[(c + 3) % 4], 3 * corner[c]);
            add(3 * corner[c], side[c]);
            add(side[c], side[(c + 3) % 4]);
          }
      } else {
        for (std::size_t k = 0; k < outline.size(); ++k) add(outline[k], outline[(k + 1) % outline.size()]);
      }
    }
  std::vector<Line> rings;
  while (!next.empty()) {
    Line ring;
    const std::int64_t start = next.begin()->first;
    std::int64_t at = start;
    do {
      const std::int64_t n = at / 3, kind = at % 3;
      double x = static_cast<double>(n % across), y = static_cast<double>(n / across);
      if (kind != 0) {
        const double here = value(n), there = value(kind == 1 ? n + 1 : n + across);
        const double share = std::isfinite(here) && std::isfinite(there) ? (level - here) / (there - here) : 0.5;
        (kind == 1 ? x : y) += share;
      }
      ring.x.push_back(width * x / map.nx);
      ring.y.push_back(height * y / map.ny);
      const auto step = next.find(at);
      at = step->second.back();
      step->second.pop_back();
      if (step->second.empty()) next.erase(step);
    } while (at != start);
    rings.push_back(std::move(ring));
  }
  return rings;
}

Line joined(const std::vector<Line>& rings) {
  Line all;
  const auto add = [&](double x, double y) {
    all.x.push_back(x);
    all.y.push_back(y);
  };
  for (const Line& ring : rings) {
    for (std::size_t i = 0; i < ring.x.size(); ++i) add(ring.x[i], ring.y[i]);
    add(ring.x[0], ring.y[0]);
    if (&ring != &rings.front()) add(rings.front().x[0], rings.front().y[0]);
  }
  return all;
}

}  // namespace diptych::reports
