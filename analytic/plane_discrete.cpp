#include "analytic/plane_discrete.hpp"

#include <gsl/gsl_eigen.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "analytic/plane_modes.hpp"

namespace diptych::analytic {
namespace {

using Method = PlaneDiscretisation::Method;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

void require_plane(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("plane discretisation: ") + message);
}

void check_plane(const PlaneDiscretisation& d) {
  require_plane(std::isfinite(d.hx) && d.hx > 0 && std::isfinite(d.hy) && d.hy > 0, "cell sizes must be > 0");
  if (d.method == Method::fem) return;
  require_plane(!d.positions.empty(), "a cell needs particles");
  require_plane(std::all_of(d.positions.begin(), d.positions.end(), [](double xi) { return xi >= 0 && xi <= 1; }),
                "positions must lie in [0, 1]");
}

// --- one cell --------------------------------------------------------------------------------------------------------

/// A place in a cell where a strain is taken: a triangle, or a particle.
struct LatticePlace {
  double x, y;      ///< from the cell's centre [m]
  double area;      ///< that it stands for [m²]
  VectorXd shape;   ///< of the cell's nodes; empty for a triangle
  Matrix2Xd slope;  ///< ∂/∂x and ∂/∂y of the nodes' shape functions
};

/// A cell by itself. Nodes: the corners counter-clockwise from the lower left one; with FEM the centre last. Degrees of
/// freedom: x and y of each node in turn.
struct Cell {
  std::vector<std::array<double, 2>> node;  ///< from the centre [m]
  std::vector<LatticePlace> place;
  VectorXd mass;  ///< lumped, per node [kg/m]
  MatrixXd consistent,
      stiffness;  ///< mass as the particles (lumped: the nodes) have it, per node; stiffness per degree of freedom
};

MatrixXd hooke(const PlaneMedium& medium) {
  MatrixXd c = MatrixXd::Zero(3, 3);
  c(0, 0) = c(1, 1) = medium.lambda + 2 * medium.mu;
  c(0, 1) = c(1, 0) = medium.lambda;
  c(2, 2) = medium.mu;
  return c;
}

/// Strains ε_xx, ε_yy, γ_xy of the nodes' displacements.
MatrixXd strain_matrix(const Matrix2Xd& slope) {
  MatrixXd b = MatrixXd::Zero(3, 2 * slope.cols());
  for (Eigen::Index j = 0; j < slope.cols(); ++j) {
    b(0, 2 * j) = b(2, 2 * j + 1) = slope(0, j);
    b(1, 2 * j + 1) = b(2, 2 * j) = slope(1, j);
  }
  return b;
}

void add_triangles(Cell& cell, double density) {
  cell.node.push_back({0, 0});
  cell.mass = VectorXd::Zero(5);
  for (const std::array<int, 3> corner : {std::array{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}) {
    const auto &a = cell.node[static_cast<std::size_t>(corner[0])], &b = cell.node[static_cast<std::size_t>(corner[1])],
               &c = cell.node[static_cast<std::size_t>(corner[2])];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    Matrix2Xd slope = Matrix2Xd::Zero(2, 5);
    slope.col(corner[0]) << (b[1] - c[1]) / twice, (c[0] - b[0]) / twice;
    slope.col(corner[1]) << (c[1] - a[1]) / twice, (a[0] - c[0]) / twice;
    slope.col(corner[2]) << (a[1] - b[1]) / twice, (b[0] - a[0]) / twice;
    for (const int j : corner) cell.mass(j) += density * twice / 6;
    cell.place.push_back({(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, twice / 2, {}, slope});
  }
  cell.consistent = cell.mass.asDiagonal();
}

void add_particles(Cell& cell, const PlaneDiscretisation& d, double density) {
  const auto& positions = d.positions;
  const double count = static_cast<double>(positions.size() * positions.size()), area = d.hx * d.hy / count;
  cell.mass = VectorXd::Zero(4);
  cell.consistent = MatrixXd::Zero(4, 4);
  for (const double zeta : positions) {
    for (const double xi : positions) {
      VectorXd shape(4);
      shape << (1 - xi) * (1 - zeta), xi * (1 - zeta), xi * zeta, (1 - xi) * zeta;  // eq. 7
      Matrix2Xd slope(2, 4);
      slope.row(0) << -(1 - zeta) / d.hx, (1 - zeta) / d.hx, zeta / d.hx, -zeta / d.hx;
      slope.row(1) << -(1 - xi) / d.hy, -xi / d.hy, xi / d.hy, (1 - xi) / d.hy;
      cell.mass += density * area * shape;
      cell.consistent += density * area * shape * shape.transpose();
      cell.place.push_back({(xi - 0.5) * d.hx, (zeta - 0.5) * d.hy, area, shape, slope});
    }
  }
}

Cell make_cell(const PlaneMedium& medium, const PlaneDiscretisation& d) {
  const double x = d.hx / 2, y = d.hy / 2;
  Cell cell;
  cell.node = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  if (d.method == Method::fem) {
    add_triangles(cell, medium.density);
  } else {
    add_particles(cell, d, medium.density);
  }
  const auto freedoms = static_cast<Eigen::Index>(2 * cell.node.size());
  cell.stiffness = MatrixXd::Zero(freedoms, freedoms);
  for (const auto& place : cell.place) {
    const MatrixXd b = strain_matrix(place.slope);
    cell.stiffness += place.area * b.transpose() * hooke(medium) * b;
  }
  return cell;
}

// --- the lattice: waves exp(i k·x), with a polarisation for each kind of node
// ------------------------------------------

/// A complex matrix in real numbers, [Re −Im; Im Re]: products are products, and each eigenvalue of a Hermitian one
/// stands there twice. Here the phases of a cell's nodes, and which kind of node each is: corners are all one kind,
/// FEM's centres another.
MatrixXd phases(const Cell& cell, double kx, double ky) {
  const auto nodes = static_cast<Eigen::Index>(cell.node.size()), kinds = nodes == 5 ? Eigen::Index{2} : 1;
  MatrixXd p = MatrixXd::Zero(2 * nodes, 2 * kinds);
  for (Eigen::Index j = 0; j < nodes; ++j) {
    const auto& [x, y] = cell.node[static_cast<std::size_t>(j)];
    const double phase = kx * x + ky * y;
    const Eigen::Index kind = j < 4 ? 0 : 1;
    p(j, kind) = p(nodes + j, kinds + kind) = std::cos(phase);
    p(nodes + j, kind) = std::sin(phase);
    p(j, kinds + kind) = -p(nodes + j, kind);
  }
  return p;
}

/// A matrix that acts on real and imaginary parts alike.
MatrixXd on_both_parts(const MatrixXd& m) {
  MatrixXd both = MatrixXd::Zero(2 * m.rows(), 2 * m.cols());
  both.topLeftCorner(m.rows(), m.cols()) = both.bottomRightCorner(m.rows(), m.cols()) = m;
  return both;
}

/// A matrix that acts on nodes, made to act on their x and y alike.
MatrixXd on_both_axes(const MatrixXd& nodes) {
  MatrixXd both = MatrixXd::Zero(2 * nodes.rows(), 2 * nodes.cols());
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    for (Eigen::Index j = 0; j < nodes.cols(); ++j) both(2 * i, 2 * j) = both(2 * i + 1, 2 * j + 1) = nodes(i, j);
  }
  return both;
}

/// M⁻¹K and what is left of an acceleration on its way to the particles and back, F = M⁻¹ Σ m N Nᵀ, both made Hermitian
/// by M^½ from the left and M^−½ from the right.
struct Operators {
  MatrixXd rate, filter;
  VectorXd root_mass;  ///< diagonal of M^½
};

Operators operators(const MatrixXd& stiffness, const MatrixXd& consistent, const VectorXd& mass) {
  VectorXd root(2 * mass.size());
  for (Eigen::Index i = 0; i < mass.size(); ++i) root(2 * i) = root(2 * i + 1) = std::sqrt(mass(i));
  const VectorXd inverse = root.cwiseInverse();
  return {inverse.asDiagonal() * stiffness * inverse.asDiagonal(),
          inverse.asDiagonal() * on_both_axes(consistent) * inverse.asDiagonal(), root};
}

/// In real numbers, as phases() are.
Operators lattice(const Cell& cell, double kx, double ky) {
  const MatrixXd p = phases(cell, kx, ky), both = on_both_axes(p);
  const MatrixXd stiffness = on_both_parts(cell.stiffness), consistent = on_both_parts(cell.consistent);
  VectorXd twice(2 * cell.mass.size());
  twice << cell.mass, cell.mass;
  return operators(both.transpose() * stiffness * both, p.transpose() * consistent * p,
                   p.cwiseAbs2().transpose() * twice);
}

/// nx × ny cells without supports.
Operators rectangle(const Cell& cell, int nx, int ny) {
  const int corners = (nx + 1) * (ny + 1), nodes = corners + (cell.node.size() == 5 ? nx * ny : 0);
  MatrixXd stiffness = MatrixXd::Zero(2 * nodes, 2 * nodes), consistent = MatrixXd::Zero(nodes, nodes);
  VectorXd mass = VectorXd::Zero(nodes);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int first = j * (nx + 1) + i;
      const std::array<int, 5> id{first, first + 1, first + nx + 2, first + nx + 1, corners + j * nx + i};
      const auto count = static_cast<int>(cell.node.size());
      for (int a = 0; a < count; ++a) {
        const int row = id[static_cast<std::size_t>(a)];
        mass(row) += cell.mass(a);
        for (int b = 0; b < count; ++b) {
          const int column = id[static_cast<std::size_t>(b)];
          consistent(row, column) += cell.consistent(a, b);
          stiffness.block<2, 2>(2 * row, 2 * column) += cell.stiffness.block<2, 2>(2 * a, 2 * b);
        }
      }
    }
  }
  return operators(stiffness, consistent, mass);
}

