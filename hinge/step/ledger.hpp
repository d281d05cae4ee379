// Energy and momentum book-keeping, the same for every method.
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/scene/scene.hpp"
#include "hinge/step/record.hpp"

namespace diptych {

/// What a run may hold beyond what was put in.
struct Allowed {
  double scheme = Stepping{}.gains;  ///< see there
  /// Δt over the largest stable one, r. The leapfrog keeps H = ½ v·(M − Δt²K/4) v + ½ ū·Kū, v the velocities half a
  /// step before and ū the mean of the displacements at both ends of the step, and K is at most 4M/Δt² r²: so ½ v·Mv is
  /// at most H/(1 − r²), and ½ uⁿ·Kuⁿ⁺¹ = H − ½ v·Mv at least −r²/(1 − r²) H. 0: not known.
  double step_ratio = 0;
  /// Largest part of the energy that the material may give back beyond what it has taken: nothing where its stress is
  /// the derivative of an energy.
  double material = 0;
};

/// Adds up what loads and supports put in and compares it with what the bars hold and what took it away. For each kick
/// of length τ that takes v⁻ to v⁺ under forces f, the work is τ f·(v⁻ + v⁺)/2: the discrete kinetic energy changes by
/// exactly that much.
///
/// And it watches over the run: a passive scene never holds, and damage has never taken, more than was put in. That is
/// told from the work, which is added up in every step, and the energies at hand; without books these are asked for now
/// and then and at the end, and what was spent is not known.
class Ledger {
 public:
  /// first_time: of the velocity in the first line [s]; free_mass: of bars that no support holds, else 0 [kg].
  Ledger(Books books, double time_step, double first_time, double energy, double momentum, double free_mass,
         const Allowed& allowed = {})
      : books_(books),
        dt_(time_step),
        first_time_(first_time),
        start_momentum_(momentum),
        free_mass_(free_mass),
        allowed_(allowed),
        largest_put_in_(std::max(0.0, energy - of_flight(momentum))) {}

  /// Energy lines are kept.
  bool keeps() const { return books_ != Books::off; }
  /// The energies of this step are asked for: close_line is to be called.
  bool due() const { return due_; }
  void begin_step(long n, bool last = false) {
    constexpr long glance = 64;  // not 4 % of a run that keeps no books
    due_ = keeps() || last || !open_ || n % glance == 0;
  }

  /// f·v⁻ and the total force of loads and supports, before a kick.
  void before_kick(double work_rate, double force, double kick) {
    work_ += kick * work_rate / 2;
    impulse_ += kick * force;
  }
  /// f·v⁺ after it.
  void after_kick(double work_rate, double kick) { work_ += kick * work_rate / 2; }

  /// Energies that left on ways of their own [J]. Whatever belongs to a kick is told before its line is closed.
  void take_by_contact(double energy) { contact_ += energy; }
  void take_by_viscosity(double energy) { viscous_ += energy; }
  void take_by_scheme(double energy) { scheme_ += energy; }

  /// ahead: what the scheme's own energy holds beside kinetic + strain, for good or ill: see watch. by_damage: the
  /// least that damage can have taken in this step, a part of `dissipated`. (What flows or is viscous is known no
  /// better than the trapezium of a step knows it.)
  void close_line(double kinetic, double strain, double dissipated, double momentum, double ahead = 0,
                  double by_damage = 0) {
    const double held = kinetic + strain + dissipated_ + viscous_;  // strain starts from ψⁿ, so heat is of steps before
    // The books open with the first line: before it the leapfrog has no energy of its own.
    if (!open_) {
      opening_ = held + contact_ - work_;
      ahead_ = std::max(0.0, ahead);
      scheme_ = 0;
      open_ = true;
    }
    watch(kinetic, strain, momentum, ahead);
    if (keeps())
      add({first_time_ + static_cast<double>(sums_.lines) * dt_, kinetic, strain, dissipated_, viscous_, contact_,
           scheme_, work_, work_ + opening_ - held - contact_ - scheme_, momentum, start_momentum_ + impulse_});
    dissipated_ += dissipated;
    spent_ += by_damage;
  }

