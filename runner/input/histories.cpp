#include "runner/input/histories.hpp"

namespace diptych::runner {
namespace {

/// Mean over [from, to] of f(t) = amplitude for t ≥ start.
double mean_of_step(double amplitude, double start, double from, double to) {
  if (from >= start) return amplitude;
  if (to <= start) return 0;
  return amplitude * ((to - start) / (to - from));
}

/// Mean over [from, to] of a rise from 0 to the amplitude between start and start + rise.
double mean_of_ramp(double amplitude, double start, double rise, double from, double to) {
  if (from >= start + rise) return amplitude;
  const auto integral = [&](double t) {
    const double s = t - start;
    return s <= 0 ? 0 : s < rise ? s * s / (2 * rise) : s - rise / 2;
  };
  return amplitude * ((integral(to) - integral(from)) / (to - from));
}

}  // namespace

std::function<double(double, double)> mean_over(const LoadHistory& h) {
  if (h.kind == "ramp")
    return [=](double from, double to) { return mean_of_ramp(h.amplitude, h.start, h.rise, from, to); };
  if (h.kind == "impulse") {
    const double end = h.start + h.duration;
    return [=](double from, double to) {
      return mean_of_step(h.amplitude, h.start, from, to) - mean_of_step(h.amplitude, end, from, to);
    };
  }
  return [=](double from, double to) { return mean_of_step(h.amplitude, h.start, from, to); };
}

std::function<double(double, double)> mean_over(const Expression& f) {
  return [f](double from, double to) {
    const auto at = [&](double t) { return finite_value("load", f, t); };
    return (at(from) + 4 * at((from + to) / 2) + at(to)) / 6;
  };
}

}  // namespace diptych::runner
