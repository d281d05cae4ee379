#include "hinge/diffusion/damage_evolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "hinge/wide.hpp"

namespace diptych::diffusion {
namespace {

void require_evolution(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("damage evolution: ") + message);
}

/// Bounded from both sides; NaN stays NaN.
[[gnu::always_inline]] inline double clip(double value, double low, double high) {
  const double below = value > high ? high : value;
  return value < low ? low : below;
}

[[gnu::always_inline]] inline double diffusivity(double mobility, double rupture_strain, double floor,
                                                 double volumetric_strain) {
  return clip(mobility * ((rupture_strain - volumetric_strain) / rupture_strain), floor * mobility, mobility);
}

/// Area between the x-axis and the circle over [x0, x1], 0 ≤ x0 ≤ x1 ≤ r: two triangles and a sector.
double area_under_circle(double r, double x0, double x1) {
  const double y0 = std::sqrt((r - x0) * (r + x0)), y1 = std::sqrt((r - x1) * (r + x1));
  return (x1 * y1 - x0 * y0 + r * r * std::atan2(y0 * x1 - y1 * x0, x0 * x1 + y0 * y1)) / 2;
}

/// Eq. 25 of all cells.
DIPTYCH_WIDEST void diffusivities(const Diffusion& diffusion, std::size_t cells, const double* __restrict strain,
                                  double* __restrict out) {
  const double mobility = diffusion.mobility, rupture = diffusion.rupture_strain, floor = diffusion.floor;
#pragma GCC ivdep
  for (std::size_t cell = 0; cell < cells; ++cell) out[cell] = diffusivity(mobility, rupture, floor, strain[cell]);
}

/// Eq. 27 of a row of cells, from the nodes below and above: C_d rises, and where it heals it also falls.
template <bool everywhere>
DIPTYCH_WIDEST void densities(std::size_t cells, const double* __restrict low, const double* __restrict high,
                              double crack_volume, double cap, bool heals, const unsigned char* __restrict critical,
                              double* __restrict out) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    const double mean = 0.25 * ((low[i] + high[i + 1]) + (low[i + 1] + high[i]));
    const double density = clip(crack_volume * mean, 0, cap);  // schemes that are not positive may undershoot
    const double held = out[i], more = density <= held ? held : density, now = heals ? density : more;
    out[i] = everywhere || critical[i] != 0 ? now : held;
  }
}

}  // namespace

double diffusivity(const Diffusion& diffusion, double volumetric_strain) {
  return diffusivity(diffusion.mobility, diffusion.rupture_strain, diffusion.floor, volumetric_strain);
}

double area_within(double radius, double x0, double x1, double y0, double y1) {
  if (std::pair(x0, x1) > std::pair(y0, y1)) return area_within(radius, y0, y1, x0, x1);
  if (std::hypot(x1, y1) <= radius) return (x1 - x0) * (y1 - y0);
  if (std::hypot(x0, y0) >= radius) return 0;
  const auto reach = [&](double y) { return y < radius ? std::sqrt((radius - y) * (radius + y)) : 0; };
  const double top = std::clamp(reach(y1), x0, x1), end = std::clamp(reach(y0), x0, x1);  // circle leaves at y1 and y0
  return (y1 - y0) * (top - x0) + area_under_circle(radius, top, end) - y0 * (end - top);
}

