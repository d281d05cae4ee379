// A step of bars of particles, for one law: USF, USL and MUSL side by side, in the paper's order.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hinge/material/bar_update.hpp"
#include "hinge/step/stepping.hpp"
#include "hinge/step/touches.hpp"
#include "mpm/bar_books.hpp"
#include "mpm/bar_layer.hpp"
#include "mpm/bar_sample.hpp"

namespace diptych::mpm::bars {

template <class Law, Carries carries, bool viscous>
class Bars {
  using P = Particles<Law, carries, viscous>;
  static constexpr bool convected = P::convected;

 public:
  Bars(const Scene& scene, const std::vector<Law>& laws, int cells, const std::vector<double>& positions, Scheme scheme,
       const Stepping& stepping)
      : scene_(scene),
        scheme_(scheme),
        dt_(stepping.time_step),
        c_max_(largest_wave_speed(scene)),
        particles_(scene, laws, cells, positions),
        grid_(scene),
        books_(particles_, grid_, scheme, dt_) {
    grid_.node.resize(particles_.cells() + 1);
    for (const Load& load : scene.loads) layers_.push_back(boundary_layer(load, particles_));
    map_mass();
    watch_contacts(0);
    if (scheme_ == Scheme::usf) bring_usf_to_its_half_step();
  }

  void step(long n, Ledger& ledger) {
    if (scheme_ == Scheme::usf) step_usf(n, ledger);
    if (scheme_ == Scheme::usl) step_usl(n, ledger);
    if (scheme_ == Scheme::musl) step_musl(n, ledger);
    if constexpr (convected) watch_contacts(n + 1);
    node_steps_ += static_cast<long>(grid_.reached().size());
  }

  // Update stress first: (vⁿ, σⁿ⁻½) → (vⁿ⁺¹, σⁿ⁺½).
  void step_usf(long n, Ledger& ledger) {
    const Kick kick = kick_after(n, dt_);
    map_momentum();
    if (n > 0 && !ledger.keeps()) books_.after_kick(kick.length, ledger);  // the last one's, while the grid has it
    if (n > 0) update_stress(dt_, ledger);  // with the particles' velocities; the half-step from 0 to ½ is behind
    internal_force();                       // eq. 19
    if (n > 0) books_.account_for_remapping(ledger);
    external_force(kick);  // eqs. 16, 17, 20
    books_.before_kick(kick.length, ledger);
    grid_.integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);           // eq. 11
    move_particles(dt_);                    // eqs. 9, 10
    if (ledger.keeps()) {
      map_momentum();
      books_.after_kick_of_usf(kick.length, ledger);
    }
    convect();
  }

