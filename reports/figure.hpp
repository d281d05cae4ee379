// Figures by gnuplot: the script with its data inside, the data as CSV, and the SVG.
#pragma once

#include <filesystem>
#include <string>

#include "reports/drawn.hpp"
#include "reports/results.hpp"

namespace diptych::reports {

/// Writes ID.csv and ID.gp to `directory` (created if missing), runs gnuplot on the script for ID.svg and checks its
/// status and output. Without gnuplot the script and the data are still written; an older ID.svg is removed, so that
/// no picture contradicts its data. `message` receives gnuplot's own words, or what is wrong with its picture.
/// `gnuplot ID.gp` draws the picture again. ID.csv keeps the rows of NaN that part the lines of a curve, and says so;
/// spans and marks are comments at its top. Throws std::invalid_argument for a figure that cannot be drawn (no panels,
/// an empty or infinite range of the figure or of a panel, curves with unequal x and y, a span that ends before it
/// begins, a span or mark that is not finite, an id that is no plain file name) and std::runtime_error where a file
/// cannot be written.
Drawn draw(const Figure&, const std::filesystem::path& directory, std::string& message);

}  // namespace diptych::reports
