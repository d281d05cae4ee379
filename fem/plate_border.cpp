#include "fem/plate_border.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace diptych::fem {
namespace {

Hold hold_of(Edge::Support support, bool is_across) {
  switch (support) {
    case Edge::Support::free: return Hold::none;
    case Edge::Support::roller: return is_across ? Hold::held : Hold::none;
    case Edge::Support::fixed: return Hold::held;
    case Edge::Support::driven: return Hold::driven;
    case Edge::Support::platen: return is_across ? Hold::platen : Hold::none;
  }
  return Hold::none;
}

}  // namespace

Border::Border(const Plate& plate, Mesh& mesh) : plate_(plate), mesh_(mesh) {
  make_border();
  start_supports();
  make_platens();
}

// The bottom row, the top row, then what is left of the two sides, from the bottom.
Index Border::place(Index i, Index j) const {
  if (j == 0) return i;
  if (j == mesh_.ny) return mesh_.nx + 1 + i;
  return 2 * (mesh_.nx + 1) + (i == 0 ? 0 : mesh_.ny - 1) + j - 1;
}

std::vector<Index> Border::places_along(Side side) const {
  std::vector<Index> places;
  const Index nx = mesh_.nx, ny = mesh_.ny;
  for (Index k = 0; k <= (across(side) == 0 ? ny : nx); ++k) {
    const Index far = across(side) == 0 ? nx : ny, stand = outward(side) < 0 ? 0 : far;
    places.push_back(across(side) == 0 ? place(stand, k) : place(k, stand));
  }
  return places;
}

// Where two sides meet, a component is held if either holds it; else driven, by the left or right side first; else
// part of a platen.
void Border::make_border() {
  const Index nx = mesh_.nx, ny = mesh_.ny;
  border_.resize(2 * (nx + 1) + 2 * (ny - 1));
  for (Index j = 0; j <= ny; ++j) {
    for (Index i = 0; i <= nx; ++i) {
      if (i != 0 && i != nx && j != 0 && j != ny) continue;
      const bool corner = (i == 0 || i == nx) && (j == 0 || j == ny);
      border_[place(i, j)].node = j * (nx + 1) + i;
      border_[place(i, j)].mass = mesh_.cell_mass / (corner ? 6 : 3);
    }
  }
  for (const Side side : sides) {
    const Edge& edge = plate_.edge(side);
    along_[static_cast<Index>(side)] = places_along(side);
    for (const Index k : along_[static_cast<Index>(side)]) {
      for (const Index c : {Index{0}, Index{1}}) {
        const Hold hold = hold_of(edge.support, c == across(side));
        if (hold <= border_[k].hold[c]) continue;
        border_[k].hold[c] = hold;
        border_[k].driver[c] = hold == Hold::driven ? &edge : nullptr;
      }
    }
  }
}

void Border::start_supports() {
  for (const BorderNode& b : border_) {
    Vector v = mesh_.corners.v[b.node];
    for (const Index c : {Index{0}, Index{1}}) {
      if (b.hold[c] == Hold::held) v[c] = 0;
      if (b.hold[c] == Hold::driven) v[c] = given_velocity(b, c, 0);
    }
    mesh_.corners.v.set(b.node, v);
  }
}

void Border::make_platens() {
  const Nodes& corners = mesh_.corners;
  for (const Side side : sides) {
    if (plate_.edge(side).support != Edge::Support::platen) continue;
    Platen platen{side, {}, 0, 0, 0};
    for (const Index k : along_[static_cast<Index>(side)]) {
      if (border_[k].hold[across(side)] == Hold::platen) platen.nodes.push_back(k);
    }
    platen.mass = sum_over(platen, [](const BorderNode& b) { return b.mass; });
    platen.u =
        sum_over(platen, [&](const BorderNode& b) { return b.mass * corners.u[b.node][across(side)]; }) / platen.mass;
    platen.v =
        sum_over(platen, [&](const BorderNode& b) { return b.mass * corners.v[b.node][across(side)]; }) / platen.mass;
    double largest = 0, off = 0;
    for (const Index k : platen.nodes) {
      const double u = corners.u[border_[k].node][across(side)];
      largest = std::max(largest, std::abs(u));
      off = std::max(off, std::abs(u - platen.u));
    }
    if (off > 1e-12 * largest) throw std::invalid_argument("fem: the initial displacement bends a platen");
    platens_.push_back(platen);
    follow(platens_.back());
  }
}

/// Pairs from both ends, so that the mirrored platen has the mirrored bits.
template <class Of>
double Border::sum_over(const Platen& platen, Of of) const {
  const Index n = platen.nodes.size();
  double sum = 0;
  for (Index k = 0; k < n / 2; ++k) sum += of(border_[platen.nodes[k]]) + of(border_[platen.nodes[n - 1 - k]]);
  if (n % 2 == 1) sum += of(border_[platen.nodes[n / 2]]);
  return sum;
}

void Border::follow(const Platen& platen) {
  auto& u = across(platen.side) == 0 ? mesh_.corners.u.x : mesh_.corners.u.y;
  auto& v = across(platen.side) == 0 ? mesh_.corners.v.x : mesh_.corners.v.y;
  for (const Index k : platen.nodes) {
    u[border_[k].node] = platen.u;
    v[border_[k].node] = platen.v;
  }
}

