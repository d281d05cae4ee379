// Bars of particles and their step, for one law: what bar_elastic.cpp and bar_hardening.cpp compile.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "hinge/step/stepping.hpp"
#include "mpm/bar.hpp"

namespace diptych::mpm::bars {

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
inline constexpr double edge = 0.5 - 0x1p-54;

/// What a particle must carry beside its state: nothing where one bar fills the grid cell by cell and stays; its cell
/// and mass where several bars stand in it; and its stretch where it moves.
enum class Carries { nothing, cell, stretch };

template <class Law, Carries carries, bool viscous>
class Bars {
 public:
  static constexpr bool placed = carries != Carries::nothing, convected = carries == Carries::stretch;

  Bars(const Scene& scene, const std::vector<Law>& laws, int cells, const std::vector<double>& positions, Scheme scheme,
       const Stepping& stepping)
      : scene_(scene),
        positions_(positions),
        scheme_(scheme),
        dt_(stepping.time_step),
        h_(scene.bars[0].length / cells),
        c_max_(largest_wave_speed(scene)),
        per_cell_(positions.size()) {
    for (std::size_t b = 0, first = 0; b < scene.bars.size(); ++b) {
      const auto count = static_cast<std::size_t>(cells_of(scene, b, cells));
      members_.push_back(
          {laws[b], count, first, first + count * per_cell_, laws[b].density * h_ / static_cast<double>(per_cell_)});
      first = members_.back().last;
    }
    lay_grid();
    place_particles();
    choose_boundary_layers();
    map_mass();
    watch_contacts(0);
    if (scheme_ == Scheme::usf) bring_usf_to_its_half_step();
  }

  void step(long n, Ledger& ledger) {
    if (scheme_ == Scheme::usf) step_usf(n, ledger);
    if (scheme_ == Scheme::usl) step_usl(n, ledger);
    if (scheme_ == Scheme::musl) step_musl(n, ledger);
    if constexpr (convected) watch_contacts(n + 1);
  }

  // Update stress first: (vⁿ, σⁿ⁻½) → (vⁿ⁺¹, σⁿ⁺½).
  void step_usf(long n, Ledger& ledger) {
    const Kick kick = kick_after(n, dt_);
    map_momentum();
    if (n > 0 && !ledger.keeps()) ledger.after_kick(work_rate(), kick.length);  // the last one's, while the grid has it
    if (n > 0) update_stress(dt_, ledger);  // with the particles' velocities; the half-step from 0 to ½ is behind
    internal_force();                       // eq. 19
    if (n > 0) account_for_remapping(ledger);
    external_force(kick);  // eqs. 16, 17, 20
    ledger.before_kick(work_rate(), impulse_rate(), kick.length);
    integrate_momentum(kick.length);                    // eq. 18
    update_velocity(kick.length);                       // eq. 11
    move_particles(dt_);                                // eqs. 9, 10
    if (ledger.keeps()) end_kick(kick.length, ledger);  // maps them at once
    convect();
  }

