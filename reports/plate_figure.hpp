// Figures on a plate by gnuplot: the script with its data inside, the data as CSV, and the SVG.
#pragma once

#include <filesystem>
#include <string>

#include "reports/drawn.hpp"
#include "reports/plate_results.hpp"

namespace diptych::reports {

/// Writes ID.csv, ID.gp and ID.svg as draw() of a Figure does, with the same returns and errors. One unit is as long
/// across as up, in all panels. Throws std::invalid_argument for a figure that cannot be drawn (no panels, no size, an
/// unknown kind or support, a map whose values do not fit its cells, a colour range that is none, an id that is no
/// plain file name).
Drawn draw(const PlateFigure&, const std::filesystem::path& directory, std::string& message);
Drawn draw(const ProblemFigure&, const std::filesystem::path& directory, std::string& message);

}  // namespace diptych::reports
