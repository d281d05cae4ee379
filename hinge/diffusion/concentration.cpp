#include "hinge/diffusion/concentration.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "hinge/diffusion/cholesky.hpp"
#include "hinge/diffusion/node_field.hpp"
#include "hinge/diffusion/sub_cycles.hpp"
#include "hinge/wide.hpp"

namespace diptych::diffusion {
namespace {

constexpr std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// r⁻¹ over the rectangle from the origin to (x, y): ∫∫ dA/r = x asinh(y/x) + y asinh(x/y).
double inverse_radius_integral(double x, double y) {
  return x > 0 && y > 0 ? x * std::asinh(y / x) + y * std::asinh(x / y) : 0;
}

std::string with_numbers(std::initializer_list<std::string> words, std::initializer_list<double> numbers) {
  std::ostringstream message;
  message.precision(10);
  auto number = numbers.begin();
  for (const std::string& word : words) {
    message << word;
    if (number != numbers.end()) message << *number++;
  }
  return message.str();
}

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("concentration: ") + message);
}

}  // namespace

double forward_euler_limit(const Grid& grid, double largest_diffusivity) {
  return 1 / (2 * largest_diffusivity * (1 / (grid.hx * grid.hx) + 1 / (grid.hy * grid.hy)));
}

/// Finite volumes around the nodes. The face between a node and its right (upper) neighbour conducts
/// east[k] (north[k]) = ∫ w d over the face / distance; past the last column and row nothing, which is the wall.
struct Concentration::Parts {
  Grid grid;
  Scheme scheme;
  Reading reading;
  double drift;
  std::size_t row, pitch;  // of the faces and `scale`

  NodeField c, east, north, scale;         // scale: dt / volume
  std::vector<double> volume;              // ∫ w dA over the control volume
  std::vector<double> diffusivity;         // of each cell, that the faces have
  double largest = 0;                      // of it
  double unit_row_sum = 0;                 // largest Σ faces / volume for d = 1 [1/m²]
  std::vector<double> weight_x, weight_y;  // w at the middle of each half-face, below/above or left/right of it; radial
  double scaled_for = -1;
  std::vector<std::size_t> fed_nodes;  // whose source is not zero in this step
  std::vector<std::size_t> held;       // keep their values; in order
  double fed = 0, drawn = 0;           // by the source; from the held nodes
  long node_updates = 0, factorisations = 0;

  std::optional<SubCycles> cycles;
  NodeField next, before;  // forward Euler: next; RKL2: two stages back and the first one's increment
  std::vector<double> first;

  std::optional<Cholesky> cholesky;  // of volume + θ dt K
  std::vector<double> factorised, right, ground;
  double factorised_dt = -1;
  std::size_t ground_node = 0;
  std::vector<std::pair<std::size_t, double>> ties;  // of a node to a held one: θ dt times the face, as factorised
  std::vector<std::size_t> loose;  // nodes that faces join to others but not to a held one, as factorised; in order

  Parts(const Grid& g, Scheme s, Reading r, double dr)
      : grid(g), scheme(s), reading(r), drift(dr), row(static_cast<std::size_t>(g.nx) + 1), pitch(row) {
    require(g.nx >= 1 && g.ny >= 1, "the grid must have a cell at least each way");
    require(g.hx > 0 && g.hy > 0 && std::isfinite(g.hx) && std::isfinite(g.hy), "the cells' sides must be > 0");
    require(dr >= 0, "drift must be >= 0");
    require(dr == 0 || s != Scheme::crank_nicolson,
            "crank-nicolson does not damp what a stale factor gets wrong: drift must be 0");
    if (scheme == Scheme::sub_cycled) {
      cycles.emplace(g);
      pitch = NodeField::of_whole_lines(g);
    }
    c = NodeField(g);
    east = north = scale = NodeField(g, pitch);
    if (!implicit() && !cycles) next = NodeField(g);
    if (scheme == Scheme::rkl2) {
      before = NodeField(g);
      first.resize(g.nodes());
    }
    diffusivity.assign(g.cells(), 0);
    find_volumes();
    if (reading == Reading::radial) find_weights();
    find_unit_row_sum();
    if (implicit()) analyse();
  }

