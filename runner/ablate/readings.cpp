#include "runner/ablate/readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "runner/compare/uncertainty.hpp"
#include "runner/trade/errors.hpp"

namespace diptych::runner {
namespace {

using reports::AblatedQuantity;
using reports::Run;
using reports::Sample;

/// The middles of the cells, or the points themselves.
std::array<std::vector<double>, 2> places_of(const reports::VtuMesh& mesh, bool on_cells) {
  if (!on_cells) return {mesh.x, mesh.y};
  std::array<std::vector<double>, 2> middles;
  const auto corners = static_cast<std::size_t>(mesh.corners);
  for (std::size_t first = 0; first + corners <= mesh.connectivity.size(); first += corners) {
    double x = 0, y = 0;
    for (std::size_t k = 0; k < corners; ++k) {
      x += mesh.x[mesh.connectivity[first + k]] / mesh.corners;
      y += mesh.y[mesh.connectivity[first + k]] / mesh.corners;
    }
    middles[0].push_back(x);
    middles[1].push_back(y);
  }
  return middles;
}

PointValues from_array(const reports::VtuPiece& piece, const reports::VtuArray& array) {
  PointValues field;
  field.name = array.name;
  auto places = places_of(piece.mesh, array.on_cells);
  field.x = std::move(places[0]);
  field.y = std::move(places[1]);
  const std::size_t count = std::max<std::size_t>(array.components.size(), 1);
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> values;
    for (std::size_t at = k; at < array.values.size(); at += count) values.push_back(array.values[at]);
    field.component.push_back(std::move(values));
    const bool off_diagonal = array.name == "stress" && array.components[k] == "XY";
    field.weight.push_back(off_diagonal ? 2 : 1);
  }
  return field;
}

/// Points by the square in which they lie, so that the nearest are soon found; those of another bar are never near.
class Near {
 public:
  explicit Near(const PointValues& field) : field_(field) {
    const auto extent = [](const std::vector<double>& values) {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      return *most - *least;
    };
    const double across = extent(field.x), up = field.bars ? 0 : extent(field.y);
    const auto count = static_cast<double>(field.x.size());
    side_ = std::max({std::sqrt(across * up / count), std::max(across, up) / count, 1e-300});
    for (std::size_t p = 0; p < field.x.size(); ++p) squares_[square(field.x[p], field.y[p])].push_back(p);
  }

  /// Those next to the place, and all that are as near but for a hundredth; none where nothing is near.
  std::vector<std::size_t> to(double x, double y) const {
    constexpr long widest = 8;
    const auto [i, j] = square(x, y);
    for (long reach = 1; reach <= widest; reach *= 2) {
      std::vector<std::pair<double, std::size_t>> found;
      const long rows = field_.bars ? 0 : reach;
      for (long a = i - reach; a <= i + reach; ++a) {
        for (long b = j - rows; b <= j + rows; ++b) {
          const auto points = squares_.find({a, b});
          if (points == squares_.end()) continue;
          for (const std::size_t p : points->second)
            found.emplace_back(std::hypot(field_.x[p] - x, field_.y[p] - y), p);
        }
      }
      if (found.empty()) continue;
      const double least = std::min_element(found.begin(), found.end())->first;
      if (least > static_cast<double>(reach) * side_ && reach < widest) continue;  // one out of sight may be nearer
      std::vector<std::size_t> nearest;
      for (const auto& [away, p] : found)
        if (away <= least * 1.01 + 1e-9 * side_) nearest.push_back(p);
      std::sort(nearest.begin(), nearest.end());
      return nearest;
    }
    return {};
  }

