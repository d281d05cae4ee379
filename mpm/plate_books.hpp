// The books of the plate: energies and momentum, step by step, with what each scheme takes or gives. What the material
// takes is told from what the scheme misses as in fem/plate_books.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "hinge/scene/scene.hpp"
#include "hinge/solid/plane_model.hpp"
#include "hinge/step/ledger.hpp"
#include "hinge/step/stepping.hpp"
#include "hinge/wide.hpp"
#include "mpm/plate.hpp"
#include "mpm/plate_grid.hpp"
#include "mpm/plate_loads.hpp"
#include "mpm/plate_particles.hpp"
#include "mpm/plate_place.hpp"
#include "mpm/plate_viscosity.hpp"

namespace diptych::mpm {

template <class Particles, solid::PlaneModel Model>
class PlateBooks {
  static constexpr bool convected = Particles::moving;

 public:
  PlateBooks(const Particles& particles, Model& model, const Grid& grid, Bands& bands, const Supports& supports,
             const Loads& loads, const std::optional<Damping>& damping, Scheme scheme, double dt, double pic)
      : particles_(particles),
        model_(model),
        grid_(grid),
        bands_(bands),
        supports_(supports),
        loads_(loads),
        damping_(damping),
        scheme_(scheme),
        dt_(dt),
        pic_(pic),
        row_sums_(grid.ny) {}

  double energy() { return kinetic_energy() + stored_energy(); }
  /// The books hold one number: the component of the momentum along (1, 1).
  double momentum() {
    const State& state = particles_.state();
    double total = 0;
    for (std::size_t p = 0; p < state.count(); ++p) total += state.velocity.x[p] + state.velocity.y[p];
    return state.mass * total / std::sqrt(2);
  }

  // ---- the kick ----

  /// reaction: force of the supports [N]; held: what they gave to the mapped momentum [kg m/s]; both along (1, 1).
  void begin_kick(const Kick& kick, double reaction, double held, Ledger& ledger) {
    // A part of PIC pulls the particles towards the grid's velocity, by the supports as well.
    const double impulse = (loads_.impulse_rate() + reaction + pic_ * held / kick.length) / std::sqrt(2);
    // USL's loads work on the way from one of the grid's own velocities to the next: see mpm/bars.hpp.
    const bool own = scheme_ == Scheme::usl && kick.from > 0;
    const double before = loads_.work_rate(own ? grid_.kicked : grid_.velocity);
    ledger.before_kick(before, impulse, kick.length);
    if (!ledger.keeps()) return;
    if (own) ledger.take_by_scheme(kick.length * (before - loads_.work_rate(grid_.velocity)) / 2);
    if (pic_ > 0) account_for_pic(kick.length, ledger);
    driven_excess_ = excess_of_driven();
  }

  void end_kick(const Kick& kick, Ledger& ledger) {
    const VectorField& after = scheme_ == Scheme::usl ? grid_.kicked : grid_.velocity;
    const double external = loads_.work_rate(after);
    ledger.after_kick(external, kick.length);
    if (!ledger.keeps()) return;
    // Work on the velocity that the particles have at a driven node beyond the one that the node is given.
    const double excess = scheme_ == Scheme::usl ? driven_excess_ : (driven_excess_ + excess_of_driven()) / 2;
    ledger.take_by_scheme(-kick.length * excess);
    // USF: the internal work of the kick's second half, at the places where its forces were found.
    if (convected && scheme_ == Scheme::usf) half_work_of_kick_ = kick.length * (power(grid_.velocity) - external) / 2;
  }

  /// What the scheme takes on its way from one map to the next. The strain was updated with one map's velocities, half
  /// of the stress's work on it stands in the strain energy, and the other half is done by the internal forces with the
  /// particles' new places and velocities. The two cancel where nothing moved in between.
  void account_for_remapping(Ledger& ledger) {
    if (!ledger.keeps() || (!convected && scheme_ != Scheme::usl)) return;
    ledger.take_by_scheme(-(dt_ * power(grid_.velocity) / 2 + half_work_));
  }

  /// USL's kick does τ²/2 Σ m a² of work on the grid with lumped masses; particles take up less of it.
  void account_for_lumping(double kick, Ledger& ledger) {
    if (!ledger.due()) return;
    double grid = 0;
    for_nodes([&](std::size_t node, double m) {
      const double ax = grid_.acceleration.x[node], ay = grid_.acceleration.y[node];
      grid += m * (ax * ax + ay * ay);
    });
    const double particles = particles_.state().mass * sum([&](const Place& at) DIPTYCH_INLINE {
                               const Vector a = at.value(grid_.acceleration);
                               return a[0] * a[0] + a[1] * a[1];
                             });
    ledger.take_by_scheme(kick * kick / 2 * (grid - particles));
    lent_ = kick * kick / 4 * (grid - particles);
  }

  // ---- the update of strain and stress ----

