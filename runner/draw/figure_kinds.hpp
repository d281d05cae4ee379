// Figures and pages of a case: [[figure]] read from its file, and drawn from its runs.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/registry.hpp"

namespace diptych::runner {

class Table;
struct Place;
struct FigureKind;

/// Every kind of figure there is; of a scene the first is the usual one.
Registry<FigureKind>& figure_kinds();
using AddedFigureKind = Added<FigureKind, figure_kinds>;

/// An entry of [[figure]].
FigureSpec read_figure(Table&, const Case&);
/// What only all figures of the case tell.
void check_figures(const Place& figures, const Case&);

/// Fills in the result's figures and pages, drawn from its completed runs. A figure whose runs are missing says so.
void add_figures(const Case&, reports::Case&);
/// Puts the case's id and a dot before the names of all its figures and pages.
void name_after_case(reports::Case&);

}  // namespace diptych::runner
