// The elements of one bar, for one law: 2 nodes, one Gauss point, lumped mass.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fem/contact.hpp"
#include "hinge/material/bar_update.hpp"
#include "hinge/step/record.hpp"

namespace diptych::fem {

/// Energies of one update of the stress, summed over the elements [J].
struct StressWork {
  double strain = 0, dissipated = 0;
  double lost = 0;                               ///< by the trapezium of the leapfrog across a yield point
  double viscous_before = 0, viscous_after = 0;  ///< halves of the viscosity's work
};

/// The elements of one bar.
template <class Law, bool viscous>
class BarMesh {
 public:
  BarMesh(const Scene& scene, const Bar& bar, const Law& law, int cells)
      : scene_(scene),
        bar_(bar),
        law_(law),
        cells_(static_cast<std::size_t>(cells)),
        h_(bar.length / cells),
        state_(cells_),
        mass_(cells_ + 1),
        force_(cells_ + 1),
        velocity_(cells_ + 1),
        displacement_(cells_ + 1) {
    for (std::size_t e = 0; e < cells_; ++e) {
      if (bar.initial_stress) state_[e].stress = bar.initial_stress(midpoint(e));
    }
    for (std::size_t i = 0; i <= cells_; ++i) {
      mass_[i] = (i == 0 || i == cells_ ? 0.5 : 1.0) * law.density * h_;
      if (bar.initial_velocity) velocity_[i] = bar.initial_velocity(node(i));
    }
    if constexpr (viscous) q_.resize(cells_);
  }

  double node(std::size_t i) const {
    return bar_.begin + bar_.length * static_cast<double>(i) / static_cast<double>(cells_);
  }
  double midpoint(std::size_t e) const {
    return bar_.begin + bar_.length * (static_cast<double>(e) + 0.5) / static_cast<double>(cells_);
  }

  void internal_force() {  // eq. 19 with one Gauss point
    force_[0] = stress(0);
    for (std::size_t i = 1; i < cells_; ++i) force_[i] = stress(i) - stress(i - 1);
    force_[cells_] = -stress(cells_ - 1);
  }

  void add_body_force(double time) {
    body_.resize(cells_ + 1);
    for (std::size_t i = 0; i <= cells_; ++i) {
      body_[i] = mass_[i] * scene_.body_force(node(i), time);  // eq. 17b
      force_[i] += body_[i];
    }
  }

  void integrate_momentum(double kick) {  // eq. 18
    for (std::size_t i = 0; i <= cells_; ++i) velocity_[i] += kick * force_[i] / mass_[i];
  }

  void move(double dt) {
    for (std::size_t i = 0; i <= cells_; ++i) displacement_[i] += dt * velocity_[i];
  }

  template <bool with_ledger>
  void update_stress(double dt, double c_max, double largest, StressWork& work) {
    for (std::size_t e = 0; e < cells_; ++e) {
      const double strain_increment = dt * (velocity_[e + 1] - velocity_[e]) / h_;
      const double stress_before = state_[e].stress;
      double stored_before = 0;
      if constexpr (with_ledger) {
        stored_before = law_.stored(state_[e]);
        work.strain += h_ * (stored_before + stress_before * strain_increment / 2);
        if constexpr (viscous) work.viscous_before += h_ * q_[e] * strain_increment / 2;
      }
      const material::Response response = law_.update(state_[e], strain_increment);
      if constexpr (viscous) {
        const double speed =
            scene_.viscosity->form == material::Viscosity::Form::york ? c_max : law_.elastic_wave_speed();
        q_[e] = scene_.viscosity->stress(strain_increment / dt, largest, law_.density, speed, h_);
      }
      if constexpr (with_ledger) {
        work.dissipated += h_ * response.dissipated;
        if constexpr (viscous) work.viscous_after += h_ * q_[e] * strain_increment / 2;
        if constexpr (Law::yields) {
          work.lost += h_ * ((stress_before + response.stress) / 2 * strain_increment -
                             (response.stored - stored_before) - response.dissipated);
        }
      }
    }
  }

  /// Largest |D| where viscosity acts.
  double largest_gradient() const {
    double largest = 0;
    for (std::size_t e = 0; e < cells_; ++e) {
      const double D = (velocity_[e + 1] - velocity_[e]) / h_;
      if (scene_.viscosity->acts(D)) largest = std::max(largest, std::abs(D));
    }
    return largest;
  }

  void sample(double time, double half_step, Snapshot& s) const {
    s.stress.time = s.displacement.time = time;
    s.velocity.time = s.step == 0 ? 0 : time - half_step;
    for (Field* f : {&s.stress, &s.velocity, &s.displacement}) f->first.push_back(f->value.size());
    for (std::size_t i = 0; i <= cells_; ++i) {
      s.stress.edges.push_back(node(i));
      s.velocity.x.push_back(node(i));
      s.displacement.x.push_back(node(i));
      s.velocity.value.push_back(velocity_[i]);
      s.displacement.value.push_back(displacement_[i]);
    }
    for (std::size_t e = 0; e < cells_; ++e) {
      s.stress.x.push_back(midpoint(e));
      s.stress.value.push_back(state_[e].stress);
    }
  }

  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t i = 0; i <= cells_; ++i) sum += mass_[i] * velocity_[i] * velocity_[i] / 2;
    return sum;
  }
  double stored_energy() const {
    double sum = 0;
    for (const auto& state : state_) sum += h_ * law_.stored(state);
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (std::size_t i = 0; i <= cells_; ++i) sum += mass_[i] * velocity_[i];
    return sum;
  }
  double body_work_rate() const {
    double sum = 0;
    for (std::size_t i = 0; i < body_.size(); ++i) sum += body_[i] * velocity_[i];
    return sum;
  }
  double body_impulse_rate() const {
    double sum = 0;
    for (const double b : body_) sum += b;
    return sum;
  }

  Face face(std::size_t i) const { return {mass_[i], force_[i], velocity_[i], displacement_[i]}; }
  std::size_t cells() const { return cells_; }
  bool has_body_force() const { return !body_.empty(); }
  double mass() const { return law_.density * bar_.length; }
  double& force_at(std::size_t i) { return force_[i]; }
  double force_at(std::size_t i) const { return force_[i]; }
  double& velocity_at(std::size_t i) { return velocity_[i]; }
  double velocity_at(std::size_t i) const { return velocity_[i]; }
  std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return of(state_) + of(mass_) + of(force_) + of(velocity_) + of(displacement_) + of(body_) + of(q_);
  }

 private:
  double stress(std::size_t e) const {
    if constexpr (viscous) return state_[e].stress + q_[e];
    return state_[e].stress;
  }

  const Scene& scene_;
  const Bar& bar_;
  const Law& law_;
  std::size_t cells_;
  double h_;
  std::vector<typename Law::State> state_;                      // per element
  std::vector<double> mass_, force_, velocity_, displacement_;  // per node
  std::vector<double> body_;                                    // per node, only with a body force
  std::vector<double> q_;                                       // per element, only with viscosity
};

}  // namespace diptych::fem
