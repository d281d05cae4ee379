// gnuplot: its script mode, and running it. For reports/ alone.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "reports/drawn.hpp"

namespace diptych::reports {

/// Throws std::invalid_argument unless the id is a plain file name: at most 200 letters, digits, '_',
/// '-' and '.'.
void check_id(const std::string& id);

/// What a '-' of the last plot command is to read, with 18 digits. `gp` is the stream that draw_files gives.
void send_points(std::ostream& gp, const std::vector<std::pair<double, double>>& points);

/// Writes ID.csv, and ID.gp as `write` sends it to gnuplot-iostream, runs gnuplot and keeps its picture if it is whole:
/// see draw(). Throws std::runtime_error where a script did not arrive whole.
Drawn draw_files(const std::string& id, const std::string& csv, const std::function<void(std::ostream&)>& write,
                 const std::filesystem::path& directory, std::string& message);

}  // namespace diptych::reports
