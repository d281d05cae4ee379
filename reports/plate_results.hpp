// Results on a plate as plain data: what its figures draw.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reports/look.hpp"

namespace diptych::reports {

/// A polyline through (x[i], y[i]); closed where the last point repeats the first. A point that holds NaN ends it and
/// the next begins a new one.
struct Line {
  std::vector<double> x, y;
};

/// Contours and maps of fields on a plate 0 ≤ x ≤ width, 0 ≤ y ≤ height: panels of equal scale in rows and columns.
struct PlateFigure {
  std::string id;  ///< "fig13": names the files
  std::string title;
  std::vector<std::string> notes;  ///< lines under the title: parameters, what is our choice
  std::string x_label, y_label;    ///< "x [m]"
  double width = 1, height = 1;    ///< of the plate
  struct Contour {
    std::string label;  ///< written on the line, once in a panel for equal labels: "C_d = 0.05"; empty: nothing
    double level = 0;
    std::string kind;  ///< "difference", dotted, or of one of the looks
    std::vector<Line> lines;
  };
  /// Filled bands between the node values, which are linear along the sides of the cells.
  struct Map {
    int nx = 1, ny = 1;  ///< equal cells that fill the plate
    std::vector<double>
        nodes;                ///< (nx + 1)(ny + 1) values, row by row from the bottom; cells that touch NaN stay empty
    double min = 0, max = 1;  ///< of the colours; values beyond take the last colour
    std::string label;        ///< of the colour bar: "ε_v [-]"; panels with equal bars share one
    bool diverging = false;   ///< white in the middle of min and max
  };
  struct Panel {
    std::string label;  ///< above it: "FEM, t = 100 µs"
    std::vector<Contour> contours;
    std::optional<Map> map = {};
  };
  int columns = 1;
  std::vector<Panel> panels;  ///< row by row from the top
  std::vector<PanelLook> looks = {};
};

/// The drawing of a problem on a plate: its shape, mesh, supports and loads, and a cell of either method.
struct ProblemFigure {
  std::string id, title;
  std::vector<std::string> notes;
  std::string x_label = "x", y_label = "y";               ///< of the coordinate axes
  double width = 1, height = 1;                           ///< of the plate
  std::string width_label = "L_x", height_label = "L_y";  ///< of the dimension lines: "L_x = 1.0 m"
  int nx = 1, ny = 1;                                     ///< cells drawn
  bool triangles = false;                                 ///< four in each cell instead of the bare cells
  struct Side {
    std::string support = "free";  ///< "free", "roller", "fixed", "platen", "driven"
    std::string load;              ///< text of what acts: "p = 700 MPa, ramp 50 µs"; empty: no arrows
    bool outward = false;          ///< arrows pull instead of push
    std::string label;             ///< of the support: "rigid platen, frictionless"
  };
  std::array<Side, 4> sides;  ///< left, right, bottom, top
  double weak_radius = 0;     ///< of the quarter circle around the origin; 0: none
  std::string weak_label;
  struct Note {
    double x = 0, y = 0;  ///< where its text begins, in the plate's coordinates
    std::string text;
  };
  std::vector<Note> annotations;
  bool insets = true;  ///< one cell with four triangles (FEM), one with four particles (MPM)
};

}  // namespace diptych::reports
