// The largest stable step of a plate. With S the particles' shape functions, M = Sᵀ m 1 the lumped mass, W = M⁻¹ Sᵀ m S
// what mapping leaves of a grid velocity and A = M⁻¹ K the cells' own operator, one step of a linear plate is
//   USF, MUSL:  V' = F V − Δt W A q,   q' = q + Δt V'
//   USL:        V' = F V − Δt W A q,   q' = q + Δt (V − Δt A q)
// with F = 1 − part of PIC · (1 − W). Both leave the unit circle at −1, where (1 + F) q = (x/2) W A q, and with USL
// (1 + F) q = (x/2)(1 + F − W) A q, x = Δt². So Δt = 2/√λ with λ the largest eigenvalue of φ(W) A, and φ(w) = 2w/(1 +
// f), with USL 2(1 + f − w)/(1 + f). Without PIC f = 1: φ = w and 2 − w. For USF and MUSL and for USL without PIC the
// condition is sufficient too: the quadratic form of any eigenvector is a real quadratic with its roots in the circle.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "hinge/step/eigenvalues.hpp"
#include "hinge/step/viscous_step.hpp"
#include "mpm/plate.hpp"

namespace diptych::mpm {
namespace {

constexpr double inside = 0.5 - 0x1p-54;  // as the particles are placed

struct Setting {
  material::Stiffness stiffness;
  double density, hx, hy;
  Scheme scheme;
  double pic;
  std::vector<double> near, far;  // shape functions at the particles' places along an axis

  double filter(double w) const {
    const double f = 1 - pic * (1 - w);
    return (scheme == Scheme::usl ? 2 * (1 + f - w) : 2 * w) / (1 + f);
  }
};

/// λ of waves through cells without end. Along an axis W of a wave is Π (1 − a sin²(θ/2)), a the mean of 4ξ(1 − ξ).
double interior(const Setting& s, bool anywhere) {
  const std::size_t n = s.near.size();
  double a = 0;
  for (std::size_t k = 0; k < n; ++k) a += 4 * s.near[k] * s.far[k] / static_cast<double>(n);
  double largest = 0;
  constexpr int parts = 96;
  for (int jx = 0; jx <= parts; ++jx) {
    for (int jy = -parts; jy <= parts; ++jy) {
      const double tx = M_PI * jx / parts, ty = M_PI * jy / parts;
      const std::complex<double> ex = std::polar(1.0, tx), ey = std::polar(1.0, ty);
      double xx = 0, yy = 0;
      std::complex<double> xy = 0;
      const auto add = [&](double near_x, double far_x, double near_y, double far_y, double share) {
        const std::complex<double> dx = (ex - 1.0) / s.hx * (near_y + far_y * ey);
        const std::complex<double> dy = (ey - 1.0) / s.hy * (near_x + far_x * ex);
        xx += share * (s.stiffness.normal * std::norm(dx) + s.stiffness.shear * std::norm(dy));
        yy += share * (s.stiffness.normal * std::norm(dy) + s.stiffness.shear * std::norm(dx));
        xy += share * (s.stiffness.cross * std::conj(dx) * dy + s.stiffness.shear * std::conj(dy) * dx);
      };
      double filter = 1;
      if (anywhere) {  // at a node the gradients of a wave are largest and the mapping leaves all of it
        add(1, 0, 1, 0, 1);
      } else {
        for (std::size_t p = 0; p < n * n; ++p)
          add(s.near[p % n], s.far[p % n], s.near[p / n], s.far[p / n], 1 / static_cast<double>(n * n));
        const double sx = std::sin(tx / 2), sy = std::sin(ty / 2);
        filter = s.filter((1 - a * sx * sx) * (1 - a * sy * sy));
      }
      const double mean = (xx + yy) / 2, half = (xx - yy) / 2;
      largest = std::max(largest, filter * (mean + std::sqrt(half * half + std::norm(xy))) / s.density);
    }
  }
  return largest;
}

/// What a degree of freedom of a block is part of: an unknown, and how much of it; none where it is held.
struct Share {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t unknown = none;
  double part = 1;
};

/// The unknowns of a block of nx × ny cells as its supports leave them, those along x first; count: how many of x and
/// y. A platen's nodes move as one: with displacements scaled by √M they have parts in proportion to √M of one unknown
/// of unit length.
std::vector<Share> unknowns_of(const Plate& plate, bool free, int nx, int ny, const std::vector<double>& mass,
                               std::array<std::size_t, 2>& count) {
  const std::array<Side, 4> sides{Side::left, Side::right, Side::bottom, Side::top};
  std::vector<Share> shares(2 * mass.size());
  std::size_t next = 0;
  for (std::size_t c = 0; c < 2; ++c) {
    std::array<double, 4> platen_mass{};
    std::array<std::vector<std::size_t>, 4> platen;
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const std::array<bool, 4> there{i == 0, i == nx, j == 0, j == ny};
        const std::size_t node = static_cast<std::size_t>(j * (nx + 1) + i), freedom = 2 * node + c;
        bool held = false;
        std::size_t on = 4;
        for (std::size_t side = 4; side-- > 0;) {  // a corner goes with the first of its sides
          if (!there[side] || free) continue;
          const auto support = plate.edge(sides[side]).support;
          const bool across = (side < 2) == (c == 0);
          held = held || support == Edge::Support::fixed || support == Edge::Support::driven ||
                 (support == Edge::Support::roller && across);
          if (support == Edge::Support::platen && across) on = side;
        }
        if (held) continue;
        if (on == 4) {
          shares[freedom].unknown = next++;
        } else {
          platen[on].push_back(freedom);
          platen_mass[on] += mass[node];
        }
      }
    }
    for (std::size_t side = 0; side < 4; ++side) {
      if (platen[side].empty()) continue;
      for (const std::size_t freedom : platen[side])
        shares[freedom] = {next, std::sqrt(mass[freedom / 2] / platen_mass[side])};
      ++next;
    }
    count[c] = next - (c == 0 ? 0 : count[0]);
  }
  return shares;
}

