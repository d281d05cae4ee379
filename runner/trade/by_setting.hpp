// What was found on a sweep, setting by setting: each becomes a line of a figure.
#pragma once

#include <algorithm>
#include <vector>

namespace diptych::runner {

/// Those of `all` that are `wanted`, by their `setting`: settings in the order of first mention, what is of one in that
/// of `before`. `all` must outlive it.
template <class One, class Wanted, class Before>
std::vector<std::vector<const One*>> by_setting(const std::vector<One>& all, Wanted wanted, Before before) {
  std::vector<std::vector<const One*>> settings;
  for (const One& one : all) {
    if (!wanted(one)) continue;
    const auto known = std::find_if(settings.begin(), settings.end(),
                                    [&](const auto& of_one) { return of_one.front()->setting == one.setting; });
    if (known == settings.end())
      settings.push_back({&one});
    else
      known->push_back(&one);
  }
  for (auto& of_one : settings)
    std::sort(of_one.begin(), of_one.end(), [&](const One* a, const One* b) { return before(*a, *b); });
  return settings;
}

}  // namespace diptych::runner