/// Eigenvalues of a symmetric matrix and, in columns, its eigenvectors.
struct Spectrum {
  VectorXd values;
  MatrixXd vectors;
};

Spectrum spectrum_of(MatrixXd a) {
  const Eigen::Index n = a.rows();
  const auto size = static_cast<std::size_t>(n);
  Spectrum found{VectorXd(n), MatrixXd(n, n)};
  gsl_matrix_view matrix = gsl_matrix_view_array(a.data(), size, size);
  gsl_matrix_view vectors = gsl_matrix_view_array(found.vectors.data(), size, size);
  gsl_vector_view values = gsl_vector_view_array(found.values.data(), size);
  const std::unique_ptr<gsl_eigen_symmv_workspace, void (*)(gsl_eigen_symmv_workspace*)> space(
      gsl_eigen_symmv_alloc(size), gsl_eigen_symmv_free);
  gsl_eigen_symmv(&matrix.matrix, &values.vector, &vectors.matrix, space.get());
  found.vectors.transposeInPlace();  // GSL stores rows one after the other
  return found;
}

/// Largest Δt, from the largest eigenvalue of F A (A = M⁻¹K), of which leapfrog bears (ωΔt)² = 4. USL: with w the
/// strain's displacement and V the velocity, w′ = w + Δt V − Δt² A w, V′ = V − Δt F A w, so (z−1)² w = −Δt² F A w −
/// (z−1) Δt² A w. Waves leave the unit circle at z = −1, where 4 w = Δt² (2 − F) A w.
double limit(const Operators& o, Method method) {
  const Spectrum rates = spectrum_of(o.rate);
  const MatrixXd root = rates.vectors * rates.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  MatrixXd middle = o.filter;
  if (method == Method::usl) middle = 2 * MatrixXd::Identity(root.rows(), root.cols()) - o.filter;
  const double largest = spectrum_of(root.transpose() * middle * root).values.maxCoeff();
  return largest > 0 ? 2 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

// --- a standing mode, step by step ----------------------------------------------------------------------------------

/// What becomes of the wave exp(ik·x): strained, the displacement whose gradient the strain is; gained, the velocity
/// that the particles have taken from the grid; moved, the displacement that they have taken. Each has x and y of every
/// kind of node.
struct Course {
  VectorXd strained, gained, moved;
};

/// Steps are matrices here, and many of them a power of one.
class March {
 public:
  /// rate: M⁻¹K; filter: F. strained, velocity: at the start, as nodes have them.
  March(const MatrixXd& rate, const MatrixXd& filter, const PlaneDiscretisation& d, const VectorXd& strained,
        const VectorXd& velocity)
      : method_(d.method), dt_(d.time_step), n_(strained.size()), start_(VectorXd::Zero(3 * n_ + 1)) {
    // over the state (strained, Δt gained, moved, 1)
    velocity_ = MatrixXd::Zero(n_, 3 * n_ + 1);  // times Δt, mapped from the particles
    velocity_.middleCols(n_, n_) = filter;
    velocity_.rightCols(1) = dt_ * velocity;
    acceleration_ = MatrixXd::Zero(n_, 3 * n_ + 1);  // times Δt²
    acceleration_.leftCols(n_) = -dt_ * dt_ * rate;
    start_.head(n_) = strained;
    start_(3 * n_) = 1;
  }

  Course after(long steps) const {
    VectorXd state = start_;
    if (method_ == Method::usf) {  // to its half step
      const VectorXd half = velocity_ * state / 2;
      state.head(n_) += half;
      state.segment(2 * n_, n_) += half;
    }
    if (steps > 0) state = ((method_ == Method::usf ? kick(1) : step(0.5)) * state).eval();  // the first is another
    long left = steps - 1;
    for (MatrixXd power = step(1); left > 0; left /= 2, power = (power * power).eval()) {
      if (left % 2 == 1) state = (power * state).eval();
    }
    return {state.head(n_), state.segment(n_, n_) / dt_, state.segment(2 * n_, n_)};
  }

 private:
  /// Particles take the grid's acceleration over a part of Δt, and move with its velocities over all of it.
  MatrixXd kick(double part) const {
    MatrixXd m = MatrixXd::Identity(3 * n_ + 1, 3 * n_ + 1);
    m.middleRows(n_, n_) += part * acceleration_;
    m.middleRows(2 * n_, n_) += velocity_ + part * acceleration_;
    return m;
  }

  MatrixXd step(double part) const {
    MatrixXd strain = MatrixXd::Identity(3 * n_ + 1, 3 * n_ + 1);
    strain.topRows(n_) += velocity_;
    if (method_ == Method::usf) return kick(part) * strain;
    if (method_ != Method::usl) return strain * kick(part);
    MatrixXd m = kick(part);  // strains are of the grid's own velocities, with all of the acceleration
    m.topRows(n_) += velocity_ + part * acceleration_;
    return m;
  }

  Method method_;
  double dt_;
  Eigen::Index n_;
  MatrixXd velocity_, acceleration_;
  VectorXd start_;
};

/// Adds up a norm; NaN anywhere makes it NaN.
class ErrorNorm {
 public:
  explicit ErrorNorm(int p) : p_(p) {}
  void add(double weight, const std::array<double, 3>& numerical, const std::array<double, 3>& exact) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c)
      square += (c == 2 ? 2 : 1) * (numerical[c] - exact[c]) * (numerical[c] - exact[c]);
    const double error = std::sqrt(square);
    weight_ += weight;
    if (p_ == 0) {
      if (!std::isnan(sum_) && !(error <= sum_)) sum_ = error;
    } else {
      sum_ += weight * (p_ == 1 ? error : square);
    }
  }
  double value() const { return p_ == 0 ? sum_ : p_ == 1 ? sum_ / weight_ : std::sqrt(sum_ / weight_); }

 private:
  int p_;
  double sum_ = 0, weight_ = 0;
};

