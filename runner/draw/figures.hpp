// From measured runs to figures.
#pragma once

#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"

namespace diptych::runner {

/// Fills in the result's figures (and of a plate its page), drawn from its completed runs. A figure whose runs are
/// missing says so.
void add_figures(const Case&, reports::Case&);

}  // namespace diptych::runner