  bool implicit() const { return scheme == Scheme::backward_euler || scheme == Scheme::crank_nicolson; }
  double theta() const { return scheme == Scheme::backward_euler ? 1 : 0.5; }
  std::size_t columns() const { return static_cast<std::size_t>(grid.nx); }
  std::size_t rows() const { return static_cast<std::size_t>(grid.ny); }

  void find_volumes() {
    volume.resize(grid.nodes());
    for (std::size_t j = 0; j <= rows(); ++j) {
      for (std::size_t i = 0; i <= columns(); ++i) {
        const double halves_x = (i > 0) + (i < columns()), halves_y = (j > 0) + (j < rows());
        double& v = volume[j * row + i];
        v = halves_x * halves_y * (grid.hx * grid.hy / 4);
        if (reading == Reading::isotropic) continue;
        const auto x = [&](double at) { return std::clamp(at, 0.0, static_cast<double>(columns())) * grid.hx; };
        const auto y = [&](double at) { return std::clamp(at, 0.0, static_cast<double>(rows())) * grid.hy; };
        const auto di = static_cast<double>(i), dj = static_cast<double>(j);
        const double x0 = x(di - 0.5), x1 = x(di + 0.5), y0 = y(dj - 0.5), y1 = y(dj + 0.5);
        v = inverse_radius_integral(x1, y1) + inverse_radius_integral(x0, y0) -
            (inverse_radius_integral(x0, y1) + inverse_radius_integral(x1, y0));
      }
    }
  }

  /// Two for each face: of its half in the cell below and above (east), left and right (north).
  void find_weights() {
    weight_x.assign(2 * grid.nodes(), 0);
    weight_y.assign(2 * grid.nodes(), 0);
    for (std::size_t j = 0; j <= rows(); ++j) {
      for (std::size_t i = 0; i <= columns(); ++i) {
        const auto di = static_cast<double>(i), dj = static_cast<double>(j);
        for (std::size_t side = 0; side < 2; ++side) {
          const double off = side == 0 ? -0.25 : 0.25;
          weight_x[2 * (j * row + i) + side] = 1 / std::hypot((di + 0.5) * grid.hx, (dj + off) * grid.hy);
          weight_y[2 * (j * row + i) + side] = 1 / std::hypot((di + off) * grid.hx, (dj + 0.5) * grid.hy);
        }
      }
    }
  }

  /// Faces from the cells' diffusivities, eq. 25 averaged over each face.
  template <bool weighted>
  void find_faces(const double* d) {
    const std::size_t n = columns();
    const double across = grid.hy / (2 * grid.hx), up = grid.hx / (2 * grid.hy);
    for (std::size_t j = 0; j <= rows(); ++j) {
      const double* below = j > 0 ? d + (j - 1) * n : nullptr;
      const double* above = j < rows() ? d + j * n : nullptr;
      double* e = east.data() + j * pitch;
      if constexpr (weighted) {
        const double* w = weight_x.data() + 2 * j * row;
        for (std::size_t i = 0; i < n; ++i)
          e[i] = across * ((below ? below[i] * w[2 * i] : 0) + (above ? above[i] * w[2 * i + 1] : 0));
      } else if (below && above) {
        for (std::size_t i = 0; i < n; ++i) e[i] = across * (below[i] + above[i]);
      } else {
        const double* only = below ? below : above;
        for (std::size_t i = 0; i < n; ++i) e[i] = across * only[i];
      }
      if (!above) continue;
      double* f = north.data() + j * pitch;
      if constexpr (weighted) {
        const double* w = weight_y.data() + 2 * j * row;
        for (std::size_t i = 0; i <= n; ++i)
          f[i] = up * ((i > 0 ? above[i - 1] * w[2 * i] : 0) + (i < n ? above[i] * w[2 * i + 1] : 0));
      } else {
        f[0] = up * above[0];
        for (std::size_t i = 1; i < n; ++i) f[i] = up * (above[i - 1] + above[i]);
        f[n] = up * above[n - 1];
      }
    }
  }
  void find_faces(const double* d) { reading == Reading::radial ? find_faces<true>(d) : find_faces<false>(d); }

