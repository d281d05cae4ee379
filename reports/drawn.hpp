// What became of a picture.
#pragma once

namespace diptych::reports {

enum class Drawn { yes, gnuplot_missing, gnuplot_failed };

}  // namespace diptych::reports
