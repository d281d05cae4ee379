#include "fem/bar.hpp"

#include <algorithm>
#include <stdexcept>

#include "material/stepping.hpp"

namespace diptych::fem {
namespace {

template <class Law>
class Bar {
 public:
  Bar(const Scene& scene, const Law& law, int cells, const Stepping& stepping)
      : scene_(scene),
        law_(law),
        dt_(stepping.time_step),
        cells_(static_cast<std::size_t>(cells)),
        h_(scene.length / cells),
        state_(cells_),
        mass_(cells_ + 1),
        force_(cells_ + 1),
        velocity_(cells_ + 1),
        displacement_(cells_ + 1) {
    for (std::size_t e = 0; e < cells_; ++e) {
      if (scene.initial_stress) state_[e].stress = scene.initial_stress(midpoint(e));
    }
    for (std::size_t i = 0; i <= cells_; ++i) {
      mass_[i] = (i == 0 || i == cells_ ? 0.5 : 1.0) * law.density * h_;
      if (scene.initial_velocity) velocity_[i] = scene.initial_velocity(node(i));
    }
    hold_supports();
  }

  // Central differences: (uⁿ, σⁿ, vⁿ⁻½) → (uⁿ⁺¹, σⁿ⁺¹, vⁿ⁺½).
  void step(long n, Ledger* ledger) {
    const Kick kick = kick_around(n, dt_);
    internal_force();      // eq. 19 with one Gauss point
    external_force(kick);  // eqs. 17, 20
    if (ledger) ledger->before_kick(work_rate(), impulse_rate(), kick.length);
    integrate_momentum(kick.length);  // eq. 18
    if (ledger) ledger->after_kick(work_rate(), kick.length);
    move();
    if (ledger) {
      update_stress<true>(ledger);
    } else {
      update_stress<false>(nullptr);
    }
  }

  Snapshot sample(long n) const {
    const double time = static_cast<double>(n) * dt_;
    Snapshot s{n, {time, {}, {}, {}}, {n == 0 ? 0 : time - dt_ / 2, {}, {}, velocity_}, {time, {}, {}, displacement_}};
    for (std::size_t i = 0; i <= cells_; ++i) s.stress.edges.push_back(node(i));
    s.velocity.x = s.displacement.x = s.stress.edges;
    for (std::size_t e = 0; e < cells_; ++e) {
      s.stress.x.push_back(midpoint(e));
      s.stress.value.push_back(state_[e].stress);
    }
    return s;
  }

  static std::string trouble() { return {}; }
  double first_ledger_time() const { return dt_ / 2; }
  double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i <= cells_; ++i) sum += mass_[i] * velocity_[i] * velocity_[i] / 2;
    for (const auto& state : state_) sum += h_ * law_.stored(state);
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (std::size_t i = 0; i <= cells_; ++i) sum += mass_[i] * velocity_[i];
    return sum;
  }
  double free_mass() const {
    return scene_.left == Support::free && scene_.right == Support::free ? law_.density * scene_.length : 0;
  }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{Law::feature};
    if (!body_.empty()) active.push_back("body-force");
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return {static_cast<long>(cells_) * steps, 0, static_cast<long>(cells_ + 1) * steps,
            bytes(state_) + bytes(mass_) + bytes(force_) + bytes(velocity_) + bytes(displacement_) + bytes(body_)};
  }

 private:
  double node(std::size_t i) const { return scene_.length * static_cast<double>(i) / static_cast<double>(cells_); }
  double midpoint(std::size_t e) const {
    return scene_.length * (static_cast<double>(e) + 0.5) / static_cast<double>(cells_);
  }

  void internal_force() {
    force_[0] = state_[0].stress;
    for (std::size_t i = 1; i < cells_; ++i) force_[i] = state_[i].stress - state_[i - 1].stress;
    force_[cells_] = -state_[cells_ - 1].stress;
  }

  void external_force(const Kick& kick) {
    load_[0] = load_[1] = 0;
    for (const Load& load : scene_.loads) {
      const double traction = load.mean_traction(kick.from, kick.to);
      if (load.end == End::left)
        load_[0] -= traction;
      else
        load_[1] += traction;
    }
    force_[0] += load_[0];
    force_[cells_] += load_[1];
    if (scene_.body_force) add_body_force((kick.from + kick.to) / 2);
  }

  void add_body_force(double time) {
    body_.resize(cells_ + 1);
    for (std::size_t i = 0; i <= cells_; ++i) {
      body_[i] = mass_[i] * scene_.body_force(node(i), time);  // eq. 17b
      force_[i] += body_[i];
    }
  }

  void integrate_momentum(double kick) {
    for (std::size_t i = 0; i <= cells_; ++i) velocity_[i] += kick * force_[i] / mass_[i];
    hold_supports();
  }

  void hold_supports() {
    if (scene_.left == Support::fixed) velocity_[0] = 0;
    if (scene_.right == Support::fixed) velocity_[cells_] = 0;
  }

  void move() {
    for (std::size_t i = 0; i <= cells_; ++i) displacement_[i] += dt_ * velocity_[i];
  }

  template <bool with_ledger>
  void update_stress(Ledger* ledger) {
    double strain_energy = 0, dissipated = 0;
    for (std::size_t e = 0; e < cells_; ++e) {
      const double strain_increment = dt_ * (velocity_[e + 1] - velocity_[e]) / h_;
      if constexpr (with_ledger) strain_energy += law_.stored(state_[e]) + state_[e].stress * strain_increment / 2;
      const material::Response response = law_.update(state_[e], strain_increment);
      if constexpr (with_ledger) dissipated += response.dissipated;
    }
    if constexpr (with_ledger) {
      double kinetic = 0;
      for (std::size_t i = 0; i <= cells_; ++i) kinetic += mass_[i] * velocity_[i] * velocity_[i] / 2;
      ledger->close_line(kinetic, h_ * strain_energy, h_ * dissipated, momentum());
    }
  }

  double work_rate() const {
    double sum = load_[0] * velocity_[0] + load_[1] * velocity_[cells_];
    if (scene_.body_force) {
      for (std::size_t i = 0; i <= cells_; ++i) sum += body_[i] * velocity_[i];
    }
    return sum;
  }

  // Loads plus reactions: a support takes up whatever force stands at its node.
  double impulse_rate() const {
    double sum = load_[0] + load_[1];
    if (scene_.body_force) {
      for (const double b : body_) sum += b;
    }
    if (scene_.left == Support::fixed) sum -= force_[0];
    if (scene_.right == Support::fixed) sum -= force_[cells_];
    return sum;
  }

  const Scene& scene_;
  const Law& law_;
  double dt_;
  std::size_t cells_;
  double h_;
  std::vector<typename Law::State> state_;                      // per element
  std::vector<double> mass_, force_, velocity_, displacement_;  // per node
  std::vector<double> body_;                                    // per node, only with a body force
  double load_[2] = {0, 0};                                     // force of the tractions on the end nodes
};

}  // namespace

double critical_time_step(const Scene& scene, int cells) {
  return scene.length / cells / material::wave_speed(scene.material);
}

Record run(const Scene& scene, int cells, const Stepping& stepping) {
  if (scene.convected) throw std::invalid_argument("fem solves infinitesimal displacements only");
  for (const Load& load : scene.loads) {
    if (load.transfer != Transfer::node) throw std::invalid_argument("fem has no boundary layer");
  }
  return std::visit(
      [&](const auto& law) {
        Bar<std::decay_t<decltype(law)>> bar(scene, law, cells, stepping);
        return take_steps(bar, stepping);
      },
      scene.material);
}

}  // namespace diptych::fem
