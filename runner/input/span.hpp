#pragma once

namespace diptych::runner {

/// Where a bar stands in reference coordinates [m].
struct Span {
  double begin, end;
};

}  // namespace diptych::runner
