// A case file as data: one scene, an exact solution where there is one, the axes to sweep, and the gates.
// cases/README.md is the schema for people; runner/app/case_file.cpp is the schema for the program.
#pragma once

#include <any>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analytic/solution_parameter.hpp"
#include "hinge/scene/scene.hpp"
#include "runner/input/declaration.hpp"
#include "runner/input/plate_spec.hpp"

namespace diptych::runner {

/// A length or a time as written: value and unit. Times: "s" or "L/c". Lengths: "m", "L" or "cells".
struct Measured {
  double value = 0;
  std::string unit;
};

/// One bar of a row.
struct BarSpec {
  double length = 0;
  Measured gap{0, "m"};  ///< to the bar before it, ≥ 0; none for the first
  std::string velocity;  ///< uniform at the start, an expression of parameters; empty: none
  material::Material material;
};

struct LoadSpec {
  End end = End::right;
  std::string history;     ///< "step", "ramp", "impulse" or "expression"
  double traction = 0;     ///< amplitude, tension positive (not for "expression")
  Measured start{0, "s"};  ///< when it begins, ≥ 0
  Measured rise;           ///< ramp: > 0
  Measured duration;       ///< impulse: > 0
  std::string expression;  ///< of t (and parameters), for "expression"
  Transfer transfer = Transfer::node;
  Measured layer_thickness;  ///< boundary layer: > 0, unit "cells", "m" or "L"
};

/// Artificial viscosity whose constants may be expressions of parameters.
struct ViscositySpec {
  material::Viscosity form;  ///< all but the constants
  std::string c1 = "0", c2 = "0";
};

struct ExactSpec {
  std::string solution = "none";               ///< one of analytic::bar_solutions, "expressions" or "none"
  analytic::SolutionParameters parameters;     ///< those of the solution
  std::string stress, velocity, displacement;  ///< expressions of x and t; an empty one is not compared
};

/// Names of [parameters] with the values that a run gives them.
using Parameters = std::map<std::string, double>;

/// Values of the swept axes; every combination is a run (FEM ignores `particles`: one run for all of them).
struct Axes {
  std::vector<std::string> method;                        ///< "fem", "mpm-usf", "mpm-usl", "mpm-musl"
  std::vector<int> cells;                                 ///< ≥ 1
  std::vector<double> courant;                            ///< > 0
  std::vector<std::vector<double>> particles{{0.5}};      ///< natural coordinates ξ in [0, 1], ascending, at least one
  std::map<std::string, std::vector<double>> parameters;  ///< swept ones of [parameters]
  std::vector<std::string> variant{""};                   ///< of a plate; "" is the case as it stands
  unsigned line = 0;                                      ///< of `courant` in the file
};

/// Restricts a gate to some values of the axes; an empty list is no restriction.
struct Where {
  std::vector<std::string> method;
  std::vector<int> cells;
  std::vector<double> courant;
  std::vector<std::vector<double>> particles;
  std::map<std::string, std::vector<double>> parameters;
  std::vector<std::string> variant;
};

struct Probe {
  std::string id;
  std::string field;  ///< "stress", "velocity", "displacement"
  Measured at;        ///< reference coordinate, unit "m", "L" or "cells" counted from the left end
};

/// What a kind of gate has of its own, see judge/gate_kind.hpp.
struct Criterion;

struct GateSpec {
  std::string id;        ///< unique in the case
  std::string kind;      ///< of judge/gate_kinds.cpp
  std::string quantity;  ///< of compare/quantities.cpp
  std::string reason;    ///< why this tolerance
  Where where;
  std::vector<double> times;                   ///< subset of the sample times; empty: all
  std::shared_ptr<const Criterion> criterion;  ///< none where the kind is not known
  bool keeps_time_steps = false;  ///< its runs' time steps are no smaller than asked for, to meet each sample time
  long steps = 2000;              ///< of each trial in the search for the critical Courant number
  bool slow = false;              ///< left out by --quick, and then reported as left out
  int line = 0;                   ///< of its declaration
  Declaration declaration;        ///< all its keys but its id and prose, for gates.lock
};

/// What runs must keep for a figure, beside their samples.
struct Recorded {
  bool curves = false;                           ///< of the fields along the bars, at the sample times
  bool paths = false;                            ///< of points of the bars
  bool energy = false;                           ///< in their books
  std::optional<std::array<double, 2>> closely;  ///< paths: more often between these times [time unit of the case]
};

/// A figure or a page of the case: what all its kinds have in common.
struct FigureSpec {
  std::string id;             ///< "fig1"
  std::string title;          ///< empty: the case's
  std::string kind;           ///< one of the rows in runner/draw/figure_kinds.cpp
  std::vector<double> times;  ///< subset of the sample times; empty: all
  int cells = 0;              ///< which runs to draw
  double courant = 0;
  std::map<std::string, double> courants;  ///< of methods that are drawn at another Courant number
  std::vector<std::string> methods;        ///< drawn ones
  std::string choices;                     ///< parameters that the paper leaves open, in words
  std::vector<double> particles{0.5};
  Parameters parameters;                       ///< of the runs to draw, where they are swept
  std::string over;                            ///< the swept parameter of which all values are drawn; empty: none
  std::optional<std::array<double, 2>> range;  ///< of the field's axis, or of its colours
  std::vector<std::string> pictures;           ///< of a page: figures of the case that stand on it
  Recorded recorded;
  std::any options;  ///< the options of its kind, which the kind's file reads and draws