/// Whole steps taken when a quantity stands at time t.
long steps_at(const PlaneDiscretisation& d, PlaneQuantity quantity, double t) {
  if (quantity == PlaneQuantity::velocity && t == 0) return 0;
  double ahead = 0;  // of the steps, in steps
  if (quantity == PlaneQuantity::velocity && d.method != Method::usf) ahead = -0.5;
  if (quantity == PlaneQuantity::stress && d.method == Method::usf) ahead = -0.5;
  if (quantity == PlaneQuantity::displacement && d.method == Method::usf) ahead = 0.5;
  const double steps = t / d.time_step - ahead, whole = std::round(steps);
  require_plane(std::abs(steps - whole) <= 1e-6 && whole >= (ahead < 0 ? 1 : 0) && whole < 1e9,
                "the quantity has no value at this time");
  return static_cast<long>(whole);
}

/// Cells along a side, 0 where they are not a whole number.
int cells_along(double side, double h) {
  const double cells = std::round(side / h);
  return cells >= 1 && cells < 1e5 && std::abs(cells * h - side) <= 1e-9 * side ? static_cast<int>(cells) : 0;
}

bool symmetric(std::vector<double> positions) {
  std::sort(positions.begin(), positions.end());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (std::abs(positions[i] + positions[positions.size() - 1 - i] - 1) > 1e-12) return false;
  }
  return true;
}

