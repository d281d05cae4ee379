// The norms of a field's error, by name.
#pragma once

#include <array>
#include <optional>

#include "reports/results.hpp"

namespace diptych::reports {

/// One of the three norms of a FieldError.
struct Norm {
  const char* name;
  double FieldError::*measured;
  std::optional<double> FieldError::*predicted;
};
inline const std::array<Norm, 3> norms{{{"L1", &FieldError::l1, &FieldError::predicted_l1},
                                        {"L2", &FieldError::l2, &FieldError::predicted_l2},
                                        {"Linf", &FieldError::linf, &FieldError::predicted_linf}}};

}  // namespace diptych::reports
