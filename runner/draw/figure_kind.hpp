// What a kind of figure is made of. Each kind is one file here, and a row in figure_kinds.cpp.
#pragma once

#include <any>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

struct FigureKind {
  enum class Scenes { bars, plates };
  /// Which runs a figure draws: those that its keys name, which must be among the axes' ones; or none, or what there is
  /// of many.
  enum class Draws { its_runs, what_there_is };

  std::string id;
  Scenes scenes = Scenes::bars;
  Names keys;  ///< those that not all kinds take: its own, and of the common ones "cells", "times" and "range"
  Draws draws = Draws::its_runs;
  /// Fills in `options`, `recorded`, `over` and `pictures`; id, times and range are read already. Null where the kind
  /// has no keys of its own.
  void (*read)(Table&, const Case&, FigureSpec&) = nullptr;
  /// What only all figures of the case tell; mistakes are said at the place. Null where there is nothing.
  void (*check)(const Place& figures, const Case&, const FigureSpec&) = nullptr;
  /// Draws from the result's completed runs (and gates) into its figures or pages. The case has the figure's values of
  /// the swept parameters.
  void (*add)(const Case&, const FigureSpec&, reports::Case&) = nullptr;
};

/// The options of the figure's own kind.
template <class Options>
const Options& options_of(const FigureSpec& spec) {
  return std::any_cast<const Options&>(spec.options);
}

}  // namespace diptych::runner