  /// Where the faces of a node stand.
  std::size_t place(std::size_t k) const { return pitch == row ? k : k / row * pitch + k % row; }

  /// Σ of the four faces of a node.
  double conductance(std::size_t k) const {
    const double *e = east.data() + place(k), *n = north.data() + place(k);
    return (e[0] + e[-1]) + (n[0] + n[-static_cast<std::ptrdiff_t>(pitch)]);
  }

  void find_unit_row_sum() {
    if (reading == Reading::isotropic) {
      unit_row_sum = 1 / forward_euler_limit(grid, 1);
      return;
    }
    find_faces(std::vector<double>(grid.cells(), 1).data());
    for (std::size_t k = 0; k < volume.size(); ++k) unit_row_sum = std::max(unit_row_sum, conductance(k) / volume[k]);
    east.fill(0);
    north.fill(0);
  }

  double limit() const { return 1 / (largest * unit_row_sum); }

  bool is_held(std::size_t k) const { return std::ranges::binary_search(held, k); }

  void hold(std::vector<std::size_t> nodes) {
    require(std::ranges::all_of(nodes, [&](std::size_t k) { return k < volume.size(); }),
            "a node to be held is not in the grid");
    std::ranges::sort(nodes);
    nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
    held = std::move(nodes);
    scaled_for = factorised_dt = -1;
  }

  /// The next node (right, left, above, below) and the face to it; a face of no conductance where there is none.
  std::array<std::pair<std::size_t, double>, 4> neighbours(std::size_t k) const {
    const double *e = east.data() + place(k), *n = north.data() + place(k);
    return {{{k + 1, e[0]}, {k - 1, e[-1]}, {k + row, n[0]}, {k - row, n[-static_cast<std::ptrdiff_t>(pitch)]}}};
  }

  /// What flows into the held nodes per unit time. u: of a field that stands as the faces do.
  double into_held(const double* u) const {
    double sum = 0;
    for (const std::size_t k : held) {
      for (const auto& [other, face] : neighbours(k)) {
        if (face > 0 && !is_held(other)) sum += face * (u[place(other)] - u[place(k)]);
      }
    }
    return sum;
  }

  void take(std::span<const double> d) {
    if (std::ranges::equal(d, diffusivity)) return;
    constexpr double greatest = std::numeric_limits<double>::max();
    std::uint64_t doubtful = 0;  // its top bit: of one that is negative, infinite or not a number
    for (const double value : d) doubtful |= bits(value) | (bits(greatest) - bits(value));
    bool finite = true;
    if (doubtful >> 63 != 0) {
      require(std::ranges::none_of(d, [](double value) { return value < 0; }), "a diffusivity is negative");
      finite = std::ranges::all_of(d, [](double value) { return value <= greatest; });
    }
    std::array<double, 4> top{};  // side by side: one maximum alone waits for itself
    const auto raise = [](double& to, double value) { to = value > to ? value : to; };
    std::size_t i = 0;
    for (; i + 4 <= d.size(); i += 4) {
      for (std::size_t k = 0; k < 4; ++k) raise(top[k], d[i + k]);
    }
    for (; i < d.size(); ++i) raise(top[0], d[i]);
    largest = finite ? std::ranges::max(top) : std::numeric_limits<double>::quiet_NaN();
    std::ranges::copy(d, diffusivity.begin());
    find_faces(diffusivity.data());
  }