  double courant_of(const std::string& method) const {
    const auto own = courants.find(method);
    return own == courants.end() ? courant : own->second;
  }
};

struct Case {
  Case();  // compiled once, in case.cpp, where each source that copies a case would compile them anew
  Case(const Case&);
  Case(Case&&) noexcept;
  Case& operator=(const Case&);
  Case& operator=(Case&&) noexcept;
  ~Case();

  std::filesystem::path path;
  std::string changed;        ///< what was changed of its file, "material.nu=0.4999"; empty: nothing
  std::string changed_scene;  ///< the part of it that makes another scene and not another way to solve it
  std::string id, title, claim, why;
  std::vector<std::string> paper_figures;               ///< "1", "3a"
  std::string units;                                    ///< "SI" or "paper"
  std::vector<BarSpec> bars = std::vector<BarSpec>(1);  ///< left to right
  Support left = Support::free, right = Support::free;
  bool convected = false;
  std::optional<PlateSpec> plate;  ///< then `bars`, their ends, loads and exact solution mean nothing
  std::vector<PlateVariant> variants;
  std::vector<PlateProbe> plate_probes;
  std::vector<GaugeSpec> gauges;
  Contact contact = Contact::node_to_node;
  std::optional<ViscositySpec> viscosity;
  std::vector<LoadSpec> loads;
  std::string body_force, initial_velocity, initial_stress;  ///< expressions, empty: none
  Parameters parameters;                                     ///< names for expressions, besides L, E, rho, c and pi
  std::vector<std::string> features;                         ///< declared, sorted
  ExactSpec exact;
  std::vector<Axes> axes;     ///< blocks; the runs are the union of their products
  std::string time_unit;      ///< "s" or "L/c"
  bool from_contact = false;  ///< times count from when the first two bars would meet in free flight
  std::vector<double> times;  ///< ascending, > 0
  std::vector<Probe> probes;
  Declaration scene;  ///< all keys but id, gates, figures and prose, for gates.lock
  std::vector<GateSpec> gates;
  std::vector<FigureSpec> figures;
  bool allow_unstable = false;
  bool ledger = true;

  /// The bar whose length and material stand for L, E, rho and c.
  const BarSpec& first() const { return bars.front(); }
};

}  // namespace diptych::runner
