// --limit-of KEY=LEAST:MOST: which number of a case is raised until its runs are no longer stable.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/stability/loaded.hpp"

namespace diptych::runner {

/// Of a case: "courant", one of its parameters, or a key of its file as list --declarations writes it.
struct LimitOf {
  std::string key;
  double least = 0, most = 0;  ///< 0 < least < most
  bool of_file() const;        ///< the key is one of the file
};
/// Throws InputError where the text is not KEY=LEAST:MOST, or the case has no such key.
LimitOf limit_of(const Case&, const std::string& text);

/// "QUANTITY=MOST", of --at-most. Throws InputError where it is not that, or no number of the case's runs.
Ceiling ceiling_of(const Case&, const std::string& text);

/// Axes without the values that make no difference where the key has one value after the other.
void leave_to(const LimitOf&, Case&);

/// A leaf of a case whose key has the value. over: what made the case of its file, see with_values; which: its place
/// among those that this made.
struct Loaded {
  std::shared_ptr<const Case> c;
  Leaf leaf;
};
Loaded with_value(const Case&, const Leaf&, const LimitOf&, double value, const std::vector<std::string>& over,
                  std::size_t which);

}  // namespace diptych::runner