/// λ of a block of cells with these supports. Its matrices are made symmetric by √M.
double block(const Setting& s, const Plate& plate, bool free, int nx, int ny) {
  const std::size_t n = s.near.size(), row = static_cast<std::size_t>(nx) + 1;
  const double volume = s.hx * s.hy / static_cast<double>(n * n), mass = volume * s.density;
  struct Place {
    std::array<double, 4> shape, x, y;  // N, ∂N/∂x, ∂N/∂y
  };
  std::vector<Place> places;
  for (std::size_t p = 0; p < n * n; ++p) {
    const double l = s.near[p % n], r = s.far[p % n], b = s.near[p / n], t = s.far[p / n];
    places.push_back({{l * b, r * b, l * t, r * t},
                      {-b / s.hx, b / s.hx, -t / s.hx, t / s.hx},
                      {-l / s.hy, -r / s.hy, l / s.hy, r / s.hy}});
  }
  const auto for_corners = [&](auto&& act) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(ny); ++j) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(nx); ++i) {
        const std::size_t first = j * row + i;
        act(std::array<std::size_t, 4>{first, first + 1, first + row, first + row + 1});
      }
    }
  };
  std::vector<double> M(row * (static_cast<std::size_t>(ny) + 1));
  for_corners([&](const auto& node) {
    for (const Place& place : places)
      for (std::size_t k = 0; k < 4; ++k) M[node[k]] += mass * place.shape[k];
  });
  std::array<std::size_t, 2> count{};
  const std::vector<Share> shares = unknowns_of(plate, free, nx, ny, M, count);
  if (count[0] + count[1] == 0) return 0;

  // Of one cell, node by node: what is left of the mass as the particles have it, and the stiffness.
  struct Pair {
    double filter = 0;
    std::array<std::array<double, 2>, 2> stiffness{};
  };
  std::array<std::array<Pair, 4>, 4> cell;
  const auto& [normal, cross, shear] = s.stiffness;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t q = 0; q < 4; ++q) {
      auto& [filter, K] = cell[k][q];
      for (const Place& p : places) {
        filter += mass * p.shape[k] * p.shape[q];
        K[0][0] += volume * (normal * p.x[k] * p.x[q] + shear * p.y[k] * p.y[q]);
        K[1][1] += volume * (normal * p.y[k] * p.y[q] + shear * p.x[k] * p.x[q]);
        K[0][1] += volume * (cross * p.x[k] * p.y[q] + shear * p.y[k] * p.x[q]);
        K[1][0] += volume * (cross * p.y[k] * p.x[q] + shear * p.x[k] * p.y[q]);
      }
    }
  }
  std::vector<material::SymmetricMatrix> W{material::SymmetricMatrix(count[0]), material::SymmetricMatrix(count[1])};
  material::SymmetricMatrix A(count[0] + count[1]);
  for_corners([&](const auto& node) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t q = 0; q < 4; ++q) {
        const double root = std::sqrt(M[node[k]] * M[node[q]]);
        for (std::size_t c = 0; c < 2; ++c) {
          const Share& a = shares[2 * node[k] + c];
          if (a.unknown == Share::none) continue;
          for (std::size_t d = 0; d < 2; ++d) {
            const Share& b = shares[2 * node[q] + d];
            if (b.unknown == Share::none) continue;
            const double part = a.part * b.part / root;
            A(a.unknown, b.unknown) += part * cell[k][q].stiffness[c][d];
            const std::size_t first = c == 0 ? 0 : count[0];
            if (c == d) W[c](a.unknown - first, b.unknown - first) += part * cell[k][q].filter;
          }
        }
      }
    }
  });
  return material::largest_eigenvalue(
      W, [&](double w) { return s.filter(w); }, A);
}

