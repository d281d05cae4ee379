// When bars act on each other, as a run comes to know it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hinge/step/record.hpp"

namespace diptych {

/// Touches of neighbouring bars `left` and `left` + 1 in the order of their beginning. At any time a pair has at most
/// one that has not ended.
class Touches {
 public:
  void begin(std::size_t left, double time) { all_.push_back({left, time}); }
  /// Ends the touch that has not ended yet; does nothing where there is none.
  void end(std::size_t left, double time) {
    const auto touch = lasting(left);
    if (touch != all_.rend()) touch->to = time;
  }
  bool last(std::size_t left) { return lasting(left) != all_.rend(); }
  const std::vector<Touch>& all() const { return all_; }

 private:
  std::vector<Touch>::reverse_iterator lasting(std::size_t left) {
    return std::find_if(all_.rbegin(), all_.rend(),
                        [&](const Touch& touch) { return touch.left == left && std::isinf(touch.to); });
  }

  std::vector<Touch> all_;
};

}  // namespace diptych
