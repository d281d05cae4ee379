// From a case to what the solvers and the oracle take.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "analytic/bar_solutions.hpp"
#include "analytic/discrete.hpp"
#include "analytic/exact.hpp"
#include "hinge/scene/scene.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/span.hpp"

namespace diptych::runner {

/// Case units per unit of time as written: 1 for "s", L/c for "L/c" [s].
double time_unit(const Case&, const std::string& unit);
/// "E = 10000, ρ = 1, L = 0.5": a bar's own numbers, for people.
std::string words_of(const BarSpec&);
std::string words_of(const material::Viscosity&);
/// Velocity of a bar at the start [m/s].
double velocity_of(const Case&, std::size_t bar);
/// Where the bars begin, on a grid of `cells` in the first one [m].
std::vector<double> begins_of(const Case&, int cells);
/// When the ends of the first two bars to meet in free flight do so, on a grid of `cells` [s]; infinite where none do.
double contact_time(const Case&, int cells);
/// The same as the run's panel has it: some bars meet on a node of the grid.
double contact_time(const Case&, const Leaf&);
/// A sample time as written, in seconds from the start of the run. Times from contact are from when the ends meet, or
/// from the run's own.
double instant(const Case&, int cells, double at);
double instant(const Case&, const Leaf&, double at);
/// A length as written, in case units, on a grid of `cells`.
double length_of(const Case&, const Measured&, int cells);

/// Where each bar stands at the start, on a grid of `cells` in the first one [m].
std::vector<Span> spans_of(const Case&, int cells);
/// The case's artificial viscosity, which it must have.
material::Viscosity viscosity_of(const Case&);
/// ν/(c h) of the case's artificial viscosity: of eq. 21 where it is largest, else of the linear term.
double viscosity_strength(const Case&);
/// A scene with one of the bars and what holds and loads it.
Scene alone(const Scene&, std::size_t bar);

/// The scene of one run. Holds expressions of its own: make one for each thread.
Scene make_scene(const Case&, int cells);
/// The bars as exact solutions see them, on a grid of `cells` in the first one; not yet moved together, see CloserBars.
analytic::BarSetting bar_setting(const Case&, int cells);
/// The row of the case's exact solution; null where it names none or gives expressions.
const analytic::BarSolution* solution_of(const Case&);
/// The exact solution for a run, or null where the case names none. Particles' bars touch as soon as they share a node
/// of the grid, which rigid flight tells to the bit; the exact bars are then given the same distance to touch at.
std::unique_ptr<analytic::ExactSolution> make_exact(const Case&, const Leaf&);
/// The same scheme and grid as theory sees them; nothing where there is no theory of the panel.
std::optional<analytic::Discretisation> discretisation(const Case&, const Leaf&, double courant);

/// Another solution of the same bars standing nearer to each other. The reader's coordinates are those before they were
/// moved together.
class CloserBars final : public analytic::ExactSolution {
 public:
  /// begins: of the bars; shifts: by how much each was moved to the left.
  CloserBars(std::unique_ptr<analytic::ExactSolution> solution, std::vector<double> begins, std::vector<double> shifts)
      : solution_(std::move(solution)), begins_(std::move(begins)), shifts_(std::move(shifts)) {}
  std::string name() const override { return solution_->name(); }
  double at(analytic::BarQuantity q, double x, double t) const override { return solution_->at(q, x - shift_at(x), t); }
  std::vector<analytic::Front> fronts(double t) const override;
  double scale(analytic::BarQuantity q) const override { return solution_->scale(q); }
  double residual(double t_end) const override { return solution_->residual(t_end); }
  std::optional<std::vector<Contact>> contact_times() const override { return solution_->contact_times(); }
  std::optional<double> work_of_flow(double t) const override { return solution_->work_of_flow(t); }
  double strain_of_face(double t) const override { return solution_->strain_of_face(t); }

 private:
  double shift_at(double x) const;
  std::unique_ptr<analytic::ExactSolution> solution_;
  std::vector<double> begins_, shifts_;
};

/// All lengths, times and stresses multiplied by powers of two: a run must answer with the same bits, scaled.
struct PowersOfTwo {
  double length = 1, modulus = 1, density = 1, stress = 1;
  double time() const;      ///< length·√(density/modulus)
  double velocity() const;  ///< stress/√(modulus·density)
  double displacement() const { return stress * length / modulus; }
};
inline constexpr PowersOfTwo powers_of_two{2, 4, 16, 32};  ///< so that no derived factor is 1
Scene scaled(const Scene&, const PowersOfTwo&);
/// The bar seen from behind: x → L − x, velocities reversed.
Scene mirrored(const Scene&);

}  // namespace diptych::runner
