// A plate of particles and its step, for one kind of particles and one law: what plate_*.cpp compile, each for a few.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "hinge/diffusion/damage_evolution.hpp"
#include "hinge/diffusion/dilatancy.hpp"
#include "hinge/step/stepping.hpp"
#include "mpm/plate.hpp"
#include "mpm/plate_grid.hpp"
#include "mpm/plate_kernels.hpp"
#include "mpm/plate_law.hpp"
#include "mpm/plate_particles.hpp"

namespace diptych::mpm {

inline constexpr std::array sides{Side::left, Side::right, Side::bottom, Side::top};
constexpr bool across(Side side) { return side == Side::left || side == Side::right; }
constexpr bool outward(Side side) { return side == Side::right || side == Side::top; }

/// A traction's force on a node.
struct NodalForce {
  std::size_t node;
  double mass;
  Vector force;
};

/// Column of nodes at which flyer and target meet.
inline std::size_t face_of(const Plate& plate, double hx) {
  return static_cast<std::size_t>(std::lround(plate.impact->face / hx));
}

/// What a run is made of; all of it outlives the run.
struct Setup {
  const Plate& plate;
  const Cells& cells;
  const std::vector<double>& positions;
  Scheme scheme;
  const std::optional<diffusion::Evolution>& evolution;
  const Stepping& stepping;
  const std::optional<diffusion::Spread>& spread;
};

template <class Particles, class PlateLaw>
class Body {
 public:
  static constexpr bool convected = Particles::moving;
  static constexpr bool damaging = PlateLaw::damaging, failing = PlateLaw::failing;
  static constexpr bool staggered = damaging || failing;  // something happens between strain and force

  explicit Body(const Setup& setup)
      : plate_(setup.plate),
        scheme_(setup.scheme),
        dt_(setup.stepping.time_step),
        nx_(static_cast<std::size_t>(setup.cells.x)),
        ny_(static_cast<std::size_t>(setup.cells.y)),
        grid_(lay_grid(plate_, setup.cells, scheme_)),
        places_(setup.positions),
        particles_(plate_, setup.cells, places_, grid_),
        law_(plate_, nx_ * ny_, particles_.storage()),
        bands_(grid_.ny, grid_.row_length(), setup.stepping.threads),
        supports_(plate_, grid_) {
    const auto& [plate, cells, positions, scheme, evolution, stepping, spread] = setup;
    State& state = particles_.state();
    state.resize(particles_.storage());
    state.volume = grid_.hx * grid_.hy / static_cast<double>(particles_.per_cell());
    state.mass = elastic(plate).density * state.volume;
    if constexpr (damaging) {
      evolution_.emplace(*evolution, diffusion::Grid{cells.x, cells.y, grid_.hx, grid_.hy});
      volumetric_strain_.resize(nx_ * ny_);
      has_diffusion_ = evolution->diffusion.has_value();
    }
    if constexpr (failing) {
      dilatancy_.emplace(*spread, diffusion::Grid{cells.x, cells.y, grid_.hx, grid_.hy});
      ceiling_.resize(nx_ * ny_);
      has_diffusion_ = true;
      law_.dilate(dilatancy_->of_cells());
    }
    if (plate.viscosity) damping_.emplace(*plate.viscosity, plate, grid_, particles_.storage());
    place_gauges(stepping.steps);
    row_sums_.resize(grid_.ny);
    if (supports_.has_platen()) platen_.reserve(static_cast<std::size_t>(stepping.steps));
    nodal_forces_.reserve(8 * (grid_.nx + grid_.ny));
    if (plate.body_force) body_.resize(grid_.storage());
    particles_.map_mass(bands_);
    start();
    if (grid_.cut != Grid::uncut) {
      fly(stepping);
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
      account_for_remapping(ledger);
    } else {
      internal_force();  // eq. 19
    }
    external_force(kick);      // eqs. 17a, 20
    integrate_momentum(kick);  // eq. 18
    begin_kick(kick, ledger);
    kick_and_move(kick.length, dt_);  // eqs. 11, 9, 10, and the new momentum mapped
    end_kick(kick, ledger);
    convect();
  }

