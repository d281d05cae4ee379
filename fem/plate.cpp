#include "fem/plate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fem/cell.hpp"
#include "fem/sweep.hpp"
#include "hinge/step/stepping.hpp"
#include "hinge/step/threads.hpp"

namespace diptych::fem {
namespace {

using material::PlasticStrain;
using material::Stiffness;
using material::Tensor;
using Index = std::size_t;

constexpr std::array<Side, 4> sides{Side::left, Side::right, Side::bottom, Side::top};

/// The component across a side, and the sign of its outward normal.
constexpr Index across(Side side) { return side == Side::left || side == Side::right ? 0 : 1; }
constexpr double outward(Side side) { return side == Side::left || side == Side::bottom ? -1 : 1; }

struct Components {
  std::vector<double> x, y;

  Components() = default;
  explicit Components(Index n) : x(n), y(n) {}
  Vector operator[](Index i) const { return {x[i], y[i]}; }
  void set(Index i, const Vector& v) { x[i] = v[0], y[i] = v[1]; }
  Index bytes() const { return (x.capacity() + y.capacity()) * sizeof(double); }
};

/// Corners of cells, or their middles: row by row from the bottom.
struct Nodes {
  Index across, up;
  Components u, v;
  Components body;  ///< body force at the nodes [N/m], only with one

  Nodes(Index nx, Index ny) : across(nx), up(ny), u(nx * ny), v(nx * ny) {}
  NodeRow row(Index j, Index i = 0) {
    const Index k = j * across + i;
    return {&u.x[k],
            &u.y[k],
            &v.x[k],
            &v.y[k],
            body.x.empty() ? nullptr : &body.x[k],
            body.y.empty() ? nullptr : &body.y[k]};
  }
};

/// What moves a component of a node on a side.
enum class Hold {
  none,    ///< its own force
  platen,  ///< that of its platen
  driven,  ///< a given velocity
  held     ///< nothing
};

struct BorderNode {
  Index node;   ///< among the corners
  double mass;  ///< [kg/m]
  std::array<Hold, 2> hold{Hold::none, Hold::none};
  std::array<const Edge*, 2> driver{};  ///< of driven components
  Vector load{};                        ///< of tractions [N/m]
  Vector force{};                       ///< all but the reaction of what holds it [N/m]
  Vector before{};                      ///< velocity before the kick, for the books [m/s]
};

/// Nodes of a side that move as one across it.
struct Platen {
  Side side;
  std::vector<Index> nodes;  ///< places in the border
  double mass = 0;           ///< [kg/m]
  double u = 0, v = 0;       ///< along x or y [m], [m/s]
};

/// Rows of cells that one task looks after.
struct Band {
  Index begin, end;
  Components below;  ///< force of the last row of cells on the nodes above it [N/m]
  Components first;  ///< of the band's first row of cells on the nodes below it [N/m]
  CornerForces forces;
};

/// What the material has taken in a step [J/m³].
struct Taken {
  double by_damage = 0, by_flow = 0;
};

/// Energies and momentum of a row of cells and of the nodes at its middle and bottom.
struct RowSums {
  double kinetic = 0, strain = 0, dissipated = 0;
  Vector momentum{};
};

/// The solid where it is cracked.
struct Cracked {
  double crack_density = 0;
  material::CrackedStiffness stiffness;
};

/// What viscosity does in a row of cells.
struct Drag {
  double largest = 0;  ///< |D| where it acts [1/s]
  bool acted = false;  ///< at any time
  double work = 0;     ///< ½ Σ A q tr Δε of a kick [J/m]
};

/// What a gauge reads: two cells, and how much of each.
struct Reading {
  Index left, right;
  double of_left, of_right;
};

/// What a plate has beside elasticity.
struct Kind {
  bool damaging = false;  ///< tensile damage
  bool plastic = false;   ///< plasticity in compression
  bool failing = false;   ///< a failure wave
  bool viscous = false;   ///< artificial viscosity
};

/// Of a place on a grid that is made up of so many equal parts: its coordinate in parts, exact on what stands between
/// two of them but for round-off.
double in_parts(double x, double length, int parts) {
  const double place = x / length * parts, nearest = std::round(place);
  return std::abs(place - nearest) <= 1e-9 ? nearest : place;
}

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("fem: " + why); }

void check(const Plate& plate, const Cells& cells, const std::optional<diffusion::Evolution>& evolution,
           const std::optional<diffusion::Spread>& spread) {
  const bool damaging = std::holds_alternative<material::TensileDamage>(plate.material);
  const bool failing = std::holds_alternative<material::FailureWave>(plate.material);
  if (cells.x < 1 || cells.y < 1) refuse("a plate needs at least one cell each way");
  if (damaging && !evolution) refuse("tensile damage needs an evolution of the crack density");
  if (!damaging && evolution) refuse("an evolution of the crack density needs tensile damage");
  if (plate.compression && elastic(plate).plane == material::Plane::stress) {
    refuse("plasticity in compression is for plane strain only");
  }
  if (failing && !spread) refuse("a failure wave needs the spread of its dilatancy");
  if (!failing && spread) refuse("the spread of a dilatancy needs a failure wave");
  if (failing && elastic(plate).plane == material::Plane::stress) refuse("a failure wave is for plane strain only");
  if (failing && plate.compression) refuse("a failure wave has no plasticity in compression beside it");
  if (plate.viscosity && plate.viscosity->form != material::Viscosity::Form::york) {
    refuse("in a plate the artificial viscosity is that of eq. 21");
  }
  if (plate.viscosity && (evolution || plate.compression)) {
    refuse("artificial viscosity is for elastic plates and failure waves, not beside tensile damage or plasticity");
  }
  if (plate.impact) {
    const auto found = [](double x) { return " (" + std::to_string(x) + ")"; };
    const double face = in_parts(plate.impact->face, plate.width, cells.x);
    if (plate.initial_velocity || plate.initial_displacement) refuse("an impact has no initial state beside it");
    if (!(plate.impact->velocity > 0)) {
      refuse("the velocity of an impact is > 0 m/s" + found(plate.impact->velocity));
    }
    if (!(face > 0 && face < cells.x && face == std::round(face))) {
      refuse("the face of an impact is a column of nodes inside the plate, 1 to " + std::to_string(cells.x - 1) +
             " cells from the left" + found(face));
    }
  }
  for (const Gauge& gauge : plate.gauges) {
    if (!(gauge.x >= 0 && gauge.x <= plate.width && gauge.y >= 0 && gauge.y <= plate.height)) {
      refuse("a gauge stands outside of the plate");
    }
  }
  for (const Edge& edge : plate.edges) {
    using enum Edge::Support;
    const auto loaded = [&](bool normal, bool shear) {
      return (normal && edge.normal_traction) || (shear && edge.shear_traction);
    };
    if (edge.support == driven && !edge.velocity) refuse("a driven side needs a velocity");
    if ((edge.support == driven || edge.support == fixed) && loaded(true, true)) {
      refuse("a traction on a side that is driven or fixed does nothing");
    }
    if (edge.support == roller && loaded(true, false)) refuse("a normal traction on rollers does nothing");
    if (edge.support == platen && loaded(false, true)) refuse("a platen is frictionless and passes no shear on");
  }
}

/// One plate. An elastic one has displacements and velocities of nodes and nothing else.
template <Kind kind>
class Body {
  static constexpr bool damaging = kind.damaging, plastic = kind.plastic, failing = kind.failing,
                        viscous = kind.viscous;
  static constexpr bool dissipative = damaging || plastic || failing;  ///< the material itself
  static constexpr bool linear = !dissipative && !viscous;