/// The wave exp(ik·x) of which, with its mirror images, a mode consists, and the form it takes in the rectangle.
class Standing {
 public:
  explicit Standing(const PlaneWave& wave) : wave_(wave) {}
  /// A sine is (e^iφ − e^−iφ)/2i, a cosine (e^iφ + e^−iφ)/2: where u_x has two sines u_y has two cosines, and their
  /// signs differ.
  double sign() const { return wave_.rollers[0] == wave_.rollers[1] ? 1 : -1; }
  /// x and y of every kind of node.
  VectorXd polarisation(Eigen::Index kinds, double factor) const {
    VectorXd q(2 * kinds);
    for (Eigen::Index i = 0; i < kinds; ++i) {
      q(2 * i) = factor * sign() * wave_.amplitude[0];
      q(2 * i + 1) = factor * wave_.amplitude[1];
    }
    return q;
  }
  std::array<double, 2> at(const VectorXd& q, Eigen::Index kind, double x, double y) const {
    const double px = wave_.wave_number[0] * x, py = wave_.wave_number[1] * y;
    const auto [rx, ry] = wave_.rollers;
    return {sign() * q(2 * kind) * (rx ? std::sin(px) : std::cos(px)) * (ry ? std::cos(py) : std::sin(py)),
            q(2 * kind + 1) * (rx ? std::cos(px) : std::sin(px)) * (ry ? std::sin(py) : std::cos(py))};
  }

