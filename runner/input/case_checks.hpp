// What no single value of a case file tells: whether scene, axes, solution and expressions go together. Each
// check notes its mistakes at the place given, and passes over what is empty because it has been reported already.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

inline const Names fields{"stress", "velocity", "displacement"};

/// Methods that can take the case's scene.
Names methods_of(const Case&);
/// Ids of a plate's variants, and "" for the case as it stands.
Names variants_of(const Case&);
/// The values of all blocks of axes together; none where the axes hold a mistake.
Axes all_axes(const Case&);
/// The length of the first bar in "m", "L" or "cells" of the coarsest grid; 0 where it is not known.
double bar_in(const std::string& unit, const Case&);
/// The runs that a gate speaks of.
std::vector<Leaf> runs_of(const GateSpec&, const Case&);
/// The case with each set of parameters that some run has; itself where no run is known.
std::vector<Case> cases_of_runs(const Case&);
/// Each of them greater than the one before.
bool ascending(const std::vector<double>&);

/// Compiles a formula of constants; it must be finite for all values of the parameters that runs have.
bool check_constant(const Place&, const std::string& formula, const Case&);
/// A constant that is not negative for any values of the parameters that runs have.
void check_not_negative(const Place&, const std::string& formula, const Case&);
/// Bars that fit one grid in every run, and velocities beside [initial].
void check_bars(const Place& bar, const Case&);
/// Bars that close in so slowly that the time of their contact would be lost in round-off, or be looked for too long.
void check_approach(const Place& bar, const Case&);
void check_in_some_bar(const Place&, const Measured& at, const Case&);
/// Times from contact need bars that close in, in every run, and must lie after the start.
void check_contact(const Place& from, const Case&);
void check_times(const Place& at, const Case&);
/// Compiles a formula of `variables` ("x", "t") and tries it at x in {0, L/2, L} and t in {0, the sample times}.
void check_expression(const Place&, const std::string& text, const Names& variables, const Case&);
/// The features that the scene of bars switches on, each with the key that does it.
std::map<std::string, std::string> features_in_use(const Case&);
void check_features(const Place&, const Case&);
void check_steps(const Place& courant, const Axes&, const Case&);
void check_methods(const Place& method, const Axes&, const Case&);
void check_solution(const Place& solution, const Case&);

}  // namespace diptych::runner