 public:
  Body(const Plate& plate, const Cells& cells, const std::optional<diffusion::Evolution>& evolution,
       const std::optional<diffusion::Spread>& spread, const Stepping& stepping)
      : plate_(plate),
        dt_(stepping.time_step),
        nx_(static_cast<Index>(cells.x)),
        ny_(static_cast<Index>(cells.y)),
        h_{plate.width / cells.x, plate.height / cells.y},
        solid_(elastic(plate).stiffness()),
        whole_(solid_, h_),
        cell_mass_(elastic(plate).density * h_.x * h_.y),
        corners_(nx_ + 1, ny_ + 1),
        middles_(nx_, ny_),
        loops_(loops(static_cast<bool>(plate.body_force))),
        sums_(ny_ + 1),
        threads_(stepping.threads) {
    make_bands(static_cast<Index>(std::max(1, stepping.threads)));
    make_border();
    if (plate.body_force) {
      corners_.body = Components((nx_ + 1) * (ny_ + 1));
      middles_.body = Components(nx_ * ny_);
    }
    set_off();
    make_platens();
    if (!platens_.empty()) platen_.reserve(static_cast<Index>(stepping.steps));
    if constexpr (!linear) {
      stress_.resize(nx_ * ny_);
      answers_.resize(nx_ * ny_);
    }
    if constexpr (dissipative) {
      if (stepping.books != Books::off) {
        recoverable_.resize(nx_ * ny_);
        answered_.resize(nx_ * ny_);
        taken_.resize(ny_);
      }
    }
    if constexpr (plastic) plastic_.resize(nx_ * ny_);
    if constexpr (damaging) {
      cracked_.resize(nx_ * ny_);
      volumetric_.resize(nx_ * ny_);
      evolution_.emplace(*evolution, diffusion::Grid{cells.x, cells.y, h_.x, h_.y});
      if (plate.initial_displacement) evolve_damage();  // a plate at rest has no strains that cracks could grow by
    }
    if constexpr (failing) {
      ceiling_.resize(nx_ * ny_);
      dilatancy_.emplace(*spread, diffusion::Grid{cells.x, cells.y, h_.x, h_.y});
    }
    if constexpr (viscous) {
      q_.resize(nx_ * ny_);
      drag_.resize(ny_);
    }
    if constexpr (dissipative) update_stress(false);
    place_gauges(stepping.steps);
  }

  // Central differences: (uⁿ, σⁿ, vⁿ⁻½) → (uⁿ⁺¹, σⁿ⁺¹, vⁿ⁺½). Forces, kick and drift go by rows, in one sweep.
  void step(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    external_force(kick);  // eqs. 17b, 20
    note_velocities();
    for_bands([&](Band& band) { sweep(band, kick.length); });  // eqs. 19, 18
    close_rows(kick.length);
    move_platens(kick.length);
    drive_supports((static_cast<double>(n) + 0.5) * dt_);
    keep_work(kick.length, ledger);
    if (ledger.due()) measure_energies(ledger);
    if constexpr (damaging) evolve_damage();    // eqs. 23 to 28, staggered
    if constexpr (failing) spread_dilatancy();  // likewise
    if constexpr (!linear) update_stress(ledger.keeps());
    if constexpr (viscous) resist();  // eqs. 21, 22
    if (ledger.due()) close_books(ledger);
    if (!gauges_.empty()) read_gauges(n + 1);
  }

  PlateSnapshot sample(long n) const;

  static std::string trouble() { return {}; }
  static double gives_back() { return failing ? material::FailureWave::gives_back : 0; }
  double first_ledger_time() const { return dt_ / 2; }
  double energy() const {
    double sum = 0;
    for (Index j = 0; j < ny_; ++j) {
      for (Index i = 0; i < nx_; ++i) {
        const Triangles strain = strains(at(corners_.u, middles_.u, i, j), h_);
        for (const Tensor& e : strain) {
          if constexpr (failing) {
            sum += h_.triangle_area() * failure().stored(e, dilatancy_->of_cells()[j * nx_ + i]);
          } else {
            sum += h_.triangle_area() * solid_.stress(e).contract(e) / 2;
          }
        }
      }
    }
    return sum + kinetic().kinetic;
  }
  /// The ledger has one number for a vector: its component along the diagonal.
  double momentum() const { return along_diagonal(kinetic().momentum); }
  double free_mass() const {
    const bool free = std::all_of(plate_.edges.begin(), plate_.edges.end(), [](const Edge& e) {
      return e.support == Edge::Support::free || e.support == Edge::Support::platen;
    });
    return free ? elastic(plate_).density * plate_.width * plate_.height : 0;
  }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{evolution_ ? "damage" : dilatancy_ ? "failure-wave" : "elastic"};
    if (!corners_.body.x.empty()) active.push_back("body-force");
    if (!plastic_.empty()) active.push_back("compression-plasticity");
    if (dilatancy_ || (evolution_ && !evolution_->concentration().empty())) active.push_back("diffusion");
    if (plate_.impact) active.push_back("impact");
    if (!platens_.empty()) active.push_back("platen");
    if (std::any_of(drag_.begin(), drag_.end(), [](const Drag& row) { return row.acted; })) {
      active.push_back("viscosity");
    }
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    Work sum;
    sum.element_steps = static_cast<long>(4 * nx_ * ny_) * steps;
    sum.node_steps = static_cast<long>((nx_ + 1) * (ny_ + 1) + nx_ * ny_) * steps;
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    for (const Nodes* nodes : {&corners_, &middles_})
      sum.bytes += nodes->u.bytes() + nodes->v.bytes() + nodes->body.bytes();
    for (const Band& band : bands_) sum.bytes += sizeof band + band.below.bytes() + band.first.bytes();
    sum.bytes += of(border_) + of(stress_) + of(answers_) + of(plastic_) + of(cracked_) + of(volumetric_) +
                 of(ceiling_) + of(q_) + of(drag_) + of(recoverable_) + of(answered_) + of(taken_) + of(sums_);
    for (const GaugeRecord& g : gauges_) sum.bytes += of(g.time) + of(g.xx) + of(g.yy) + of(g.dilatancy);
    if (evolution_) sum.bytes += evolution_->bytes();
    if (dilatancy_) sum.bytes += dilatancy_->bytes();
    return sum;
  }
  void hand_over(PlateRecord& record) {
    record.platen = std::move(platen_);
    record.gauges = gauges_;
    record.fed = evolution_ ? evolution_->fed() : dilatancy_ ? dilatancy_->fed() : 0;
    record.diffusion_updates = evolution_ ? evolution_->node_updates() : dilatancy_ ? dilatancy_->node_updates() : 0;
  }

