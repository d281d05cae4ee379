// How figures tell what one panel computed from what another did.
#pragma once

#include <string>
#include <vector>

namespace diptych::reports {

/// gnuplot's line properties; shapes differ as well as colours, for print without colour.
struct PanelLook {
  std::string id;                  ///< "fem": the kind of its series and contours
  std::string name;                ///< "FEM"
  bool markers = false;            ///< its curves are drawn as markers instead of lines
  std::vector<std::string> lines;  ///< of the first, second, ... of its curves in a figure; at least one
  std::vector<std::string> thin;   ///< likewise of kind "fem-thin", a second quantity or run in the same colour
  std::string contour;             ///< of its contours in a plate
};

}  // namespace diptych::reports
