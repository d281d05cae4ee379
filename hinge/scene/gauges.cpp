#include "hinge/scene/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hinge/scene/plate_check.hpp"

namespace diptych {

GaugeReading reading_of(const Gauge& gauge, const Plate& plate, const Cells& cells) {
  // The two cells whose middles are beside a place, and the share of the second.
  const auto beside = [](double place, double cell, int count) {
    const double at = std::clamp(in_cells(place, cell) - 0.5, 0.0, static_cast<double>(count - 1));
    const auto low = static_cast<std::size_t>(at);
    return std::tuple{low, std::min(low + 1, static_cast<std::size_t>(count - 1)), at - static_cast<double>(low)};
  };
  const auto [left, right, share] = beside(gauge.x, plate.width / cells.x, cells.x);
  const auto [below, above, part] = beside(gauge.y, plate.height / cells.y, cells.y);
  return {{left, right}, {part > 0.5 ? above : below, part < 0.5 ? below : above}, share};
}

Gauges::Gauges(const Plate& plate, const Cells& cells, long steps, bool dilatancy)
    : columns_(static_cast<std::size_t>(cells.x)) {
  for (const Gauge& gauge : plate.gauges) {
    readings_.push_back(reading_of(gauge, plate, cells));
    GaugeRecord& record = records_.emplace_back();
    for (auto* values : {&record.time, &record.xx, &record.yy}) values->reserve(static_cast<std::size_t>(steps));
    if (dilatancy) record.dilatancy.reserve(static_cast<std::size_t>(steps));
  }
}

std::size_t Gauges::bytes() const {
  std::size_t numbers = 0;
  for (const GaugeRecord& r : records_)
    for (const auto* values : {&r.time, &r.xx, &r.yy, &r.dilatancy}) numbers += values->capacity();
  return numbers * sizeof(double);
}

}  // namespace diptych
