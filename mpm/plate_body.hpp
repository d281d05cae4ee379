// The plate and its step, for one kind of particles and one model of its solid: what plate_solid.cpp.in and
// plate_moving.cpp compile.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/scene/gauges.hpp"
#include "hinge/scene/plate_check.hpp"
#include "hinge/solid/cone.hpp"
#include "hinge/step/stepping.hpp"
#include "mpm/plate.hpp"
#include "mpm/plate_books.hpp"
#include "mpm/plate_grid.hpp"
#include "mpm/plate_kernels.hpp"
#include "mpm/plate_loads.hpp"
#include "mpm/plate_particles.hpp"
#include "mpm/plate_run.hpp"
#include "mpm/plate_sampling.hpp"
#include "mpm/plate_viscosity.hpp"

namespace diptych::mpm {

template <class Particles, solid::PlaneModel Model>
class PlateBody {
 public:
  static constexpr bool convected = Particles::moving;
  static_assert(!convected || !Model::staggered, "what changes in cells cannot go with particles that cross them");

  template <class Solid>
  PlateBody(const Setup& setup, const Solid& solid)
      : plate_(setup.plate),
        scheme_(setup.scheme),
        dt_(setup.stepping.time_step),
        grid_(grid_of(plate_, setup.cells, convected, scheme_ == Scheme::usl)),
        places_(setup.positions),
        lattice_{static_cast<std::size_t>(setup.cells.x), static_cast<std::size_t>(setup.cells.y), grid_.hx, grid_.hy,
                 places_},
        particles_(plate_, setup.cells, places_, grid_),
        model_(solid, {setup.cells.x, setup.cells.y, grid_.hx, grid_.hy}, particles_.storage()),
        bands_(grid_.ny, grid_.row_length(), setup.stepping.threads),
        supports_(plate_, grid_),
        loads_(plate_, grid_, supports_, places_),
        books_(particles_, model_, grid_, bands_, supports_, loads_, damping_, scheme_, dt_, plate_.pic),
        gauges_(plate_, setup.cells, setup.stepping.steps, !model_.fields().dilatancy.empty()) {
    State& state = particles_.state();
    state.resize(particles_.storage());
    state.volume = grid_.hx * grid_.hy / static_cast<double>(particles_.per_cell());
    state.mass = elastic(plate_).density * state.volume;
    if (Model::staggered) driver_.resize(lattice_.nx * lattice_.ny);
    if (const auto* viscosity = material::acting(plate_.viscosity))
      damping_.emplace(*viscosity, plate_, grid_, particles_.storage());
    if (supports_.has_platen()) platen_.reserve(static_cast<std::size_t>(setup.stepping.steps));
    particles_.map_mass(bands_);
    start(setup.cells);
    if (grid_.cut != Grid::uncut) {
      fly(setup.stepping);
      supports_.join();
    }
    map_momentum();
    if (scheme_ == Scheme::usf) bring_usf_to_its_half_step();
    if (scheme_ != Scheme::usf) internal_force();
  }

  void step(long n, Ledger& ledger) {
    if (scheme_ == Scheme::usf) step_usf(n, ledger);
    if (scheme_ == Scheme::usl) step_usl(n, ledger);
    if (scheme_ == Scheme::musl) step_musl(n, ledger);
    if (supports_.has_platen()) platen_.push_back(platen_now_);
    if (!gauges_.empty()) read_gauges(n + 1);
  }

  // The momentum of the particles stands on the grid when a step begins, mapped when the one before it ended. Where
  // particles keep their places, MUSL's second map is the first map of the next step, and the internal force is found
  // along with the strain that it follows from.

  // Update stress first: (vⁿ, σⁿ⁻½) → (vⁿ⁺¹, σⁿ⁺½).
  void step_usf(long n, Ledger& ledger) {
    const Kick kick = kick_after(n, dt_);
    if (n > 0) {                              // the half-step from 0 to ½ is behind
      update_strain(grid_.velocity, ledger);  // with the particles' velocities; eq. 19
      books_.account_for_remapping(ledger);
    } else {
      internal_force();  // eq. 19
    }
    external_force(kick);      // eqs. 17a, 20
    integrate_momentum(kick);  // eq. 18
    books_.begin_kick(kick, reaction_, held_, ledger);
    kick_and_move(kick.length, dt_);  // eqs. 11, 9, 10, and the new momentum mapped
    books_.end_kick(kick, ledger);
    convect();
  }

