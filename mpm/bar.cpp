#include "mpm/bar.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "material/stepping.hpp"

namespace diptych::mpm {
namespace {

/// Contributions of one cell's particles to its left and right node.
struct Pair {
  double left = 0, right = 0;
  Pair operator+(const Pair& o) const { return {left + o.left, right + o.right}; }
};

/// All that the grid knows of a node, in one record.
struct Node {
  double mass = 0, velocity = 0, force = 0, acceleration = 0;
};

/// A traction's force on a node.
struct NodalForce {
  std::size_t node;
  double force;
};

/// A particle stands in a cell at an offset η = ξ − ½ from its centre, so that N₁ = ½ − η, N₂ = ½ + η (eq. 6):
/// mirroring the bar or shifting it by whole cells leaves every bit of the shape functions alone. A particle on a node
/// stays one ulp inside its cell: no node it touches is without mass, and the limit ξ → 0 is taken rather than 0/0.
constexpr double edge = 0.5 - 0x1p-54;

template <class Law, bool convected>
class Bar {
 public:
  Bar(const Scene& scene, const Law& law, int cells, const std::vector<double>& positions, Scheme scheme,
      const Stepping& stepping)
      : scene_(scene),
        law_(law),
        positions_(positions),
        scheme_(scheme),
        dt_(stepping.time_step),
        h_(scene.length / cells),
        per_cell_(positions.size()),
        cells_(static_cast<std::size_t>(cells)),
        particle_mass_(law.density * h_ / static_cast<double>(per_cell_)),
        first_cell_(convected && scene.left == Support::free ? cells_ : 0),
        grid_cells_(first_cell_ + cells_ + (convected && scene.right == Support::free ? cells_ : 0)),
        node_(grid_cells_ + 1),
        cell_start_(grid_cells_ + 1) {
    place_particles();
    choose_boundary_layers();
    map_mass();
    if (scheme_ == Scheme::usf) bring_usf_to_its_half_step();
  }

  void step(long n, Ledger* ledger) {
    if (scheme_ == Scheme::usf) step_usf(n, ledger);
    if (scheme_ == Scheme::usl) step_usl(n, ledger);
    if (scheme_ == Scheme::musl) step_musl(n, ledger);
  }

  // Update stress first: (vⁿ, σⁿ⁻½) → (vⁿ⁺¹, σⁿ⁺½).
  void step_usf(long n, Ledger* ledger) {
    const Kick kick = kick_after(n, dt_);
    map_momentum();
    if (n > 0) {  // the half-step from 0 to ½ is behind
      if (ledger) ledger->after_kick(work_rate(), dt_);
      update_stress(dt_, ledger);  // with the particles' velocities on the grid
    }
    internal_force();      // eq. 19
    external_force(kick);  // eqs. 16, 17, 20
    if (ledger) ledger->before_kick(work_rate(), impulse_rate(), kick.length);
    integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);     // eq. 11
    move_particles(dt_);              // eqs. 9, 10
    convect();
  }

