// The largest stable step of a plate. With S the particles' shape functions, M = Sᵀ m 1 the lumped mass, W = M⁻¹ Sᵀ m S
// what mapping leaves of a grid velocity and A = M⁻¹ K the cells' own operator, one step of a linear plate is
//   USF, MUSL:  V' = F V − Δt W A q,   q' = q + Δt V'
//   USL:        V' = F V − Δt W A q,   q' = q + Δt (V − Δt A q)
// with F = 1 − part of PIC · (1 − W). Both leave the unit circle at −1, where (1 + F) q = (x/2) W A q, and with USL
// (1 + F) q = (x/2)(1 + F − W) A q, x = Δt². So Δt = 2/√λ with λ the largest eigenvalue of φ(W) A, and φ(w) = 2w/(1 +
// f), with USL 2(1 + f − w)/(1 + f). Without PIC f = 1: φ = w and 2 − w. For USF and MUSL and for USL without PIC the
// condition is sufficient too: the quadratic form of any eigenvector is a real quadratic with its roots in the circle.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "material/viscous_step.hpp"
#include "mpm/plate.hpp"

namespace diptych::mpm {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double edge = 0.5 - 0x1p-54;  // as the particles are placed

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

/// λ of a block of cells with these supports. Its matrices are made symmetric by √M.
double block(const Setting& s, const Plate& plate, bool free, int nx, int ny) {
  const std::size_t n = s.near.size();
  const Eigen::Index row = nx + 1, nodes = row * (ny + 1), size = 2 * nodes;
  const double volume = s.hx * s.hy / static_cast<double>(n * n), mass = volume * s.density;
  Eigen::VectorXd M = Eigen::VectorXd::Zero(nodes);
  Matrix W = Matrix::Zero(nodes, nodes), K = Matrix::Zero(size, size);
  Matrix C(3, 3);
  C << s.stiffness.normal, s.stiffness.cross, 0, s.stiffness.cross, s.stiffness.normal, 0, 0, 0, s.stiffness.shear;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Eigen::Index first = j * row + i;
      const std::array<Eigen::Index, 4> node{first, first + 1, first + row, first + row + 1};
      for (std::size_t p = 0; p < n * n; ++p) {
        const double l = s.near[p % n], r = s.far[p % n], b = s.near[p / n], t = s.far[p / n];
        const std::array<double, 4> N{l * b, r * b, l * t, r * t};
        const std::array<double, 4> dx{-b / s.hx, b / s.hx, -t / s.hx, t / s.hx};
        const std::array<double, 4> dy{-l / s.hy, -r / s.hy, l / s.hy, r / s.hy};
        Matrix B = Matrix::Zero(3, 8);
        for (std::size_t k = 0; k < 4; ++k) {
          const auto c = static_cast<Eigen::Index>(2 * k);
          B(0, c) = B(2, c + 1) = dx[k];
          B(1, c + 1) = B(2, c) = dy[k];
          M(node[k]) += mass * N[k];
          for (std::size_t q = 0; q < 4; ++q) W(node[k], node[q]) += mass * N[k] * N[q];
        }
        const Matrix cell = volume * (B.transpose() * C * B);
        for (Eigen::Index k = 0; k < 8; ++k) {
          for (Eigen::Index q = 0; q < 8; ++q)
            K(2 * node[static_cast<std::size_t>(k / 2)] + k % 2, 2 * node[static_cast<std::size_t>(q / 2)] + q % 2) +=
                cell(k, q);
        }
      }
    }
  }
  // The columns of Q span what the supports leave free, each of unit length once √M has been taken out.
  std::vector<Eigen::VectorXd> columns;
  const auto held = [&](Eigen::Index i, Eigen::Index j, int c) {
    const auto by = [&](Side side, bool there) {
      if (!there || free) return false;
      const auto support = plate.edge(side).support;
      const int normal = side == Side::left || side == Side::right ? 0 : 1;
      return support == Edge::Support::fixed || support == Edge::Support::driven ||
             (support == Edge::Support::roller && c == normal);
    };
    return by(Side::left, i == 0) || by(Side::right, i == nx) || by(Side::bottom, j == 0) || by(Side::top, j == ny);
  };
  const auto platen_of = [&](Eigen::Index i, Eigen::Index j, int c) {
    const auto by = [&](Side side, bool there) {
      return there && !free && plate.edge(side).support == Edge::Support::platen &&
             c == (side == Side::left || side == Side::right ? 0 : 1);
    };
    return by(Side::left, i == 0)     ? 0
           : by(Side::right, i == nx) ? 1
           : by(Side::bottom, j == 0) ? 2
           : by(Side::top, j == ny)   ? 3
                                      : -1;
  };
  std::array<Eigen::VectorXd, 4> platen;
  platen.fill(Eigen::VectorXd::Zero(size));
  for (Eigen::Index j = 0; j <= ny; ++j) {
    for (Eigen::Index i = 0; i <= nx; ++i) {
      for (int c = 0; c < 2; ++c) {
        const Eigen::Index dof = 2 * (j * row + i) + c;
        if (held(i, j, c)) continue;
        if (const int side = platen_of(i, j, c); side >= 0) {
          platen[static_cast<std::size_t>(side)](dof) = std::sqrt(M(dof / 2));
        } else {
          columns.push_back(Eigen::VectorXd::Unit(size, dof));
        }
      }
    }
  }
  for (const auto& side : platen) {
    if (side.norm() > 0) columns.push_back(side.normalized());
  }
  if (columns.empty()) return 0;
  Matrix Q(size, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) Q.col(static_cast<Eigen::Index>(k)) = columns[k];
  Matrix both = Matrix::Zero(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    for (Eigen::Index q = 0; q < size; ++q) {
      const double root = std::sqrt(M(k / 2) * M(q / 2));
      K(k, q) /= root;
      if (k % 2 == q % 2) both(k, q) = W(k / 2, q / 2) / root;
    }
  }
  const Matrix w = Q.transpose() * both * Q, A = Q.transpose() * K * Q;
  const Matrix one = Matrix::Identity(w.rows(), w.cols()), F = one - s.pic * (one - w);
  const Matrix inverse = (one + F).inverse(),
               phi = s.scheme == Scheme::usl ? Matrix(2 * inverse * (one + F - w)) : Matrix(2 * inverse * w);
  return Eigen::EigenSolver<Matrix>(phi * A, false).eigenvalues().real().maxCoeff();
}

/// Of a plate of this solid without viscosity.
double limit_of(const material::PlaneElastic& solid, const Plate& plate, const Cells& cells,
                const std::vector<double>& positions, Scheme scheme) {
  Setting s{solid.stiffness(), solid.density, plate.width / cells.x, plate.height / cells.y, scheme, plate.pic, {}, {}};
  for (const double xi : positions) {
    const double offset = std::clamp(xi - 0.5, -edge, edge);
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
