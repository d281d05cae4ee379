// The gnuplot script of a figure of curves. For reports/ alone.
#pragma once

#include <iosfwd>

#include "reports/results.hpp"

namespace diptych::reports::curves {

/// The whole script, its data inside. `gp` is the stream that draw_files gives.
void write_script(std::ostream& gp, const Figure&);

}  // namespace diptych::reports::curves
