// Results as plain data: what a run measured, what a gate said. Everything in reports/ works on these alone and
// knows nothing of solvers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/bar_fields.hpp"
#include "reports/field_results.hpp"
#include "reports/look.hpp"
#include "reports/page_results.hpp"
#include "reports/plate_results.hpp"

namespace diptych::reports {

/// Error of one field at one time, divided by the field's scale.
struct FieldError {
  std::string field;                ///< "stress", "velocity", "displacement"
  double time = 0;                  ///< the field's own time level [the case's unit of time]
  double scale = 0;                 ///< what the error was divided by [case units]
  double l1 = 0, l2 = 0, linf = 0;  ///< mean norms over the bar: L1 ≤ L2 ≤ L∞
  std::optional<double> predicted_l1, predicted_l2, predicted_linf;  ///< from theory, divided by the same scale
};

/// A value read at one point of the bar.
struct ProbeValue {
  std::string id;
  double value = 0;
  std::optional<double> predicted;
};

/// Field values along the bar, for drawing: a polyline through (x[i], y[i]). A field that is constant in each cell
/// comes as its steps, two points a cell.
struct Curve {
  std::vector<double> x, y;

  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
  void end_line() { add(std::nan(""), std::nan("")); }  ///< what is added next is not joined to it
};

/// Damage of a plate on the nodes of its cells, row by row from the bottom.
struct PlateFields {
  int nx = 0, ny = 0;                 ///< cells
  double width = 0, height = 0;       ///< [m]
  std::vector<double> crack_density;  ///< C_d
  std::vector<double> damage;         ///< D
};

/// One file of a plate's fields: "mesh" (triangles), "particles" or "cells".
struct VtuPiece {
  std::string name;
  VtuMesh mesh;
  std::vector<VtuArray> arrays;
};

struct Sample {
  double asked = 0;  ///< requested time in the case's unit of time, as written there
  double time = 0;   ///< time reached at the nearest step [the same]
  std::vector<FieldError> errors;
  std::vector<ProbeValue> probes;
  std::map<std::string, Curve> curves;        ///< field -> numerical field (filled only where a figure asks)
  std::map<std::string, Curve> exact_curves;  ///< field -> exact field on a fine line
  std::optional<PlateFields> plate = {};      ///< of a plate with damage
  std::vector<VtuPiece> files = {};           ///< all fields of a plate, filled only where they are asked for
  std::vector<BarPoints> bar_points = {};     ///< likewise of bars
};

/// One line of a run's energy and momentum ledger, in case units; the fields are those of the solvers' books.
struct LedgerLine {
  double time, kinetic, strain, dissipated, viscous, contact, scheme, work, lost, momentum, impulse;
};

/// Stress and dilatancy at a place in the target of an impact, after each step.
struct GaugeHistory {
  std::string id;
  double from_face = 0;                         ///< distance from the impact face [m]
  std::vector<double> time, xx, yy, dilatancy;  ///< [s], [Pa]; V_d, empty without a failure wave
};

struct Run {
  Run();  // compiled once, in results.cpp
  Run(const Run&);
  Run(Run&&) noexcept;
  Run& operator=(const Run&);
  Run& operator=(Run&&) noexcept;
  ~Run();