DamageEvolution::DamageEvolution(const Evolution& evolution, CrackGrowth growth, const Grid& grid)
    : evolution_(evolution), growth_(std::move(growth)), grid_(grid) {
  require_evolution(evolution.cap >= 0, "the cap must be >= 0");
  require_evolution(evolution.rate == Rate::tracked || evolution.reference_rate > 0, "the reference rate must be > 0");
  require_evolution(evolution.rate == Rate::reference || evolution.rate_floor > 0, "the rate's floor must be > 0");
  if (evolution.diffusion) {
    const Diffusion& d = *evolution.diffusion;
    require_evolution(d.characteristic_time > 0, "the characteristic time must be > 0");
    require_evolution(d.crack_volume > 0, "the crack volume must be > 0");
    require_evolution(d.rupture_strain > 0, "the rupture strain must be > 0");
    require_evolution(d.mobility >= 0, "the mobility must be >= 0");
    require_evolution(d.floor >= 0 && d.floor <= 1, "the floor must lie between 0 and 1");
    require_evolution(d.source != Source::zone || d.radius >= 0, "the radius must be >= 0");
    concentration_.emplace(grid, d.scheme, d.reading, d.drift);
    place_source();
    source_.assign(grid.nodes(), 0);
    diffusivity_.assign(grid.cells(), 0);
  } else {
    largest_.assign(grid.cells(), 0);
  }
  crack_density_.assign(grid.cells(), 0);
  if (!evolution.damage_everywhere) critical_.assign(grid.cells(), 0);
  if (evolution.rate == Rate::tracked) {
    const std::size_t followed = evolution.diffusion ? fed_cells_.size() : grid.cells();
    strain_before_.assign(followed, 0);
    largest_rate_.assign(followed, evolution.rate_floor);
  }
}

void DamageEvolution::place_source() {
  const Diffusion& d = *evolution_.diffusion;
  const auto nx = static_cast<std::size_t>(grid_.nx), ny = static_cast<std::size_t>(grid_.ny);
  const double quarter = grid_.hx * grid_.hy / 4;
  const auto area = [&](std::size_t i, std::size_t j) {  // of quarter i, j of the grid of quarters, within the zone
    const auto x = static_cast<double>(i) * (grid_.hx / 2), y = static_cast<double>(j) * (grid_.hy / 2);
    switch (d.source) {
      case Source::zone: return area_within(d.radius, x, x + grid_.hx / 2, y, y + grid_.hy / 2);
      case Source::node: return i == 0 && j == 0 ? quarter : 0;
      case Source::everywhere: break;
    }
    return quarter;
  };
  std::vector<std::size_t> place(grid_.cells(), grid_.cells());  // of each cell among the fed ones
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    const std::size_t i = 2 * (cell % nx), j = 2 * (cell / nx);
    if (!(area(i, j) > 0)) continue;  // the quarter nearest to the origin
    place[cell] = fed_cells_.size();
    fed_cells_.push_back(cell);
  }
  q_.assign(fed_cells_.size() + 1, 0);
  for (std::size_t j = 0; j <= ny; ++j) {
    for (std::size_t i = 0; i <= nx; ++i) {
      const double quarters = ((i > 0) + (i < nx)) * ((j > 0) + (j < ny));
      FedNode fed;
      fed.node = j * (nx + 1) + i;
      fed.cell.fill(fed_cells_.size());
      for (std::size_t q = 0; q < 4; ++q) {
        const std::size_t right = q % 2, up = q / 2;
        if (i + right < 1 || i + right > nx || j + up < 1 || j + up > ny) continue;
        const std::size_t cell = (j + up - 1) * nx + (i + right - 1);
        if (place[cell] == grid_.cells()) continue;
        fed.cell[q] = place[cell];
        fed.share[q] = area(2 * i + right - 1, 2 * j + up - 1) / (quarters * quarter);
      }
      if (std::ranges::any_of(fed.share, [](double share) { return share > 0; })) fed_nodes_.push_back(fed);
    }
  }
}

double DamageEvolution::rate(std::size_t k, double strain, double dt) {
  if (evolution_.rate == Rate::reference) return evolution_.reference_rate;
  double& largest = largest_rate_[k];
  largest = std::max(largest, (strain - strain_before_[k]) / dt);
  strain_before_[k] = strain;
  return largest;
}

void DamageEvolution::advance(std::span<const double> strain, double dt) {
  require_evolution(strain.size() == grid_.cells(), "one strain a cell");
  require_evolution(std::isfinite(dt) && dt > 0, "dt must be finite and > 0");
  for (std::size_t cell = 0; cell < critical_.size(); ++cell)
    critical_[cell] = static_cast<unsigned char>(critical_[cell] | !(strain[cell] < evolution_.critical_strain));
  concentration_ ? diffuse(strain, dt) : local(strain, dt);
}