  // Update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_usl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    books_.account_for_remapping(ledger);  // since the last update
    external_force(kick);                  // eqs. 17a, 20
    integrate_momentum(kick);              // eq. 18
    books_.begin_kick(kick, reaction_, held_, ledger);
    kick_grid(kick.length);           // likewise: the grid's own new velocities
    kick_and_move(kick.length, dt_);  // eqs. 11, 9, 10
    books_.end_kick(kick, ledger);
    books_.account_for_lumping(kick.length, ledger);
    update_strain(grid_.kicked, ledger);  // with the grid's own new velocities; eq. 19
    convect();
  }

  // Modified update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_musl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    books_.account_for_remapping(ledger);  // since the last update
    external_force(kick);                  // eqs. 17a, 20
    integrate_momentum(kick);              // eq. 18
    books_.begin_kick(kick, reaction_, held_, ledger);
    kick_and_move(kick.length, dt_);  // eqs. 11, 9, 10, and the new momentum mapped once more
    books_.end_kick(kick, ledger);
    update_strain(grid_.velocity, ledger);  // with the particles' new velocities; eq. 19
    convect();
  }

  PlateSnapshot sample(long n) const {
    const double time = static_cast<double>(n) * dt_, half = dt_ / 2;
    const bool usf = scheme_ == Scheme::usf;
    PlateSnapshot s = sample_particles(lattice_, particles_, model_);
    s.step = n;
    s.time = s.stress.time = time_of_stress(n);
    s.velocity.time = usf ? time : n == 0 ? 0 : time - half;
    s.displacement.time = usf ? time + half : time;
    return s;
  }

  std::string trouble() const { return particles_.trouble(); }
  static double gives_back() { return Model::gives_back; }
  double first_ledger_time() const { return scheme_ == Scheme::usf ? dt_ : dt_ / 2; }
  double energy() { return books_.energy(); }
  double momentum() { return books_.momentum(); }
  double free_mass() const {
    return supports_.free() ? particles_.state().mass * static_cast<double>(particles_.count()) : 0;
  }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active;
    model_.name_features(active);
    if (loads_.has_body_force()) active.emplace_back("body-force");
    if (particles_.has_moved()) active.emplace_back("convection");
    if (plate_.impact) active.emplace_back("impact");
    if (plate_.pic > 0) active.emplace_back("pic");
    if (!platen_.empty()) active.emplace_back("platen");
    if (damping_ && damping_->acted()) active.emplace_back("viscosity");
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    return {0, static_cast<long>(particles_.count()) * steps, static_cast<long>(grid_.nodes()) * steps,
            particles_.bytes() + model_.bytes() + grid_.bytes() + bands_.bytes() + supports_.bytes() + loads_.bytes() +
                books_.bytes() + gauges_.bytes() + driver_.capacity() * sizeof(double) +
                (damping_ ? damping_->bytes() : 0)};
  }
  void complete(PlateRecord& record) {
    record.platen = std::move(platen_);
    record.platen_ahead = scheme_ == Scheme::usf ? dt_ / 2 : 0;
    record.gauges = gauges_.records();
    record.fed = model_.fed();
    record.diffusion_updates = model_.node_updates();
    record.approach = static_cast<double>(flight_steps_) * dt_;
    record.left_over = left_over_;
  }

 private:
  // --- how the plate starts ------------------------------------------------------------------------------------------

  void start(const Cells& cells) {
    State& state = particles_.state();
    const auto set = [&](const auto& f, auto&& receive) {
      if (!f) return;
      lattice_.for_cells([&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < particles_.per_cell(); ++k) {
          const Vector x = lattice_.start(i, j, k);
          receive(particles_.index(i, j, k), f(x[0], x[1]));
        }
      });
    };
    set(plate_.initial_velocity, [&](std::size_t p, const Vector& v) {
      state.velocity.x[p] = v[0];
      state.velocity.y[p] = v[1];
    });
    if (plate_.impact) {
      const std::size_t face = impact_column(plate_, cells);
      lattice_.for_cells([&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < particles_.per_cell() && i < face; ++k)
          state.velocity.x[particles_.index(i, j, k)] = plate_.impact->velocity;
      });
    }
    if (!plate_.initial_displacement) return;
    set(plate_.initial_displacement, [&](std::size_t p, const Vector& u) {
      state.displacement.x[p] = u[0];
      state.displacement.y[p] = u[1];
    });
    strain_of_initial_displacement();
    if constexpr (convected) {
      for (std::size_t p = 0; p < particles_.count(); ++p)
        particles_.displace(p, {state.displacement.x[p], state.displacement.y[p]});
      particles_.convect(bands_);
    }
  }
  /// Strains are those of the displacements of the grid's nodes, a field that the cells can take.
  void strain_of_initial_displacement() {
    State& state = particles_.state();
    VectorField nodal;
    nodal.resize(grid_.storage());
    for (std::size_t j = 0; j <= grid_.ny; ++j) {
      for (std::size_t i = 0; i <= grid_.nx; ++i) {
        const Vector u = plate_.initial_displacement(std::clamp(grid_.x(i), 0.0, plate_.width),
                                                     std::clamp(grid_.y(j), 0.0, plate_.height));
        nodal.x[grid_.row(j) + i] = u[0];
        nodal.y[grid_.row(j) + i] = u[1];
      }
    }
    for (std::size_t j = 0; j < particles_.rows(); ++j) {
      particles_.visit_row(j, [&](const Place& at) {
        const material::Tensor strain = at.gradient(nodal, grid_);
        state.strain.xx[at.particle] = strain.xx;
        state.strain.yy[at.particle] = strain.yy;
        state.strain.xy[at.particle] = strain.xy;
      });
    }
    if (supports_.has_platen()) platen_now_ = supports_.of_platen(nodal);
  }

  /// Whole steps until the flyer is as near to the target as it gets: at most half a step's travel is left. Loads count
  /// from the contact, nothing strains in flight, and places are those at its end.
  void fly(const Stepping& stepping) {
    State& state = particles_.state();
    const std::size_t ny = lattice_.ny;
    const auto mean = [&](const std::vector<double>& component, std::size_t column) {
      double sum = 0;
      for (std::size_t j = 0; j < ny; ++j) {
        for (std::size_t k = 0; k < particles_.per_cell(); ++k) sum += component[particles_.index(column, j, k)];
      }
      return sum / static_cast<double>(ny * particles_.per_cell());
    };
    const auto opened = [&](const std::vector<double>& component) {
      return mean(component, grid_.cut) - mean(component, grid_.cut - 1);
    };
    const Kick kick{0, dt_, dt_};
    left_over_ = plate_.impact->gap;
    map_momentum();
    while (!(stepping.cancelled && *stepping.cancelled)) {
      if (!(std::abs(left_over_ + dt_ * opened(state.velocity.x)) < std::abs(left_over_))) break;
      internal_force();
      integrate_momentum(kick);
      if (scheme_ == Scheme::usl) kick_grid(kick.length);
      kick_and_move(kick.length, dt_);
      left_over_ = plate_.impact->gap + opened(state.displacement.x);
      ++flight_steps_;
    }
    for (auto* u : {&state.displacement.x, &state.displacement.y}) std::fill(u->begin(), u->end(), 0.0);
  }

  /// USF keeps the velocity at whole steps and strain and displacement half-way between them.
  void bring_usf_to_its_half_step() {
    strain(grid_.velocity, dt_ / 2);
    for (auto* a : {&grid_.acceleration.x, &grid_.acceleration.y}) std::fill(a->begin(), a->end(), 0.0);
    kick_and_move(0, dt_ / 2);
    convect();
  }

  // --- a step's parts ------------------------------------------------------------------------------------------------

  void map_momentum() {
    particles_.map_momentum(bands_);
    held_ = supports_.hold_velocity();
  }

  /// Internal force of the strain at hand.
  void internal_force() {
    if constexpr (convected)
      particles_.map_force(bands_, model_);
    else
      strain_and_force<Update::force>(grid_.velocity, 0);
  }

  template <Update what>
  void strain_and_force(const VectorField& velocity, double dt) {
    Inviscid none;
    if constexpr (!convected && Model::takes_viscosity && what != Update::both) {
      if (damping_) return particles_.template strain_and_force<what>(bands_, velocity, dt, model_, *damping_);
    }
    particles_.template strain_and_force<what>(bands_, velocity, dt, model_, none);
  }

  /// Strains, what follows from them in the cells, and the internal forces of both. keeps_books: also adds up what
  /// damage takes.
  void strain(const VectorField& velocity, double dt, bool keeps_books = false) {
    if constexpr (convected) {
      if (scheme_ != Scheme::usf) return strain_and_force<Update::strain>(velocity, dt);  // forces: when all have moved
    }
    if constexpr (!Model::staggered) {
      if (!damping_) return strain_and_force<Update::both>(velocity, dt);
    }
    if constexpr (!convected) {
      strain_and_force<Update::strain>(velocity, dt);
      if constexpr (Model::staggered) change_cells(velocity, dt, keeps_books);
      internal_force();
    }
  }

  /// Eqs. 23 to 28, staggered: the cells' mean strains give what changes in cells at the strains' own time.
  void change_cells(const VectorField& velocity, double dt, bool keeps_books) {
    for_rows([&](std::size_t j) { particles_.drive_row(j, model_.driver(), &driver_[j * lattice_.nx]); });
    model_.advance(driver_, dt);
    const auto renew = [&](std::size_t first, std::size_t cells) { model_.renew(first, cells); };
    if (keeps_books && model_.has_potential())
      books_.count_damage(velocity, dt, renew);
    else
      for_rows([&](std::size_t j) { renew(j * lattice_.nx, lattice_.nx); });
  }
  template <class F>
  void for_rows(F&& f) {
    bands_.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) f(j);
    });
  }

  void external_force(const Kick& kick) { loads_.apply(kick, particles_); }

  /// What the supports leave of the accelerations; the velocities follow row by row, while the particles are kicked.
  void integrate_momentum(const Kick& kick) { reaction_ = supports_.hold_acceleration(kick.to, kick.length); }
  void kick_grid(double kick) {
    bands_.for_each([&](Band& band) {
      const std::size_t from = grid_.row(band.first);
      const std::size_t to = band.last == grid_.ny ? grid_.storage() : grid_.row(band.last);
      for (std::size_t i = from; i < to; ++i) {
        grid_.kicked.x[i] = grid_.velocity.x[i] + kick * grid_.acceleration.x[i];
        grid_.kicked.y[i] = grid_.velocity.y[i] + kick * grid_.acceleration.y[i];
      }
    });
  }

  void kick_and_move(double kick, double drift) {
    if (supports_.has_platen())
      platen_now_ += drift * (supports_.of_platen(grid_.velocity) + kick * supports_.of_platen(grid_.acceleration));
    particles_.kick_and_move(bands_, kick, drift, plate_.pic, scheme_ == Scheme::usl && kick > 0);
    held_ = supports_.hold_velocity();
  }

  /// Strains to their new time level, what changes in cells with them, and the internal forces of both.
  void update_strain(const VectorField& velocity, Ledger& ledger) {
    if (!ledger.due()) return strain(velocity, dt_);
    books_.begin_update(velocity, ledger);
    strain(velocity, dt_, ledger.keeps());
    books_.end_update(velocity, ledger);
  }

  void convect() {
    if constexpr (convected) {
      particles_.convect(bands_);
      map_momentum();
      if (scheme_ != Scheme::usf) internal_force();
    }
  }

  void read_gauges(long n) {
    const auto of_cell = [&](std::size_t i, std::size_t j) { return mean_stress(lattice_, particles_, model_, i, j); };
    gauges_.read(time_of_stress(n), of_cell, model_.fields().dilatancy);
  }
  double time_of_stress(long n) const {
    const double time = static_cast<double>(n) * dt_;
    return scheme_ == Scheme::usf ? std::max(time - dt_ / 2, dt_ / 2) : time;
  }

  const Plate& plate_;
  Scheme scheme_;
  double dt_;
  Grid grid_;
  Places places_;
  Lattice lattice_;
  Particles particles_;
  Model model_;
  Bands bands_;
  Supports supports_;
  Loads loads_;
  std::optional<Damping> damping_;
  PlateBooks<Particles, Model> books_;
  Gauges gauges_;
  std::vector<double> driver_;  // of each cell, where something changes in cells
  std::vector<double> platen_;
  double platen_now_ = 0;
  double reaction_ = 0, held_ = 0;  // of the supports, along (1, 1): force of the kick, impulse of the last map
  double left_over_ = 0;
  long flight_steps_ = 0;
};

/// Runs a plate that has been checked.
template <class Particles, class Solid>
PlateRecord run_body(const Setup& setup, const Solid& solid) {
  return solid::with_model(solid, [&]<class Model>() {
    PlateBody<Particles, Model> body(setup, solid);
    return take_steps<PlateRecord>(body, setup.stepping);
  });
}

/// Particles that keep their places.
template <class Solid>
PlateRecord run_standing(const Setup& setup, const Solid& solid) {
  return run_body<Standing>(setup, solid);
}

}  // namespace diptych::mpm