 private:
  PlaneWave wave_;
};

}  // namespace

std::optional<double> predicted_error(const PlaneSolution& solution, const PlaneDiscretisation& d,
                                      PlaneQuantity quantity, int norm, double t) {
  check_plane(d);
  require_plane(std::isfinite(d.time_step) && d.time_step > 0, "time step must be > 0");
  require_plane(norm >= 0 && norm <= 2, "norms are 1, 2 and 0 for the largest");
  const auto* mode = dynamic_cast<const PlaneMode*>(&solution);
  if (!mode || !mode->gives(quantity) || dynamic_cast<const StandingSWave*>(mode)) return std::nullopt;
  if (d.method != Method::fem && !symmetric(d.positions)) return std::nullopt;
  const int nx = cells_along(mode->width(), d.hx), ny = cells_along(mode->height(), d.hy);
  const auto [kx, ky] = mode->wave().wave_number;
  if (nx == 0 || ny == 0 || kx * d.hx >= pi * (1 - 1e-9) || ky * d.hy >= pi * (1 - 1e-9)) return std::nullopt;
  const long steps = steps_at(d, quantity, t);

  const Cell cell = make_cell(mode->medium(), d);
  const Operators o = lattice(cell, kx, ky);
  // Cells are their own image turned by half a turn, so that nothing here is complex: the real part is all.
  const Eigen::Index real = o.rate.rows() / 2, kinds = real / 2;
  const VectorXd root = o.root_mass.head(real), inverse = root.cwiseInverse();
  const MatrixXd rate = inverse.asDiagonal() * o.rate.topLeftCorner(real, real) * root.asDiagonal();
  const MatrixXd filter = inverse.asDiagonal() * o.filter.topLeftCorner(real, real) * root.asDiagonal();
  const Standing wave(mode->wave());
  const VectorXd zero = VectorXd::Zero(2 * kinds);
  const bool rest = mode->wave().from_rest;
  VectorXd velocity = rest ? zero : wave.polarisation(kinds, mode->wave().frequency);
  if (d.method != Method::fem) {  // what nodes are mapped of particles that have the wave's own values
    double mapped = 0;
    for (const auto& place : cell.place) {
      for (std::size_t j = 0; j < cell.node.size(); ++j)
        mapped += place.area / (d.hx * d.hy) * place.shape(static_cast<Eigen::Index>(j)) *
                  std::cos(kx * (place.x - cell.node[j][0]) + ky * (place.y - cell.node[j][1]));
    }
    velocity *= mapped;
  }
  const Course course = March(rate, filter, d, rest ? wave.polarisation(kinds, 1) : zero, velocity).after(steps);

  const VectorXd& q = quantity == PlaneQuantity::stress         ? course.strained
                      : quantity == PlaneQuantity::displacement ? course.moved
                                                                : course.gained;
  const MatrixXd moduli = hooke(mode->medium());
  ErrorNorm error(norm);
  MatrixXd value(2, static_cast<Eigen::Index>(cell.node.size()));
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const double x = (i + 0.5) * d.hx, y = (j + 0.5) * d.hy;
      for (std::size_t n = 0; n < cell.node.size(); ++n) {
        const auto [ux, uy] = wave.at(q, n < 4 ? 0 : 1, x + cell.node[n][0], y + cell.node[n][1]);
        value.col(static_cast<Eigen::Index>(n)) << ux, uy;
      }
      const auto note = [&](double weight, double px, double py, const auto& numerical, bool change) {
        std::array<double, 3> all{}, exact = mode->at(quantity, px, py, t);
        for (std::size_t c = 0; c < components(quantity); ++c) all[c] = numerical(static_cast<Eigen::Index>(c));
        if (change) {
          const auto start = mode->at(quantity, px, py, 0);
          for (std::size_t c = 0; c < 3; ++c) all[c] += start[c];
        }
        error.add(weight, all, exact);
      };
      if (quantity == PlaneQuantity::stress) {
        for (const auto& place : cell.place) {
          const VectorXd strain = strain_matrix(place.slope) * value.reshaped();
          note(place.area, x + place.x, y + place.y, (moduli * strain).eval(), false);
        }
      } else if (d.method == Method::fem) {
        for (std::size_t n = 0; n < cell.node.size(); ++n) {
          const auto index = static_cast<Eigen::Index>(n);
          note(cell.mass(index), x + cell.node[n][0], y + cell.node[n][1], value.col(index).eval(), true);
        }
      } else {
        for (const auto& place : cell.place)
          note(place.area, x + place.x, y + place.y, (value * place.shape).eval(), true);
      }
    }
  }
  return error.value();
}

