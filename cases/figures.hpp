// From measured runs to figures.
#pragma once

#include <vector>

#include "cases/case.hpp"
#include "reports/results.hpp"

namespace diptych::cases {

/// The case's figures, drawn from its completed runs. A figure whose runs are missing says so in its notes.
std::vector<reports::Figure> make_figures(const Case&, const std::vector<reports::Run>&);

}  // namespace diptych::cases
