// Energy and momentum book-keeping, the same for every method.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "material/record.hpp"

namespace diptych {

/// Adds up what loads and supports put in and compares it with what the bar holds. For each kick of length τ that takes
/// v⁻ to v⁺ under forces f, the work is τ f·(v⁻ + v⁺)/2: the discrete kinetic energy changes by exactly that much.
class Ledger {
 public:
  /// first_time: of the velocity in the first line [s].
  Ledger(double time_step, double first_time, double initial_energy, double initial_momentum)
      : dt_(time_step), first_time_(first_time), start_momentum_(initial_momentum), input_(initial_energy) {}

  /// f·v⁻ and the total force of loads and supports, before a kick.
  void before_kick(double work_rate, double force, double kick) {
    add_work(kick * work_rate / 2);
    impulse_ += kick * force;
  }
  /// f·v⁺ after it.
  void after_kick(double work_rate, double kick) { add_work(kick * work_rate / 2); }

  void close_line(double kinetic, double strain, double dissipated, double momentum) {
    const double held = kinetic + strain + dissipated_;  // strain starts from ψⁿ, so heat is that of the steps before
    // The books open with the first line: before it the leapfrog has no energy of its own.
    if (lines_.empty()) opening_ = held - work_;
    lines_.push_back({first_time_ + static_cast<double>(lines_.size()) * dt_, kinetic, strain, dissipated_, work_,
                      work_ + opening_ - held, momentum, start_momentum_ + impulse_});
    dissipated_ += dissipated;
  }

  /// A stable run never holds more than was put in; at a Courant number very near the limit the energies at hand can
  /// stand above the leapfrog's own by 1/(1 − C²), hence the wide margin. An unstable run passes it within a few
  /// hundred steps.
  bool unstable() const {
    if (lines_.empty()) return false;
    const double held = lines_.back().kinetic + std::abs(lines_.back().strain);
    return !(held <= 1e6 * input_);
  }

  std::vector<LedgerLine> take() { return std::move(lines_); }

 private:
  void add_work(double work) {
    work_ += work;
    input_ += std::abs(work);
  }

  double dt_, first_time_;
  double start_momentum_;
  double input_;  ///< sum of all that was put in or taken out
  double work_ = 0, impulse_ = 0, dissipated_ = 0, opening_ = 0;
  std::vector<LedgerLine> lines_;
};

}  // namespace diptych
