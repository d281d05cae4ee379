// What gates hold their runs against, to look at and to change.
#pragma once

#include <memory>

#include "runner/judge/gate_kind.hpp"

namespace diptych::tests {

/// Throws std::bad_cast where the gate has another one.
template <class Own>
const Own& criterion(const runner::GateSpec& gate) {
  return dynamic_cast<const Own&>(*gate.criterion);
}

/// A new one in the place of the gate's.
template <class Own>
Own& replace_criterion(runner::GateSpec& gate, const Own& by = {}) {
  const auto own = std::make_shared<Own>(by);
  gate.criterion = own;
  return *own;
}

/// A copy in the place of the gate's, to be changed.
template <class Own>
Own& change_criterion(runner::GateSpec& gate) {
  return replace_criterion(gate, criterion<Own>(gate));
}

}  // namespace diptych::tests
