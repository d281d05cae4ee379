// Bars in a row that fly, strike, stay in contact, part and strike again: front tracking, exact to round-off.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "analytic/bar_wave.hpp"
#include "analytic/exact.hpp"

namespace diptych::analytic {

/// One bar of unit cross-section, at rest in itself at t = 0. Elastic, or with bilinear isotropic hardening.
struct ImpactBar {
  double begin, length;                                           ///< left end at t = 0 [m] and length > 0 [m]
  double youngs_modulus, density;                                 ///< E [Pa], ρ [kg/m³], > 0
  double velocity = 0;                                            ///< uniform at t = 0 [m/s]
  double yield_stress = std::numeric_limits<double>::infinity();  ///< initial Y₀ [Pa], > 0; infinite: elastic
  double tangent_modulus = 0;  ///< E_t [Pa], 0 < E_t < E where the yield stress is finite; else not read
};

/// Waves in piecewise linear bars are fronts between constant states. In reference coordinates a front moves with
/// ±c = ±√(E/ρ) where the bar loads or unloads elastically and with ±c_p = ±√(E_t/ρ) where it yields further, and a
/// jump of the current yield stress or of the plastic strain stands still. Small strains; stress positive in tension;
/// the current yield stress Y(x) is the larger of Y₀ and the largest |σ| met.
///
/// Wherever fronts meet, reach a yield jump, an end or a contact, where a contact closes and where a load changes,
/// a Riemann problem is solved exactly: with φ(s₀→s) = ∫ ds/(ρ c(s)), c(s) = c for |s| ≤ Y and c_p beyond, it is
/// v_L + φ_L(σ*) = v_R − φ_R(σ*), increasing and piecewise linear in σ*; at most one elastic and one plastic front
/// leave to either side (Berjamin, Lombard, Chiavassa, Favrie, arXiv 1608.02721, for general laws).
///
/// Ends of neighbours that meet stay together while they press on each other (σ* ≤ 0). Where σ* = 0 to round-off they
/// have one velocity and stay in touch without stress, so a grazing contact does not chatter; touching bars of one
/// velocity are in contact from the start. A fixed end holds its bar in tension too, as in BarWave; a wall that lets
/// go is the mid-plane of two bars that mirror each other.
///
/// Round-off: events at one place count as one where they are less than 1e-11 of the shortest L/c apart, and a front
/// is dropped where its jump is below 1e-14 of the largest stress (or ρc times speed) of its bar. Times, places
/// and states are kept in long double, so that on x86 true coincidences lie far inside both (less far where
/// long double is double). What is merged or dropped is an error of that size, once.
///
/// The number of fronts stays bounded in elastic bars whose crossing times are commensurate and grows like a power of
/// time in others that share contacts. Where a plastic front nears another or a yield jump, elastic waves run to and
/// fro between them ever faster: such a cascade has no last event but converges geometrically, and round-off as above
/// ends it. Hardening bars can therefore be followed for a limited time, from below one crossing to for ever as the
/// case may be, before there are too many events.
class BarImpact final : public ExactSolution {
 public:
  struct Parameters {
    std::vector<ImpactBar> bars;  ///< left to right, at least one; not overlapping, touching allowed
    BarEnd left, right;           ///< outer ends of the first and of the last bar; their tractions may only jump
    double until;                 ///< fronts are followed up to this time [s], > 0
    bool bonded = false;          ///< bars that touch, at t = 0 or later, hold together for ever, also in tension
  };

  struct Event {
    enum class Kind {
      fronts_meet,        ///< each other or a jump of the yield stress, inside a bar
      front_reflects,     ///< from a fixed, loaded or free end, or from the face of an open contact
      contact_passes_on,  ///< fronts reach a contact that stays closed
      contact_closes,
      contact_opens,
      load_changes
    };
    Kind kind;
    double time;      ///< [s]
    std::size_t bar;  ///< where; of a contact the left one
    double position;  ///< in that bar, reference coordinate [m]
  };

  /// Part of a bar in one state, between two fronts, yield jumps or ends. Lengths from the bar's left end.
  struct Region {
    double begin, end;              ///< [m]
    double begin_speed, end_speed;  ///< of what bounds it [m/s]
    double stress, velocity;        ///< [Pa], [m/s]
    double plastic_strain;          ///< ε_p, with its sign
    double yield_stress;            ///< current [Pa]
    double displacement;            ///< at `begin` [m]
  };

  /// All states from one event to the next.
  struct Snapshot {
    double time, until;                     ///< of this event (or 0) and of the next (or the last time followed) [s]
    std::vector<std::vector<Region>> bars;  ///< of each bar, ascending, at `time`
    std::vector<bool> touching;             ///< of bars k and k + 1
  };

