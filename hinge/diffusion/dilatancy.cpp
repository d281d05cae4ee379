#include "hinge/diffusion/dilatancy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace diptych::diffusion {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("dilatancy: " + message);
}

}  // namespace

Dilatancy::Dilatancy(const Spread& spread, const Grid& grid)
    : spread_(spread), grid_(grid), field_(grid, spread.scheme, Reading::isotropic, spread.drift) {
  require(spread.diffusivity >= 0 && std::isfinite(spread.diffusivity),
          "the diffusivity must be finite and >= 0, not " + std::to_string(spread.diffusivity));
  require(!spread.face || (*spread.face >= 0 && *spread.face <= grid.nx), "the face must be a column of nodes, 0 to " +
                                                                              std::to_string(grid.nx) + ", not " +
                                                                              std::to_string(spread.face.value_or(0)));
  of_cells_.assign(grid.cells(), 0);
  diffusivity_.assign(grid.cells(), 0);
  no_source_.assign(grid.nodes(), 0);
  if (!spread.start.empty()) {
    require(spread.start.size() == grid.nodes(), "the start must have a value for each node");
    std::ranges::copy(spread.start, field_.values().begin());
    anything_ = true;
    raised_ = field_.total();
    find_of_cells();
    spread_.start = {};
  }
  if (spread.face) set_off_.assign(static_cast<std::size_t>(grid.ny) + 1, 0);
}

/// Mean of the positive ceilings beside node j of the face; 0 if there is none.
double Dilatancy::face_ceiling(std::span<const double> ceiling, std::size_t j) const {
  const auto columns = static_cast<std::size_t>(grid_.nx), i = static_cast<std::size_t>(*spread_.face);
  int count = 0;
  const auto at = [&](bool right, bool up) {  // 0 where there is no cell
    if ((right ? i == columns : i == 0) || (up ? j + 1 == set_off_.size() : j == 0)) return 0.0;
    const double value = ceiling[(up ? j : j - 1) * columns + (right ? i : i - 1)];
    count += value > 0;
    return value;
  };
  const double one = at(false, false) + at(true, true), other = at(true, false) + at(false, true);
  return count > 0 ? (one + other) / count : 0;
}

void Dilatancy::set_face(std::span<const double> ceiling) {
  const auto row = static_cast<std::size_t>(grid_.nx) + 1, i = static_cast<std::size_t>(*spread_.face);
  const std::span<double> v = field_.values();
  bool more = false;
  for (std::size_t j = 0; j < set_off_.size(); ++j) {
    const double mean = face_ceiling(ceiling, j);
    if (!(mean > 0)) continue;
    anything_ = true;
    more |= !set_off_[j];
    set_off_[j] = 1;
    double& value = v[j * row + i];
    if (mean == value || (spread_.keeps_largest && !(mean > value))) continue;  // NaN stays
    const int quarters = ((i > 0) + (i + 1 < row)) * ((j > 0) + (j + 1 < set_off_.size()));
    raised_ += quarters * (grid_.hx * grid_.hy / 4) * (mean - value);
    value = mean;
  }
  if (!more) return;
  std::vector<std::size_t> held;
  for (std::size_t j = 0; j < set_off_.size(); ++j) {
    if (set_off_[j]) held.push_back(j * row + i);
  }
  field_.hold(std::move(held));
}

double Dilatancy::diffusivity(double ceiling, double dilatancy) const {
  if (std::isnan(ceiling)) return ceiling;
  if (ceiling == 0) return spread_.ahead ? spread_.diffusivity : 0;
  if (spread_.profile == Profile::constant) return spread_.diffusivity;
  const double part = dilatancy / ceiling;
  const double d = spread_.diffusivity * (spread_.profile == Profile::rising ? part : 1 - part);
  return d < 0 ? 0 : d > spread_.diffusivity ? spread_.diffusivity : d;  // this order keeps NaN
}

void Dilatancy::find_of_cells() {
  const std::span<const double> v = of_nodes();
  const auto columns = static_cast<std::size_t>(grid_.nx), rows = static_cast<std::size_t>(grid_.ny);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t left = j * (columns + 1) + i, above = left + columns + 1;
      of_cells_[j * columns + i] = 0.25 * ((v[left] + v[above + 1]) + (v[left + 1] + v[above]));
    }
  }
}

void Dilatancy::advance(std::span<const double> ceiling, double dt) {
  require(ceiling.size() == grid_.cells(), "one ceiling a cell");
  bool number = true;
  for (const double value : ceiling) {
    if (value < 0) throw std::invalid_argument("dilatancy: a ceiling is negative: " + std::to_string(value));
    number &= !std::isnan(value);
  }
  if (spread_.face) set_face(ceiling);
  anything_ |= !number;  // a wave that has blown up must show, even where there is nothing to diffuse
  if (!anything_) return;
  for (std::size_t cell = 0; cell < ceiling.size(); ++cell)
    diffusivity_[cell] = diffusivity(ceiling[cell], of_cells_[cell]);
  field_.step(diffusivity_, no_source_, dt);
  find_of_cells();
}

std::span<const double> Dilatancy::of_nodes() const { return field_.values(); }
double Dilatancy::total() const { return field_.total(); }
double Dilatancy::fed() const { return raised_ + field_.fed(); }
long Dilatancy::node_updates() const { return field_.node_updates(); }

std::size_t Dilatancy::bytes() const {
  std::size_t sum = set_off_.capacity() + field_.bytes();
  for (const std::vector<double>* v : {&of_cells_, &diffusivity_, &no_source_}) sum += v->capacity() * sizeof(double);
  return sum;
}

}  // namespace diptych::diffusion