 private:
  // ---- building up ----

  void make_bands(Index threads) {
    const Index count = std::min(threads, ny_);
    for (Index k = 0; k < count; ++k) {
      bands_.push_back({k * ny_ / count, (k + 1) * ny_ / count, Components(nx_ + 1), Components(nx_ + 1), {}});
    }
  }

  // The bottom row, the top row, then what is left of the two sides, from the bottom.
  Index border_place(Index i, Index j) const {
    if (j == 0) return i;
    if (j == ny_) return nx_ + 1 + i;
    return 2 * (nx_ + 1) + (i == 0 ? 0 : ny_ - 1) + j - 1;
  }
  std::vector<Index> places_along(Side side) const {
    std::vector<Index> places;
    for (Index k = 0; k <= (across(side) == 0 ? ny_ : nx_); ++k) {
      const Index far = across(side) == 0 ? nx_ : ny_, stand = outward(side) < 0 ? 0 : far;
      places.push_back(across(side) == 0 ? border_place(stand, k) : border_place(k, stand));
    }
    return places;
  }

  // Where two sides meet, a component is held if either holds it; else driven, by the left or right side first; else
  // part of a platen.
  void make_border() {
    border_.resize(2 * (nx_ + 1) + 2 * (ny_ - 1));
    for (Index j = 0; j <= ny_; ++j) {
      for (Index i = 0; i <= nx_; ++i) {
        if (i != 0 && i != nx_ && j != 0 && j != ny_) continue;
        const bool corner = (i == 0 || i == nx_) && (j == 0 || j == ny_);
        border_[border_place(i, j)].node = j * (nx_ + 1) + i;
        border_[border_place(i, j)].mass = cell_mass_ / (corner ? 6 : 3);
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
  static Hold hold_of(Edge::Support support, bool is_across) {
    switch (support) {
      case Edge::Support::free: return Hold::none;
      case Edge::Support::roller: return is_across ? Hold::held : Hold::none;
      case Edge::Support::fixed: return Hold::held;
      case Edge::Support::driven: return Hold::driven;
      case Edge::Support::platen: return is_across ? Hold::platen : Hold::none;
    }
    return Hold::none;
  }

  // Supports take up at once what the scene would have them do at the start.
  void set_off() {
    for_nodes([&](Nodes& nodes, Index k, double x, double y) {
      if (plate_.initial_displacement) nodes.u.set(k, plate_.initial_displacement(x, y));
      if (plate_.initial_velocity) nodes.v.set(k, plate_.initial_velocity(x, y));
    });
    if (plate_.impact) strike();
    for (const BorderNode& b : border_) {
      Vector v = corners_.v[b.node];
      for (const Index c : {Index{0}, Index{1}}) {
        if (b.hold[c] == Hold::held) v[c] = 0;
        if (b.hold[c] == Hold::driven) v[c] = given_velocity(b, c, 0);
      }
      corners_.v.set(b.node, v);
    }
  }

  // Half of the mass of a node on the face is the flyer's.
  void strike() {
    const auto face = static_cast<Index>(in_parts(plate_.impact->face, plate_.width, static_cast<int>(nx_)));
    const double v = plate_.impact->velocity;
    for (Index j = 0; j <= ny_; ++j) {
      for (Index i = 0; i <= face; ++i) corners_.v.x[j * (nx_ + 1) + i] = i < face ? v : v / 2;
    }
    for (Index j = 0; j < ny_; ++j) {
      for (Index i = 0; i < face; ++i) middles_.v.x[j * nx_ + i] = v;
    }
  }

  // A gauge on a row's edge reads the row below it; one before the first or beyond the last middle reads that cell.
  void place_gauges(long steps) {
    for (const Gauge& gauge : plate_.gauges) {
      const double x = in_parts(gauge.x, plate_.width, static_cast<int>(nx_)) - 0.5;
      const double y = in_parts(gauge.y, plate_.height, static_cast<int>(ny_));
      const double cell = std::clamp(std::floor(x), 0.0, static_cast<double>(nx_ - 1));
      const Index row = static_cast<Index>(std::max(std::ceil(y) - 1, 0.0)), left = static_cast<Index>(cell);
      const double of_right = left + 1 < nx_ ? std::max(x - cell, 0.0) : 0;
      readings_.push_back({row * nx_ + left, row * nx_ + std::min(left + 1, nx_ - 1), 1 - of_right, of_right});
      gauges_.emplace_back();
      for (std::vector<double>* v : {&gauges_.back().time, &gauges_.back().xx, &gauges_.back().yy}) {
        v->reserve(static_cast<Index>(steps));
      }
      if constexpr (failing) gauges_.back().dilatancy.reserve(static_cast<Index>(steps));
    }
  }

  void make_platens() {
    for (const Side side : sides) {
      if (plate_.edge(side).support != Edge::Support::platen) continue;
      Platen platen{side, {}, 0, 0, 0};
      for (const Index k : along_[static_cast<Index>(side)]) {
        if (border_[k].hold[across(side)] == Hold::platen) platen.nodes.push_back(k);
      }
      if (platen.nodes.empty()) refuse("a platen whose nodes are all held by the sides beside it");
      platen.mass = sum_over(platen, [](const BorderNode& b) { return b.mass; });
      platen.u = sum_over(platen, [&](const BorderNode& b) { return b.mass * corners_.u[b.node][across(side)]; }) /
                 platen.mass;
      platen.v = sum_over(platen, [&](const BorderNode& b) { return b.mass * corners_.v[b.node][across(side)]; }) /
                 platen.mass;
      double largest = 0, off = 0;
      for (const Index k : platen.nodes) {
        const double u = corners_.u[border_[k].node][across(side)];
        largest = std::max(largest, std::abs(u));
        off = std::max(off, std::abs(u - platen.u));
      }
      if (off > 1e-12 * largest) refuse("the initial displacement bends a platen");
      platens_.push_back(platen);
      place(platens_.back());
    }
  }

  /// Pairs from both ends, so that the mirrored platen has the mirrored bits.
  template <class Of>
  double sum_over(const Platen& platen, Of of) const {
    const Index n = platen.nodes.size();
    double sum = 0;
    for (Index k = 0; k < n / 2; ++k) sum += of(border_[platen.nodes[k]]) + of(border_[platen.nodes[n - 1 - k]]);
    if (n % 2 == 1) sum += of(border_[platen.nodes[n / 2]]);
    return sum;
  }
  void place(const Platen& platen) {
    auto& u = across(platen.side) == 0 ? corners_.u.x : corners_.u.y;
    auto& v = across(platen.side) == 0 ? corners_.v.x : corners_.v.y;
    for (const Index k : platen.nodes) {
      u[border_[k].node] = platen.u;
      v[border_[k].node] = platen.v;
    }
  }

  double corner_x(Index i) const { return plate_.width * static_cast<double>(i) / static_cast<double>(nx_); }
  double corner_y(Index j) const { return plate_.height * static_cast<double>(j) / static_cast<double>(ny_); }
  double middle_x(Index i) const { return plate_.width * (static_cast<double>(i) + 0.5) / static_cast<double>(nx_); }
  double middle_y(Index j) const { return plate_.height * (static_cast<double>(j) + 0.5) / static_cast<double>(ny_); }

  template <class Do>
  void for_nodes(Do act) {
    for (Index j = 0; j <= ny_; ++j) {
      for (Index i = 0; i <= nx_; ++i) act(corners_, j * (nx_ + 1) + i, corner_x(i), corner_y(j));
    }
    for (Index j = 0; j < ny_; ++j) {
      for (Index i = 0; i < nx_; ++i) act(middles_, j * nx_ + i, middle_x(i), middle_y(j));
    }
  }

  // ---- forces from outside ----

  void external_force(const Kick& kick) {
    for (const Side side : sides) {
      const Edge& edge = plate_.edge(side);
      if (!edge.normal_traction && !edge.shear_traction) continue;
      for (const Index k : along_[static_cast<Index>(side)]) border_[k].load = {0, 0};
    }
    for (const Side side : sides) {
      const Edge& edge = plate_.edge(side);
      if (!edge.normal_traction && !edge.shear_traction) continue;
      const double length = across(side) == 0 ? h_.y : h_.x;
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
    if (!plate_.body_force) return;
    const double time = (kick.from + kick.to) / 2;
    for_nodes([&](Nodes& nodes, Index k, double x, double y) {
      const Vector b = plate_.body_force(x, y, time);
      const double mass = &nodes == &middles_ ? cell_mass_ / 3 : cell_mass_ * 2 / 3;
      nodes.body.set(k, {mass * b[0], mass * b[1]});
    });
    for (const BorderNode& b : border_) {  // these have less of a mass
      const double less = b.mass / (cell_mass_ * 2 / 3);
      const Vector f = corners_.body[b.node];
      corners_.body.set(b.node, {less * f[0], less * f[1]});
    }
  }

  // ---- the sweep ----

  void sweep(Band& band, double kick) {
    const KickAndDrift corner{kick / (cell_mass_ * 2 / 3), dt_};
    for (Index j = band.begin; j < band.end; ++j) {
      band.forces.lower_right[0][0] = band.forces.lower_right[1][0] = 0;
      band.forces.upper_right[0][0] = band.forces.upper_right[1][0] = 0;
      for (Index from = 0; from < nx_; from += block) {
        const Index cells = std::min(block, nx_ - from);
        internal_force(j, from, cells, kick, band.forces);
        if (j == band.begin) {
          open_row(band, from, cells);
        } else {
          if (from == 0) move_end(band, 0, j, kick);
          loops_.nodes(from == 0 ? 1 : 0, cells, band.forces, corners_.row(j, from), corner, &band.below.x[from],
                       &band.below.y[from]);
        }
        band.forces.carry(cells);
      }
      const Vector lower = right_end(band.forces.lower_right), upper = right_end(band.forces.upper_right);
      if (j == band.begin) {
        band.first.set(nx_, lower);
      } else {
        kick_border(nx_, j, plus(band.below[nx_], lower), kick);
      }
      band.below.set(nx_, upper);
    }
  }
  static Vector right_end(const double (&f)[2][block + 1]) { return {f[0][0], f[1][0]}; }
  static Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1]}; }

  /// Eq. 19, and eq. 18 of the nodes in the middle of cells.
  void internal_force(Index j, Index from, Index cells, double kick, CornerForces& forces) {
    const NodeRow lower = corners_.row(j, from), upper = corners_.row(j + 1, from);
    const KickAndDrift middle{kick / (cell_mass_ / 3), dt_};
    if constexpr (linear) {
      loops_.cells(whole_, cells, lower.ux, lower.uy, upper.ux, upper.uy, middles_.row(j, from), middle, forces, 0);
    } else {
      const auto answers = answers_.begin() + static_cast<std::ptrdiff_t>(j * nx_ + from);
      const auto end = answers + static_cast<std::ptrdiff_t>(cells);
      for (auto at_cell = answers; at_cell != end;) {
        const auto next = std::find(at_cell, end, !*at_cell ? 1 : 0);
        const Index first = static_cast<Index>(at_cell - answers), count = static_cast<Index>(next - at_cell);
        if (!*at_cell) {
          loops_.cells(whole_, count, lower.ux + first, lower.uy + first, upper.ux + first, upper.uy + first,
                       middles_.row(j, from + first), middle, forces, first);
        } else {
          for (Index i = first; i < first + count; ++i) cell_force(j * nx_ + from + i, i, middle, forces);
        }
        at_cell = next;
      }
    }
  }
  /// The same of a cell whose triangles have answered for themselves.
  void cell_force(Index cell, Index i, const KickAndDrift& factor, CornerForces& forces) {
    Triangles stress = stress_[cell];
    if constexpr (viscous) {  // of the velocities half a step before
      for (Index t = 0; t < 4; ++t) stress[t] = stress[t] + Tensor{q_[cell][t], q_[cell][t], 0};
    }
    const CellValues f = internal_forces(stress, h_);
    for (const Index c : {Index{0}, Index{1}}) {
      forces.lower_left[c][i] = f[0][c];
      forces.lower_right[c][i + 1] = f[1][c];
      forces.upper_right[c][i + 1] = f[2][c];
      forces.upper_left[c][i] = f[3][c];
      auto& u = c == 0 ? middles_.u.x : middles_.u.y;
      auto& v = c == 0 ? middles_.v.x : middles_.v.y;
      double force = f[4][c];
      if (plate_.body_force) force += middles_.body[cell][c];
      v[cell] += factor.kick * force;
      u[cell] += factor.drift * v[cell];
    }
  }

  // A band's first row of nodes waits for the band below it.
  void open_row(Band& band, Index from, Index cells) {
    const CornerForces& f = band.forces;
    for (Index i = 0; i < cells; ++i) {
      band.first.set(from + i, {f.lower_left[0][i] + f.lower_right[0][i], f.lower_left[1][i] + f.lower_right[1][i]});
      band.below.set(from + i, {f.upper_left[0][i] + f.upper_right[0][i], f.upper_left[1][i] + f.upper_right[1][i]});
    }
  }
  void move_end(Band& band, Index i, Index j, double kick) {
    const CornerForces& f = band.forces;
    kick_border(i, j,
                {band.below.x[i] + (f.lower_left[0][0] + f.lower_right[0][0]),
                 band.below.y[i] + (f.lower_left[1][0] + f.lower_right[1][0])},
                kick);
    band.below.set(i, {f.upper_left[0][0] + f.upper_right[0][0], f.upper_left[1][0] + f.upper_right[1][0]});
  }

  /// The rows of nodes between bands, at the bottom and at the top.
  void close_rows(double kick) {
    const double factor = kick / (cell_mass_ * 2 / 3);
    for (Index k = 0; k <= bands_.size(); ++k) {
      const Index j = k == bands_.size() ? ny_ : bands_[k].begin;
      const auto force = [&](Index i) {
        if (k == 0) return bands_[k].first[i];
        if (k == bands_.size()) return bands_[k - 1].below[i];
        return plus(bands_[k - 1].below[i], bands_[k].first[i]);
      };
      for (Index i = 0; i <= nx_; ++i) {
        if (i == 0 || i == nx_ || j == 0 || j == ny_) {
          kick_border(i, j, force(i), kick);
          continue;
        }
        const Index node = j * (nx_ + 1) + i;
        const Vector f = plate_.body_force ? plus(force(i), corners_.body[node]) : force(i);
        const Vector v{corners_.v.x[node] + factor * f[0], corners_.v.y[node] + factor * f[1]};
        corners_.v.set(node, v);
        corners_.u.set(node, {corners_.u.x[node] + dt_ * v[0], corners_.u.y[node] + dt_ * v[1]});
      }
    }
  }

  /// Eq. 18 of a node on a side, where nothing holds it.
  void kick_border(Index i, Index j, const Vector& internal, double kick) {
    BorderNode& b = border_[border_place(i, j)];
    b.force = plus(internal, b.load);
    if (plate_.body_force) b.force = plus(b.force, corners_.body[b.node]);
    const double factor = kick / b.mass;
    if (b.hold[0] == Hold::none) {
      corners_.v.x[b.node] += factor * b.force[0];
      corners_.u.x[b.node] += dt_ * corners_.v.x[b.node];
    }
    if (b.hold[1] == Hold::none) {
      corners_.v.y[b.node] += factor * b.force[1];
      corners_.u.y[b.node] += dt_ * corners_.v.y[b.node];
    }
  }

  // ---- supports ----

  /// One acceleration for all of its nodes, Σf/Σm: what the rigid platen passes between them adds up to nothing.
  void move_platens(double kick) {
    for (Platen& platen : platens_) {
      platen.v +=
          kick * sum_over(platen, [&](const BorderNode& b) { return b.force[across(platen.side)]; }) / platen.mass;
      platen.u += dt_ * platen.v;
      place(platen);
    }
    if (!platens_.empty()) platen_.push_back(outward(platens_.front().side) * platens_.front().u);
  }

  void drive_supports(double time) {
    for (const BorderNode& b : border_) {
      for (const Index c : {Index{0}, Index{1}}) {
        if (b.hold[c] != Hold::driven) continue;
        const double v = given_velocity(b, c, time);
        (c == 0 ? corners_.v.x : corners_.v.y)[b.node] = v;
        (c == 0 ? corners_.u.x : corners_.u.y)[b.node] += dt_ * v;
      }
    }
  }
  double given_velocity(const BorderNode& b, Index c, double time) const {
    return b.driver[c]->velocity(corner_x(b.node % (nx_ + 1)), corner_y(b.node / (nx_ + 1)), time)[c];
  }

  // ---- what the material answers ----

  static CellValues at(const Components& corners, const Components& middles, Index i, Index j, Index nx) {
    const Index k = j * (nx + 1) + i, l = k + nx + 1;
    return {corners[k], corners[k + 1], corners[l + 1], corners[l], middles[j * nx + i]};
  }
  CellValues at(const Components& corners, const Components& middles, Index i, Index j) const {
    return at(corners, middles, i, j, nx_);
  }

  const material::TensileDamage& damage() const { return std::get<material::TensileDamage>(plate_.material); }
  const material::FailureWave& failure() const { return std::get<material::FailureWave>(plate_.material); }

  void evolve_damage() {
    for_bands([&](Band& band) {
      for (Index cell = band.begin * nx_; cell < band.end * nx_; ++cell) {
        volumetric_[cell] = damage().volumetric(mean_strain(at(corners_.u, middles_.u, cell % nx_, cell / nx_), h_));
      }
    });
    evolution_->advance(volumetric_, dt_);
  }

  void spread_dilatancy() {
    for_bands([&](Band& band) {
      for (Index cell = band.begin * nx_; cell < band.end * nx_; ++cell) {
        ceiling_[cell] = failure().open_ceiling(mean_strain(at(corners_.u, middles_.u, cell % nx_, cell / nx_), h_));
      }
    });
    dilatancy_->advance(ceiling_, dt_);
  }

  /// books: also adds up what the material takes.
  void update_stress(bool books) {
    for_bands([&](Band& band) {
      for (Index j = band.begin; j < band.end; ++j) {
        Taken taken;
        for (Index cell = j * nx_; cell < (j + 1) * nx_; ++cell)
          answers_[cell] = answer(cell, dissipative && books ? &taken : nullptr);
        if (dissipative && books) taken_[j] = taken;
      }
    });
  }

  /// ψ of each triangle where the last step began and where it ended [J/m³].
  std::array<std::array<double, 2>, 4> stored_along(Index cell) const {
    const Triangles now = strains(at(corners_.u, middles_.u, cell % nx_, cell / nx_), h_),
                    rate = strains(at(corners_.v, middles_.v, cell % nx_, cell / nx_), h_);
    std::array<std::array<double, 2>, 4> energy{};
    for (Index t = 0; t < 4; ++t) energy[t] = {stored(cell, t, now[t] - rate[t] * dt_), stored(cell, t, now[t])};
    return energy;
  }

  /// Stresses of a cell at uⁿ; false if they are those of the whole solid, which are not kept. Adds to `taken` what
  /// damage and flow dissipate of each triangle [J/m³].
  bool answer(Index cell, Taken* taken) {
    material::CrackedStiffness now{solid_, solid_};
    bool own = false;
    const auto strain_of_cell = [&] { return strains(at(corners_.u, middles_.u, cell % nx_, cell / nx_), h_); };
    if constexpr (damaging) {
      const double crack_density = evolution_->crack_density()[cell];
      Cracked& cracked = cracked_[cell];
      if (crack_density != cracked.crack_density) {
        std::array<std::array<double, 2>, 4> before{};
        if (taken) before = stored_along(cell);
        cracked = {crack_density, damage().damaged_stiffness(crack_density)};
        if (taken) {
          const auto after = stored_along(cell);
          for (Index t = 0; t < 4; ++t)
            taken->by_damage += std::min(before[t][0] - after[t][0], before[t][1] - after[t][1]);
        }
      }
      if (crack_density != 0) {
        now = cracked.stiffness;
        own = true;
      }
    }
    double dilatancy = 0;
    if constexpr (failing) {
      dilatancy = dilatancy_->of_cells()[cell];
      own = dilatancy != 0;
    }
    if (!own && !plastic) return false;
    Triangles stress = strain_of_cell();
    for (Index t = 0; t < 4; ++t) {
      const Tensor strain = stress[t];
      const bool tension = strain.xx + strain.yy >= 0;
      if constexpr (failing) {
        stress[t] = failure().stress(strain, dilatancy);
      } else if constexpr (plastic) {
        PlasticStrain& flown = plastic_[cell][t];
        if (tension) {  // plastic strain is deviatoric
          stress[t] = now.open.stress(strain) - flown * (2 * now.open.shear);
        } else {
          double dissipated = 0;
          stress[t] = plate_.compression->stress(now.closed, strain, flown, dissipated);
          if (taken) taken->by_flow += dissipated;
        }
        own = own || flown.xx != 0 || flown.yy != 0 || flown.xy != 0;
      } else {
        stress[t] = (tension ? now.open : now.closed).stress(strain);
      }
    }
    if (own) stress_[cell] = stress;
    return own;
  }

  /// q of each triangle, of its rate of dilation. A whole cell that it acts in answers for itself.
  void resist() {
    const material::Viscosity& viscosity = *plate_.viscosity;
    const material::PlaneElastic& solid = elastic(plate_);
    const double speed = solid.pressure_wave_speed(), length = std::sqrt(h_.x * h_.y);
    double largest = 0;
    if (viscosity.needs_largest()) {
      for_bands([&](Band& band) {
        for (Index j = band.begin; j < band.end; ++j) {
          drag_[j].largest = 0;
          for (Index cell = j * nx_; cell < (j + 1) * nx_; ++cell) {
            for (const double D : dilation(cell)) {
              if (viscosity.acts(D)) drag_[j].largest = std::max(drag_[j].largest, std::abs(D));
            }
          }
        }
      });
      for (const Drag& row : drag_) largest = std::max(largest, row.largest);
    }
    for_bands([&](Band& band) {
      for (Index cell = band.begin * nx_; cell < band.end * nx_; ++cell) {
        const std::array<double, 4> D = dilation(cell);
        bool acts = false;
        for (Index t = 0; t < 4; ++t) {
          q_[cell][t] = viscosity.stress(D[t], largest, solid.density, speed, length);
          acts = acts || q_[cell][t] != 0;
        }
        if (!acts) continue;
        drag_[cell / nx_].acted = true;
        if (!answers_[cell]) stress_[cell] = whole_stress(cell);
        answers_[cell] = 1;
      }
    });
  }
  /// tr D of each triangle [1/s].
  std::array<double, 4> dilation(Index cell) const {
    const Triangles rate = strains(at(corners_.v, middles_.v, cell % nx_, cell / nx_), h_);
    return {rate[0].xx + rate[0].yy, rate[1].xx + rate[1].yy, rate[2].xx + rate[2].yy, rate[3].xx + rate[3].yy};
  }

  Triangles whole_stress(Index cell) const {
    Triangles stress = strains(at(corners_.u, middles_.u, cell % nx_, cell / nx_), h_);
    for (Tensor& t : stress) t = solid_.stress(t);
    return stress;
  }
  /// The material's, without q.
  Triangles stress_of(Index cell) const {
    if constexpr (!linear) {
      if (answers_[cell]) return stress_[cell];
    }
    return whole_stress(cell);
  }

  void read_gauges(long n) {
    const auto mean = [&](Index cell) {  // of pairs that change places in a mirror
      const auto [bottom, right, top, left] = stress_of(cell);
      return ((right + left) + (bottom + top)) * 0.25;
    };
    for (Index k = 0; k < gauges_.size(); ++k) {
      const Reading& r = readings_[k];
      const Tensor stress = mean(r.left) * r.of_left + mean(r.right) * r.of_right;
      gauges_[k].time.push_back(static_cast<double>(n) * dt_);
      gauges_[k].xx.push_back(stress.xx);
      gauges_[k].yy.push_back(stress.yy);
      if constexpr (failing) {
        const auto dilatancy = dilatancy_->of_cells();
        gauges_[k].dilatancy.push_back(dilatancy[r.left] * r.of_left + dilatancy[r.right] * r.of_right);
      }
    }
  }

  // ---- books ----

  static double along_diagonal(const Vector& v) { return (v[0] + v[1]) / std::sqrt(2.0); }

  void note_velocities() {
    for (BorderNode& b : border_) b.before = corners_.v[b.node];
    body_work_rate_ = body_work_rate();
  }
  double body_work_rate() const {
    double sum = 0;
    for (const Nodes* nodes : {&corners_, &middles_}) {
      const Index n = nodes->body.x.size();
      for (Index k = 0; k < n; ++k) sum += nodes->body.x[k] * nodes->v.x[k] + nodes->body.y[k] * nodes->v.y[k];
    }
    return sum;
  }

  /// Work and impulse of loads and of what holds or drives the sides. Their reactions follow from the motion:
  /// R = m Δv/τ − f; what a platen passes between its nodes does no work and adds up to nothing.
  void keep_work(double kick, Ledger& ledger) const {
    double before = body_work_rate_, after = body_work_rate();
    Vector force{};
    for (const Nodes* nodes : {&corners_, &middles_}) {
      force[0] = std::accumulate(nodes->body.x.begin(), nodes->body.x.end(), force[0]);
      force[1] = std::accumulate(nodes->body.y.begin(), nodes->body.y.end(), force[1]);
    }
    for (const BorderNode& b : border_) {
      const Vector v = corners_.v[b.node];
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
    ledger.before_kick(before, along_diagonal(force), kick);
    ledger.after_kick(after, kick);
  }

  /// Kinetic energy and momentum of all nodes.
  RowSums kinetic() const {
    RowSums sum;
    for (Index j = 0; j <= ny_; ++j) add(sum, kinetic(j));
    return sum;
  }
  static void add(RowSums& sum, const RowSums& row) {
    sum.kinetic += row.kinetic;
    sum.strain += row.strain;
    sum.dissipated += row.dissipated;
    sum.momentum = plus(sum.momentum, row.momentum);
  }
  /// Of a row of corners and of the middles above it.
  RowSums kinetic(Index j) const {
    const auto of = [](const Components& v, Index begin, Index end, double mass) {
      RowSums sum;
      for (Index k = begin; k < end; ++k) {
        sum.kinetic += v.x[k] * v.x[k] + v.y[k] * v.y[k];
        sum.momentum[0] += v.x[k];
        sum.momentum[1] += v.y[k];
      }
      return RowSums{mass * sum.kinetic / 2, 0, 0, {mass * sum.momentum[0], mass * sum.momentum[1]}};
    };
    const double mass = cell_mass_ * (j == 0 || j == ny_ ? 1 : 2) / 3;
    const Index begin = j * (nx_ + 1), end = begin + nx_ + 1;
    RowSums row = of(corners_.v, begin + 1, end - 1, mass);
    add(row, of(corners_.v, begin, begin + 1, mass / 2));
    add(row, of(corners_.v, end - 1, end, mass / 2));
    if (j < ny_) add(row, of(middles_.v, j * nx_, (j + 1) * nx_, cell_mass_ / 3));
    return row;
  }

  // With Fⁿ = −Σ A Bᵀσⁿ, the kick changes the kinetic energy by the work of the loads less ½ Σ A σⁿ:(εⁿ⁺¹ − εⁿ⁻¹). With
  // the energy ψ of what can be got back and
  //   Sⁿ⁺½ = Σ A [ψⁿ + ½ σⁿ:(εⁿ⁺¹ − εⁿ)]
  // this is −Sⁿ⁺½ + Sⁿ⁻½ − Dⁿ, where Dⁿ = Sⁿ⁻½ − Σ A [ψⁿ − ½ σⁿ:(εⁿ − εⁿ⁻¹)] is nothing for a linear solid. Of it the
  // material takes what damage takes at the least, the smaller of ψ(ε; C_dⁿ⁻¹) − ψ(ε; C_dⁿ) at both ends of the step,
  // and what flows, σⁿ:Δε_p: neither is ever negative. The rest is what the trapezium of the leapfrog misses of the
  // path between two steps, where cracks close, crack or flow in between: the scheme's.
  //
  // A failure wave has an energy, but its stress is not that energy's derivative, and neither is that of cracks which
  // close whole: all of Dⁿ is the material's, and of either sign.
  void measure_energies(Ledger& ledger) {
    for_bands([&](Band& band) {
      for (Index j = band.begin; j < band.end; ++j) {
        RowSums row = kinetic(j);
        for (Index i = 0; i < nx_; ++i) row.strain += recoverable(i, j);
        sums_[j] = row;
      }
    });
    sums_[ny_] = kinetic(ny_);
    if constexpr (dissipative) {
      if (ledger.keeps()) answered_ = answers_;
    }
    if constexpr (viscous) ledger.take_by_viscosity(viscous_work());
  }
  /// ½ Σ A q tr Δεⁿ⁺½: with the old q of the kick before this strain increment, with the new one of the kick after it.
  double viscous_work() {
    for_bands([&](Band& band) {
      for (Index j = band.begin; j < band.end; ++j) {
        double sum = 0;
        for (Index cell = j * nx_; cell < (j + 1) * nx_; ++cell) {
          const std::array<double, 4> D = dilation(cell);
          for (Index t = 0; t < 4; ++t) sum += q_[cell][t] * (D[t] * dt_);
        }
        drag_[j].work = h_.triangle_area() * sum / 2;
      }
    });
    double sum = 0;
    for (const Drag& row : drag_) sum += row.work;
    return sum;
  }
  /// Sⁿ⁺½ of a cell [J/m].
  double recoverable(Index i, Index j) {
    const Index cell = j * nx_ + i;
    const Triangles now = strains(at(corners_.u, middles_.u, i, j), h_);
    const Triangles rate = strains(at(corners_.v, middles_.v, i, j), h_);
    double sum = 0;
    for (Index t = 0; t < 4; ++t) sum += energy_between(cell, t, now[t] - rate[t] * dt_, now[t]);
    if constexpr (dissipative) {
      if (!recoverable_.empty()) recoverable_[cell] = sum;
    }
    return sum;
  }
  /// A [ψ + ½ σ:(ε − ε here)] of a triangle, ψ and σ where it stands, at the strain `here` [J/m].
  double energy_between(Index cell, Index t, const Tensor& here, const Tensor& strain) const {
    Tensor stress = solid_.stress(here);
    if constexpr (!linear) {
      if (answers_[cell]) stress = stress_[cell][t];
    }
    return h_.triangle_area() * (stored(cell, t, here) + stress.contract(strain - here) / 2);
  }
  /// ψ [J/m³].
  double stored(Index cell, [[maybe_unused]] Index t, const Tensor& strain) const {
    if constexpr (failing) {
      const double dilatancy = dilatancy_->of_cells()[cell];
      if (dilatancy != 0) return failure().stored(strain, dilatancy);
    }
    Stiffness solid = solid_;
    if constexpr (damaging) {
      if (cracked_[cell].crack_density != 0) solid = cracked_[cell].stiffness.at(strain);
    }
    if constexpr (plastic) return material::Compression::stored(solid, strain, plastic_[cell][t]);
    return solid.stress(strain).contract(strain) / 2;
  }

  void close_books(Ledger& ledger) {
    RowSums sum;
    for (const RowSums& row : sums_) add(sum, row);
    double between = 0;  // Dⁿ⁺¹
    if constexpr (dissipative) {
      if (ledger.keeps()) between = dissipation();
    }
    Taken all;
    for (const Taken& row : taken_) {
      all.by_damage += h_.triangle_area() * row.by_damage;
      all.by_flow += h_.triangle_area() * row.by_flow;
    }
    const double taken = has_potential() ? all.by_damage + all.by_flow : between;
    double viscous_after = 0;
    if constexpr (viscous) viscous_after = viscous_work();
    const double by_damage = !damaging ? 0 : has_potential() ? all.by_damage : between;
    ledger.close_line(sum.kinetic, sum.strain, taken, along_diagonal(sum.momentum), -viscous_after / 2, by_damage);
    ledger.take_by_scheme(between - taken);
    ledger.take_by_viscosity(viscous_after);
  }
  bool has_potential() const {
    if constexpr (failing) return false;
    if constexpr (damaging) return damage().has_potential();
    return true;
  }
  double dissipation() {
    for_bands([&](Band& band) {
      for (Index j = band.begin; j < band.end; ++j) {
        sums_[j].dissipated = 0;
        for (Index i = 0; i < nx_; ++i) {
          const Index cell = j * nx_ + i;
          if (!answers_[cell] && !answered_[cell]) continue;
          const Triangles now = strains(at(corners_.u, middles_.u, i, j), h_);
          const Triangles rate = strains(at(corners_.v, middles_.v, i, j), h_);
          double left = 0;
          for (Index t = 0; t < 4; ++t) left += energy_between(cell, t, now[t], now[t] - rate[t] * dt_);
          sums_[j].dissipated += recoverable_[cell] - left;
        }
      }
    });
    double sum = 0;
    for (const RowSums& row : sums_) sum += row.dissipated;
    return sum;
  }

  /// One task for each band; the same bits for any number of them.
  template <class Do>
  void for_bands(Do act) {
    threads_.for_each(bands_.size(), [&](Index k) { act(bands_[k]); });
  }

  const Plate& plate_;
  double dt_;
  Index nx_, ny_;
  CellSize h_;
  Stiffness solid_;
  WholeCell whole_;
  double cell_mass_;  // ρ h_x h_y [kg/m]: a third to its middle, a sixth to each corner
  Nodes corners_, middles_;
  Loops loops_;
  std::vector<Band> bands_;
  std::vector<BorderNode> border_;
  std::array<std::vector<Index>, 4> along_;  // places in the border, by side
  std::vector<Platen> platens_;
  std::vector<double> platen_;     // displacement of the first one after each step
  std::vector<Reading> readings_;  // per gauge
  std::vector<GaugeRecord> gauges_;
  // per cell, where not every cell is linear
  std::vector<Triangles> stress_;
  std::vector<unsigned char> answers_;  // 1 where the stress is not the whole solid's
  std::vector<std::array<PlasticStrain, 4>> plastic_;
  std::vector<Cracked> cracked_;
  std::vector<double> volumetric_;
  std::optional<diffusion::DamageEvolution> evolution_;
  std::vector<double> ceiling_;
  std::optional<diffusion::Dilatancy> dilatancy_;
  std::vector<std::array<double, 4>> q_;  // of triangles [Pa]
  std::vector<Drag> drag_;                // per row
  // for the books
  std::vector<RowSums> sums_;        // per row
  std::vector<Taken> taken_;         // per row
  std::vector<double> recoverable_;  // per cell, likewise [J/m]
  std::vector<unsigned char> answered_;
  double body_work_rate_ = 0;
  Threads threads_;
};

template <Kind kind>
PlateSnapshot Body<kind>::sample(long n) const {
  PlateSnapshot s;
  s.step = n;
  s.time = s.displacement.time = s.stress.time = static_cast<double>(n) * dt_;
  s.velocity.time = n == 0 ? 0 : s.time - dt_ / 2;
  const auto nodes_of = [&](const Nodes& nodes, auto x_of, auto y_of, bool middle) {
    for (Index j = 0; j < nodes.up; ++j) {
      for (Index i = 0; i < nodes.across; ++i) {
        const double sides_of = (i == 0 || i == nx_ ? 0.5 : 1) * (j == 0 || j == ny_ ? 0.5 : 1);
        for (PointField* f : {&s.displacement, &s.velocity}) {
          f->x.push_back(x_of(i));
          f->y.push_back(y_of(j));
          f->weight.push_back(h_.x * h_.y * (middle ? 1 : 2 * sides_of) / 3);
        }
        for (const Index c : {Index{0}, Index{1}}) {
          s.displacement.component[c].push_back(nodes.u[j * nodes.across + i][c]);
          s.velocity.component[c].push_back(nodes.v[j * nodes.across + i][c]);
        }
      }
    }
  };
  s.displacement.component.resize(2);
  s.velocity.component.resize(2);
  s.stress.component.resize(3);
  nodes_of(
      corners_, [&](Index i) { return corner_x(i); }, [&](Index j) { return corner_y(j); }, false);
  nodes_of(
      middles_, [&](Index i) { return middle_x(i); }, [&](Index j) { return middle_y(j); }, true);
  const material::TensileDamage undamaged{elastic(plate_)};
  for (Index j = 0; j < ny_; ++j) {
    for (Index i = 0; i < nx_; ++i) {
      const CellValues u = at(corners_.u, middles_.u, i, j);
      const Triangles stress = stress_of(j * nx_ + i);
      const Tensor mean = mean_strain(u, h_);
      if constexpr (damaging) {
        s.volumetric_strain.push_back(damage().volumetric(mean));
        s.strain.push_back(mean);
      } else {
        s.volumetric_strain.push_back(undamaged.volumetric(mean));
      }
      const std::array<Vector, 4> towards{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
      for (Index t = 0; t < 4; ++t) {
        s.stress.x.push_back(middle_x(i) + towards[t][0] * h_.x / 3);
        s.stress.y.push_back(middle_y(j) + towards[t][1] * h_.y / 3);
        s.stress.weight.push_back(h_.triangle_area());
        s.stress.component[0].push_back(stress[t].xx);
        s.stress.component[1].push_back(stress[t].yy);
        s.stress.component[2].push_back(stress[t].xy);
      }
    }
  }
  if (evolution_) {
    s.crack_density.assign(evolution_->crack_density().begin(), evolution_->crack_density().end());
    s.concentration.assign(evolution_->concentration().begin(), evolution_->concentration().end());
  }
  if (dilatancy_) {
    s.dilatancy.assign(dilatancy_->of_cells().begin(), dilatancy_->of_cells().end());
    s.concentration.assign(dilatancy_->of_nodes().begin(), dilatancy_->of_nodes().end());
  }
  return s;
}

}  // namespace

PlateRecord run(const Plate& plate, const Cells& cells, const std::optional<diffusion::Evolution>& evolution,
                const Stepping& stepping, const std::optional<diffusion::Spread>& spread) {
  check(plate, cells, evolution, spread);
  const auto go = [&]<Kind kind>() {
    Body<kind> body(plate, cells, evolution, spread, stepping);
    return take_steps<PlateRecord>(body, stepping);
  };
  if (spread) {
    return plate.viscosity ? go.template operator()<Kind{false, false, true, true}>()
                           : go.template operator()<Kind{false, false, true, false}>();
  }
  if (plate.viscosity) return go.template operator()<Kind{false, false, false, true}>();
  if (evolution) {
    return plate.compression ? go.template operator()<Kind{true, true, false, false}>()
                             : go.template operator()<Kind{true, false, false, false}>();
  }
  return plate.compression ? go.template operator()<Kind{false, true, false, false}>()
                           : go.template operator()<Kind{false, false, false, false}>();
}

}  // namespace diptych::fem