  // Update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_usl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    map_momentum();
    internal_force();                      // eq. 19
    books_.account_for_remapping(ledger);  // since the last update
    external_force(kick);                  // eqs. 16, 17, 20
    books_.before_kick_of_usl(kick.length, ledger);
    grid_.integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);           // eq. 11
    move_particles(dt_);                    // eqs. 9, 10
    books_.after_kick(kick.length, ledger);
    books_.account_for_lumping(kick.length, ledger);
    update_stress(dt_, ledger);  // with the grid's own new velocities
    books_.keep_velocities_of_usl();
    convect();
  }

  // Modified update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_musl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    map_momentum();
    internal_force();                      // eq. 19
    books_.account_for_remapping(ledger);  // since the last update
    external_force(kick);                  // eqs. 16, 17, 20
    books_.before_kick(kick.length, ledger);
    grid_.integrate_momentum(kick.length);  // eq. 18
    update_velocity(kick.length);           // eq. 11
    move_particles(dt_);                    // eqs. 9, 10
    map_momentum();
    books_.after_kick(kick.length, ledger);
    update_stress(dt_, ledger);  // with the particles' new velocities, mapped once more
    convect();
  }

  Snapshot sample(long n) const { return bars::sample(particles_, scene_, scheme_, dt_, n); }
  const std::string& trouble() const { return particles_.trouble(); }
  static double gives_back() { return 0; }
  double first_ledger_time() const { return scheme_ == Scheme::usf ? dt_ : dt_ / 2; }
  double energy() const { return particles_.energy(); }
  double momentum() const { return particles_.momentum(); }
  double free_mass() const {
    return scene_.left == Support::free && scene_.right == Support::free ? particles_.total_mass() : 0;
  }
  void complete(Record& record) const { record.touches = touches_.all(); }
  /// Those that this run has built up, whatever the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{Law::feature};
    if (!grid_.body_force.empty()) active.push_back("body-force");
    if (!particles_.advance.empty()) active.push_back("convection");
    if (particles_.member.size() > 1) active.push_back("contact");
    if (!particles_.q.empty()) active.push_back("viscosity");
    if (std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) { return !layer.empty(); })) {
      active.push_back("boundary-layer");
    }
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    const std::size_t of_grid =
        grid_.node.capacity() * sizeof(Node) + grid_.body_force.capacity() * sizeof(grid_.body_force[0]);
    return {0, static_cast<long>(particles_.offset.size()) * steps, node_steps_, particles_.bytes() + of_grid};
  }

 private:
  /// USF keeps the velocity at whole steps and stress and displacement half-way between them.
  void bring_usf_to_its_half_step() {
    map_momentum();
    update_stress<false>(dt_ / 2);
    move_particles(dt_ / 2);
    convect();
  }

  // --- particles to grid ---------------------------------------------------------------------------------------------

  void map_mass() {  // eq. 15
    grid_.reach(particles_.first_filled(), particles_.last_filled() + 1);
    particles_.gather(
        [&](std::size_t p, std::size_t) {
          const double mass = particles_.mass(p);
          return Pair{mass * (0.5 - particles_.offset[p]), mass * (0.5 + particles_.offset[p])};
        },
        [&](std::size_t i, double mass) { grid_.node[i].mass = mass; });
  }

  void map_momentum() {
    particles_.gather(
        [&](std::size_t p, std::size_t) {
          const double momentum = particles_.mass(p) * particles_.velocity[p];
          return Pair{(0.5 - particles_.offset[p]) * momentum, (0.5 + particles_.offset[p]) * momentum};
        },
        [&](std::size_t i, double momentum) {
          Node& node = grid_.node[i];
          node.velocity = node.mass > 0 ? momentum / node.mass : 0;
        });
    grid_.hold_supports();
  }

  void internal_force() {  // eq. 19: gradients −1/h and 1/h
    particles_.gather(
        [&](std::size_t p, std::size_t) {
          const double force = particles_.length(p) / particles_.h * particles_.stress(p);
          return Pair{force, -force};
        },
        [&](std::size_t i, double force) { grid_.node[i].force = force; });
  }

  void external_force(const Kick& kick) {
    grid_.traction.clear();
    for (std::size_t k = 0; k < scene_.loads.size(); ++k) {
      const Load& load = scene_.loads[k];
      const double traction = (load.end == End::left ? -1 : 1) * load.mean_traction(kick.from, kick.to);
      if (load.transfer == Transfer::node) {
        grid_.traction.push_back(
            {load.end == End::left ? particles_.left_end_node() : particles_.right_end_node(), traction});
      } else {
        add_layer_force(layers_[k], traction, particles_, grid_.traction);
      }
    }
    for (const NodalForce& f : grid_.traction) grid_.node[f.node].force += f.force;
    if (scene_.body_force) add_body_force((kick.from + kick.to) / 2);
  }

  void add_body_force(double time) {  // eq. 17a
    grid_.body_force.resize(grid_.node.size());
    particles_.gather(
        [&](std::size_t p, std::size_t cell) {
          const double force = particles_.mass(p) * scene_.body_force(particles_.position(cell, p), time);
          return Pair{(0.5 - particles_.offset[p]) * force, (0.5 + particles_.offset[p]) * force};
        },
        [&](std::size_t i, double force) {
          grid_.body_force[i] = force;
          grid_.node[i].force += force;
        });
  }

  // --- grid to particles ---------------------------------------------------------------------------------------------

  void update_velocity(double kick) {
    const std::vector<double>& offset = particles_.offset;
    particles_.for_each(grid_.node, [&](std::size_t p, const Node& left, const Node& right) {
      particles_.velocity[p] += kick * ((0.5 - offset[p]) * left.acceleration + (0.5 + offset[p]) * right.acceleration);
    });
  }

  void move_particles(double drift) {
    const std::vector<double>& offset = particles_.offset;
    particles_.for_each(grid_.node, [&](std::size_t p, const Node& left, const Node& right) {
      const double increment = drift * ((0.5 - offset[p]) * left.velocity + (0.5 + offset[p]) * right.velocity);
      particles_.displacement[p] += increment;
      // The grid is left behind only when the step is done.
      if constexpr (convected) particles_.advance[p] = increment / particles_.h;
    });
  }

  void update_stress(double strain_time, Ledger& ledger) {
    if (ledger.due()) {
      books_.close_line(update_stress<true>(strain_time), ledger);
    } else {
      update_stress<false>(strain_time);
    }
  }

  template <bool with_ledger>
  StressWork update_stress(double strain_time) {
    StressWork work;
    [[maybe_unused]] const double rest_length = particles_.rest_length();
    [[maybe_unused]] double largest = 0;
    if constexpr (viscous) {
      if (scene_.viscosity->needs_largest()) largest = largest_gradient();
    }
    for (const Member<Law>& member : particles_.member) {
      const Law& law = member.law;
      particles_.for_each(member, grid_.node, [&](std::size_t p, const Node& left, const Node& right) {
        const double gradient = (right.velocity - left.velocity) / particles_.h;
        // Strain of the reference configuration, as FEM has it: the two then solve one and the same problem.
        double strain_increment = strain_time * gradient;
        if constexpr (convected) strain_increment *= particles_.stretch[p];
        auto& state = particles_.state[p];
        const double stress_before = state.stress;
        double stored_before = 0;
        if constexpr (with_ledger) {
          stored_before = law.stored(state);
          work.strain += rest_length * (stored_before + stress_before * strain_increment / 2);
          if constexpr (viscous) work.viscous_before += rest_length * particles_.q[p] * strain_increment / 2;
          work.half_before += rest_length * particles_.stress(p) * strain_increment / 2;
        }
        const material::Response response = law.update(state, strain_increment);
        if constexpr (convected) particles_.stretch[p] += strain_increment;  // eq. 1
        if constexpr (viscous) {
          const bool york = scene_.viscosity->form == material::Viscosity::Form::york;
          particles_.q[p] = scene_.viscosity->stress(gradient, largest, law.density,
                                                     york ? c_max_ : law.elastic_wave_speed(), particles_.h);
        }
        if constexpr (with_ledger) {
          work.dissipated += rest_length * response.dissipated;
          if constexpr (viscous) work.viscous_after += rest_length * particles_.q[p] * strain_increment / 2;
          work.half_after += rest_length * particles_.stress(p) * strain_increment / 2;
          if constexpr (Law::yields) {
            work.lost += rest_length * ((stress_before + response.stress) / 2 * strain_increment -
                                        (response.stored - stored_before) - response.dissipated);
          }
        }
      });
    }
    return work;
  }

  /// Largest |D| where viscosity acts.
  double largest_gradient() const {
    double largest = 0;
    particles_.for_each(grid_.node, [&](std::size_t, const Node& left, const Node& right) {
      const double D = (right.velocity - left.velocity) / particles_.h;
      if (scene_.viscosity->acts(D)) largest = std::max(largest, std::abs(D));
    });
    return largest;
  }

  void convect() {
    if constexpr (convected) {
      particles_.convect();
      if (particles_.trouble().empty()) map_mass();  // of particles out of order there is no first and no last
    }
  }

  /// Bars act on each other while the grid has a node that both of them reach.
  void watch_contacts(long n) {
    const double now = static_cast<double>(n) * dt_;
    for (std::size_t b = 0; b + 1 < particles_.member.size(); ++b) {
      const bool share = particles_.share_a_node(b), shared = touches_.last(b);
      if (share && !shared) touches_.begin(b, now);
      if (!share && shared) touches_.end(b, now);
    }
  }

  const Scene& scene_;
  Scheme scheme_;
  double dt_, c_max_;
  long node_steps_ = 0;
  P particles_;
  Grid grid_;
  BarBooks<P> books_;
  std::vector<std::vector<LayerPoint>> layers_;  // of each load
  Touches touches_;
};

}  // namespace diptych::mpm::bars
