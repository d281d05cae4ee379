// Whether what is followed over many steps grows without end, and how fast.
#pragma once

#include <optional>
#include <vector>

namespace diptych::runner {

/// What comes of a look-ahead.
struct Growth {
  /// Of amplitudes, per step: half the slope of log energy, fitted over the second half of the look-ahead, when the
  /// fastest mode has outgrown the others. < 0: all modes fade; none: all have faded to nothing.
  std::optional<double> rate = 0;
  bool unstable = false;
};

/// Energies are exchanged between bodies of the mesh and between motion and strain, and each keeps its bound: the fit
/// over many exchanges is level. The fit, drawn out over the whole look-ahead, multiplies the energy of what grows
/// without end by more than this. (At the very limit energy grows as the square of the steps, by this fit 16-fold:
/// unstable.)
inline constexpr double growth_of_instability = 10;

/// The growth of energies that stand `stride` steps apart, all finite. Each tenth of their second half counts by its
/// largest, whatever it does within. ahead: steps of the whole look-ahead, of which an unstable run may have made
/// fewer.
Growth growth_of(const std::vector<double>& energies, long stride, long ahead);

}  // namespace diptych::runner