/// Eq. 23a from the cell's own strain; what has cracked stays so.
void DamageEvolution::local(std::span<const double> strain, double dt) {
  for (std::size_t cell = 0; cell < strain.size(); ++cell) {
    const double e = strain[cell], rate_max = rate(cell, e, dt);
    // Below the critical strain a fixed rate gives less than the critical state will, which alone is shown.
    const bool later = evolution_.rate == Rate::reference && !critical_.empty() && e < evolution_.critical_strain;
    if (later || e <= 0) continue;
    const double now = growth_(e, rate_max);
    double& held = largest_[cell];
    if (!(now <= held) && !std::isnan(held)) held = now;
    if (critical_.empty() || critical_[cell]) crack_density_[cell] = std::min(held, evolution_.cap);
  }
}

/// Q of the k-th fed cell, eq. 26.
double DamageEvolution::source(std::size_t k, double strain, double dt) {
  const Diffusion& d = *evolution_.diffusion;
  const double rate_max = rate(k, strain, dt);
  if (strain < evolution_.critical_strain || strain <= 0) return 0;
  const double acting = d.clip_strain && strain > d.rupture_strain ? d.rupture_strain : strain;
  const double density = growth_(acting, rate_max);
  return density / d.characteristic_time / (d.per_crack_volume ? d.crack_volume : 1);
}

void DamageEvolution::diffuse(std::span<const double> strain, double dt) {
  const Diffusion& d = *evolution_.diffusion;
  for (std::size_t k = 0; k < fed_cells_.size(); ++k) {
    q_[k] = source(k, strain[fed_cells_[k]], dt);
    anything_ |= q_[k] != 0;
  }
  // A wave that has blown up must show, even where there is nothing to diffuse.
  if (!anything_ && std::ranges::none_of(strain, [](double e) { return std::isnan(e); })) return;

  for (const FedNode& fed : fed_nodes_) {
    const auto part = [&](std::size_t k) { return fed.share[k] * q_[fed.cell[k]]; };
    source_[fed.node] = (part(0) + part(3)) + (part(1) + part(2));
  }
  if (d.saturates) {
    const std::span<const double> c = std::as_const(*concentration_).values();
    const double most = evolution_.cap / d.crack_volume;
    for (const FedNode& fed : fed_nodes_)
      source_[fed.node] = std::min(source_[fed.node], std::max(0.0, most - c[fed.node]) / dt);
  }
  diffusivities(d, strain.size(), strain.data(), diffusivity_.data());
  concentration_->step(diffusivity_, source_, dt);

  const std::span<const double> c = std::as_const(*concentration_).values();
  const auto columns = static_cast<std::size_t>(grid_.nx), rows = static_cast<std::size_t>(grid_.ny);
  for (std::size_t j = 0; j < rows; ++j) {
    const double* low = c.data() + j * (columns + 1);
    const auto renew = critical_.empty() ? densities<true> : densities<false>;
    renew(columns, low, low + columns + 1, d.crack_volume, evolution_.cap, evolution_.heals,
          critical_.data() + (critical_.empty() ? 0 : j * columns), crack_density_.data() + j * columns);
  }
}

std::span<const double> DamageEvolution::concentration() const {
  return concentration_ ? std::as_const(*concentration_).values() : std::span<const double>{};
}

double DamageEvolution::total() const { return concentration_ ? concentration_->total() : 0; }
double DamageEvolution::fed() const { return concentration_ ? concentration_->fed() : 0; }
long DamageEvolution::node_updates() const { return concentration_ ? concentration_->node_updates() : 0; }

std::size_t DamageEvolution::bytes() const {
  std::size_t sum =
      critical_.capacity() + fed_cells_.capacity() * sizeof(std::size_t) + fed_nodes_.capacity() * sizeof(FedNode);
  for (const std::vector<double>* v :
       {&crack_density_, &strain_before_, &largest_rate_, &largest_, &q_, &source_, &diffusivity_})
    sum += v->capacity() * sizeof(double);
  return sum + (concentration_ ? concentration_->bytes() : 0);
}

}  // namespace diptych::diffusion