  // Update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_usl(long n, Ledger* ledger) {
    const Kick kick = kick_around(n, dt_);
    map_momentum();
    internal_force();      // eq. 19
    external_force(kick);  // eqs. 16, 17, 20
    if (ledger) ledger->before_kick(work_rate(), impulse_rate(), kick.length);
    integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);     // eq. 11
    move_particles(dt_);              // eqs. 9, 10
    if (ledger) ledger->after_kick(work_rate(), kick.length);
    update_stress(dt_, ledger);  // with the grid's own new velocities
    convect();
  }

  // Modified update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_musl(long n, Ledger* ledger) {
    const Kick kick = kick_around(n, dt_);
    map_momentum();
    internal_force();      // eq. 19
    external_force(kick);  // eqs. 16, 17, 20
    if (ledger) ledger->before_kick(work_rate(), impulse_rate(), kick.length);
    integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);     // eq. 11
    move_particles(dt_);              // eqs. 9, 10
    map_momentum();
    if (ledger) ledger->after_kick(work_rate(), kick.length);
    update_stress(dt_, ledger);  // with the particles' new velocities, mapped once more
    convect();
  }

  Snapshot sample(long n) const {
    const double time = static_cast<double>(n) * dt_, half = dt_ / 2;
    const bool usf = scheme_ == Scheme::usf;
    Snapshot s;
    s.step = n;
    s.stress.time = usf ? time - half : time;
    s.velocity.time = usf ? time : time - half;
    s.displacement.time = usf ? time + half : time;
    for (std::size_t p = 0; p < offset_.size(); ++p) {
      s.stress.x.push_back(reference(p));
      s.stress.edges.push_back(share_begin(p));
      s.stress.value.push_back(state_[p].stress);
    }
    s.stress.edges.push_back(scene_.length);
    s.velocity.x = s.displacement.x = s.stress.x;
    s.velocity.value = velocity_;
    s.displacement.value = displacement_;
    return s;
  }

  const std::string& trouble() const { return trouble_; }
  double first_ledger_time() const { return scheme_ == Scheme::usf ? dt_ : dt_ / 2; }
  double energy() const {
    double sum = kinetic_energy();
    for (std::size_t p = 0; p < state_.size(); ++p) sum += length(p) * law_.stored(state_[p]);
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (const double v : velocity_) sum += particle_mass_ * v;
    return sum;
  }
  double free_mass() const {
    return scene_.left == Support::free && scene_.right == Support::free ? law_.density * scene_.length : 0;
  }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{Law::feature};
    if (!body_.empty()) active.push_back("body-force");
    if (!advance_.empty()) active.push_back("convection");
    if (std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) { return !layer.empty(); })) {
      active.push_back("boundary-layer");
    }
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return {0, static_cast<long>(offset_.size()) * steps, static_cast<long>(node_.size()) * steps,
            bytes(offset_) + bytes(state_) + bytes(velocity_) + bytes(displacement_) + bytes(cell_) + bytes(length_) +
                bytes(advance_) + bytes(node_) + bytes(body_) + bytes(cell_start_)};
  }

 private:
  // --- particles and cells -------------------------------------------------------------------------------------------

  void place_particles() {
    const std::size_t count = cells_ * per_cell_;
    offset_.resize(count);
    state_.resize(count);
    velocity_.resize(count);
    displacement_.resize(count);
    if constexpr (convected) {
      cell_.resize(count);
      length_.assign(count, h_ / static_cast<double>(per_cell_));
      advance_.resize(count);
    }
    for (std::size_t p = 0; p < count; ++p) {
      offset_[p] = std::clamp(positions_[p % per_cell_] - 0.5, -edge, edge);
      if constexpr (convected) cell_[p] = static_cast<std::int32_t>(first_cell_ + p / per_cell_);
      if (scene_.initial_stress) state_[p].stress = scene_.initial_stress(reference(p));
      if (scene_.initial_velocity) velocity_[p] = scene_.initial_velocity(reference(p));
    }
    for (std::size_t c = 0; c <= grid_cells_; ++c) {
      cell_start_[c] = (std::clamp(c, first_cell_, first_cell_ + cells_) - first_cell_) * per_cell_;
    }
  }

  /// USF keeps the velocity at whole steps and stress and displacement half-way between them.
  void bring_usf_to_its_half_step() {
    map_momentum();
    update_stress<false>(dt_ / 2, nullptr);
    move_particles(dt_ / 2);
    convect();
  }

  /// Length of bar that a particle stands for: constant unless the particles move.
  double length(std::size_t p) const {
    if constexpr (convected) return length_[p];
    return h_ / static_cast<double>(per_cell_);
  }
  /// Where a particle started.
  double reference(std::size_t p) const {
    const double cell = static_cast<double>(p / per_cell_) + positions_[p % per_cell_];
    return scene_.length * (cell / static_cast<double>(cells_));
  }
  /// Left end of a particle's share of the bar, in reference coordinates.
  double share_begin(std::size_t p) const {
    return scene_.length * (static_cast<double>(p) / static_cast<double>(cells_ * per_cell_));
  }
  double position(std::size_t cell, std::size_t p) const {
    return (static_cast<double>(cell) - static_cast<double>(first_cell_) + 0.5 + offset_[p]) * h_;
  }
  bool has_particles(std::size_t cell) const { return cell_start_[cell] < cell_start_[cell + 1]; }

  /// Sum over a cell's particles from the outside in: a mirrored bar adds the same numbers in the same order.
  template <class F>
  auto sum_over_cell(std::size_t cell, F&& f) const {
    std::size_t low = cell_start_[cell], high = cell_start_[cell + 1];
    decltype(f(low)) sum{};
    for (; low + 1 < high; ++low) {
      --high;
      sum = sum + (f(low) + f(high));
    }
    if (low < high) sum = sum + f(low);
    return sum;
  }

  /// Visits the nodes in order with the sum of what the two neighbouring cells' particles give to each.
  template <class F, class Visit>
  void gather(F&& particle_contribution, Visit&& visit) {
    double carried = 0;
    for (std::size_t c = 0; c < grid_cells_; ++c) {
      const Pair sum = sum_over_cell(c, particle_contribution);
      visit(node_[c], carried + sum.left);
      carried = sum.right;
    }
    visit(node_[grid_cells_], carried);
  }

  // --- particles to grid ---------------------------------------------------------------------------------------------

  void map_mass() {  // eq. 15
    gather(
        [&](std::size_t p) {
          return Pair{particle_mass_ * (0.5 - offset_[p]), particle_mass_ * (0.5 + offset_[p])};
        },
        [](Node& node, double mass) { node.mass = mass; });
  }

  void map_momentum() {
    gather(
        [&](std::size_t p) {
          const double momentum = particle_mass_ * velocity_[p];
          return Pair{(0.5 - offset_[p]) * momentum, (0.5 + offset_[p]) * momentum};
        },
        [](Node& node, double momentum) { node.velocity = node.mass > 0 ? momentum / node.mass : 0; });
    hold_supports();
  }

  void internal_force() {  // eq. 19: gradients −1/h and 1/h
    gather(
        [&](std::size_t p) {
          const double force = length(p) / h_ * state_[p].stress;
          return Pair{force, -force};
        },
        [](Node& node, double force) { node.force = force; });
  }

  void external_force(const Kick& kick) {
    nodal_forces_.clear();
    for (std::size_t k = 0; k < scene_.loads.size(); ++k) {
      const Load& load = scene_.loads[k];
      const double traction = (load.end == End::left ? -1 : 1) * load.mean_traction(kick.from, kick.to);
      if (load.transfer == Transfer::node) {
        nodal_forces_.push_back({load.end == End::left ? left_end_node() : right_end_node(), traction});
      } else {
        boundary_layer_force(layers_[k], traction);
      }
    }
    for (const NodalForce& f : nodal_forces_) node_[f.node].force += f.force;
    if (scene_.body_force) add_body_force((kick.from + kick.to) / 2);
  }

  struct LayerPoint {
    std::size_t particle;
    double share;  ///< M_p h⁻¹ of eq. 16 in lengths: the part of the layer that this particle fills
  };

  void boundary_layer_force(const std::vector<LayerPoint>& layer, double traction) {  // eq. 16
    for (const LayerPoint& point : layer) {
      const std::size_t cell = cell_of(point.particle);
      const double force = traction * point.share;
      nodal_forces_.push_back({cell, (0.5 - offset_[point.particle]) * force});
      nodal_forces_.push_back({cell + 1, (0.5 + offset_[point.particle]) * force});
    }
  }

  void choose_boundary_layers() {
    for (const Load& load : scene_.loads) {
      auto& layer = layers_.emplace_back();
      if (load.transfer != Transfer::boundary_layer) continue;
      const double thickness = load.layer_thickness;
      // From the surface inwards, counted from the loaded end: a mirrored bar adds the same numbers in the same order.
      for (std::size_t q = 0; q < offset_.size(); ++q) {
        const double begin = share_begin(q), end = share_begin(q + 1);  // depths under the surface
        const double inside = std::min(end - begin, thickness - begin);
        if (inside > 0) layer.push_back({load.end == End::left ? q : offset_.size() - 1 - q, inside / thickness});
      }
    }
  }

  void add_body_force(double time) {  // eq. 17a
    body_.resize(node_.size());
    std::size_t i = 0;
    double carried = 0;
    for (; i < grid_cells_; ++i) {
      const Pair sum = sum_over_cell(i, [&](std::size_t p) {
        const double force = particle_mass_ * scene_.body_force(position(i, p), time);
        return Pair{(0.5 - offset_[p]) * force, (0.5 + offset_[p]) * force};
      });
      body_[i] = carried + sum.left;
      carried = sum.right;
    }
    body_[i] = carried;
    for (i = 0; i < node_.size(); ++i) node_[i].force += body_[i];
  }

  // --- the grid ------------------------------------------------------------------------------------------------------

  void integrate_momentum(double kick) {  // eq. 18
    for (Node& node : node_) {
      node.acceleration = node.mass > 0 ? node.force / node.mass : 0;
      node.velocity += kick * node.acceleration;
    }
    hold_supports();
  }

  void hold_supports() {
    if (scene_.left == Support::fixed) node_[0].velocity = node_[0].acceleration = 0;
    if (scene_.right == Support::fixed) node_[grid_cells_].velocity = node_[grid_cells_].acceleration = 0;
  }

  // --- grid to particles ---------------------------------------------------------------------------------------------

  template <class F>
  void for_each_particle(F&& f) {
    for (std::size_t c = 0; c < grid_cells_; ++c) {
      for (std::size_t p = cell_start_[c]; p < cell_start_[c + 1]; ++p) f(p, node_[c], node_[c + 1]);
    }
  }

  void update_velocity(double kick) {
    for_each_particle([&](std::size_t p, const Node& left, const Node& right) {
      velocity_[p] += kick * ((0.5 - offset_[p]) * left.acceleration + (0.5 + offset_[p]) * right.acceleration);
    });
  }

  void move_particles(double drift) {
    for_each_particle([&](std::size_t p, const Node& left, const Node& right) {
      const double increment = drift * ((0.5 - offset_[p]) * left.velocity + (0.5 + offset_[p]) * right.velocity);
      displacement_[p] += increment;
      if constexpr (convected) advance_[p] = increment / h_;  // the grid is left behind only when the step is done
    });
  }

  void update_stress(double strain_time, Ledger* ledger) {
    if (ledger) {
      update_stress<true>(strain_time, ledger);
    } else {
      update_stress<false>(strain_time, nullptr);
    }
  }

  template <bool with_ledger>
  void update_stress(double strain_time, Ledger* ledger) {
    double strain_energy = 0, dissipated = 0;
    for_each_particle([&](std::size_t p, const Node& left, const Node& right) {
      const double strain_increment = strain_time * (right.velocity - left.velocity) / h_;
      if constexpr (with_ledger) {
        strain_energy += length(p) * (law_.stored(state_[p]) + state_[p].stress * strain_increment / 2);
      }
      const material::Response response = law_.update(state_[p], strain_increment);
      if constexpr (with_ledger) dissipated += length(p) * response.dissipated;
      if constexpr (convected) length_[p] *= 1 + strain_increment;  // eq. 1
    });
    if constexpr (with_ledger) ledger->close_line(kinetic_energy(), strain_energy, dissipated, momentum());
  }

  // --- crossing cells ------------------------------------------------------------------------------------------------

  void convect() {
    if constexpr (convected) {
      for (std::size_t p = 0; p < offset_.size(); ++p) {
        const double offset = offset_[p] + advance_[p];
        if (std::abs(offset) > 0.5) {
          cross(p, offset);
        } else {
          offset_[p] = std::clamp(offset, -edge, edge);
        }
      }
      count_particles();
      map_mass();
    }
  }

  void cross(std::size_t p, double offset) {
    const double cells_crossed = std::round(offset);
    const double target = static_cast<double>(cell_[p]) + cells_crossed;
    if (target >= 0 && target < static_cast<double>(grid_cells_)) {
      cell_[p] = static_cast<std::int32_t>(target);
      offset_[p] = std::clamp(offset - cells_crossed, -edge, edge);
    } else if (std::abs(offset) <= 0.5 + 1e-9) {  // round-off beyond a wall
      offset_[p] = std::clamp(offset, -edge, edge);
    } else {
      trouble_ = "particle " + std::to_string(p) + " left the grid, which reaches one bar length beyond a free end";
    }
  }

  void count_particles() {
    std::size_t p = 0;
    for (std::size_t c = 0; c <= grid_cells_; ++c) {
      while (p < cell_.size() && static_cast<std::size_t>(cell_[p]) < c) ++p;
      cell_start_[c] = p;
    }
    if (!std::is_sorted(cell_.begin(), cell_.end()) && trouble_.empty()) trouble_ = "particles passed one another";
  }

  std::size_t cell_of(std::size_t p) const {
    if constexpr (convected) return static_cast<std::size_t>(cell_[p]);
    return p / per_cell_;
  }
  std::size_t left_end_node() const { return cell_of(0); }
  std::size_t right_end_node() const { return cell_of(offset_.size() - 1) + 1; }

  // --- books ---------------------------------------------------------------------------------------------------------

  double kinetic_energy() const {
    double sum = 0;
    for (const double v : velocity_) sum += particle_mass_ * v * v / 2;
    return sum;
  }

  double work_rate() const {
    double sum = 0;
    for (const NodalForce& f : nodal_forces_) sum += f.force * node_[f.node].velocity;
    for (std::size_t i = 0; i < body_.size(); ++i) sum += body_[i] * node_[i].velocity;
    return sum;
  }

  // Loads plus reactions: a support takes up whatever force stands at its node.
  double impulse_rate() const {
    double sum = 0;
    for (const NodalForce& f : nodal_forces_) sum += f.force;
    for (const double b : body_) sum += b;
    if (scene_.left == Support::fixed) sum -= node_[0].force;
    if (scene_.right == Support::fixed) sum -= node_[grid_cells_].force;
    return sum;
  }

  const Scene& scene_;
  const Law& law_;
  const std::vector<double>& positions_;
  Scheme scheme_;
  double dt_, h_;
  std::size_t per_cell_, cells_;
  double particle_mass_;
  std::size_t first_cell_, grid_cells_;  // the bar starts in first_cell_; moving bars have room on their free sides

  std::vector<Node> node_;
  std::vector<std::size_t> cell_start_;  // particles of cell c are [cell_start_[c], cell_start_[c+1])
  // Particles, in the order of the bar and hence of the cells:
  std::vector<double> offset_, velocity_, displacement_;
  std::vector<typename Law::State> state_;
  std::vector<std::int32_t> cell_;        // only where particles move
  std::vector<double> length_, advance_;  // likewise
  std::vector<double> body_;              // per node, only with a body force
  std::vector<NodalForce> nodal_forces_;  // of the current step
  std::vector<std::vector<LayerPoint>> layers_;
  std::string trouble_;
};

