// How series and spans look, and the legend that tells it. For reports/ alone.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"

namespace diptych::reports::curves {

constexpr double legend_sample = 34, legend_gap = 7;  // [px]

/// How a series looks. Colours after Okabe & Ito; shapes differ too, for print without colour.
struct Look {
  std::string line;  ///< gnuplot's line properties
  bool markers = false;
};

/// How the nth kind of span looks. A tint tells colours apart and not shades of grey, so that bands that overlap add up
/// to a darker one; without colour, kinds differ by the dashes of their edges and of the bars that carry their labels.
struct SpanLook {
  const char *tint, *edge;
};
SpanLook span_look(std::size_t nth);
/// Kinds of spans in the order of their first mention.
std::vector<std::string> span_kinds(const Figure&);

/// One entry of the legend: all series of this label, in every panel.
struct Entry {
  std::string label, kind;
  Look appearance;
  std::size_t interval = 1;  ///< a marker at every so many points; in a motion diagram the most of all panels
  bool motion = false;
  bool joined = false;   ///< where axes are powers of ten: a marker at every point and lines between them
  double x = 0;          ///< of its sample in the legend [px]
  std::size_t line = 0;  ///< of the legend, the first of this entry's
  std::vector<std::string> lines = {};
  std::string text() const;
};

/// Legend entries in the order of first mention. Lines lie under markers because the series come in that order.
std::vector<Entry> entries_of(const Figure&);
const char* style_of(const Entry&);  ///< gnuplot's: "lines", "points" or both
/// How many points to go from marker to marker, so that they do not melt into a band.
std::size_t interval_of(const Figure&, const Figure::Panel&, const Curve&);

}  // namespace diptych::reports::curves