  // Update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_usl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    account_for_remapping(ledger);  // since the last update
    external_force(kick);           // eqs. 17a, 20
    integrate_momentum(kick);       // eq. 18
    begin_kick(kick, ledger);
    kick_grid(kick.length);           // likewise: the grid's own new velocities
    kick_and_move(kick.length, dt_);  // eqs. 11, 9, 10
    end_kick(kick, ledger);
    account_for_lumping(kick.length, ledger);
    update_strain(grid_.kicked, ledger);  // with the grid's own new velocities; eq. 19
    convect();
  }

  // Modified update stress last: (σⁿ, vⁿ⁻½) → (σⁿ⁺¹, vⁿ⁺½).
  void step_musl(long n, Ledger& ledger) {
    const Kick kick = kick_around(n, dt_);
    account_for_remapping(ledger);  // since the last update
    external_force(kick);           // eqs. 17a, 20
    integrate_momentum(kick);       // eq. 18
    begin_kick(kick, ledger);
    kick_and_move(kick.length, dt_);  // eqs. 11, 9, 10, and the new momentum mapped once more
    end_kick(kick, ledger);
    update_strain(grid_.velocity, ledger);  // with the particles' new velocities; eq. 19
    convect();
  }

  PlateSnapshot sample(long n) const {
    const double time = static_cast<double>(n) * dt_, half = dt_ / 2;
    const bool usf = scheme_ == Scheme::usf;
    PlateSnapshot s;
    s.step = n;
    s.time = time_of_stress(n);
    const std::size_t count = particles_.count(), per_cell = particles_.per_cell();
    PointField points;
    points.time = s.time;
    points.weight.assign(count, grid_.hx * grid_.hy / static_cast<double>(per_cell));
    std::vector<std::size_t> number;
    for_cells([&](std::size_t i, std::size_t j) {
      for (std::size_t k = 0; k < per_cell; ++k) {
        const Vector x = reference(i, j, k);
        points.x.push_back(x[0]);
        points.y.push_back(x[1]);
        number.push_back(particles_.index(i, j, k));
      }
    });
    const auto in_cell_order = [&](const std::vector<double>& values) {
      std::vector<double> ordered;
      ordered.reserve(count);
      for (const std::size_t p : number) ordered.push_back(values[p]);
      return ordered;
    };
    s.displacement = s.velocity = s.stress = points;
    s.velocity.time = usf ? time : n == 0 ? 0 : time - half;
    s.displacement.time = usf ? time + half : time;
    const State& state = particles_.state();
    s.displacement.component = {in_cell_order(state.displacement.x), in_cell_order(state.displacement.y)};
    s.velocity.component = {in_cell_order(state.velocity.x), in_cell_order(state.velocity.y)};
    s.stress.component.resize(3);
    for (std::size_t q = 0; q < count; ++q) {
      const std::size_t p = number[q];
      const material::Tensor stress = law_.stress(state.strain[p], q / per_cell, p);
      s.stress.component[0].push_back(stress.xx);
      s.stress.component[1].push_back(stress.yy);
      s.stress.component[2].push_back(stress.xy);
    }
    for_cells([&](std::size_t i, std::size_t j) {
      const material::Tensor mean = particles_.mean_strain(i, j);
      s.volumetric_strain.push_back(volumetric(mean));
      if constexpr (damaging) s.strain.push_back(mean);
    });
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

  std::string trouble() const { return particles_.trouble(); }
  static double gives_back() { return failing ? material::FailureWave::gives_back : 0; }
  double first_ledger_time() const { return scheme_ == Scheme::usf ? dt_ : dt_ / 2; }
  double energy() {
    return kinetic_energy() + sum([&](const Place& at) {
                                return law_.stored(particles_.state().strain[at.particle], at.cell, at.particle);
                              }) * particles_.state().volume;
  }
  /// The books hold one number: the component of the momentum along (1, 1).
  double momentum() {
    const State& state = particles_.state();
    double total = 0;
    for (std::size_t p = 0; p < state.count(); ++p) total += state.velocity.x[p] + state.velocity.y[p];
    return state.mass * total / std::sqrt(2);
  }
  double free_mass() const {
    return supports_.free() ? particles_.state().mass * static_cast<double>(particles_.count()) : 0;
  }
  /// Told by what this run has built up, not by what the scene asks for.
  std::vector<std::string> features() const {
    std::vector<std::string> active{damaging ? "damage" : failing ? "failure-wave" : "elastic"};
    if (!body_.x.empty()) active.push_back("body-force");
    if (PlateLaw::plastic) active.push_back("compression-plasticity");
    if (particles_.has_moved()) active.push_back("convection");
    if (has_diffusion_) active.push_back("diffusion");
    if (plate_.impact) active.push_back("impact");
    if (plate_.pic > 0) active.push_back("pic");
    if (!platen_.empty()) active.push_back("platen");
    if (damping_ && damping_->acted()) active.push_back("viscosity");
    std::sort(active.begin(), active.end());
    return active;
  }
  Work work(long steps) const {
    return {0, static_cast<long>(particles_.count()) * steps, static_cast<long>(grid_.nodes()) * steps,
            particles_.bytes() + law_.bytes() + grid_.bytes() + bands_.bytes() + supports_.bytes() + body_.bytes() +
                nodal_forces_.capacity() * sizeof(NodalForce) + volumetric_strain_.capacity() * sizeof(double) +
                ceiling_.capacity() * sizeof(double) + (evolution_ ? evolution_->bytes() : 0) +
                (dilatancy_ ? dilatancy_->bytes() : 0) + (damping_ ? damping_->bytes() : 0)};
  }
  void hand_over(PlateRecord& record) {
    record.platen = std::move(platen_);
    record.platen_ahead = scheme_ == Scheme::usf ? dt_ / 2 : 0;
    record.gauges = gauges_;
    record.fed = evolution_ ? evolution_->fed() : dilatancy_ ? dilatancy_->fed() : 0;
    record.diffusion_updates = evolution_ ? evolution_->node_updates() : dilatancy_ ? dilatancy_->node_updates() : 0;
    record.approach = static_cast<double>(flight_steps_) * dt_;
    record.left_over = left_over_;
  }

 private:
  // --- how the plate starts ------------------------------------------------------------------------------------------

  /// Particles that move have room on the plate's free sides.
  static Grid lay_grid(const Plate& plate, const Cells& cells, Scheme scheme) {
    Grid grid;
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y);
    grid.hx = plate.width / cells.x;
    grid.hy = plate.height / cells.y;
    grid.nx = nx;
    grid.ny = ny;
    if (plate.impact && plate.impact->gap > 0) {
      grid.cut = face_of(plate, grid.hx);
      ++grid.nx;
    }
    if constexpr (convected) {
      const auto room = [&](Side side, std::size_t count) {
        return plate.edge(side).support == Edge::Support::free ? count : 0;
      };
      grid.left = -static_cast<double>(room(Side::left, nx)) * grid.hx;
      grid.bottom = -static_cast<double>(room(Side::bottom, ny)) * grid.hy;
      grid.nx += room(Side::left, nx) + room(Side::right, nx);
      grid.ny += room(Side::bottom, ny) + room(Side::top, ny);
      grid.alike = false;
    }
    grid.stride = off_pages(grid.row_length(), 4);
    grid.mass.assign(grid.mass_rows() * grid.stride, 0);
    grid.velocity.resize(grid.storage());
    grid.acceleration.resize(grid.storage());
    if (scheme == Scheme::usl) grid.kicked.resize(grid.storage());
    return grid;
  }

