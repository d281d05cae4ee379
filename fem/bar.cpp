#include "fem/bar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/bar_books.hpp"
#include "hinge/step/stepping.hpp"
#include "hinge/step/touches.hpp"

namespace diptych::fem {
namespace {

template <class Law, bool viscous>
class Bars {
 public:
  Bars(const Scene& scene, const std::vector<Law>& laws, int cells, const Stepping& stepping)
      : scene_(scene),
        dt_(stepping.time_step),
        c_max_(largest_wave_speed(scene)),
        books_(scene, meshes_, pairs_, load_) {
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
    books_.before_kick(kick.length, ledger);
    for (auto& mesh : meshes_) mesh.integrate_momentum(kick.length);  // eq. 18
    hold_supports();
    books_.after_kick(kick.length, ledger);
    for (auto& mesh : meshes_) mesh.move(dt_);
    update_stress(ledger);
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
  double energy() const { return books_.energy(); }
  double momentum() const { return books_.momentum(); }
  double free_mass() const { return books_.free_mass(); }
  void complete(Record& record) const { record.touches = touches_.all(); }
  /// Those that this run has built up, whatever the scene asks for.
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
    load_ = {};
    for (const Load& load : scene_.loads) {
      const double traction = load.mean_traction(kick.from, kick.to);
      if (load.end == End::left)
        load_.left -= traction;
      else
        load_.right += traction;
    }
    first().force_at(0) += load_.left;
    last().force_at(last().cells()) += load_.right;
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
      if (pair.closed()) touches_.begin(pair.left(), now + pair.share_of_step() * dt_);
      if (pair.opened()) touches_.end(pair.left(), now);
    }
  }

  void hold_supports() {
    if (scene_.left == Support::fixed) first().velocity_at(0) = 0;
    if (scene_.right == Support::fixed) last().velocity_at(last().cells()) = 0;
  }

  void update_stress(Ledger& ledger) {
    if (ledger.due()) {
      books_.close_line(update_stress<true>(), ledger);
    } else {
      update_stress<false>();
    }
  }

  template <bool with_ledger>
  StressWork update_stress() {
    double largest = 0;
    if constexpr (viscous) {
      if (scene_.viscosity->needs_largest()) {
        for (const auto& mesh : meshes_) largest = std::max(largest, mesh.largest_gradient());
      }
    }
    StressWork work;
    for (auto& mesh : meshes_) mesh.template update_stress<with_ledger>(dt_, c_max_, largest, work);
    return work;
  }

  BarMesh<Law, viscous>& first() { return meshes_.front(); }
  BarMesh<Law, viscous>& last() { return meshes_.back(); }

  const Scene& scene_;
  double dt_, c_max_;
  std::vector<BarMesh<Law, viscous>> meshes_;
  std::vector<Pair> pairs_;
  Touches touches_;
  EndForces load_;
  BarBooks<BarMesh<Law, viscous>> books_;
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
        return material::acting(scene.viscosity) ? go.template operator()<true>(laws)
                                                 : go.template operator()<false>(laws);
      },
      laws(scene));
}

}  // namespace diptych::fem