  /// More is held than was put in. What is kinetic beyond the shadow energy's bound (see Allowed) grows without end;
  /// what the shadow energy itself has too much of came from the material or the scheme. A free bar is looked at from
  /// its centre of mass, or its flight would hide what grows inside; room is left for the round-off of that
  /// subtraction.
  bool unstable() const { return !(excess_ <= room_) || !(magnitude_ <= bound_); }

  /// With both numbers and the part that gave it. unit: "J" or the like.
  std::string trouble(const char* unit) const {
    std::ostringstream text;
    text.precision(3);
    const bool grows = !(magnitude_ <= bound_);
    if (!std::isfinite(magnitude_) || !std::isfinite(inside_) || !std::isfinite(work_)) {
      text << "a number is not finite: of the energies held, " << inside_ << ' ' << unit
           << ", or of the work of loads, " << work_ << ' ' << unit << ": NaN, or larger than a double can hold";
      return text.str();
    }
    text << "more energy than was put in: " << (grows ? magnitude_ : inside_) << ' ' << unit << " held or spent, "
         << largest_put_in_ << ' ' << unit << " put in at the most";
    if (grows)
      text << ", of which a stable step of this length holds up to " << bound_ << ": it grows with the steps";
    else if (!keeps())
      text << "; given by the material or the scheme (the books were not kept)";
    else if (most_dissipated_ - dissipated_ > -(scheme_ + contact_ + viscous_))
      text << "; given by the material: " << most_dissipated_ - dissipated_ << ' ' << unit;
    else
      text << "; given by the scheme: " << -(scheme_ + contact_ + viscous_) << ' ' << unit;
    return text.str();
  }

  const LedgerSums& sums() const { return sums_; }
  std::vector<LedgerLine> take_lines() { return std::move(lines_); }

 private:
  double of_flight(double momentum) const { return free_mass_ > 0 ? momentum * momentum / (2 * free_mass_) : 0; }

  void watch(double kinetic, double strain, double momentum, double ahead) {
    const double flight = of_flight(momentum), put_in = opening_ + ahead_ + work_;
    // What damage took is gone: what comes back of it is too much.
    most_spent_ = std::max(most_spent_, spent_);
    const double inside = kinetic + strain + most_spent_ + ahead;
    largest_put_in_ = std::max(largest_put_in_, put_in - flight);
    inside_ = inside - flight;
    excess_ = inside - put_in;
    magnitude_ = kinetic - flight + std::abs(strain);
    const double round_off = 1e-9 * kinetic;
    room_ = (allowed_.scheme + allowed_.material) * largest_put_in_ + round_off;
    const double r = allowed_.step_ratio, largest_factor = 1e6;
    const double factor = r > 0 && r < 1 ? std::min(2 * (1 + r * r) / (1 - r * r), largest_factor) : largest_factor;
    bound_ = (factor + allowed_.material) * largest_put_in_ + round_off;
  }

  void add(const LedgerLine& line) {
    ++sums_.lines;
    sums_.last = line;
    most_dissipated_ = std::max(most_dissipated_, line.dissipated);
    sums_.given_back = std::max(sums_.given_back, most_dissipated_ - line.dissipated);
    sums_.excess = std::max(sums_.excess, excess_);
    sums_.put_in = largest_put_in_ + 1e-9 * line.kinetic;  // a body in flight has been given nothing inside
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
  Allowed allowed_;
  bool due_ = true, open_ = false;
  double work_ = 0, impulse_ = 0, dissipated_ = 0, viscous_ = 0, contact_ = 0, scheme_ = 0, opening_ = 0, ahead_ = 0;
  double largest_put_in_, most_dissipated_ = 0, spent_ = 0, most_spent_ = 0;
  double inside_ = 0, excess_ = 0, room_ = 0, magnitude_ = 0, bound_ = 0;  // of the last line
  LedgerSums sums_;
  std::vector<LedgerLine> lines_;
};

}  // namespace diptych
