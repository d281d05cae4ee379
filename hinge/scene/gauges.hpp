// How gauges read a plate, the same for both panels.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hinge/material/plane.hpp"
#include "hinge/scene/plate.hpp"

namespace diptych {

/// The cells that a gauge reads, and how much of each: on the line between the middles of the two cells beside it, and
/// beyond the first or last middle of the row that cell alone. On an edge between two rows the mean of both, which a
/// mirrored plate reads as well; else its own row.
struct GaugeReading {
  std::array<std::size_t, 2> column, row;
  double right = 0;  ///< share of the right column

  /// of_cell(i, j): the value of a cell.
  template <class OfCell>
  auto read(OfCell&& of_cell) const {
    const auto along = [&](std::size_t j) {
      return of_cell(column[0], j) * (1 - right) + of_cell(column[1], j) * right;
    };
    return row[0] == row[1] ? along(row[0]) : (along(row[0]) + along(row[1])) * 0.5;
  }
};

/// Of a plate that has been checked.
GaugeReading reading_of(const Gauge&, const Plate&, const Cells&);

/// All gauges of a plate and what they have seen.
class Gauges {
 public:
  /// steps: to be read; dilatancy: that there is one.
  Gauges(const Plate&, const Cells&, long steps, bool dilatancy);

  bool empty() const { return records_.empty(); }
  /// mean_stress(i, j): of a cell; dilatancy: of the cells, or empty.
  template <class MeanStress>
  void read(double time, MeanStress&& mean_stress, std::span<const double> dilatancy) {
    for (std::size_t g = 0; g < records_.size(); ++g) {
      const material::Tensor stress = readings_[g].read(mean_stress);
      records_[g].time.push_back(time);
      records_[g].xx.push_back(stress.xx);
      records_[g].yy.push_back(stress.yy);
      if (!dilatancy.empty())
        records_[g].dilatancy.push_back(
            readings_[g].read([&](std::size_t i, std::size_t j) { return dilatancy[j * columns_ + i]; }));
    }
  }
  const std::vector<GaugeRecord>& records() const { return records_; }
  std::size_t bytes() const;

 private:
  std::size_t columns_;
  std::vector<GaugeReading> readings_;
  std::vector<GaugeRecord> records_;
};

}  // namespace diptych