 private:
  std::pair<long, long> square(double x, double y) const {
    const auto part = [&](double at) { return std::lround(std::floor(at / side_)); };
    return {part(x), field_.bars ? std::lround(y) : part(y)};
  }
  const PointValues& field_;
  double side_ = 1;
  std::map<std::pair<long, long>, std::vector<std::size_t>> squares_;
};

const PointValues* field_called(const std::vector<PointValues>& fields, const std::string& name) {
  for (const PointValues& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

const reports::FieldError* error_of(const Sample& sample, const std::string& field) {
  for (const reports::FieldError& error : sample.errors)
    if (error.field == field) return &error;
  return nullptr;
}

bool same_moment(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

const RunNumber* number_called(const std::vector<RunNumber>& numbers, const AblatedQuantity& one) {
  for (const RunNumber& number : numbers)
    if (number.quantity == one.quantity && same_moment(number.time, one.time)) return &number;
  return nullptr;
}

/// By the meshes that have the number.
void judge_uncertainty(const Case& c, const std::vector<const Run*>& meshes, AblatedQuantity& one) {
  std::vector<double> sizes, values;
  for (const Run* run : meshes) {
    const auto numbers = numbers_of(c, *run);
    const RunNumber* number = number_called(numbers, one);
    if (!number || !std::isfinite(number->value)) continue;
    sizes.push_back(run->cell_size);
    values.push_back(number->value);
  }
  if (values.size() < 2) return;
  if (values.size() >= levels_for_uncertainty) {
    one.uncertainty = discretisation_uncertainty(sizes, values).band.back() / one.scale;
  } else {
    one.uncertainty = std::abs(values.back() - values[values.size() - 2]) / one.scale;
    values.resize(2);
  }
  one.known_by = std::to_string(values.size()) + " meshes";
}

std::vector<AblatedQuantity> fields_with_doubt(const std::vector<const Run*>& meshes) {
  std::vector<AblatedQuantity> all;
  const Run& run = *meshes.back();
  std::map<std::string, double> largest = largest_lengths(run);
  for (std::size_t s = 0; s < run.samples.size(); ++s) {
    const Sample& sample = run.samples[s];
    for (const PointValues& field : fields_at(sample)) {
      AblatedQuantity one;
      one.quantity = field.name;
      one.time = sample.asked;
      one.field = true;
      const reports::FieldError* error = error_of(sample, field.name);
      one.scale = error ? error->scale : largest[field.name];
      if (!(one.scale > 0)) one.scale = 1;  // nothing but zeros
      if (error) {
        one.stands = one.uncertainty = error->l2;
        one.known_by = "exact";
      } else if (meshes.size() > 1 && s < meshes[meshes.size() - 2]->samples.size()) {
        const auto coarser = fields_at(meshes[meshes.size() - 2]->samples[s]);
        if (const PointValues* other = field_called(coarser, field.name)) {
          one.uncertainty = l2_distance(*other, field) / one.scale;
          one.known_by = "2 meshes";
        }
      }
      all.push_back(one);
    }
  }
  return all;
}

}  // namespace

double PointValues::length(std::size_t point) const {
  double square = 0;
  for (std::size_t k = 0; k < component.size(); ++k) square += weight[k] * component[k][point] * component[k][point];
  return std::sqrt(square);
}

std::vector<PointValues> fields_at(const Sample& sample) {
  std::vector<PointValues> all;
  for (const reports::BarPoints& points : sample.bar_points) {
    for (const auto& [name, values] : points.fields) {
      PointValues field{name, points.x, {}, {values}, {1}, true};
      field.y.assign(points.bar.begin(), points.bar.end());
      all.push_back(std::move(field));
    }
  }
  for (const reports::VtuPiece& piece : sample.files)
    for (const reports::VtuArray& array : piece.arrays) all.push_back(from_array(piece, array));
  std::erase_if(all, [](const PointValues& field) { return field.x.empty(); });
  return all;
}

std::map<std::string, double> largest_lengths(const Run& run) {
  std::map<std::string, double> largest;
  for (const Sample& sample : run.samples)
    for (const PointValues& field : fields_at(sample))
      for (std::size_t p = 0; p < field.x.size(); ++p)
        largest[field.name] = std::max(largest[field.name], field.length(p));
  return largest;
}

double l2_distance(PointValues a, PointValues b, Axis regardless) {
  if (a.component.size() != b.component.size() || b.x.empty()) return std::nan("");
  for (PointValues* field : {&a, &b}) {
    if (regardless == Axis::x) std::fill(field->x.begin(), field->x.end(), 0);
    if (regardless == Axis::y) std::fill(field->y.begin(), field->y.end(), 0);
  }
  const bool same_points = a.x == b.x && a.y == b.y;
  const std::optional<Near> near = same_points ? std::nullopt : std::optional<Near>(b);
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < a.x.size(); ++p) {
    const std::vector<std::size_t> nearest = same_points ? std::vector{p} : near->to(a.x[p], a.y[p]);
    if (nearest.empty()) continue;
    double square = 0;
    for (std::size_t k = 0; k < a.component.size(); ++k) {
      double mean = 0;
      for (const std::size_t q : nearest) mean += b.component[k][q] / static_cast<double>(nearest.size());
      square += a.weight[k] * (a.component[k][p] - mean) * (a.component[k][p] - mean);
    }
    sum += square;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

std::vector<AblatedQuantity> quantities_of(const Case& c, const std::vector<const Run*>& meshes) {
  std::vector<AblatedQuantity> all;
  const std::vector<RunNumber> numbers = numbers_of(c, *meshes.back());
  for (const RunNumber& number : numbers) {
    AblatedQuantity one;
    one.quantity = number.quantity;
    one.time = number.time;
    one.stands = number.value;
    // What is read at several times is a part of the largest of them.
    double largest = 0;
    for (const RunNumber& other : numbers)
      if (other.quantity == number.quantity && std::isfinite(other.value))
        largest = std::max(largest, std::abs(other.value));
    one.scale = largest > 0 ? largest : 1;
    judge_uncertainty(c, meshes, one);
    all.push_back(one);
  }
  const auto fields = fields_with_doubt(meshes);
  all.insert(all.end(), fields.begin(), fields.end());
  return all;
}

void compare(const Case& c, const Run& stands, const ChangedRun& other, std::vector<AblatedQuantity>& quantities) {
  const Run& changed = *other.run;
  const std::vector<double>& times = other.scene->times;
  const std::vector<RunNumber> numbers = numbers_of(*other.scene, changed);
  // Sample times go by their place: those of the changed scene may be written in another unit.
  const auto sample_of = [&](double time) {
    const auto at = std::find(c.times.begin(), c.times.end(), time);
    return static_cast<std::size_t>(at - c.times.begin());
  };
  for (AblatedQuantity& one : quantities) {
    if (one.field) {
      const std::size_t s = sample_of(one.time);
      if (s >= stands.samples.size() || s >= changed.samples.size()) continue;
      const auto before = fields_at(stands.samples[s]), after = fields_at(changed.samples[s]);
      const PointValues *first = field_called(before, one.quantity), *second = field_called(after, one.quantity);
      if (!first || !second) continue;
      one.change = l2_distance(*first, *second, other.strip) / one.scale;
      const reports::FieldError* error = error_of(changed.samples[s], one.quantity);
      if (error && !other.another_exact) one.changed = error->l2 * error->scale / one.scale;
      continue;
    }
    AblatedQuantity as_there = one;
    if (!std::isnan(one.time) && sample_of(one.time) < times.size()) as_there.time = times[sample_of(one.time)];
    if (const RunNumber* number = number_called(numbers, as_there)) {
      one.changed = number->value;
      one.change = std::abs(one.changed - one.stands) / one.scale;
    }
  }
  for (const RunNumber& number : numbers) {
    if (!std::isnan(number.time)) continue;
    const bool known = std::any_of(quantities.begin(), quantities.end(),
                                   [&](const AblatedQuantity& one) { return one.quantity == number.quantity; });
    if (known) continue;
    AblatedQuantity one;
    one.quantity = number.quantity;
    one.changed = number.value;
    quantities.push_back(one);
  }
}

}  // namespace diptych::runner
