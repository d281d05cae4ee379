// What features cost where they are off, as plain data.
#pragma once

#include <cstddef>
#include <string>

#include "reports/trade_results.hpp"

namespace diptych::reports {

/// One feature in one solver, on a scene of one size: a run without it beside a run with it.
struct OffRow {
  /// What the second run is.
  enum class Kind {
    zero,  ///< the feature is written and is nothing: a run must be what it is without it, to the bit and byte
    idle,  ///< it is there and does nothing yet: no bit may differ, and what it costs is told
    books  ///< the first keeps none; of the second's every step is in them
  };
  std::string feature;  ///< "viscosity"
  std::string scene;    ///< "plate"
  std::string method;   ///< "fem"
  Kind kind = Kind::zero;
  std::size_t points = 0;  ///< elements or particles of the first
  bool same_bits = false;  ///< of what both have
  double bytes = 0;        ///< a point, of the first
  double least = 0;        ///< of these, what an elastic scene cannot do without, a point
  double rim = 0;          ///< allowed beyond it, for what goes with rows and ends and not with points, a point
  double more = 0;         ///< bytes a point that the second has beyond the first's
  Timed ratio;             ///< of the times of a step a point, second over first; `seconds` is the ratio
  std::string trouble;     ///< why there are no numbers; empty: there are

  /// The watch over instability, which reads the energies of one step in so many where no books are kept.
  static constexpr double glance = 64;
  static constexpr double allowed = 1.02;  ///< of a ratio

  /// What the feature costs a scene that does not use it, as a ratio of times: measured where it is written as nothing;
  /// of the books, whose every step costs what one in `glance` costs without them, from above. NaN of what is idle,
  /// which a scene without it has in no form: bits and bytes tell of it.
  double off_ratio() const;
  /// The same bits, and no byte more than the scene needs.
  bool exact() const {
    return trouble.empty() && same_bits && bytes <= least + rim && (kind != Kind::zero || more == 0);
  }
  double off_spread() const;  ///< of off_ratio(), likewise relative
  /// Whether a scene without the feature pays no more than is allowed: yes; no, by more than the spread; or the machine
  /// was too busy to tell. Of what is idle no time is asked for.
  enum class Time { quick, slow, unsure };
  Time time() const;
};

}  // namespace diptych::reports