  void note_source(std::span<const double> source, double dt) {
    fed_nodes.clear();
    double rate = 0;
    for (std::size_t begin = 0; begin < source.size(); begin += 8) {  // eight at a time: most are zero
      const std::size_t end = std::min(begin + 8, source.size());
      std::uint64_t any = 0;
      for (std::size_t k = begin; k < end; ++k) any |= bits(source[k]);
      if (any == 0) continue;
      for (std::size_t k = begin; k < end; ++k) {
        if (source[k] == 0) continue;
        fed_nodes.push_back(k);
        rate += volume[k] * source[k];
      }
    }
    if (!held.empty() && !fed_nodes.empty()) {
      std::erase_if(fed_nodes, [&](std::size_t k) { return is_held(k); });
      rate = 0;
      for (const std::size_t k : fed_nodes) rate += volume[k] * source[k];
    }
    fed += dt * rate;
  }

  void set_scale(double dt) {
    if (dt == scaled_for) return;
    for (std::size_t k = 0; k < volume.size(); ++k) scale.data()[place(k)] = dt / volume[k];
    for (const std::size_t k : held) scale.data()[place(k)] = 0;
    scaled_for = dt;
  }

  /// combine(k, what flows into node k's volume per unit time) for all nodes, where the faces' rows are one after the
  /// other.
  template <class Combine>
  void sweep(const double* u, Combine combine) const {
    for_inflows(static_cast<std::ptrdiff_t>(volume.size()), static_cast<std::ptrdiff_t>(row), east.data(), north.data(),
                u, combine);
  }

  void euler(std::span<const double> source, double dt) {
    set_scale(dt);
    const double* u = c.data();
    double* out = next.data();
    const auto up = static_cast<std::ptrdiff_t>(row), nodes = static_cast<std::ptrdiff_t>(volume.size());
    diffusion::euler({up, east.data(), north.data(), scale.data()}, nodes, u, out);
    for (const std::size_t k : fed_nodes) out[k] += dt * source[k];
    drawn -= dt * into_held(u);
    std::swap(c, next);
    node_updates += static_cast<long>(volume.size());
  }

  void sub_cycle(std::span<const double> source, double dt, long parts) {
    const double part = dt / static_cast<double>(parts);
    set_scale(part);
    cycles->feed(fed_nodes, source);
    cycles->values().take(c);
    if (held.empty()) {
      cycles->take(parts, east, north, scale, part);
    } else {
      for (long i = 0; i < parts; ++i) {
        drawn -= part * into_held(cycles->values().data());
        cycles->take(1, east, north, scale, part);
      }
    }
    c.take(cycles->values());
    node_updates += parts * static_cast<long>(volume.size());
  }

  /// Meyer, Balsara & Aslam, J. Comput. Phys. 257:594 (2014), eqs. 14–18, for the increment y = Y − C: a uniform C then
  /// stays so to the bit, and mass is lost only to the increment's round-off. What flows into the held nodes obeys the
  /// same recursion.
  void rkl2(std::span<const double> source, double dt) {
    const double parts = dt / (limit() * (1 + 1e-12));
    long stages = std::max(3L, static_cast<long>(std::ceil((std::sqrt(9 + 16 * parts) - 1) / 2)));
    stages += stages % 2 == 0;
    const auto s = static_cast<double>(stages);
    const double w = 4 / (s * s + s - 2);
    const auto b = [](double j) { return j < 2 ? 1.0 / 3 : (j * j + j - 2) / (2 * j * (j + 1)); };
    set_scale(dt);
    const double* __restrict a = scale.data();
    double* __restrict m = first.data();
    double *y = next.data(), *z = before.data();
    sweep(c.data(), [=](std::ptrdiff_t k, double inflow) DIPTYCH_INLINE { m[k] = a[k] * inflow; });
    for (const std::size_t k : fed_nodes) m[k] += dt * source[k];
    const double into = dt * into_held(c.data());
    double flown = b(1) * w * into, flown_before = 0;
    for (std::size_t k = 0; k < first.size(); ++k) {
      y[k] = b(1) * w * m[k];
      z[k] = 0;
    }
    for (long stage = 2; stage <= stages; ++stage) {
      const auto j = static_cast<double>(stage);
      const double mu = (2 * j - 1) / j * b(j) / b(j - 1), nu = -(j - 1) / j * b(j) / b(j - 2);
      const double mu_w = mu * w, constant = mu_w * b(j - 1);  // μ̃ + γ̃ with γ̃ = −(1 − b_{j−1}) μ̃
      const double* __restrict yr = y;
      double* __restrict zr = z;
      sweep(yr, [=](std::ptrdiff_t k, double inflow)
                    DIPTYCH_INLINE { zr[k] = mu * yr[k] + nu * zr[k] + mu_w * (a[k] * inflow) + constant * m[k]; });
      flown_before = mu * flown + nu * flown_before + mu_w * (dt * into_held(y)) + constant * into;
      std::swap(flown, flown_before);
      std::swap(y, z);
    }
    double* __restrict u = c.data();
    for (std::size_t k = 0; k < first.size(); ++k) u[k] += y[k];
    drawn -= flown;
    node_updates += stages * static_cast<long>(volume.size());
  }