  /// Before the strains' update with these velocities, where the ledger is due.
  void begin_update(const VectorField& velocity, Ledger& ledger) {
    const auto [work, stored] = sums([&](const Place& at) DIPTYCH_INLINE {
      return std::array{work_rate_of_stress(at, velocity), stored_at(at)};
    });
    const State& state = particles_.state();
    const double half_work = state.volume * dt_ * work / 2;
    stored_and_half_ = state.volume * stored + half_work;
    if (!ledger.keeps()) return;
    if (convected && scheme_ == Scheme::usf) ledger.take_by_scheme(-(half_work_of_kick_ + half_work));
    if (damping_) ledger.take_by_viscosity(work_of_viscosity(velocity) / 2);
    if constexpr (Model::yields) model_.note_flow();
  }
  /// And after it.
  void end_update(const VectorField& velocity, Ledger& ledger) {
    if (!ledger.keeps()) {
      ledger.close_line(kinetic_energy(), stored_and_half_, 0, momentum(),
                        lent_ - (damping_ ? work_of_viscosity(velocity) / 4 : 0));
      return;
    }
    // Nothing asks for what a linear law stores.
    const auto [work, kinetic, stored] = sums([&](const Place& at) DIPTYCH_INLINE {
      return std::array{work_rate_of_stress(at, velocity), speed_squared(at), Model::linear ? 0 : stored_at(at)};
    });
    const State& state = particles_.state();
    half_work_ = state.volume * dt_ * work / 2;
    // What the trapezium of the leapfrog finds gone; nothing where the law is linear.
    double between = 0, taken = 0;
    if (!Model::linear) between = stored_and_half_ + half_work_ - state.volume * stored;
    if (Model::staggered) taken += taken_by_damage_;
    if constexpr (Model::yields) taken += work_of_flow();
    if (!model_.has_potential()) taken = between;
    const double viscous = damping_ ? work_of_viscosity(velocity) / 2 : 0;
    const double spent = !Model::only_takes ? 0 : model_.has_potential() ? taken_by_damage_ : between;
    ledger.close_line(state.mass / 2 * kinetic, stored_and_half_, taken, momentum(), lent_ - viscous / 2, spent);
    ledger.take_by_scheme(between - taken);
    ledger.take_by_viscosity(viscous);
    half_work_ += viscous;
  }
  /// Where renew(first cell, cells) gives the cells of each row their new laws, with the strains as these velocities
  /// have just made them in dt. Of cells that do not change damage takes nothing.
  template <class Renew>
  void count_damage(const VectorField& velocity, double dt, Renew&& renew) {
    if constexpr (!convected) {
      const std::size_t columns = grid_.columns();
      bands_.for_each([&](Band& band) {
        for (std::size_t j = band.first; j < band.last; ++j) {
          const std::size_t row = j * columns;
          const auto [from, to] = solid::outdated_in(model_, {row, row + columns});
          row_sums_[j][0] = from < to ? taken_in_row(j, from - row, to - row, velocity, dt, renew, band.told) : 0;
        }
      });
      taken_by_damage_ = particles_.state().volume * of_rows<1>()[0];
    }
  }

  std::size_t bytes() const { return row_sums_.capacity() * sizeof(row_sums_[0]); }

 private:
  /// A part of PIC adds d = part · (Σ N v − v_p) to a particle's velocity.
  void account_for_pic(double kick, Ledger& ledger) {
    const double share = scheme_ == Scheme::usl ? 1 : 0.5;  // of the kick in the velocity that d works on
    const double given = particles_.state().mass * sum([&](const Place& at) DIPTYCH_INLINE {
                           const Vector a = at.value(grid_.acceleration), v = at.value(grid_.velocity);
                           const auto component = [&](double mine, double grid, double kicked) DIPTYCH_INLINE {
                             const double d = pic_ * (grid - mine);
                             return (mine + share * kick * kicked + d / 2) * d;
                           };
                           return component(particles_.state().velocity.x[at.particle], v[0], a[0]) +
                                  component(particles_.state().velocity.y[at.particle], v[1], a[1]);
                         });
    ledger.take_by_scheme(-given);
  }

  /// Σ of what damage takes at the least in columns [from, to) of a row of cells, of each particle the smaller of the
  /// falls of ψ where the last strain increment began and where it ended. told: room.
  template <class Renew>
  double taken_in_row(std::size_t j, std::size_t from, std::size_t to, const VectorField& velocity, double dt,
                      Renew&& renew, std::vector<double>& told) {
    const std::size_t cells = to - from, particles = particles_.per_cell(), count = cells * particles;
    if (told.size() < 4 * count) told.resize(4 * count);
    const auto tell = [&](double* out) {
      particles_.tell_row(
          j, from, to, [&](const Place& at) DIPTYCH_INLINE { return stored_along(at, velocity, dt); }, out);
    };
    double *before = told.data(), *after = before + 2 * count;
    tell(before);
    renew(j * grid_.columns() + from, cells);
    tell(after);
    double sum = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      for (std::size_t p = i; p < count; p += cells)
        sum += std::min(before[p] - after[p], before[count + p] - after[count + p]);
    }
    return sum;
  }

