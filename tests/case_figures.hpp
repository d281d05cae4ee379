// A case's figures and pages, drawn from runs made by hand.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.hpp"
#include "runner/draw/figure_kinds.hpp"

namespace diptych::tests {

/// All of them.
inline reports::Case drawn_case(const runner::Case& c, std::vector<reports::Run> runs = {}) {
  reports::Case result;
  result.runs = std::move(runs);
  runner::add_figures(c, result);
  return result;
}

/// The one of this id. Throws where there is none.
template <class Figure>
const Figure& named(const std::vector<Figure>& figures, const std::string& id) {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.id == id; });
  return figures.at(static_cast<std::size_t>(found - figures.begin()));
}

/// The same of a case's curves: profiles, motion, histories, convergence.
inline reports::Figure drawn_figure(const runner::Case& c, const std::string& id, std::vector<reports::Run> runs = {}) {
  return named(drawn_case(c, std::move(runs)).figures, id);
}

}  // namespace diptych::tests