/// Of a plate of this solid without viscosity.
double limit_of(const material::PlaneElastic& solid, const Plate& plate, const Cells& cells,
                const std::vector<double>& positions, Scheme scheme) {
  Setting s{solid.stiffness(), solid.density, plate.width / cells.x, plate.height / cells.y, scheme, plate.pic, {}, {}};
  for (const double xi : positions) {
    const double offset = std::clamp(xi - 0.5, -inside, inside);
    s.near.push_back(0.5 - offset);
    s.far.push_back(0.5 + offset);
  }
  const bool anywhere = plate.convected && scheme != Scheme::usl;
  double largest = interior(s, anywhere);
  if (!anywhere) {
    // A block of 8 × 8 and one of 7 × 7 cells: what is special at sides and corners reaches a few cells inwards, and
    // odd and even numbers differ by a per cent. Smaller plates are looked at whole, narrow strips over a greater
    // length.
    const auto is_free = [&](Side at) { return plate.edge(at).support == Edge::Support::free; };
    const bool all_free = is_free(Side::left) && is_free(Side::right) && is_free(Side::bottom) && is_free(Side::top);
    const auto along = [](int cells_along, int cells_aside, int less) {
      const int most = cells_aside < 4 ? 48 / (cells_aside + 1) : 8;
      return cells_along <= most ? cells_along : most - less;
    };
    for (const int less : {0, 1}) {
      const int nx = along(cells.x, cells.y, less), ny = along(cells.y, cells.x, less);
      largest = std::max(largest, block(s, plate, true, nx, ny));
      if (!all_free) largest = std::max(largest, block(s, plate, false, nx, ny));
      if (nx == cells.x && ny == cells.y) break;
    }
  }
  return 2 / std::sqrt(largest);
}

}  // namespace

double critical_time_step(const Plate& plate, const Cells& cells, const std::vector<double>& positions, Scheme scheme) {
  const double area = (plate.width / cells.x) * (plate.height / cells.y);
  return material::plate_time_step(plate, area, [&](const material::PlaneElastic& solid) {
    return limit_of(solid, plate, cells, positions, scheme);
  });
}

}  // namespace diptych::mpm