double interior_stability_limit(const PlaneMedium& medium, const PlaneDiscretisation& d) {
  check_plane(d);
  const Cell cell = make_cell(medium, d);
  const auto at = [&](double x, double y) { return limit(lattice(cell, pi * x / d.hx, pi * y / d.hy), d.method); };
  // 0 ≤ k_x h_x ≤ π and −π ≤ k_y h_y ≤ π have every wave; from the least found on, closer and closer around it
  double best_x = 0.5, best_y = 0, reach_x = 0.5, reach_y = 1, least = std::numeric_limits<double>::infinity();
  for (int half = 12; reach_y > 1e-7; half = 4) {
    const double middle_x = best_x, middle_y = best_y;
    for (int i = -half; i <= half; ++i) {
      for (int j = -half; j <= half; ++j) {
        const double x = std::clamp(middle_x + reach_x * i / half, 0.0, 1.0);
        const double y = std::clamp(middle_y + reach_y * j / half, -1.0, 1.0);
        const double here = at(x, y);
        if (here < least) {
          least = here;
          best_x = x;
          best_y = y;
        }
      }
    }
    reach_x /= 3;
    reach_y /= 3;
  }
  return least;
}

double free_stability_limit(const PlaneMedium& medium, const PlaneDiscretisation& d, int nx, int ny) {
  check_plane(d);
  require_plane(nx >= 1 && ny >= 1 && nx * ny <= 400, "a free rectangle has 1 to 400 cells");
  if (d.method != Method::fem) {  // the nodes beside an empty half of the outermost cells would have no mass
    const auto [least, most] = std::minmax_element(d.positions.begin(), d.positions.end());
    require_plane(*most > 0 && *least < 1, "particles must not all lie at one end of their cells");
  }
  return limit(rectangle(make_cell(medium, d), nx, ny), d.method);
}

double plane_stability_limit(const PlaneMedium& medium, const PlaneDiscretisation& d) {
  return std::min(free_stability_limit(medium, d, 6, 6), interior_stability_limit(medium, d));
}

}  // namespace diptych::analytic
