#include "reports/bench_table.hpp"

#include <fmt/core.h>

#include "reports/json.hpp"

namespace diptych::reports {

std::string bench_text(const std::vector<BenchRow>& rows) {
  std::string out = fmt::format("{:<10} {:<10} {:>8} {:>9} {:>7} {:>8} {:>7} {:>8} {:>7} {:>9}\n", "scene", "method",
                                "points", "cells", "threads", "M/s", "spread", "B/point", "GB/s", "of floor");
  for (const BenchRow& row : rows) {
    const std::string cells = fmt::format("{}x{}", row.cells_x, row.cells_y);
    out += fmt::format("{:<10} {:<10} {:>8} {:>9} {:>7} ", row.scene, row.method, row.points, cells, row.threads);
    out += !row.trouble.empty()
               ? row.trouble + '\n'
               : fmt::format("{:>8.1f} {:>5.0f} % {:>8.0f} {:>7.1f} {:>7.0f} %{}\n", row.rate() / 1e6,
                             100 * row.step.spread, row.bytes / static_cast<double>(row.points), row.bandwidth / 1e9,
                             100 * row.of_floor(),
                             row.diffusion > 0 ? fmt::format("  {:.1f} diffusion updates a point",
                                                             row.diffusion / static_cast<double>(row.points))
                                               : "");
  }
  return out +
         "M/s: elements or particles a microsecond, median of the rounds, spread half their interquartile range, no "
         "books\nGB/s: a sweep in place over as many bytes as the run holds, in the same minute; of floor: the time of "
         "that sweep\nover a step's, above 100 % where caches hold part of what one step leaves for the next\n";
}

std::string bench_json(const std::vector<BenchRow>& rows, const Provenance& made_by) {
  std::string out;
  for (const BenchRow& row : rows) {
    Json one{{"type", "bench"},        {"scene", row.scene},     {"method", row.method},
             {"points", row.points},   {"cells_x", row.cells_x}, {"cells_y", row.cells_y},
             {"threads", row.threads}, {"trouble", row.trouble}, {"rounds", row.step.rounds}};
    Numbers numbers(one);
    if (row.trouble.empty()) {
      numbers.put("points_per_second", row.rate());
      numbers.put("spread", row.step.spread);
      numbers.put("bytes_per_point", row.bytes / static_cast<double>(row.points));
      numbers.put("diffusion_updates_per_point", row.diffusion / static_cast<double>(row.points));
      numbers.put("bandwidth", row.bandwidth);
      numbers.put("of_floor", row.of_floor());
    }
    numbers.finish();
    out += json_line(one);
  }
  return out + json_line({{"type", "provenance"}, {"env", env_of(made_by)}});
}

}  // namespace diptych::reports
