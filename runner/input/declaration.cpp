#include "runner/input/declaration.hpp"

namespace diptych::runner {

std::string words(const Declaration& declaration) {
  std::string line;
  for (const auto& [key, value] : declaration) line += (line.empty() ? "" : " ") + key + '=' + value;
  return line;
}

}  // namespace diptych::runner
