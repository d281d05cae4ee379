// What the figures of a trade have in common: the series of its settings, and a strip for those without an error.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "reports/results.hpp"
#include "reports/trade_results.hpp"

namespace diptych::runner {

inline constexpr double exact_but_for_round_off = 1e-12;

/// A completed point's error, where its logarithm and that of its cost can be drawn; else null.
const reports::TradeError* drawable_error(const reports::TradePoint&, const reports::Aim&, reports::Cost);

/// Whether some completed point was timed.
bool is_timed(const reports::Trade&);

/// The meshes that can be drawn of each setting, from the coarsest on.
std::vector<std::vector<const reports::TradePoint*>> settings_of(const reports::Trade&, const reports::Aim&,
                                                                 reports::Cost);

/// The meshes of each setting joined. Settings have a series each where their family of methods has three at most, else
/// a method has one. `at`: x and y of a point that can be drawn.
std::vector<reports::Figure::Series> series_of(
    const std::vector<std::vector<const reports::TradePoint*>>& settings,
    const std::function<std::array<double, 2>(const reports::TradePoint&)>& at);

/// The range of what is drawn, a margin around it.
std::array<double, 2> span_of(const std::vector<const std::vector<double>*>&);

/// Adds the points without an error, each as what became of it: "unstable", which is also what completed above its
/// limit, "timed out" or "not judged". They stand in a strip above the range of y, which is widened, those of a family
/// of methods in a row. `x` of a point: NaN where it has none.
void add_strip(const reports::Trade&, const std::function<double(const reports::TradePoint&)>& x,
               std::array<double, 2>& y_range, reports::Figure::Panel&);
/// The looks of methods and of the strip.
std::vector<reports::PanelLook> looks_of_trade();
/// A note that counts the points without an error, empty where all have one.
std::string note_on_others(const reports::Trade&);

}  // namespace diptych::runner