  void analyse() {
    std::vector<int> starts{0}, lines;
    for (std::size_t j = 0; j <= rows(); ++j) {
      for (std::size_t i = 0; i <= columns(); ++i) {
        const std::size_t k = j * row + i;
        lines.push_back(static_cast<int>(k));
        if (i < columns()) lines.push_back(static_cast<int>(k + 1));
        if (j < rows()) lines.push_back(static_cast<int>(k + row));
        starts.push_back(static_cast<int>(lines.size()));
      }
    }
    cholesky.emplace(std::move(starts), std::move(lines));
    right.resize(volume.size());
  }

  /// Backward Euler with K_f in the place of K stays stable while K − 2 K_f ≤ 2 V/dt as quadratic forms, which the
  /// second condition gives (K of d has no eigenvalue above 2 d · unit_row_sum).
  bool factor_serves(double dt) const {
    if (dt != factorised_dt) return false;
    const double near = drift * *std::ranges::max_element(factorised), slack = 1 / (unit_row_sum * dt);
    for (std::size_t i = 0; i < diffusivity.size(); ++i) {
      const double d = diffusivity[i], then = factorised[i];
      if (!(std::abs(d - then) <= near && d - 2 * then <= slack)) return false;
    }
    // Beside held nodes the same faces must conduct: which nodes are loose hangs on it.
    return held.empty() ||
           std::ranges::equal(diffusivity, factorised, [](double d, double then) { return (d > 0) == (then > 0); });
  }

  /// Where the column of node k begins among the matrix' entries: itself, its right and its upper neighbour.
  std::size_t entry(std::size_t k) const {
    const std::size_t i = k % row, j = k / row;
    return j * (3 * columns() + 2) + (j < rows() ? 3 : 2) * i;
  }

  /// The increment of a held node is zero: only the diagonal stands in its row and column. Returns the loose node of
  /// the largest K, to be tied down, and that K, or zero.
  std::pair<std::size_t, double> eliminate(std::span<double> entries, double step) {
    ties.clear();
    loose.clear();
    std::vector<unsigned char> reached(volume.size(), 0);
    for (const std::size_t k : held) {
      reached[k] = 1;
      if (k % row < columns()) entries[entry(k) + 1] = 0;
      if (k / row < rows()) entries[entry(k + 1) - 1] = 0;
      if (k % row > 0) entries[entry(k - 1) + 1] = 0;
      if (k >= row) entries[entry(k - row + 1) - 1] = 0;
      for (const auto& [other, face] : neighbours(k)) {
        if (face > 0 && !is_held(other)) ties.emplace_back(other, step * face);
      }
    }
    std::vector<std::size_t> from = held;
    while (!from.empty()) {
      const std::size_t k = from.back();
      from.pop_back();
      for (const auto& [other, face] : neighbours(k)) {
        if (!(face > 0) || reached[other]) continue;
        reached[other] = 1;
        from.push_back(other);
      }
    }
    std::pair<std::size_t, double> stiffest{0, 0};
    for (std::size_t k = 0; k < volume.size(); ++k) {
      const double sum = step * conductance(k);
      if (reached[k] || !(sum > 0)) continue;
      loose.push_back(k);
      if (sum > stiffest.second) stiffest = {k, sum};
    }
    return stiffest;
  }