  void start() {
    State& state = particles_.state();
    const auto set = [&](const auto& f, auto&& receive) {
      if (!f) return;
      for_cells([&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < particles_.per_cell(); ++k) {
          const Vector x = reference(i, j, k);
          receive(particles_.index(i, j, k), f(x[0], x[1]));
        }
      });
    };
    set(plate_.initial_velocity, [&](std::size_t p, const Vector& v) {
      state.velocity.x[p] = v[0];
      state.velocity.y[p] = v[1];
    });
    if (plate_.impact) {
      const std::size_t face = face_of(plate_, grid_.hx);
      for_cells([&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < particles_.per_cell() && i < face; ++k)
          state.velocity.x[particles_.index(i, j, k)] = plate_.impact->velocity;
      });
    }
    if (!plate_.initial_displacement) return;
    set(plate_.initial_displacement, [&](std::size_t p, const Vector& u) {
      state.displacement.x[p] = u[0];
      state.displacement.y[p] = u[1];
    });
    // Strains are those of the displacements of the grid's nodes, a field that the cells can take.
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
    if constexpr (convected) {
      for (std::size_t p = 0; p < particles_.count(); ++p)
        particles_.displace(p, {state.displacement.x[p], state.displacement.y[p]});
      particles_.convect(bands_);
    }
  }

  /// Whole steps until the flyer is as near to the target as it gets: at most half a step's travel is left. Loads count
  /// from the contact, nothing strains in flight, and places are those at its end.
  void fly(const Stepping& stepping) {
    State& state = particles_.state();
    const auto mean = [&](const std::vector<double>& component, std::size_t column) {
      double sum = 0;
      for (std::size_t j = 0; j < ny_; ++j) {
        for (std::size_t k = 0; k < particles_.per_cell(); ++k) sum += component[particles_.index(column, j, k)];
      }
      return sum / static_cast<double>(ny_ * particles_.per_cell());
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

  template <class F>
  void for_cells(F&& f) const {
    for (std::size_t j = 0; j < ny_; ++j) {
      for (std::size_t i = 0; i < nx_; ++i) f(i, j);
    }
  }
  /// Where the k-th particle of a cell of the plate started.
  Vector reference(std::size_t i, std::size_t j, std::size_t k) const {
    return {(static_cast<double>(i) + (0.5 + places_.offset[k % places_.count()])) * grid_.hx,
            (static_cast<double>(j) + (0.5 + places_.offset[k / places_.count()])) * grid_.hy};
  }
  double volumetric(const material::Tensor& strain) const {
    if (const auto* damage = std::get_if<material::TensileDamage>(&plate_.material)) return damage->volumetric(strain);
    material::TensileDamage reading;
    reading.elastic = elastic(plate_);
    return reading.volumetric(strain);
  }

  // --- a step's parts ------------------------------------------------------------------------------------------------

  void map_momentum() {
    particles_.map_momentum(bands_);
    held_ = supports_.hold_velocity();
  }

  /// Internal force of the strain at hand.
  void internal_force() {
    if constexpr (convected)
      particles_.map_force(bands_, law_);
    else
      strain_and_force<Do::force>(grid_.velocity, 0);
  }

  template <Do what>
  void strain_and_force(const VectorField& velocity, double dt) {
    Inviscid none;
    if constexpr (!convected && !damaging && !PlateLaw::plastic && what != Do::both) {
      if (damping_) return particles_.template strain_and_force<what>(bands_, velocity, dt, law_, *damping_);
    }
    particles_.template strain_and_force<what>(bands_, velocity, dt, law_, none);
  }

  /// Strains, what follows from them in the cells, and the internal forces of both. books: also adds up what damage
  /// takes.
  void strain(const VectorField& velocity, double dt, bool books = false) {
    if constexpr (!staggered) {
      if (!damping_) return strain_and_force<Do::both>(velocity, dt);
    }
    if constexpr (!convected) {
      strain_and_force<Do::strain>(velocity, dt);
      if constexpr (damaging) crack(velocity, dt, books);
      if constexpr (failing) dilate(dt);
      internal_force();
    }
  }

  /// Tractions on the nodes of the sides, and the body force. A node takes its part of the sides of the cells beside it
  /// as the particles divide them: half, where they stand evenly. So uniform stress is in equilibrium with its
  /// tractions.
  void external_force(const Kick& kick) {
    nodal_forces_.clear();
    for (const Side side : sides) {
      const Edge& edge_of_plate = plate_.edge(side);
      if (!edge_of_plate.normal_traction && !edge_of_plate.shear_traction) continue;
      const auto mean = [&](const auto& traction) { return traction ? traction(kick.from, kick.to) : 0.0; };
      const double normal = (outward(side) ? 1 : -1) * mean(edge_of_plate.normal_traction);
      const double shear = mean(edge_of_plate.shear_traction), h = across(side) ? grid_.hy : grid_.hx;
      supports_.for_nodes(side, [&](std::size_t i, std::size_t j) {
        const std::size_t k = across(side) ? j : i, last = grid_.ny;
        const bool begins = across(side) ? k == 0 : grid_.ends_left(k);
        const bool ends = across(side) ? k == last : grid_.ends_right(k);
        const double length = begins ? h * places_.near() : ends ? h * places_.far() : h;
        nodal_forces_.push_back(
            {grid_.row(j) + i, grid_.mass_of(i, j),
             across(side) ? Vector{length * normal, length * shear} : Vector{length * shear, length * normal}});
      });
    }
    for (const NodalForce& f : nodal_forces_) {
      grid_.acceleration.x[f.node] += f.force[0] / f.mass;
      grid_.acceleration.y[f.node] += f.force[1] / f.mass;
    }
    if (plate_.body_force) add_body_force((kick.from + kick.to) / 2);
  }

  void add_body_force(double time) {  // eq. 17a; the function is asked in one thread only
    for (auto* b : {&body_.x, &body_.y}) std::fill(b->begin(), b->end(), 0.0);
    for (std::size_t j = 0; j < particles_.rows(); ++j) {
      particles_.visit_row(j, [&](const Place& at) {
        const Vector x = particles_.position(at), b = plate_.body_force(x[0], x[1], time);
        for (std::size_t c = 0; c < 2; ++c) {
          double* nodal = (c == 0 ? body_.x : body_.y).data() + at.node;
          const double force = particles_.state().mass * b[c];
          nodal[0] += at.bottom * (at.left * force);
          nodal[1] += at.bottom * (at.right * force);
          nodal[at.next_row] += at.top * (at.left * force);
          nodal[at.next_row + 1] += at.top * (at.right * force);
        }
      });
    }
    for (std::size_t j = 0; j <= grid_.ny; ++j) {
      for (std::size_t i = 0; i <= grid_.nx; ++i) {
        const std::size_t node = grid_.row(j) + i;
        const double m = grid_.mass_of(i, j);
        if (m > 0) {
          grid_.acceleration.x[node] += body_.x[node] / m;
          grid_.acceleration.y[node] += body_.y[node] / m;
        }
      }
    }
  }

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

  /// Strains to their new time level, crack densities with them, and the internal forces of both.
  void update_strain(const VectorField& velocity, Ledger& ledger) {
    if (!ledger.due()) {
      strain(velocity, dt_);
      return;
    }
    const double half_work = work_of_stress(velocity) / 2, stored_and_half = stored_energy() + half_work;
    if (ledger.keeps()) {
      if (convected && scheme_ == Scheme::usf) ledger.take_by_scheme(-(half_work_of_kick_ + half_work));
      if (damping_) ledger.take_by_viscosity(work_of_viscosity(velocity) / 2);
    }
    if constexpr (PlateLaw::plastic) law_.note_flow(ledger.keeps());
    strain(velocity, dt_, ledger.keeps());
    if (!ledger.keeps()) {
      ledger.close_line(kinetic_energy(), stored_and_half, 0, momentum(),
                        lent_ - (damping_ ? work_of_viscosity(velocity) / 4 : 0));
      return;
    }
    half_work_ = work_of_stress(velocity) / 2;
    // What the trapezium of the leapfrog finds gone; nothing where the law is linear. Of it the material takes what
    // damage takes at the least and what flows, and the scheme the rest; all of it where the stress has no potential:
    // see fem/plate.cpp.
    double between = 0, taken = 0;
    if constexpr (staggered || PlateLaw::plastic) between = stored_and_half + half_work_ - stored_energy();
    if constexpr (damaging) taken += taken_by_damage_;
    if constexpr (PlateLaw::plastic) taken += work_of_flow();
    if (!law_.has_potential()) taken = between;
    const double viscous = damping_ ? work_of_viscosity(velocity) / 2 : 0;
    const double by_damage = !damaging ? 0 : law_.has_potential() ? taken_by_damage_ : between;
    ledger.close_line(kinetic_energy(), stored_and_half, taken, momentum(), lent_ - viscous / 2, by_damage);
    ledger.take_by_scheme(between - taken);
    ledger.take_by_viscosity(viscous);
    half_work_ += viscous;
  }

  /// Each cell's mean strain gives it its crack density at the strains' own time.
  void crack(const VectorField& velocity, double dt, bool books) {
    bands_.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) {
        for (std::size_t i = 0; i < nx_; ++i)
          volumetric_strain_[j * nx_ + i] = volumetric(particles_.mean_strain(i, j));
      }
    });
    evolution_->advance(volumetric_strain_, dt);
    if (!books) {
      law_.crack(evolution_->crack_density());
      return;
    }
    stored_before_.resize(particles_.storage());
    sum([&](const Place& at) { return (stored_before_[at.particle] = stored_along(at, velocity, dt))[0]; });
    law_.crack(evolution_->crack_density());
    taken_by_damage_ = particles_.state().volume * sum([&](const Place& at) {
                         const auto before = stored_before_[at.particle], after = stored_along(at, velocity, dt);
                         return std::min(before[0] - after[0], before[1] - after[1]);
                       });
  }

  /// Each cell's mean strain shows the diffusion its ceiling, and its dilatancy at the strains' own time comes back.
  void dilate(double dt) {
    bands_.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) {
        for (std::size_t i = 0; i < nx_; ++i) ceiling_[j * nx_ + i] = law_.ceiling(particles_.mean_strain(i, j));
      }
    });
    dilatancy_->advance(ceiling_, dt);
    law_.dilate(dilatancy_->of_cells());
  }

  void convect() {
    if constexpr (convected) {
      particles_.convect(bands_);
      map_momentum();
      if (scheme_ != Scheme::usf) internal_force();
    }
  }

  // --- gauges --------------------------------------------------------------------------------------------------------

  /// On the line between the middles of two cells, and where it stands between two rows half-way between two lines.
  struct Spot {
    std::array<std::size_t, 2> column, row;
    double right;  ///< share of the right column
  };

  void place_gauges(long steps) {
    // The cells whose middles are beside a place counted in cells; places on middles and faces but for round-off are on
    // them, so that mirrored gauges read the same bits.
    const auto beside = [](double place, std::size_t cells) {
      double at = place - 0.5;
      if (const double near = std::round(2 * at) / 2; std::abs(at - near) < 1e-9) at = near;
      at = std::clamp(at, 0.0, static_cast<double>(cells - 1));
      const auto low = static_cast<std::size_t>(at);
      return std::tuple{low, std::min(low + 1, cells - 1), at - static_cast<double>(low)};
    };
    for (const Gauge& gauge : plate_.gauges) {
      const auto [left, right, share] = beside(gauge.x / grid_.hx, nx_);
      const auto [below, above, part] = beside(gauge.y / grid_.hy, ny_);
      spots_.push_back({{left, right}, {part > 0.5 ? above : below, part < 0.5 ? below : above}, share});
      GaugeRecord& record = gauges_.emplace_back();
      for (auto* values : {&record.time, &record.xx, &record.yy}) values->reserve(static_cast<std::size_t>(steps));
      if (failing) record.dilatancy.reserve(static_cast<std::size_t>(steps));
    }
  }

  void read_gauges(long n) {
    for (std::size_t g = 0; g < gauges_.size(); ++g) {
      const Spot& spot = spots_[g];
      const auto read = [&](auto&& of_cell) {
        const auto row = [&](std::size_t j) {
          return (1 - spot.right) * of_cell(spot.column[0], j) + spot.right * of_cell(spot.column[1], j);
        };
        return (row(spot.row[0]) + row(spot.row[1])) / 2;
      };
      GaugeRecord& record = gauges_[g];
      record.time.push_back(time_of_stress(n));
      record.xx.push_back(read([&](std::size_t i, std::size_t j) { return mean_stress(i, j, &material::Tensor::xx); }));
      record.yy.push_back(read([&](std::size_t i, std::size_t j) { return mean_stress(i, j, &material::Tensor::yy); }));
      if constexpr (failing)
        record.dilatancy.push_back(
            read([&](std::size_t i, std::size_t j) { return dilatancy_->of_cells()[j * nx_ + i]; }));
    }
  }

  /// Of a cell's particles, from the outside in.
  double mean_stress(std::size_t i, std::size_t j, double material::Tensor::*component) const {
    const std::size_t along = places_.count();
    const double sum = pair_sum<0>(along, [&](std::size_t b) {
      return pair_sum<0>(along, [&](std::size_t a) {
        const std::size_t p = particles_.index(i, j, b * along + a);
        return law_.stress(particles_.state().strain[p], j * nx_ + i, p).*component;
      });
    });
    return sum / static_cast<double>(along * along);
  }

  double time_of_stress(long n) const {
    const double time = static_cast<double>(n) * dt_;
    return scheme_ == Scheme::usf ? std::max(time - dt_ / 2, dt_ / 2) : time;
  }

  // --- books ---------------------------------------------------------------------------------------------------------

  void begin_kick(const Kick& kick, Ledger& ledger) {
    // A part of PIC pulls the particles towards the grid's velocity, by the supports as well.
    const double impulse = (external_impulse_rate() + reaction_ + plate_.pic * held_ / kick.length) / std::sqrt(2);
    // USL's loads work on the way from one of the grid's own velocities to the next: see mpm/bar_step.hpp.
    const bool own = scheme_ == Scheme::usl && kick.from > 0;
    const double before = work_rate(own ? grid_.kicked : grid_.velocity);
    ledger.before_kick(before, impulse, kick.length);
    if (!ledger.keeps()) return;
    if (own) ledger.take_by_scheme(kick.length * (before - work_rate(grid_.velocity)) / 2);
    if (plate_.pic > 0) account_for_pic(kick.length, ledger);
    driven_excess_ = excess_of_driven();
  }

  void end_kick(const Kick& kick, Ledger& ledger) {
    const VectorField& after = scheme_ == Scheme::usl ? grid_.kicked : grid_.velocity;
    const double external = work_rate(after);
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
    const double particles = particles_.state().mass * sum([&](const Place& at) {
                               const Vector a = at.value(grid_.acceleration);
                               return a[0] * a[0] + a[1] * a[1];
                             });
    ledger.take_by_scheme(kick * kick / 2 * (grid - particles));
    lent_ = kick * kick / 4 * (grid - particles);
  }

  /// A part of PIC adds d = part · (Σ N v − v_p) to a particle's velocity.
  void account_for_pic(double kick, Ledger& ledger) {
    const double share = scheme_ == Scheme::usl ? 1 : 0.5;  // of the kick in the velocity that d works on
    const double given = particles_.state().mass * sum([&](const Place& at) {
                           const Vector a = at.value(grid_.acceleration), v = at.value(grid_.velocity);
                           const auto component = [&](double mine, double grid, double kicked) {
                             const double d = plate_.pic * (grid - mine);
                             return (mine + share * kick * kicked + d / 2) * d;
                           };
                           return component(particles_.state().velocity.x[at.particle], v[0], a[0]) +
                                  component(particles_.state().velocity.y[at.particle], v[1], a[1]);
                         });
    ledger.take_by_scheme(-given);
  }

  /// Σ f of particles, row by row: the same bits for any number of threads.
  template <class F>
  double sum(F&& f) {
    bands_.for_each([&](Band& band) {
      for (std::size_t j = band.first; j < band.last; ++j) {
        double row = 0;
        particles_.visit_row(j, [&](const Place& at) { row += f(at); });
        row_sums_[j] = row;
      }
    });
    double total = 0;
    for (const double row : row_sums_) total += row;
    return total;
  }
  template <class F>
  void for_nodes(F&& f) {
    for (std::size_t j = 0; j <= grid_.ny; ++j) {
      for (std::size_t i = 0; i <= grid_.nx; ++i) f(grid_.row(j) + i, grid_.mass_of(i, j));
    }
  }

  double kinetic_energy() {
    const State& state = particles_.state();
    return state.mass / 2 * sum([&](const Place& at) {
             const double x = state.velocity.x[at.particle], y = state.velocity.y[at.particle];
             return x * x + y * y;
           });
  }
  double stored_energy() {
    const State& state = particles_.state();
    return state.volume *
           sum([&](const Place& at) { return law_.stored(state.strain[at.particle], at.cell, at.particle); });
  }
  /// ψ of a particle where the last strain increment began and where it ended [J/m³].
  std::array<double, 2> stored_along(const Place& at, const VectorField& velocity, double dt) {
    const material::Tensor now = particles_.state().strain[at.particle];
    return {law_.stored(now - at.gradient(velocity, grid_) * dt, at.cell, at.particle),
            law_.stored(now, at.cell, at.particle)};
  }
  /// σ:Δε_p of the last update.
  double work_of_flow() {
    return particles_.state().volume * sum([&](const Place& at) {
             return law_.work_of_flow(particles_.state().strain[at.particle], at.cell, at.particle);
           });
  }
  /// Of the stress at hand on the strain increment of these velocities.
  double work_of_stress(const VectorField& velocity) {
    const State& state = particles_.state();
    return state.volume * dt_ * sum([&](const Place& at) {
             return law_.stress(state.strain[at.particle], at.cell, at.particle).contract(at.gradient(velocity, grid_));
           });
  }
  /// Of the artificial viscosity at hand, likewise.
  double work_of_viscosity(const VectorField& velocity) {
    return particles_.state().volume * dt_ * sum([&](const Place& at) {
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
  double work_rate(const VectorField& velocity) const {
    double total = 0;
    for (const NodalForce& f : nodal_forces_)
      total += f.force[0] * velocity.x[f.node] + f.force[1] * velocity.y[f.node];
    for (std::size_t i = 0; i < body_.x.size(); ++i) total += body_.x[i] * velocity.x[i] + body_.y[i] * velocity.y[i];
    for (const auto& d : supports_.driven()) {
      const std::size_t node = grid_.row(d.j) + d.i;
      total += d.reaction[0] * velocity.x[node] + d.reaction[1] * velocity.y[node];
    }
    return total;
  }
  double external_impulse_rate() const {
    double total = 0;
    for (const NodalForce& f : nodal_forces_) total += f.force[0] + f.force[1];
    for (std::size_t i = 0; i < body_.x.size(); ++i) total += body_.x[i] + body_.y[i];
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

  const Plate& plate_;
  Scheme scheme_;
  double dt_;
  std::size_t nx_, ny_;  // cells of the plate
  Grid grid_;
  Places places_;
  Particles particles_;
  PlateLaw law_;
  Bands bands_;
  Supports supports_;
  std::optional<diffusion::DamageEvolution> evolution_;
  std::optional<diffusion::Dilatancy> dilatancy_;
  std::optional<Damping> damping_;
  bool has_diffusion_ = false;
  std::vector<double> volumetric_strain_;  // of each cell, only with damage
  std::vector<double> ceiling_;            // V_d,max of each cell, only with a failure wave
  VectorField body_;                       // forces on nodes, only with a body force
  std::vector<NodalForce> nodal_forces_;   // of the current step
  std::vector<double> platen_;
  double platen_now_ = 0;
  std::vector<Spot> spots_;
  std::vector<GaugeRecord> gauges_;
  double left_over_ = 0;
  long flight_steps_ = 0;
  // For the books:
  std::vector<double> row_sums_;
  std::vector<std::array<double, 2>> stored_before_;  // of particles, before they crack
  double half_work_ = 0, half_work_of_kick_ = 0, reaction_ = 0, held_ = 0, driven_excess_ = 0, taken_by_damage_ = 0,
         lent_ = 0;
};

/// Runs a plate that has been checked.
template <class Particles, class PlateLaw>
PlateRecord run_body(const Setup& setup) {
  Body<Particles, PlateLaw> body(setup);
  return take_steps<PlateRecord>(body, setup.stepping);
}

using Whole = Law<Damage::none, false>;
using Yielding = Law<Damage::none, true>;  // plasticity in compression
using Cracked = Law<Damage::cracks, false>;
using CrackedYielding = Law<Damage::cracks, true>;
using Failing = Law<Damage::failure_wave, false>;

// In plate_elastic.cpp, plate_cracked.cpp, plate_failing.cpp and plate_moving.cpp.
extern template PlateRecord run_body<Standing, Whole>(const Setup&);
extern template PlateRecord run_body<Standing, Yielding>(const Setup&);
extern template PlateRecord run_body<Standing, Cracked>(const Setup&);
extern template PlateRecord run_body<Standing, CrackedYielding>(const Setup&);
extern template PlateRecord run_body<Standing, Failing>(const Setup&);
extern template PlateRecord run_body<Moving, Whole>(const Setup&);
extern template PlateRecord run_body<Moving, Yielding>(const Setup&);

}  // namespace diptych::mpm
