// What a case file gives an exact solution beside the scene.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace diptych::analytic {

/// A key of [exact].
struct SolutionParameter {
  enum class Rule {
    whole,     ///< 1 to 1000
    positive,  ///< > 0
    not_zero,  ///< any number but 0
    choice     ///< a word of `choices`, whose place in them is the value; the first one where it is not given
  };
  std::string key;
  Rule rule;
  std::vector<std::string> choices = {};
};

/// By key.
using SolutionParameters = std::map<std::string, double>;

}  // namespace diptych::analytic
