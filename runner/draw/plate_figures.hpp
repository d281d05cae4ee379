// From a plate's results to what its figures draw.
#pragma once

#include <vector>

#include "reports/results.hpp"
#include "runner/compare/contours.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

reports::PlateFigure contour_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);
reports::ProblemFigure problem_figure(const Case&, const FigureSpec&);
reports::Figure history_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);
/// How far the methods are apart and how far they may be, as the gates of kind "agreement" have found: a page.
void add_agreement(const Case&, const FigureSpec&, reports::Case&);
/// What each variant does to the contour: a page, and a picture for each of its rows.
void add_choices(const Case&, const FigureSpec&, const std::vector<reports::Run>&, reports::Case&);

}  // namespace diptych::runner
