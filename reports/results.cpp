#include "reports/results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace diptych::reports {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The numbers in a list such as "[0.25, 0.75]", whatever separates them.
std::vector<double> numbers(const std::string& list) {
  std::vector<double> found;
  for (const char* at = list.c_str(); *at != '\0';) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      found.push_back(value);
      at = end;
    }
  }
  return found;
}

double room(const Check& check) {
  if (std::isnan(check.judged)) return -infinity;
  const double below = check.judged - check.low, above = check.high - check.judged;
  const bool open_low = std::isinf(check.low), open_high = std::isinf(check.high);
  double value = infinity;
  if (open_low != open_high) {
    const double edge = std::abs(open_low ? check.high : check.low);
    value = (open_low ? above : below) / (edge > 0 ? edge : 1);
  } else if (!open_low) {
    const double half_width = (check.high - check.low) / 2;
    const double nearest = std::min(below, above);
    value = half_width > 0 ? nearest / half_width : nearest < 0 ? -infinity : 0;
  }
  // What failed for another reason than its band must not look as if it had room.
  return check.passed || value < 0 ? value : -infinity;
}

}  // namespace

Run::Run() = default;
Run::Run(const Run&) = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(const Run&) = default;
Run& Run::operator=(Run&&) noexcept = default;
Run::~Run() = default;

Case::Case() = default;
Case::Case(const Case&) = default;
Case::Case(Case&&) noexcept = default;
Case& Case::operator=(const Case&) = default;
Case& Case::operator=(Case&&) noexcept = default;
Case::~Case() = default;

std::string Run::label() const {
  std::string text = fmt::format("{} N={} C={}", method, cells, courant_asked);
  const std::string swept = parameters.empty() ? "" : " " + parameters;
  if (particles.empty()) return text + swept;
  const std::vector<double> positions = numbers(particles);
  text += fmt::format(" ppc={}", positions.size());
  const double count = static_cast<double>(positions.size());
  bool even = true;
  for (std::size_t i = 0; i < positions.size(); ++i)
    even = even && std::abs(positions[i] - (static_cast<double>(i) + 0.5) / count) < 1e-12;
  if (!even) {
    std::string at = particles;
    std::replace(at.begin(), at.end(), ' ', ',');
    text += "@" + at;
  }
  return text + swept;
}

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass: return "PASS";
    case Verdict::fail: return "FAIL";
    case Verdict::unstable: return "UNSTABLE";
    case Verdict::error: return "ERROR";
    case Verdict::invalid: return "INVALID";
  }
  return "INVALID";
}

double Gate::headroom() const {
  if (checks.empty()) return std::numeric_limits<double>::quiet_NaN();
  double least = infinity;
  for (const Check& check : checks) least = std::min(least, room(check));
  return least;
}

}  // namespace diptych::reports