  /// Throws std::invalid_argument where a parameter is out of range, bars overlap, a traction has a ramp or a fixed end
  /// carries one, and where more than a million events, or states that would fill a quarter of a gigabyte, lie before
  /// `until`.
  explicit BarImpact(Parameters);

  std::string name() const override { return "bar-impact"; }
  /// x: reference coordinate, i.e. position at t = 0. Where two bars touch at x, the right one is meant. At a front,
  /// the state to its right; at an event, the state just after. Throws std::domain_error for x in a gap or outside all
  /// bars, t outside [0, until], and where either is not finite.
  double at(BarQuantity, double x, double t) const override;
  /// In reference coordinates. `travelled` goes on through reflections, contacts and other fronts: it is that of the
  /// longest path among incoming fronts of the same direction, else among all, else 0 where a front is set off.
  std::vector<Front> fronts(double t) const override;
  /// Stress: the largest |σ| met (if none, the largest ρc times the largest velocity difference of the bars; if none,
  /// 1). Velocity: the largest difference of velocities met, of bars and fixed ends (if none, the stress scale / ρc of
  /// the first bar). Displacement: by how much the stress scale lengthens all bars, Σ σL/E: not the flight.
  double scale(BarQuantity) const override;

  /// Of all states up to `until`, whatever t_end.
  double residual(double t_end) const override;
  std::optional<std::vector<Contact>> contact_times() const override { return contacts(); }
  std::optional<double> work_of_flow(double t) const override { return plastic_work(t); }

  double wave_speed(std::size_t bar) const;                ///< c [m/s]
  double position(double x, double t) const;               ///< x + u(x, t) [m]
  double momentum(double t) const;                         ///< of all bars, per unit of cross-section [kg/(m s)]
  double momentum(std::size_t bar, double t) const;        ///< throws std::out_of_range where there is no such bar
  double kinetic_energy(double t) const;                   ///< [J/m²]
  double strain_energy(double t) const;                    ///< ∫ σ²/2E [J/m²]
  double plastic_work(double t) const;                     ///< ∫∫ σ dε_p [J/m²]
  double plastic_strain(std::size_t bar, double t) const;  ///< ∫ |ε_p| dx over a bar [m]
  double external_work(double t) const;                    ///< of the tractions up to t [J/m²]
  /// By start, then from left to right; `to` is infinite where they still touched at `until`.
  const std::vector<Contact>& contacts() const;
  const std::vector<Event>& events() const;  ///< by time
  const Parameters& parameters() const;
  std::size_t snapshots() const;         ///< the number of events, plus one for the start
  Snapshot snapshot(std::size_t) const;  ///< throws std::out_of_range

 private:
  struct Record;
  class Tracker;
  std::shared_ptr<const Record> record_;  ///< immutable, so copies may share it
};

/// Worst violations over all states and events, each divided by the largest size of its terms in that bar, so that 1
/// is a wrong solution and round-off a right one. NaN stays NaN.
struct Balance {
  double jump = 0;  ///< [σ] + ρ U [v] and [v] + U [ε] across fronts; U = 0, ±c, or ±c_p where the bar yields
  double state = 0;  ///< |σ| ≤ Y, Y ≥ Y₀, |ε_p| ≤ (Y − Y₀)/H, no ε_p in an elastic bar; regions fill the bar
  double continuity = 0;  ///< an event changes nothing but at its place: ∫ |jump in time| dx of σ, v, ε_p, Y; t = 0
  double momentum = 0;    ///< of each bar: since t = 0, against the impulse of its ends
  double energy = 0;      ///< of each bar: kinetic + strain + plastic work since t = 0, against the work at its ends
  double motion = 0;      ///< displacements against strains in space and against velocities in time
  double contact = 0;     ///< equal σ ≤ 0 (any sign where bonded) and v in contact; else σ = 0; no overlap of bars
  double boundary = 0;    ///< outer ends: v = 0 or σ = f(t)
  std::size_t fronts = 0, states = 0;  ///< looked at

  double worst() const;  ///< the largest of them; NaN if one is NaN, infinity if no state was looked at
};

Balance audit(const BarImpact&);

/// The same of any history: snapshot(k) for 0 ≤ k < count. It reads parameters and states, nothing of the tracker.
Balance audit(const BarImpact::Parameters&, std::size_t count,
              const std::function<BarImpact::Snapshot(std::size_t)>& snapshot);

}  // namespace diptych::analytic
