// From a plate's results to what its figures draw.
#pragma once

#include <vector>

#include "cases/case.hpp"
#include "cases/contours.hpp"
#include "reports/results.hpp"

namespace diptych::cases {

/// Lines under a figure's title: the scene, what the diffusion is read as, and what the paper leaves open.
std::vector<std::string> plate_notes(const Case&, const FigureSpec&);
/// C_d, or D for "damage", on the nodes.
NodalMap map_of(const reports::PlateFields&, const std::string& field);
reports::PlateFigure contour_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);
reports::ProblemFigure problem_figure(const Case&, const FigureSpec&);
reports::Figure history_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);
/// How far the methods are apart and how far they may be, as the gates of kind "agreement" have found: a page.
void add_agreement(const Case&, const FigureSpec&, reports::Case&);
/// What each variant does to the contour: a page, and a picture for each of its rows.
void add_choices(const Case&, const FigureSpec&, const std::vector<reports::Run>&, reports::Case&);

}  // namespace diptych::cases
