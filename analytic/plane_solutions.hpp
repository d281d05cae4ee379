// The exact solutions in the plane that a case may name: a row each.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analytic/diffusion_front.hpp"
#include "analytic/plane_exact.hpp"
#include "analytic/solution_parameter.hpp"

namespace diptych::analytic {

/// A plate as an exact solution sees it: nothing of how it is solved.
struct PlaneSetting {
  double width = 0, height = 0;         ///< [m]
  std::array<std::string, 4> supports;  ///< of left, right, bottom and top, as case files call them
  bool elastic = false;                 ///< a solid that neither cracks nor fails
  std::optional<PlaneMedium> medium;    ///< none: diffusion alone
  struct Strike {
    double face;      ///< between flyer and target [m]
    double velocity;  ///< of the flyer [m/s]
  };
  std::optional<Strike> strike;
  double corner_rate = 0;  ///< source at the origin, of the quarter plane [C m²/s]
  double diffusivity = 0;  ///< at the origin, or d₀ of a front [m²/s]
  FrontProfile profile = FrontProfile::constant;
  SolutionParameters parameters;  ///< those of the row
};

struct PlaneSolutionRow {
  std::string name;
  std::vector<SolutionParameter> parameters;
  enum class Scene {
    solid,      ///< gives displacement, velocity and stress
    diffusion,  ///< gives the concentration
    front       ///< the same, of what spreads from a face that is held
  };
  Scene scene;
  /// What of the setting it does not know, each after the solution's name: "of ...; allowed: ...".
  std::vector<std::string> (*misfits)(const PlaneSetting&);
  /// Of a setting that fits. Throws std::invalid_argument where a parameter is out of range.
  std::unique_ptr<PlaneSolution> (*make)(const PlaneSetting&);
};

const std::vector<PlaneSolutionRow>& plane_solutions();

}  // namespace diptych::analytic