void Border::external_force(const Kick& kick) {
  for (const Side side : sides) {
    const Edge& edge = plate_.edge(side);
    if (!edge.normal_traction && !edge.shear_traction) continue;
    for (const Index k : along_[static_cast<Index>(side)]) border_[k].load = {0, 0};
  }
  for (const Side side : sides) {
    const Edge& edge = plate_.edge(side);
    if (!edge.normal_traction && !edge.shear_traction) continue;
    const double length = across(side) == 0 ? mesh_.h.y : mesh_.h.x;
    Vector whole{};  // of a node that has a cell on either hand
    if (edge.normal_traction) {
      whole[across(side)] = outward(side) * edge.normal_traction(kick.from, kick.to) * length;
    }
    if (edge.shear_traction) whole[1 - across(side)] = edge.shear_traction(kick.from, kick.to) * length;
    const auto& places = along_[static_cast<Index>(side)];
    for (const Index k : places) {
      const double share = k == places.front() || k == places.back() ? 0.5 : 1;
      for (const Index c : {Index{0}, Index{1}}) border_[k].load[c] += share * whole[c];
    }
  }
  if (plate_.body_force) apply_body_force((kick.from + kick.to) / 2);
}

void Border::apply_body_force(double time) {
  mesh_.for_nodes([&](Nodes& nodes, Index k, double x, double y) {
    const Vector b = plate_.body_force(x, y, time);
    const double mass = &nodes == &mesh_.middles ? mesh_.cell_mass / 3 : mesh_.cell_mass * 2 / 3;
    nodes.body.set(k, {mass * b[0], mass * b[1]});
  });
  for (const BorderNode& b : border_) {  // these have less of a mass
    const double less = b.mass / (mesh_.cell_mass * 2 / 3);
    const Vector f = mesh_.corners.body[b.node];
    mesh_.corners.body.set(b.node, {less * f[0], less * f[1]});
  }
}

void Border::kick(Index i, Index j, const Vector& internal_force, double kick, double dt) {
  Nodes& corners = mesh_.corners;
  BorderNode& b = border_[place(i, j)];
  b.force = plus(internal_force, b.load);
  if (plate_.body_force) b.force = plus(b.force, corners.body[b.node]);
  const double factor = kick / b.mass;
  if (b.hold[0] == Hold::none) {
    corners.v.x[b.node] += factor * b.force[0];
    corners.u.x[b.node] += dt * corners.v.x[b.node];
  }
  if (b.hold[1] == Hold::none) {
    corners.v.y[b.node] += factor * b.force[1];
    corners.u.y[b.node] += dt * corners.v.y[b.node];
  }
}

/// Σf/Σm: what the rigid platen passes between its nodes adds up to nothing.
void Border::move_platens(double kick, double dt) {
  for (Platen& platen : platens_) {
    platen.v +=
        kick * sum_over(platen, [&](const BorderNode& b) { return b.force[across(platen.side)]; }) / platen.mass;
    platen.u += dt * platen.v;
    follow(platen);
  }
}

double Border::platen_displacement() const { return outward(platens_.front().side) * platens_.front().u; }

void Border::drive_supports(double time, double dt) {
  for (const BorderNode& b : border_) {
    for (const Index c : {Index{0}, Index{1}}) {
      if (b.hold[c] != Hold::driven) continue;
      const double v = given_velocity(b, c, time);
      (c == 0 ? mesh_.corners.v.x : mesh_.corners.v.y)[b.node] = v;
      (c == 0 ? mesh_.corners.u.x : mesh_.corners.u.y)[b.node] += dt * v;
    }
  }
}

double Border::given_velocity(const BorderNode& b, Index component, double time) const {
  const Index row = mesh_.nx + 1;
  return b.driver[component]->velocity(mesh_.corner_x(b.node % row), mesh_.corner_y(b.node / row), time)[component];
}

bool Border::free() const {
  return std::all_of(plate_.edges.begin(), plate_.edges.end(), [](const Edge& e) {
    return e.support == Edge::Support::free || e.support == Edge::Support::platen;
  });
}

void Border::note_velocities() {
  for (BorderNode& b : border_) b.before = mesh_.corners.v[b.node];
  body_work_rate_ = body_work_rate();
}

double Border::body_work_rate() const {
  double sum = 0;
  for (const Nodes* nodes : {&mesh_.corners, &mesh_.middles}) {
    const Index n = nodes->body.x.size();
    for (Index k = 0; k < n; ++k) sum += nodes->body.x[k] * nodes->v.x[k] + nodes->body.y[k] * nodes->v.y[k];
  }
  return sum;
}

/// Reactions of what holds or drives the sides follow from the motion: R = m Δv/τ − f; what a platen passes between its
/// nodes does no work and adds up to nothing.
ExternalWork Border::external_work(double kick) const {
  double before = body_work_rate_, after = body_work_rate();
  Vector force{};
  for (const Nodes* nodes : {&mesh_.corners, &mesh_.middles}) {
    force[0] = std::accumulate(nodes->body.x.begin(), nodes->body.x.end(), force[0]);
    force[1] = std::accumulate(nodes->body.y.begin(), nodes->body.y.end(), force[1]);
  }
  for (const BorderNode& b : border_) {
    const Vector v = mesh_.corners.v[b.node];
    for (const Index c : {Index{0}, Index{1}}) {
      double f = b.load[c];
      if (b.hold[c] == Hold::held || b.hold[c] == Hold::driven) {
        f += b.mass * (v[c] - b.before[c]) / kick - b.force[c];
      }
      before += f * b.before[c];
      after += f * v[c];
      force[c] += f;
    }
  }
  return {before, after, force};
}

}  // namespace diptych::fem