  void factorise(double dt) {
    const double step = theta() * dt;
    std::span<double> entries = cholesky->entries();
    std::size_t at = 0;
    double top = 0;
    for (std::size_t j = 0; j <= rows(); ++j) {
      for (std::size_t i = 0; i <= columns(); ++i) {
        const std::size_t k = j * row + i;
        const double sum = step * conductance(k);
        if (sum > top) {
          top = sum;
          ground_node = k;
        }
        entries[at++] = volume[k] + sum;
        if (i < columns()) entries[at++] = -step * east.data()[k];
        if (j < rows()) entries[at++] = -step * north.data()[k];
      }
    }
    if (!held.empty()) std::tie(ground_node, top) = eliminate(entries, step);
    // Next to so large a K the volumes drown in round-off and the matrix is singular but for them. One node is tied to
    // zero instead, which the solution corrects for (Sherman & Morrison 1950). What reaches a held node is tied by it.
    const bool drowned = step * largest * unit_row_sum > 1e8 && top > 0;
    if (drowned) entries[entry(ground_node)] += top;
    factorised_dt = -1;  // unless it succeeds
    cholesky->factorise();
    ++factorisations;
    ground.clear();
    if (drowned) {
      std::ranges::fill(right, 0.0);
      right[ground_node] = top;
      const std::span<const double> solution = cholesky->solve(right);
      ground.assign(solution.begin(), solution.end());
    }
    factorised = diffusivity;
    factorised_dt = dt;
  }

  /// (V + θ dt K) δ = dt (V S − K C) for the increment δ = Cⁿ⁺¹ − Cⁿ. What the solution gives away in round-off comes
  /// back evenly: at dt d/h² = 10¹⁵ it would be several times the whole content.
  void solve(std::span<const double> source, double dt) {
    if (!factor_serves(dt)) factorise(dt);
    double* __restrict r = right.data();
    sweep(c.data(), [=](std::ptrdiff_t k, double inflow) DIPTYCH_INLINE { r[k] = dt * inflow; });
    if (!held.empty()) return solve_beside_held(source, dt);
    double given = 0, gained = 0, whole = 0;
    for (const std::size_t k : fed_nodes) {
      r[k] += dt * volume[k] * source[k];
      given += dt * volume[k] * source[k];
    }
    const std::span<const double> delta = cholesky->solve(right);
    double* u = c.data();
    if (ground.empty()) {
      for (std::size_t k = 0; k < delta.size(); ++k) {
        gained += volume[k] * delta[k];
        whole += volume[k];
      }
      const double missing = (given - gained) / whole;
      for (std::size_t k = 0; k < delta.size(); ++k) u[k] += delta[k] + missing;
    } else {
      for (std::size_t k = 0; k < delta.size(); ++k) {
        gained += volume[k] * delta[k];
        whole += volume[k] * ground[k];
      }
      const double missing = (given - gained) / whole;
      for (std::size_t k = 0; k < delta.size(); ++k) u[k] += delta[k] + missing * ground[k];
    }
    node_updates += 2 * static_cast<long>(volume.size());
  }

  /// The same with K C in place. Held nodes fix what reaches them; the content of the loose ones is known as above.
  void solve_beside_held(std::span<const double> source, double dt) {
    drawn -= dt * into_held(c.data());
    for (const std::size_t k : held) right[k] = 0;
    for (const std::size_t k : fed_nodes) right[k] += dt * volume[k] * source[k];
    const std::span<const double> delta = cholesky->solve(right);
    for (const auto& [k, tie] : ties) drawn -= tie * delta[k];
    double* u = c.data();
    for (std::size_t k = 0; k < delta.size(); ++k) u[k] += delta[k];
    double missing = 0, whole = 0;
    const auto weight = [&](std::size_t k) { return ground.empty() ? 1 : ground[k]; };
    for (const std::size_t k : fed_nodes) {
      if (std::ranges::binary_search(loose, k)) missing += dt * volume[k] * source[k];
    }
    for (const std::size_t k : loose) {
      missing -= volume[k] * delta[k];
      whole += volume[k] * weight(k);
    }
    for (const std::size_t k : loose) u[k] += missing / whole * weight(k);
    node_updates += 2 * static_cast<long>(volume.size());
  }
};

