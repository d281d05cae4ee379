// Files as a careless hand or a bad disk leaves them, for readers that must never crash.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "tests/text.hpp"

namespace diptych::tests {

/// Gives `read` the text cut short at every `stride`-th place, with each line gone and each line twice, with each value
/// replaced by each scrap, and `times` times with one to three places of it overwritten by scraps.
template <class Read>
void read_broken(const std::string& base, const std::vector<std::string>& scraps, std::size_t stride, int times,
                 std::mt19937& random, const Read& read) {
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t size = 0; size < base.size(); size += stride) read(base.substr(0, size));
  const auto all = lines(base);
  for (std::size_t skipped = 0; skipped < all.size(); ++skipped) {
    std::string less, more;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i != skipped) less += all[i] + "\n";
      more += all[i] + "\n" + (i == skipped ? all[i] + "\n" : "");
    }
    read(less);
    read(more);
  }
  for (const std::string& line : all) {
    const std::size_t equals = line.find("= ");
    if (equals == std::string::npos) continue;
    for (const std::string& scrap : scraps) read(replaced(base, line, line.substr(0, equals + 2) + scrap));
  }
  for (int i = 0; i < times; ++i) {
    std::string text = base;
    for (std::size_t n = 1 + pick(3); n > 0; --n) text.replace(pick(text.size()), pick(4), scraps[pick(scraps.size())]);
    read(text);
  }
}

}  // namespace diptych::tests
