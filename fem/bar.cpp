#include "fem/bar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/contact.hpp"
#include "hinge/step/stepping.hpp"

namespace diptych::fem {
namespace {

/// The elements of one bar.
template <class Law, bool viscous>
class Mesh {
 public:
  Mesh(const Scene& scene, const Bar& bar, const Law& law, int cells)
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

  /// Energies per length of an update of all elements, each times h.
  struct Energies {
    double strain = 0, dissipated = 0, lost = 0, viscous_before = 0, viscous_after = 0;
  };

  template <bool with_ledger>
  void update_stress(double dt, double c_max, double largest, Energies& sums) {
    for (std::size_t e = 0; e < cells_; ++e) {
      const double strain_increment = dt * (velocity_[e + 1] - velocity_[e]) / h_;
      const double stress_before = state_[e].stress;
      double stored_before = 0;
      if constexpr (with_ledger) {
        stored_before = law_.stored(state_[e]);
        sums.strain += h_ * (stored_before + stress_before * strain_increment / 2);
        if constexpr (viscous) sums.viscous_before += h_ * q_[e] * strain_increment / 2;
      }
      const material::Response response = law_.update(state_[e], strain_increment);
      if constexpr (viscous) {
        const double speed =
            scene_.viscosity->form == material::Viscosity::Form::york ? c_max : law_.elastic_wave_speed();
        q_[e] = scene_.viscosity->stress(strain_increment / dt, largest, law_.density, speed, h_);
      }
      if constexpr (with_ledger) {
        sums.dissipated += h_ * response.dissipated;
        if constexpr (viscous) sums.viscous_after += h_ * q_[e] * strain_increment / 2;
        if constexpr (Law::yields) {  // the trapezium of the leapfrog across a yield point
          sums.lost += h_ * ((stress_before + response.stress) / 2 * strain_increment -
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

template <class Law, bool viscous>
class Bars {
 public:
  Bars(const Scene& scene, const std::vector<Law>& laws, int cells, const Stepping& stepping)
      : scene_(scene), dt_(stepping.time_step), c_max_(largest_wave_speed(scene)) {
    for (std::size_t b = 0; b < scene.bars.size(); ++b) {
      meshes_.emplace_back(scene, scene.bars[b], laws[b], cells_of(scene, b, cells));
      if (b > 0) pairs_.emplace_back(b - 1, scene.bars[b].begin - scene.bars[b - 1].end(), scene.contact);
    }
    hold_supports();
  }

  // Central differences: (uⁿ, σⁿ, vⁿ⁻½) → (uⁿ⁺¹, σⁿ⁺¹, vⁿ⁺½).
  void step(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    for (auto& mesh : meshes_) mesh.internal_force();  // eq. 19
    external_force(kick);                              // eqs. 17, 20
    contact_force(n, kick.length);
    ledger.before_kick(work_rate(), impulse_rate(), kick.length);
    ledger.take_by_contact(-kick.length * contact_work_rate() / 2);
    for (auto& mesh : meshes_) mesh.integrate_momentum(kick.length);  // eq. 18
    hold_supports();
    ledger.after_kick(work_rate(), kick.length);
    ledger.take_by_contact(-kick.length * contact_work_rate() / 2);
    for (auto& mesh : meshes_) mesh.move(dt_);
    if (ledger.due()) {
      update_stress<true>(&ledger);
    } else {
      update_stress<false>(nullptr);
    }
  }

  Snapshot sample(long n) const {
    Snapshot s;
    s.step = n;
    for (Field* f : {&s.stress, &s.velocity, &s.displacement}) f->first.clear();
    for (const auto& mesh : meshes_) mesh.sample(static_cast<double>(n) * dt_, dt_ / 2, s);
    return s;
  }

  static std::string trouble() { return {}; }
  static double gives_back() { return 0; }
  double first_ledger_time() const { return dt_ / 2; }
  double energy() const {
    double sum = 0;
    for (const auto& mesh : meshes_) sum += mesh.kinetic_energy() + mesh.stored_energy();
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (const auto& mesh : meshes_) sum += mesh.momentum();
    return sum;
  }
  double free_mass() const {
    double sum = 0;
    if (scene_.left == Support::free && scene_.right == Support::free) {
      for (const auto& mesh : meshes_) sum += mesh.mass();
    }
    return sum;
  }
  void hand_over(Record& record) { record.touches = touches_; }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{Law::feature};
    if (meshes_.front().has_body_force()) active.push_back("body-force");
    if (!pairs_.empty()) active.push_back("contact");
    if (viscous) active.push_back("viscosity");
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    Work sum;
    for (const auto& mesh : meshes_) {
      sum.element_steps += static_cast<long>(mesh.cells()) * steps;
      sum.node_steps += static_cast<long>(mesh.cells() + 1) * steps;
      sum.bytes += mesh.bytes();
    }
    sum.bytes += pairs_.capacity() * sizeof(Pair);
    return sum;
  }

 private:
  void external_force(const Kick& kick) {
    load_[0] = load_[1] = 0;
    for (const Load& load : scene_.loads) {
      const double traction = load.mean_traction(kick.from, kick.to);
      if (load.end == End::left)
        load_[0] -= traction;
      else
        load_[1] += traction;
    }
    first().force_at(0) += load_[0];
    last().force_at(last().cells()) += load_[1];
    if (!scene_.body_force) return;
    for (auto& mesh : meshes_) mesh.add_body_force((kick.from + kick.to) / 2);
  }

  void contact_force(long n, double kick) {
    for (Pair& pair : pairs_) {
      auto &a = meshes_[pair.left()], &b = meshes_[pair.left() + 1];
      const double force = pair.force(a.face(a.cells()), b.face(0), kick, dt_);
      a.force_at(a.cells()) -= force;
      b.force_at(0) += force;
      const double now = static_cast<double>(n) * dt_;
      if (pair.closed()) touches_.push_back({pair.left(), now + pair.share_of_step() * dt_});
      if (pair.opened()) {
        const auto same = [&](const Touch& t) { return t.left == pair.left() && std::isinf(t.to); };
        std::find_if(touches_.rbegin(), touches_.rend(), same)->to = now;
      }
    }
  }

  void hold_supports() {
    if (scene_.left == Support::fixed) first().velocity_at(0) = 0;
    if (scene_.right == Support::fixed) last().velocity_at(last().cells()) = 0;
  }

  template <bool with_ledger>
  void update_stress(Ledger* ledger) {
    double largest = 0;
    if constexpr (viscous) {
      if (scene_.viscosity->needs_largest()) {
        for (const auto& mesh : meshes_) largest = std::max(largest, mesh.largest_gradient());
      }
    }
    typename Mesh<Law, viscous>::Energies sums;
    for (auto& mesh : meshes_) mesh.template update_stress<with_ledger>(dt_, c_max_, largest, sums);
    if constexpr (with_ledger) {
      double kinetic = 0;
      for (const auto& mesh : meshes_) kinetic += mesh.kinetic_energy();
      ledger->take_by_viscosity(sums.viscous_before);
      ledger->close_line(kinetic, sums.strain, sums.dissipated, momentum(), -sums.viscous_after / 2);
      ledger->take_by_viscosity(sums.viscous_after);
      ledger->take_by_scheme(sums.lost);
    }
  }

  double work_rate() const {
    double sum = load_[0] * first().velocity_at(0) + load_[1] * last().velocity_at(last().cells());
    for (const auto& mesh : meshes_) sum += mesh.body_work_rate();
    return sum;
  }

  double contact_work_rate() const {
    double sum = 0;
    for (const Pair& pair : pairs_) {
      const auto &a = meshes_[pair.left()], &b = meshes_[pair.left() + 1];
      sum += pair.force() * (b.velocity_at(0) - a.velocity_at(a.cells()));
    }
    return sum;
  }

  // Loads plus reactions: a support takes up whatever force stands at its node.
  double impulse_rate() const {
    double sum = load_[0] + load_[1];
    for (const auto& mesh : meshes_) sum += mesh.body_impulse_rate();
    if (scene_.left == Support::fixed) sum -= first().force_at(0);
    if (scene_.right == Support::fixed) sum -= last().force_at(last().cells());
    return sum;
  }

  Mesh<Law, viscous>& first() { return meshes_.front(); }
  const Mesh<Law, viscous>& first() const { return meshes_.front(); }
  Mesh<Law, viscous>& last() { return meshes_.back(); }
  const Mesh<Law, viscous>& last() const { return meshes_.back(); }

  const Scene& scene_;
  double dt_, c_max_;
  std::vector<Mesh<Law, viscous>> meshes_;
  std::vector<Pair> pairs_;
  std::vector<Touch> touches_;
  double load_[2] = {0, 0};  // force of the tractions on the outer end nodes
};

}  // namespace

double critical_time_step(const Scene& scene, int cells) {
  const double fastest = largest_wave_speed(scene), jump = initial_velocity_jump(scene);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < scene.bars.size(); ++b) {
    const double speed = material::wave_speed(scene.bars[b].material);
    const double cell_time = scene.bars[b].length / cells_of(scene, b, cells) / speed;
    double courant = 1;
    if (scene.viscosity) {
      const bool york = scene.viscosity->form == material::Viscosity::Form::york;
      courant = with_viscosity(1, scene.viscosity->strength(speed, jump) * (york ? fastest / speed : 1));
    }
    least = std::min(least, courant * cell_time);
  }
  return least;
}

Record run(const Scene& scene, int cells, const Stepping& stepping) {
  for (const Load& load : scene.loads) {
    if (load.transfer != Transfer::node) throw std::invalid_argument("fem has no boundary layer");
  }
  const auto go = [&]<bool viscous>(const auto& laws) {
    using Law = typename std::decay_t<decltype(laws)>::value_type;
    Bars<Law, viscous> bars(scene, laws, cells, stepping);
    return take_steps(bars, stepping);
  };
  return std::visit(
      [&](const auto& laws) {
        return scene.viscosity ? go.template operator()<true>(laws) : go.template operator()<false>(laws);
      },
      laws(scene));
}

}  // namespace diptych::fem
