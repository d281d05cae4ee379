#include "runner/trade/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "reports/field_norms.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/compare/uncertainty.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

using Sort = Quantity::Sort;

/// The error of what gates could name `name`, where an exact value is known.
std::optional<double> exact_error(const Case& c, const reports::Run& run, const std::string& name, double value) {
  const auto found = [&](const std::string& what) -> std::optional<double> {
    const auto one = run.measures.find(what);
    return one == run.measures.end() ? std::nullopt : std::optional(one->second);
  };
  if (const auto error = found(name + ".error")) return *error;
  if (!name.starts_with("gauge.") || !c.plate) return {};
  const std::string what = name.substr(name.rfind('.') + 1);
  const bool elastic = std::holds_alternative<solid::Elastic>(*c.plate->solid) && !compression_of(*c.plate->solid);
  if (!contains(elastic ? Names{"arrival", "plateau", "ratio", "release"} : Names{"arrival"}, what)) return {};
  const auto exact = found(name + ".exact");
  if (!exact || *exact == 0) return {};
  return std::abs(value / *exact - 1);
}

/// What the meshes of one setting say of one quantity at a time.
struct Family {
  std::vector<std::size_t> points;
  std::vector<double> size, value;
};

}  // namespace

std::vector<RunNumber> numbers_of(const Case& c, const reports::Run& run) {
  std::vector<RunNumber> all;
  for (const reports::Sample& sample : run.samples)
    for (const reports::ProbeValue& probe : sample.probes)
      all.push_back({"probe." + probe.id, sample.asked, probe.value});
  for (const std::string& name : quantity_names(c, {Sort::outcome, Sort::gauge_reading, Sort::failure}))
    if (const auto found = run.measures.find(name); found != run.measures.end())
      all.push_back({name, std::nan(""), found->second});
  return all;
}

Names names_of_numbers(const Case& c) {
  return quantity_names(c, {Sort::probe, Sort::outcome, Sort::gauge_reading, Sort::failure});
}

std::vector<RunNumber> readings(const Case& c, const reports::Run& run) {
  if (c.times.empty()) return {};
  std::vector<RunNumber> all = numbers_of(c, run);
  std::erase_if(all, [](const RunNumber& one) { return !std::isfinite(one.value); });
  for (RunNumber& one : all) {
    if (!std::isnan(one.time)) continue;
    one.time = c.times.back();
    one.error = exact_error(c, run, one.quantity, one.value);
  }
  return all;
}

std::vector<reports::TradeError> known_errors(const Case& c, const reports::Run& run) {
  std::vector<reports::TradeError> errors;
  for (const reports::Sample& sample : run.samples)
    for (const reports::FieldError& field : sample.errors)
      for (const reports::Norm& norm : reports::norms)
        errors.push_back({field.field + "." + norm.name, sample.asked, field.*norm.measured, 0, field.*norm.predicted});
  for (const RunNumber& one : readings(c, run))
    if (one.error) errors.push_back({one.quantity, one.time, *one.error, 0, {}});
  return errors;
}

void add_extrapolated(const std::vector<std::vector<RunNumber>>& of, reports::Trade& trade) {
  std::map<std::tuple<std::string, std::string, double>, std::map<std::string, Family>> looked_at;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const reports::TradePoint& point = trade.points.at(i);
    for (const RunNumber& one : of[i]) {
      if (one.error) continue;
      Family& family = looked_at[{point.scene, one.quantity, one.time}][point.setting];
      family.points.push_back(i);
      family.size.push_back(point.cell_size);
      family.value.push_back(one.value);
    }
  }
  for (const auto& [what, families] : looked_at) {
    double reference = 0, band = std::numeric_limits<double>::infinity();
    for (const auto& [setting, family] : families) {
      if (family.size.size() < levels_for_uncertainty) continue;
      const Uncertainty u = discretisation_uncertainty(family.size, family.value);
      const auto finest =
          static_cast<std::size_t>(std::min_element(family.size.begin(), family.size.end()) - family.size.begin());
      if (u.of(finest) > 0 && u.of(finest) < band) {
        band = u.of(finest);
        reference = u.extrapolated;
      }
    }
    const double size = std::abs(reference);
    if (!(band < size / 4)) continue;
    for (const auto& [setting, family] : families)
      for (std::size_t k = 0; k < family.points.size(); ++k)
        trade.points[family.points[k]].errors.push_back(
            {std::get<1>(what), std::get<2>(what), std::abs(family.value[k] - reference) / size, band / size, {}});
  }
}

}  // namespace diptych::runner
