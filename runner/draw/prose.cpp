#include "runner/draw/prose.hpp"

#include <fmt/core.h>

namespace diptych::runner {

std::map<std::string, std::string> numbers_of(const Case& c) {
  std::map<std::string, std::string> numbers;
  if (!c.plate || !c.plate->solid) return numbers;
  constexpr double giga = 1e9;
  const auto general = [](double value) { return fmt::format("{:g}", value); };
  const material::PlaneElastic& elastic = elastic_of(*c.plate);
  const double nu = elastic.poissons_ratio;
  numbers["E"] = general(elastic.youngs_modulus / giga);
  numbers["nu"] = general(nu);
  numbers["rho"] = general(elastic.density);
  if (const auto* failing = c.plate->failing()) {
    numbers["threshold"] = general(failing->law.threshold / giga);
    // In uniaxial strain σ_y = ν/(1 - ν) σ_x, and √(3/2 s:s) = σ_x - σ_y.
    numbers["threshold_stress"] = fmt::format("{:.3g}", failing->law.threshold * (1 - nu) / (1 - 2 * nu) / giga);
    numbers["f_max"] = general(failing->law.most_converted);
    numbers["d0"] = general(failing->spread.diffusivity);
  }
  if (c.plate->flyer) numbers["velocity"] = general(c.plate->flyer->velocity);
  return numbers;
}

Rule<std::string> prose(const Case& c) {
  return {[numbers = numbers_of(c)](const Place& place) -> std::optional<std::string> {
    const auto written = text().read(place);
    if (!written) return std::nullopt;
    Names known;
    for (const auto& [name, number] : numbers) known.push_back(name);
    std::string filled;
    for (std::size_t at = 0; at < written->size();) {
      const std::size_t open = written->find_first_of("{}", at);
      filled += written->substr(at, open - at);
      if (open == std::string::npos) break;
      const std::size_t close = written->find('}', open);
      const std::string name =
          close == std::string::npos || close == open ? "" : written->substr(open + 1, close - open - 1);
      if (!numbers.contains(name))
        return place.refuse(
            words(close == std::string::npos ? written->substr(open, 1) : written->substr(open, close - open + 1)),
            known.empty() ? "no braces: this case has no numbers for them"
                          : "in braces the name of a number of this case, " + joined(known),
            suggestion(name, known));
      filled += numbers.at(name);
      at = close + 1;
    }
    return filled;
  }};
}

}  // namespace diptych::runner