  /// Sums over all particles of what `tell` says of each, row by row: the same bits for any number of threads.
  template <class Tell>
  std::array<double, told_by<Tell>> sums(Tell tell) {
    static_assert(told_by<Tell> <= most_told);
    bands_.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) {
        const auto of_row = particles_.sum_row(j, tell, band.told);
        std::copy(of_row.begin(), of_row.end(), row_sums_[j].begin());
      }
    });
    return of_rows<told_by<Tell>>();
  }
  template <class F>
  double sum(F f) {
    return sums([f](const Place& at) DIPTYCH_INLINE { return std::array{f(at)}; })[0];
  }
  template <std::size_t numbers>
  std::array<double, numbers> of_rows() const {
    std::array<double, numbers> total{};
    for (const auto& row : row_sums_) {
      for (std::size_t q = 0; q < numbers; ++q) total[q] += row[q];
    }
    return total;
  }
  template <class F>
  void for_nodes(F&& f) {
    for (std::size_t j = 0; j <= grid_.ny; ++j) {
      for (std::size_t i = 0; i <= grid_.nx; ++i) f(grid_.row(j) + i, grid_.mass_of(i, j));
    }
  }

  double kinetic_energy() {
    return particles_.state().mass / 2 * sum([&](const Place& at) DIPTYCH_INLINE { return speed_squared(at); });
  }
  double stored_energy() {
    return particles_.state().volume * sum([&](const Place& at) DIPTYCH_INLINE { return stored_at(at); });
  }
  [[gnu::always_inline]] double speed_squared(const Place& at) const {
    const VectorField& velocity = particles_.state().velocity;
    const double x = velocity.x[at.particle], y = velocity.y[at.particle];
    return x * x + y * y;
  }
  /// ψ [J/m³].
  [[gnu::always_inline]] double stored_at(const Place& at) const {
    return model_.stored(particles_.state().strain[at.particle], at.cell, at.particle);
  }
  /// ψ of a particle where the last strain increment began and where it ended [J/m³].
  [[gnu::always_inline]] std::array<double, 2> stored_along(const Place& at, const VectorField& velocity,
                                                            double dt) const {
    const material::Tensor now = particles_.state().strain[at.particle];
    return {model_.stored(now - at.gradient(velocity, grid_) * dt, at.cell, at.particle),
            model_.stored(now, at.cell, at.particle)};
  }
  /// Of the stress at hand on the strain rate of these velocities [W/m³].
  [[gnu::always_inline]] double work_rate_of_stress(const Place& at, const VectorField& velocity) const {
    return model_.standing(particles_.state().strain[at.particle], at.cell, at.particle)
        .contract(at.gradient(velocity, grid_));
  }
  /// σ:Δε_p of the last update.
  double work_of_flow() {
    return particles_.state().volume * sum([&](const Place& at) {
             return model_.work_of_flow(particles_.state().strain[at.particle], at.cell, at.particle);
           });
  }
  /// Of the artificial viscosity at hand on the strain increment of these velocities [J].
  double work_of_viscosity(const VectorField& velocity) {
    return particles_.state().volume * dt_ * sum([&](const Place& at) DIPTYCH_INLINE {
             const material::Tensor rate = at.gradient(velocity, grid_);
             return damping_->stress(at.particle) * (rate.xx + rate.yy);
           });
  }
  /// Σ m a · v
  double power(const VectorField& velocity) {
    double total = 0;
    for_nodes([&](std::size_t node, double m) {
      total += m * (grid_.acceleration.x[node] * velocity.x[node] + grid_.acceleration.y[node] * velocity.y[node]);
    });
    return total;
  }
  double excess_of_driven() const {
    double total = 0;
    for (const auto& d : supports_.driven()) {
      const std::size_t node = grid_.row(d.j) + d.i;
      total += grid_.mass_of(d.i, d.j) * (grid_.acceleration.x[node] * (d.unheld[0] - grid_.velocity.x[node]) +
                                          grid_.acceleration.y[node] * (d.unheld[1] - grid_.velocity.y[node]));
    }
    return total;
  }

  const Particles& particles_;
  Model& model_;
  const Grid& grid_;
  Bands& bands_;
  const Supports& supports_;
  const Loads& loads_;
  const std::optional<Damping>& damping_;
  Scheme scheme_;
  double dt_, pic_;
  static constexpr std::size_t most_told = 3;
  std::vector<std::array<double, most_told>> row_sums_;
  double stored_and_half_ = 0, half_work_ = 0, half_work_of_kick_ = 0, driven_excess_ = 0, taken_by_damage_ = 0,
         lent_ = 0;
};

}  // namespace diptych::mpm