Concentration::Concentration(const Grid& grid, Scheme scheme, Reading reading, double drift)
    : parts_(std::make_unique<Parts>(grid, scheme, reading, drift)) {}
Concentration::~Concentration() = default;
Concentration::Concentration(Concentration&&) noexcept = default;

std::span<double> Concentration::values() { return parts_->c.values(); }
std::span<const double> Concentration::values() const { return std::as_const(*parts_).c.values(); }

void Concentration::step(std::span<const double> diffusivity, std::span<const double> source, double dt) {
  Parts& p = *parts_;
  require(diffusivity.size() == p.grid.cells(), "one diffusivity a cell");
  require(source.size() == p.grid.nodes(), "one source a node");
  require(std::isfinite(dt) && dt >= 0, "dt must be finite and >= 0");
  p.take(diffusivity);
  const double parts = std::ceil(dt / (p.limit() * (1 + 1e-12)));
  if (p.scheme == Scheme::forward_euler && parts > 1) {
    throw std::invalid_argument(with_numbers({"forward Euler of the diffusion: dt = ", " s is above its limit of ",
                                              " s at the largest diffusivity, ", " m^2/s"},
                                             {dt, p.limit(), p.largest}));
  }
  if (!p.implicit() && parts > 1e9) {
    throw std::invalid_argument(
        with_numbers({"explicit diffusion: dt = ", " s is ", " times the limit of forward Euler"}, {dt, parts}));
  }
  if (std::isnan(p.largest)) {  // a wave that has blown up; no scheme is to hide it
    p.c.fill(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  p.note_source(source, dt);
  if (p.largest == 0) {
    for (const std::size_t k : p.fed_nodes) p.c.data()[k] += dt * source[k];
    return;
  }
  switch (p.scheme) {
    case Scheme::forward_euler: return p.euler(source, dt);
    case Scheme::sub_cycled: return p.sub_cycle(source, dt, std::max(1L, static_cast<long>(parts)));
    case Scheme::rkl2: return p.rkl2(source, dt);
    case Scheme::backward_euler:
    case Scheme::crank_nicolson: return p.solve(source, dt);
  }
}

double Concentration::total() const {
  const double* c = std::as_const(*parts_).c.data();
  double sum = 0;
  for (std::size_t k = 0; k < parts_->volume.size(); ++k) sum += parts_->volume[k] * c[k];
  return sum;
}

void Concentration::hold(std::vector<std::size_t> nodes) { parts_->hold(std::move(nodes)); }

double Concentration::fed() const { return parts_->fed + parts_->drawn; }
double Concentration::drawn() const { return parts_->drawn; }
long Concentration::node_updates() const { return parts_->node_updates; }
long Concentration::factorisations() const { return parts_->factorisations; }

std::size_t Concentration::bytes() const {
  const Parts& p = *parts_;
  std::size_t sum = sizeof(Parts) + p.ties.capacity() * sizeof(p.ties[0]) +
                    (p.fed_nodes.capacity() + p.held.capacity() + p.loose.capacity()) * sizeof(std::size_t);
  for (const NodeField* f : {&p.c, &p.east, &p.north, &p.scale, &p.next, &p.before}) sum += f->bytes();
  for (const std::vector<double>* v :
       {&p.volume, &p.diffusivity, &p.weight_x, &p.weight_y, &p.first, &p.factorised, &p.right, &p.ground})
    sum += v->capacity() * sizeof(double);
  return sum + (p.cycles ? p.cycles->bytes() : 0) + (p.cholesky ? p.cholesky->bytes() : 0);
}

}  // namespace diptych::diffusion