  std::string case_id;
  std::string method;     ///< "fem", "mpm-usf", "mpm-usl", "mpm-musl"
  std::string work_unit;  ///< "element-steps" or "particle-steps": what the method's work is counted in
  int cells = 0;
  double courant_asked = 0, courant = 0;      ///< C = cΔt/h as asked and as used
  std::string particles;                      ///< positions in the cell as in the case file, "" for FEM
  std::string parameters;                     ///< variant and swept parameters, "v0=0.1"; "" without
  std::string status;                         ///< "completed", "unstable", "refused", "left-grid", "cancelled", "error"
  std::string message;                        ///< why, where not completed
  double cell_size = 0;                       ///< h [case units]
  int unknowns = 0;                           ///< degrees of freedom that move: nodes (FEM), particles (MPM)
  double time_step = 0, time_step_limit = 0;  ///< used and critical [case units]
  long steps = 0;
  long element_steps = 0, particle_steps = 0, node_steps = 0;  ///< deterministic work
  std::size_t bytes = 0;                                       ///< of the solver's arrays
  double wall_seconds = 0;
  std::vector<std::string> features;       ///< active, as the solver reports
  bool finite = true;                      ///< every sampled number was finite
  std::string invalid;                     ///< why this run cannot be judged, empty if it can
  std::map<std::string, double> measures;  ///< per-run quantities: "energy.drift", "momentum.drift", "bits.mirror", ...
  std::vector<Sample> samples;
  std::vector<LedgerLine> ledger;  ///< every step, filled only where it is asked for
  /// Paths of ends and of points between, NaN between two paths: x the place, y the time (filled where a figure asks).
  Curve paths, exact_paths;
  std::vector<double> path_origins;  ///< of each point of both: where it started
  std::vector<GaugeHistory> gauges;  ///< of a struck plate
  Curve platen;                      ///< of a plate: time [s], displacement of the platen along its normal [m]
  /// "mpm-musl N=200 C=0.5 ppc=1"; particles that are not evenly spaced add their positions, "ppc=1@0.3", and swept
  /// parameters theirs, "v0=0.1".
  std::string label() const;
};

enum class Verdict { pass, fail, unstable, error, invalid };
std::string to_string(Verdict);  ///< "PASS", "FAIL", "UNSTABLE", "ERROR", "INVALID"

/// One number a gate looked at: a run (or fit over runs), a time, what was measured and what was allowed.
struct Check {
  std::string what;  ///< "mpm-musl N=200 C=0.5 ppc=1, t = 0.5 L/c"
  double value = 0;
  std::optional<double> predicted;
  double low = 0, high = 0;  ///< allowed band of `judged`, inclusive
  double judged = 0;         ///< what is held against the band (value, ratio or slope)
  bool passed = false;
};

/// Two methods beside each other on one mesh.
struct Agreement {
  int cells = 0;
  double time = 0;                 ///< NaN: of a whole history [the case's unit of time]
  std::array<double, 2> values{};  ///< of each method; NaN where what is compared is no single number
  double apart = 0, expected = 0;  ///< the difference, and the band within which it was to be expected
  double size = 0;                 ///< of what is compared; all in its unit
};

struct Gate {
  std::string case_id, id;  ///< full name is case_id/id
  std::string kind;         ///< "exact", "constant", "order", "invariant", "limit", "agreement"
  std::string quantity;     ///< "stress.L2", "energy.drift", ...
  std::string formula;      ///< what is compared, in words and symbols
  std::string reason;       ///< where the tolerance comes from
  Verdict verdict = Verdict::invalid;
  std::string message;                     ///< why, where not passed
  std::vector<Check> checks;               ///< never empty for a judged gate
  std::vector<Agreement> agreements = {};  ///< of kind "agreement"
  int line = 0;                            ///< of its declaration in the case file
  /// Least (distance to the nearer edge)/(half width) over the checks: 1 in the middle of the band, 0 on its edge,
  /// < 0 where failed, -infinity for a value that is not a number. A band with one infinite edge is measured by the
  /// other edge's size. NaN without checks. (A bound |value| <= max is the band [-max, max], not [0, max].)
  double headroom() const;
};

/// A figure to draw: stacked panels, one per time, with the exact solution under both methods; or a motion diagram.
/// A point that holds NaN ends its line and the next point begins a new one: a curve may hold two bars with a gap
/// between them, or the paths of many particles. Series are drawn in their order, the first lies lowest.
/// Where some panel has spans or marks, the panels' labels stand above them. Those out of a panel's axes are named
/// there.
struct Figure {
  std::string id;  ///< "fig1": names the files
  std::string title;
  std::vector<std::string> notes;  ///< lines under the title: parameters, what is our choice
  std::string x_label, y_label;
  double x_min = 0, x_max = 1, y_min = -1, y_max = 1;
  /// Position across, time upwards: tall panels, two side by side; labels above them; markers far apart, at equal steps
  /// from the start of each path, above all lines, and exact paths below all; a panel that magnifies a part of another
  /// is framed there.
  bool motion = false;
  bool x_powers = false, y_powers = false;  ///< all x, or y, are log10 of what is meant; ticks are powers of ten
  struct Series {
    std::string label;
    /// "exact", or of one of the looks, "fem"; "fem-thin": a second quantity or run of the same method, in its colour
    /// but in thin dashes or with small crosses.
    std::string kind;
    Curve curve;
  };
  /// A band from x = from to x = to, as a time window: shaded under all curves, with its label on a bar above the
  /// panel. Kinds look different in their order of first mention; their names are written in the script and the data
  /// alone.
  struct Span {
    double from = 0, to = 0;
    std::string label;  ///< empty: none
    std::string kind;
  };
  /// A thin dash-dotted line over all curves at one place, as a predicted arrival or plateau.
  struct Mark {
    double at = 0;
    std::string label;     ///< empty: none
    bool vertical = true;  ///< at x, else at y
  };
  struct Panel {
    std::string label;  ///< "t = 0.5 L/c: ..."
    std::vector<Series> series;
    std::optional<std::array<double, 2>> x_range = {}, y_range = {};  ///< from, to; none: the figure's
    std::string x_label = {}, y_label = {};                           ///< empty: the figure's
    std::vector<Span> spans = {};
    std::vector<Mark> marks = {};
  };
  std::vector<Panel> panels;
  std::vector<PanelLook> looks = {};  ///< of the kinds of its series, "exact" being known
};

struct Case {
  Case();  // compiled once, in results.cpp
  Case(const Case&);
  Case(Case&&) noexcept;
  Case& operator=(const Case&);
  Case& operator=(Case&&) noexcept;
  ~Case();

  std::string id, title, why, claim, path;
  std::string time_unit;  ///< "L/c" or "s"
  std::string units;      ///< "SI" or "paper"
  std::vector<Run> runs;  ///< in the order of the axes
  std::vector<Gate> gates;
  std::vector<Figure> figures;
  std::vector<PlateFigure> plate_figures;
  std::vector<ProblemFigure> problem_figures;
  std::vector<std::pair<std::string, Page>> pages;  ///< each with the name of its file, less ".html"
};

/// What made the results.
struct Provenance {
  std::string version, commit, compiler, flags, libraries, cpu, os;
  bool dirty = false;
};

}  // namespace diptych::reports