double courant_limit(const std::vector<double>& positions, Scheme scheme, bool convected) {
  const auto count = static_cast<double>(positions.size());
  double mean = 0, filter = 0;
  for (const double xi : positions) {
    mean += xi / count;
    filter += 4 * xi * (1 - xi) / count;
  }
  // The end cell of a free bar may limit first: its two nodes carry the shares x̄ and 1 − x̄ of the cell's mass alone.
  const double spread = mean * (1 - mean), gradient_kept = spread > 0 ? std::max(0.0, 1 - filter / (4 * spread)) : 0;
  if (scheme == Scheme::usl) return std::min(2 * std::sqrt(spread / (2 - gradient_kept)), 1 / std::sqrt(1 + filter));
  if (convected) return 1;  // reached when every particle stands on a node
  const double q = filter > 0.5 ? 1 / (2 * filter) : 1, inside = 1 / std::sqrt(q * (1 - filter * q));
  return gradient_kept > 0 ? std::min(inside, 2 * std::sqrt(spread / gradient_kept)) : inside;
}

}  // namespace

double critical_time_step(const Scene& scene, int cells, const std::vector<double>& positions, Scheme scheme) {
  return courant_limit(positions, scheme, scene.convected) * scene.length / cells /
         material::wave_speed(scene.material);
}

Record run(const Scene& scene, int cells, const std::vector<double>& positions, Scheme scheme,
           const Stepping& stepping) {
  if (cells < 1 || positions.empty()) throw std::invalid_argument("mpm needs at least one cell and one particle");
  const auto go = [&](const auto& law, auto moving) {
    Bar<std::decay_t<decltype(law)>, decltype(moving)::value> bar(scene, law, cells, positions, scheme, stepping);
    return take_steps(bar, stepping);
  };
  return std::visit(
      [&](const auto& law) { return scene.convected ? go(law, std::true_type{}) : go(law, std::false_type{}); },
      scene.material);
}

}  // namespace diptych::mpm
