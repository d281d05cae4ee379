#include "reports/bar_fields.hpp"

#include <fmt/core.h>

#include "reports/results.hpp"
#include "reports/table_grids.hpp"

namespace diptych::reports {

std::string bar_fields_csv(const Case& result, const Run& run, const std::string& kind) {
  std::string head, lines;
  for (const Sample& sample : run.samples) {
    for (const BarPoints& points : sample.bar_points) {
      if (points.kind != kind) continue;
      std::vector<const std::vector<double>*> columns;
      head = fmt::format("t [{}],bar,x [{}]", result.time_unit, unit(result, "length"));
      const auto add = [&](const BarPoints::Fields& of, const char* name, const char* what) {
        const auto field = of.find(name);
        if (field == of.end()) return;
        columns.push_back(&field->second);
        head += fmt::format(",{}{} [{}]", what, name, unit(result, name));
      };
      for (const char* name : {"displacement", "velocity", "stress"}) {
        add(points.fields, name, "");
        add(points.exact, name, "exact ");
      }
      for (std::size_t i = 0; i < points.x.size(); ++i) {
        lines += fmt::format("{},{},{}", sample.asked, points.bar[i], points.x[i]);
        for (const auto* column : columns) lines += fmt::format(",{}", (*column)[i]);
        lines += '\n';
      }
    }
  }
  return head + '\n' + lines;
}

}  // namespace diptych::reports
