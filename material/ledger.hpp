// Energy and momentum book-keeping, the same for every method.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "material/record.hpp"
#include "material/scene.hpp"

namespace diptych {

/// Adds up what loads and supports put in and compares it with what the bars hold and what took it away. For each kick
/// of length τ that takes v⁻ to v⁺ under forces f, the work is τ f·(v⁻ + v⁺)/2: the discrete kinetic energy changes by
/// exactly that much.
class Ledger {
 public:
  /// first_time: of the velocity in the first line [s]; free_mass: of bars that no support holds, else 0 [kg].
  Ledger(Books books, double time_step, double first_time, double energy, double momentum, double free_mass)
      : books_(books),
        dt_(time_step),
        first_time_(first_time),
        start_momentum_(momentum),
        free_mass_(free_mass),
        input_(std::max(0.0, energy - of_flight(momentum))) {}

  /// f·v⁻ and the total force of loads and supports, before a kick.
  void before_kick(double work_rate, double force, double kick) {
    add_work(kick * work_rate / 2);
    impulse_ += kick * force;
  }
  /// f·v⁺ after it.
  void after_kick(double work_rate, double kick) { add_work(kick * work_rate / 2); }

  /// Energies that left on ways of their own [J]. Whatever belongs to a kick is told before its line is closed.
  void take_by_contact(double energy) { contact_ += energy; }
  void take_by_viscosity(double energy) { viscous_ += energy; }
  void take_by_scheme(double energy) { scheme_ += energy; }

  void close_line(double kinetic, double strain, double dissipated, double momentum) {
    const double held = kinetic + strain + dissipated_ + viscous_;  // strain starts from ψⁿ, so heat is of steps before
    // The books open with the first line: before it the leapfrog has no energy of its own.
    if (sums_.lines == 0) {
      opening_ = held + contact_ - work_;
      scheme_ = 0;
    }
    add({first_time_ + static_cast<double>(sums_.lines) * dt_, kinetic, strain, dissipated_, viscous_, contact_,
         scheme_, work_, work_ + opening_ - held - contact_ - scheme_, momentum, start_momentum_ + impulse_});
    dissipated_ += dissipated;
  }

  /// A stable run never holds more than was put in; at a Courant number very near the limit the energies at hand can
  /// stand above the leapfrog's own by 1/(1 − C²), hence the wide margin. An unstable run passes it within a few
  /// hundred steps. A free bar is looked at from its centre of mass, or its flight would hide what grows inside; the
  /// last term is the round-off of that subtraction.
  bool unstable() const {
    if (sums_.lines == 0) return false;
    const LedgerLine& now = sums_.last;
    const double inside = now.kinetic - of_flight(now.momentum) + std::abs(now.strain);
    return !(inside <= 1e6 * input_ + 1e-9 * now.kinetic);
  }

  const LedgerSums& sums() const { return sums_; }
  std::vector<LedgerLine> take_lines() { return std::move(lines_); }

 private:
  double of_flight(double momentum) const { return free_mass_ > 0 ? momentum * momentum / (2 * free_mass_) : 0; }

  void add_work(double work) {
    work_ += work;
    input_ += std::abs(work);
  }

  void add(const LedgerLine& line) {
    ++sums_.lines;
    sums_.last = line;
    sums_.held = std::max(sums_.held, line.kinetic + std::abs(line.strain) + line.dissipated + std::abs(line.viscous));
    sums_.kinetic = std::max(sums_.kinetic, line.kinetic);
    sums_.taken = std::max(sums_.taken, std::abs(line.contact + line.scheme + line.lost));
    sums_.lost = std::max(sums_.lost, std::abs(line.lost));
    sums_.momentum = std::max(sums_.momentum, std::abs(line.momentum - line.impulse));
    sums_.finite =
        sums_.finite && std::isfinite(line.lost) && std::isfinite(line.momentum) && std::isfinite(line.impulse);
    if (books_ == Books::lines) lines_.push_back(line);
  }

  Books books_;
  double dt_, first_time_;
  double start_momentum_, free_mass_;
  double input_;  ///< sum of all that was put in or taken out
  double work_ = 0, impulse_ = 0, dissipated_ = 0, viscous_ = 0, contact_ = 0, scheme_ = 0, opening_ = 0;
  LedgerSums sums_;
  std::vector<LedgerLine> lines_;
};

}  // namespace diptych
