// Figures and the page of a plate that a flyer strikes.
#pragma once

#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Histories of stress, compression positive: a panel for each gauge and variant, the elastic solution under both
/// methods, published fronts as time windows.
reports::Figure gauge_figure(const Case&, const FigureSpec&, const std::vector<reports::Run>&);

/// The model, its parameters and their sources, what is certain and what is ours, what was measured, and what each of
/// the variants named does to it.
void add_failure_page(const Case&, const FigureSpec&, reports::Case& result);

}  // namespace diptych::runner
