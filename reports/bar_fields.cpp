#include "reports/bar_fields.hpp"

#include <fmt/core.h>

#include <utility>

#include "reports/results.hpp"

namespace diptych::reports {
namespace {

constexpr std::pair<const char*, const char*> units[]{{"displacement", "m"}, {"velocity", "m/s"}, {"stress", "Pa"}};

}  // namespace

std::string bar_fields_csv(const Case& result, const Run& run, const std::string& kind) {
  const auto unit = [&](const char* si) { return result.units == "SI" ? si : result.units + " units"; };
  std::string head, lines;
  for (const Sample& sample : run.samples) {
    for (const BarPoints& points : sample.bar_points) {
      if (points.kind != kind) continue;
      std::vector<const std::vector<double>*> columns;
      head = fmt::format("t [{}],bar,x [{}]", result.time_unit, unit("m"));
      const auto add = [&](const BarPoints::Fields& of, const char* name, const char* what, const char* si) {
        const auto field = of.find(name);
        if (field == of.end()) return;
        columns.push_back(&field->second);
        head += fmt::format(",{}{} [{}]", what, name, unit(si));
      };
      for (const auto& [name, si] : units) {
        add(points.fields, name, "", si);
        add(points.exact, name, "exact ", si);
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