  // Update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_usl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    map_momentum();
    internal_force();               // eq. 19
    account_for_remapping(ledger);  // since the last update
    external_force(kick);           // eqs. 16, 17, 20
    begin_kick(kick.length, ledger);
    integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);     // eq. 11
    move_particles(dt_);              // eqs. 9, 10
    ledger.after_kick(work_rate(), kick.length);
    account_for_lumping(kick.length, ledger);
    update_stress(dt_, ledger);  // with the grid's own new velocities
    note_velocities();
    convect();
  }

  // Modified update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_musl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    map_momentum();
    internal_force();               // eq. 19
    account_for_remapping(ledger);  // since the last update
    external_force(kick);           // eqs. 16, 17, 20
    ledger.before_kick(work_rate(), impulse_rate(), kick.length);
    integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);     // eq. 11
    move_particles(dt_);              // eqs. 9, 10
    map_momentum();
    ledger.after_kick(work_rate(), kick.length);
    update_stress(dt_, ledger);  // with the particles' new velocities, mapped once more
    convect();
  }

  Snapshot sample(long n) const {
    const double time = static_cast<double>(n) * dt_, half = dt_ / 2;
    const bool usf = scheme_ == Scheme::usf;
    Snapshot s;
    s.step = n;
    s.stress.time = usf ? std::max(time - half, half) : time;
    s.velocity.time = usf ? time : std::max(time - half, 0.0);
    s.displacement.time = usf ? time + half : time;
    s.stress.first.clear();
    for (std::size_t b = 0; b < members_.size(); ++b) {
      const std::size_t count = members_[b].last - members_[b].first;
      s.stress.first.push_back(members_[b].first);
      for (std::size_t k = 0; k <= count; ++k) s.stress.edges.push_back(share_begin(b, k));
      for (std::size_t k = 0; k < count; ++k) s.stress.x.push_back(reference(b, k));
    }
    for (const auto& state : state_) s.stress.value.push_back(state.stress);
    s.velocity.first = s.displacement.first = s.stress.first;
    s.velocity.x = s.displacement.x = s.stress.x;
    s.velocity.value = velocity_;
    s.displacement.value = displacement_;
    return s;
  }

  const std::string& trouble() const { return trouble_; }
  static double gives_back() { return 0; }
  double first_ledger_time() const { return scheme_ == Scheme::usf ? dt_ : dt_ / 2; }
  double energy() const {
    double sum = kinetic_energy();
    for (const Member& member : members_) {
      for (std::size_t p = member.first; p < member.last; ++p) sum += rest_length() * member.law.stored(state_[p]);
    }
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (std::size_t p = 0; p < velocity_.size(); ++p) sum += mass(p) * velocity_[p];
    return sum;
  }
  double free_mass() const {
    double sum = 0;
    if (scene_.left == Support::free && scene_.right == Support::free) {
      for (const Member& member : members_)
        sum += static_cast<double>(member.last - member.first) * member.particle_mass;
    }
    return sum;
  }
  void hand_over(Record& record) { record.touches = touches_; }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{Law::feature};
    if (!body_.empty()) active.push_back("body-force");
    if (!advance_.empty()) active.push_back("convection");
    if (members_.size() > 1) active.push_back("contact");
    if (!q_.empty()) active.push_back("viscosity");
    if (std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) { return !layer.empty(); })) {
      active.push_back("boundary-layer");
    }
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return {0, static_cast<long>(offset_.size()) * steps, static_cast<long>(node_.size()) * steps,
            bytes(offset_) + bytes(state_) + bytes(velocity_) + bytes(displacement_) + bytes(cell_) + bytes(mass_) +
                bytes(stretch_) + bytes(advance_) + bytes(q_) + bytes(node_) + bytes(body_) + bytes(cell_start_)};
  }

 private:
  // --- particles and cells -------------------------------------------------------------------------------------------

  /// One bar of the scene: its particles are [first, last).
  struct Member {
    Law law;
    std::size_t cells, first, last;
    double particle_mass;
  };

  /// The grid has a face where the first bar begins. Bars that move have room on their free sides.
  void lay_grid() {
    const double span = scene_.end() - scene_.begin();
    auto cells = static_cast<std::size_t>(std::ceil(span / h_ * (1 - 1e-12)));
    if constexpr (!placed) cells = members_[0].cells;
    first_cell_ = convected && scene_.left == Support::free ? cells : 0;
    grid_cells_ = first_cell_ + cells + (convected && scene_.right == Support::free ? cells : 0);
    node_.resize(grid_cells_ + 1);
    cell_start_.resize(grid_cells_ + 1);
  }

  void place_particles() {
    const std::size_t count = members_.back().last;
    offset_.resize(count);
    state_.resize(count);
    velocity_.resize(count);
    displacement_.resize(count);
    if constexpr (placed) {
      cell_.resize(count);
      mass_.resize(count);
    }
    if constexpr (convected) {
      stretch_.assign(count, 1);
      advance_.resize(count);
    }
    if constexpr (viscous) q_.resize(count);
    for (std::size_t b = 0; b < members_.size(); ++b) {
      const Bar& bar = scene_.bars[b];
      // Where the bar begins, in cells; a whole number but for round-off is whole, so that its shape functions are to
      // the bit those of the bar alone.
      double begin = (bar.begin - scene_.begin()) / h_;
      if (std::abs(begin - std::round(begin)) < 1e-9) begin = std::round(begin);
      const double shift = begin - std::floor(begin);
      for (std::size_t p = members_[b].first; p < members_[b].last; ++p) {
        const std::size_t k = p - members_[b].first;
        double offset = positions_[k % per_cell_] - 0.5 + shift;
        auto cell = static_cast<std::int32_t>(first_cell_ + static_cast<std::size_t>(begin) + k / per_cell_);
        if (offset > 0.5) {
          offset -= 1;
          ++cell;
        }
        offset_[p] = std::clamp(offset, -edge, edge);
        if constexpr (placed) {
          cell_[p] = cell;
          mass_[p] = members_[b].particle_mass;
        }
        if (bar.initial_stress) state_[p].stress = bar.initial_stress(reference(b, k));
        if (bar.initial_velocity) velocity_[p] = bar.initial_velocity(reference(b, k));
      }
    }
    if constexpr (placed) {
      count_particles();
    } else {
      for (std::size_t c = 0; c <= grid_cells_; ++c) cell_start_[c] = c * per_cell_;
    }
  }

  /// USF keeps the velocity at whole steps and stress and displacement half-way between them.
  void bring_usf_to_its_half_step() {
    map_momentum();
    update_stress<false>(dt_ / 2, nullptr);
    move_particles(dt_ / 2);
    convect();
  }

  double rest_length() const { return h_ / static_cast<double>(per_cell_); }
  /// Length of bar that a particle stands for: constant unless the particles move.
  double length(std::size_t p) const {
    if constexpr (convected) return rest_length() * stretch_[p];
    return rest_length();
  }
  double mass(std::size_t p) const {
    if constexpr (placed) return mass_[p];
    return members_[0].particle_mass;
  }
  double stress(std::size_t p) const {
    if constexpr (viscous) return state_[p].stress + q_[p];
    return state_[p].stress;
  }
  /// Where the k-th particle of a bar started.
  double reference(std::size_t b, std::size_t k) const {
    const double cell = static_cast<double>(k / per_cell_) + positions_[k % per_cell_];
    return scene_.bars[b].begin + scene_.bars[b].length * (cell / static_cast<double>(members_[b].cells));
  }
  /// Left end of its share of the bar, in reference coordinates.
  double share_begin(std::size_t b, std::size_t k) const {
    return scene_.bars[b].begin +
           scene_.bars[b].length * (static_cast<double>(k) / static_cast<double>(members_[b].cells * per_cell_));
  }
  double position(std::size_t cell, std::size_t p) const {
    return scene_.begin() + (static_cast<double>(cell) - static_cast<double>(first_cell_) + 0.5 + offset_[p]) * h_;
  }

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
          return Pair{mass(p) * (0.5 - offset_[p]), mass(p) * (0.5 + offset_[p])};
        },
        [](Node& node, double mass) { node.mass = mass; });
  }

  void map_momentum() {
    gather(
        [&](std::size_t p) {
          const double momentum = mass(p) * velocity_[p];
          return Pair{(0.5 - offset_[p]) * momentum, (0.5 + offset_[p]) * momentum};
        },
        [](Node& node, double momentum) { node.velocity = node.mass > 0 ? momentum / node.mass : 0; });
    hold_supports();
  }

  void internal_force() {  // eq. 19: gradients −1/h and 1/h
    gather(
        [&](std::size_t p) {
          const double force = length(p) / h_ * stress(p);
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
      const Member& member = load.end == End::left ? members_.front() : members_.back();
      // From the surface inwards, counted from the loaded end: a mirrored bar adds the same numbers in the same order.
      for (std::size_t q = 0; q < member.last - member.first; ++q) {
        const double begin = share_depth(member, q), end = share_depth(member, q + 1);
        const double inside = std::min(end - begin, thickness - begin);
        if (inside > 0)
          layer.push_back({load.end == End::left ? member.first + q : member.last - 1 - q, inside / thickness});
      }
    }
  }
  /// Depth under a bar's surface at which the share of its q-th particle begins.
  double share_depth(const Member& member, std::size_t q) const {
    const double length = scene_.bars[static_cast<std::size_t>(&member - members_.data())].length;
    return length * (static_cast<double>(q) / static_cast<double>(member.cells * per_cell_));
  }

  void add_body_force(double time) {  // eq. 17a
    body_.resize(node_.size());
    std::size_t i = 0;
    double carried = 0;
    for (; i < grid_cells_; ++i) {
      const Pair sum = sum_over_cell(i, [&](std::size_t p) {
        const double force = mass(p) * scene_.body_force(position(i, p), time);
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

  /// Calls f(p, left node, right node) for the particles of one bar.
  template <class F>
  void for_each_particle(const Member& member, F&& f) {
    if constexpr (placed) {
      for (std::size_t p = member.first; p < member.last; ++p) {
        const auto c = static_cast<std::size_t>(cell_[p]);
        f(p, node_[c], node_[c + 1]);
      }
    } else {
      for (std::size_t c = 0; c < grid_cells_; ++c) {
        for (std::size_t p = c * per_cell_; p < (c + 1) * per_cell_; ++p) f(p, node_[c], node_[c + 1]);
      }
    }
  }
  template <class F>
  void for_each_particle(F&& f) {
    for (const Member& member : members_) for_each_particle(member, f);
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

  void update_stress(double strain_time, Ledger& ledger) {
    if (ledger.due()) {
      update_stress<true>(strain_time, &ledger);
    } else {
      update_stress<false>(strain_time, nullptr);
    }
  }

  template <bool with_ledger>
  void update_stress(double strain_time, Ledger* ledger) {
    double strain_energy = 0, dissipated = 0, lost = 0, viscous_before = 0, viscous_after = 0;
    [[maybe_unused]] double half_work_before = 0, half_work_after = 0;  // of the whole stress on half of the strain
    [[maybe_unused]] double largest = 0;
    if constexpr (viscous) {
      if (scene_.viscosity->needs_largest()) largest = largest_gradient();
    }
    for (const Member& member : members_) {
      const Law& law = member.law;
      for_each_particle(member, [&](std::size_t p, const Node& left, const Node& right) {
        const double gradient = (right.velocity - left.velocity) / h_;
        // Strain of the reference configuration, as FEM has it: the two then solve one and the same problem.
        double strain_increment = strain_time * gradient;
        if constexpr (convected) strain_increment *= stretch_[p];
        const double stress_before = state_[p].stress;
        double stored_before = 0;
        if constexpr (with_ledger) {
          stored_before = law.stored(state_[p]);
          strain_energy += rest_length() * (stored_before + stress_before * strain_increment / 2);
          if constexpr (viscous) viscous_before += rest_length() * q_[p] * strain_increment / 2;
          half_work_before += rest_length() * stress(p) * strain_increment / 2;
        }
        const material::Response response = law.update(state_[p], strain_increment);
        if constexpr (convected) stretch_[p] += strain_increment;  // eq. 1
        if constexpr (viscous) {
          const bool york = scene_.viscosity->form == material::Viscosity::Form::york;
          q_[p] =
              scene_.viscosity->stress(gradient, largest, law.density, york ? c_max_ : law.elastic_wave_speed(), h_);
        }
        if constexpr (with_ledger) {
          dissipated += rest_length() * response.dissipated;
          if constexpr (viscous) viscous_after += rest_length() * q_[p] * strain_increment / 2;
          half_work_after += rest_length() * stress(p) * strain_increment / 2;
          if constexpr (Law::yields) {  // the trapezium of the leapfrog across a yield point
            lost += rest_length() * ((stress_before + response.stress) / 2 * strain_increment -
                                     (response.stored - stored_before) - response.dissipated);
          }
        }
      });
    }
    if constexpr (with_ledger) {
      ledger->take_by_viscosity(viscous_before);
      if (convected && scheme_ == Scheme::usf) ledger->take_by_scheme(-(half_work_of_kick_ + half_work_before));
      ledger->close_line(kinetic_energy(), strain_energy, dissipated, momentum(), lent_ - viscous_after / 2);
      ledger->take_by_viscosity(viscous_after);
      ledger->take_by_scheme(lost);
      half_work_ = half_work_after;
    }
  }

  /// Largest |D| where viscosity acts.
  double largest_gradient() {
    double largest = 0;
    for_each_particle([&](std::size_t, const Node& left, const Node& right) {
      const double D = (right.velocity - left.velocity) / h_;
      if (scene_.viscosity->acts(D)) largest = std::max(largest, std::abs(D));
    });
    return largest;
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
      trouble_ =
          "particle " + std::to_string(p) + " left the grid, which reaches as far beyond a free end as the bars reach";
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
    if constexpr (placed) return static_cast<std::size_t>(cell_[p]);
    return p / per_cell_;
  }
  std::size_t left_end_node() const { return cell_of(0); }
  std::size_t right_end_node() const { return cell_of(offset_.size() - 1) + 1; }

  // --- bars that meet ------------------------------------------------------------------------------------------------

  /// Bars act on each other while the grid has a node that both of them reach.
  void watch_contacts(long n) {
    if constexpr (placed) {
      for (std::size_t b = 0; b + 1 < members_.size(); ++b) {
        const bool share = cell_[members_[b + 1].first] - cell_[members_[b].last - 1] <= 1;
        const auto open = std::find_if(touches_.rbegin(), touches_.rend(),
                                       [&](const Touch& t) { return t.left == b && std::isinf(t.to); });
        const double now = static_cast<double>(n) * dt_;
        if (share && open == touches_.rend()) touches_.push_back({b, now});
        if (!share && open != touches_.rend()) open->to = now;
      }
    }
  }

  // --- books ---------------------------------------------------------------------------------------------------------

  /// What the scheme takes on its way from one map to the next. The stress was updated with one map's velocities, half
  /// of its work on that strain stands in the strain energy, and the other half is done by the internal forces with the
  /// particles' new stretches, places and velocities. The two cancel where nothing moved in between.
  void account_for_remapping(Ledger& ledger) {
    if (!ledger.keeps() || (!convected && scheme_ != Scheme::usl)) return;
    double power = 0;
    for (const Node& node : node_) power += node.force * node.velocity;
    ledger.take_by_scheme(-(dt_ * power / 2 + half_work_));
  }

  /// USL strains with the grid's own velocities w⁺ = P v⁻ + τ a, while its particles take up N a, of which the next map
  /// leaves P N a. So its loads work on the way from w⁻ to w⁺; what they would have done from P v⁻ on is the scheme's.
  void begin_kick(double kick, Ledger& ledger) {
    const double mapped = work_rate();
    double own = mapped;
    if (!kicked_.empty()) {
      own = work_rate([&](std::size_t i) { return kicked_[i]; });
    }
    ledger.before_kick(own, impulse_rate(), kick);
    ledger.take_by_scheme(kick * (own - mapped) / 2);
  }
  void note_velocities() {
    kicked_.resize(node_.size());
    for (std::size_t i = 0; i < node_.size(); ++i) kicked_[i] = node_[i].velocity;
  }

  /// USL's kick does τ²/2 Σ m a² of work on the grid with lumped masses; particles take up less of it, D = Σ m a² less
  /// their part. H of the leapfrog then falls by τ²/2 aⁿ·D(aⁿ + aⁿ⁻¹) in a step, so that H + τ²/4 a·D a never grows:
  /// of what the scheme takes it gives so much back.
  void account_for_lumping(double kick, Ledger& ledger) {
    if (!ledger.due()) return;
    double grid = 0, particles = 0;
    for (const Node& node : node_) grid += node.mass * node.acceleration * node.acceleration;
    for_each_particle([&](std::size_t p, const Node& left, const Node& right) {
      const double a = (0.5 - offset_[p]) * left.acceleration + (0.5 + offset_[p]) * right.acceleration;
      particles += mass(p) * a * a;
    });
    const double taken = kick * kick / 2 * (grid - particles);
    ledger.take_by_scheme(taken);
    lent_ = taken / 2;
  }

  /// USF: the work of the kick's second half, at the places where its forces were found.
  void end_kick(double kick, Ledger& ledger) {
    map_momentum();
    const double external = work_rate();
    ledger.after_kick(external, kick);
    double power = -external;
    for (const Node& node : node_) power += node.force * node.velocity;
    half_work_of_kick_ = kick * power / 2;
  }

  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t p = 0; p < velocity_.size(); ++p) sum += mass(p) * velocity_[p] * velocity_[p] / 2;
    return sum;
  }

  double work_rate() const {
    return work_rate([&](std::size_t i) { return node_[i].velocity; });
  }
  template <class Velocity>
  double work_rate(Velocity&& velocity) const {
    double sum = 0;
    for (const NodalForce& f : nodal_forces_) sum += f.force * velocity(f.node);
    for (std::size_t i = 0; i < body_.size(); ++i) sum += body_[i] * velocity(i);
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
  const std::vector<double>& positions_;
  Scheme scheme_;
  double dt_, h_, c_max_;
  std::size_t per_cell_;
  std::vector<Member> members_;
  std::size_t first_cell_ = 0, grid_cells_ = 0;  // the first bar starts in first_cell_

  std::vector<Node> node_;
  std::vector<std::size_t> cell_start_;  // particles of cell c are [cell_start_[c], cell_start_[c+1])
  // Particles, in the order of the bars and hence of the cells:
  std::vector<double> offset_, velocity_, displacement_;
  std::vector<typename Law::State> state_;
  std::vector<std::int32_t> cell_;         // only where several bars stand in the grid, or particles move
  std::vector<double> mass_;               // likewise
  std::vector<double> stretch_, advance_;  // only where particles move
  std::vector<double> q_;                  // only with viscosity
  std::vector<double> body_;               // per node, only with a body force
  std::vector<NodalForce> nodal_forces_;   // of the current step
  std::vector<double> kicked_;             // velocities of the nodes after the last kick, only with USL
  std::vector<std::vector<LayerPoint>> layers_;
  std::vector<Touch> touches_;
  double half_work_ = 0, half_work_of_kick_ = 0, lent_ = 0;  // for the books
  std::string trouble_;
};

/// Runs bars that have been checked; `laws` has one for each.
template <class Law>
Record run(const Scene& scene, const std::vector<Law>& laws, int cells, const std::vector<double>& positions,
           Scheme scheme, const Stepping& stepping) {
  const auto go = [&]<Carries carries, bool viscous>() {
    Bars<Law, carries, viscous> bars(scene, laws, cells, positions, scheme, stepping);
    return take_steps(bars, stepping);
  };
  const auto with = [&]<Carries carries>() {
    return scene.viscosity ? go.template operator()<carries, true>() : go.template operator()<carries, false>();
  };
  if (scene.convected) return with.template operator()<Carries::stretch>();
  if (scene.bars.size() > 1) return with.template operator()<Carries::cell>();
  return with.template operator()<Carries::nothing>();
}

extern template Record run(const Scene&, const std::vector<material::Elastic>&, int, const std::vector<double>&, Scheme,
                           const Stepping&);
extern template Record run(const Scene&, const std::vector<material::Hardening>&, int, const std::vector<double>&,
                           Scheme, const Stepping&);

}  // namespace diptych::mpm::bars
