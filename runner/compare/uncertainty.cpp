#include "runner/compare/uncertainty.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace diptych::runner {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double least_order = 0.05, largest_order = 10;

// --- Sprague & Geers ---

void check_history(const History& h) {
  const bool ascends =
      std::adjacent_find(h.time.begin(), h.time.end(), [](double a, double b) { return !(a < b); }) == h.time.end();
  if (h.time.size() < 2 || h.value.size() != h.time.size() || !ascends)
    throw std::invalid_argument("history: needs two samples or more, at times that ascend");
}

/// Within the samples.
double history_value(const History& h, double time) {
  const auto above = std::upper_bound(h.time.begin() + 1, h.time.end() - 1, time);
  const auto i = static_cast<std::size_t>(above - h.time.begin());
  const double part = (time - h.time[i - 1]) / (h.time[i] - h.time[i - 1]);
  return (1 - part) * h.value[i - 1] + part * h.value[i];
}

/// √∫f² dt of a line between samples.
double norm(const std::vector<double>& time, const std::vector<double>& f) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < time.size(); ++i)
    sum += (time[i + 1] - time[i]) * (f[i] * f[i] + f[i] * f[i + 1] + f[i + 1] * f[i + 1]) / 3;
  return std::sqrt(sum);
}

// --- Eça & Hoekstra ---

/// A least-squares fit of φ₀ + Σ α_k b_k(h).
struct Fit {
  ErrorModel model = ErrorModel::power;
  bool weighted = false;
  double order = 0;           ///< of the power
  double extrapolated = 0;    ///< φ₀
  double deviation = 0;       ///< σ
  std::vector<double> value;  ///< of each level
};

struct Levels {
  std::vector<double> h, value;
};

/// Weights are 1 or ∝ 1/h with the mean 1.
Fit fit(const Levels& levels, ErrorModel model, bool weighted, double order = 0) {
  const std::size_t n = levels.h.size(), terms = model == ErrorModel::mixed ? 3 : 2;
  const std::size_t unknowns = model == ErrorModel::power || model == ErrorModel::mixed ? 3 : 2;
  const auto matrix = [](std::size_t rows, std::size_t columns) {
    return std::unique_ptr<gsl_matrix, void (*)(gsl_matrix*)>(gsl_matrix_alloc(rows, columns), gsl_matrix_free);
  };
  const auto vector = [](std::size_t size) {
    return std::unique_ptr<gsl_vector, void (*)(gsl_vector*)>(gsl_vector_alloc(size), gsl_vector_free);
  };
  const auto basis = matrix(n, terms), covariance = matrix(terms, terms);
  const auto weight = vector(n), value = vector(n), coefficient = vector(terms);
  double inverse = 0;
  for (const double h : levels.h) inverse += 1 / h;
  for (std::size_t i = 0; i < n; ++i) {
    const double h = levels.h[i];
    gsl_matrix_set(basis.get(), i, 0, 1);
    gsl_matrix_set(basis.get(), i, 1,
                   model == ErrorModel::power    ? std::pow(h, order)
                   : model == ErrorModel::second ? h * h
                                                 : h);
    if (terms == 3) gsl_matrix_set(basis.get(), i, 2, h * h);
    gsl_vector_set(weight.get(), i, weighted ? static_cast<double>(n) / (h * inverse) : 1);
    gsl_vector_set(value.get(), i, levels.value[i]);
  }
  const std::unique_ptr<gsl_multifit_linear_workspace, void (*)(gsl_multifit_linear_workspace*)> space(
      gsl_multifit_linear_alloc(n, terms), gsl_multifit_linear_free);
  double squares = 0;
  gsl_multifit_wlinear(basis.get(), weight.get(), value.get(), coefficient.get(), covariance.get(), &squares,
                       space.get());
  Fit result{model,
             weighted,
             order,
             gsl_vector_get(coefficient.get(), 0),
             std::sqrt(squares / static_cast<double>(n - unknowns)),
             {}};
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < terms; ++k)
      sum += gsl_vector_get(coefficient.get(), k) * gsl_matrix_get(basis.get(), i, k);
    result.value.push_back(sum);
  }
  return result;
}

/// The power fit over all orders: the least of a scan, then Brent's method between its neighbours.
Fit fit_power(const Levels& levels, bool weighted) {
  struct Given {
    const Levels* levels;
    bool weighted;
  } given{&levels, weighted};
  const auto deviation = [](double order, void* p) {
    const auto* g = static_cast<const Given*>(p);
    return fit(*g->levels, ErrorModel::power, g->weighted, order).deviation;
  };
  constexpr int parts = 100;
  const double ratio = std::pow(largest_order / least_order, 1.0 / parts);
  const auto order_of = [&](int i) { return i == parts ? largest_order : least_order * std::pow(ratio, i); };
  std::vector<double> scan;
  for (int i = 0; i <= parts; ++i) scan.push_back(deviation(order_of(i), &given));
  const int best = static_cast<int>(std::min_element(scan.begin(), scan.end()) - scan.begin());
  double order = order_of(best);
  const auto s = [&](int i) { return scan[static_cast<std::size_t>(i)]; };
  if (best > 0 && best < parts && s(best) < s(best - 1) && s(best) < s(best + 1)) {
    const std::unique_ptr<gsl_min_fminimizer, void (*)(gsl_min_fminimizer*)> solver(
        gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent), gsl_min_fminimizer_free);
    gsl_function f{deviation, &given};
    gsl_min_fminimizer_set_with_values(solver.get(), &f, order, s(best), order_of(best - 1), s(best - 1),
                                       order_of(best + 1), s(best + 1));
    for (int i = 0; i < 100; ++i) {
      if (gsl_min_fminimizer_iterate(solver.get()) != GSL_SUCCESS) break;
      const double low = gsl_min_fminimizer_x_lower(solver.get()), high = gsl_min_fminimizer_x_upper(solver.get());
      if (gsl_min_test_interval(low, high, 0, 1e-10) == GSL_SUCCESS) break;
    }
    order = gsl_min_fminimizer_x_minimum(solver.get());
  }
  return fit(levels, ErrorModel::power, weighted, order);
}

Fit better(Fit a, Fit b) { return b.deviation < a.deviation ? b : a; }

/// The fit of the smaller deviation, with weights or without.
Fit either_weight(const Levels& levels, ErrorModel model) {
  return better(fit(levels, model, false), fit(levels, model, true));
}

}  // namespace

SpragueGeers sprague_geers(const History& history, const History& reference) {
  check_history(history);
  check_history(reference);
  const double begin = std::max(history.time.front(), reference.time.front());
  const double end = std::min(history.time.back(), reference.time.back());
  if (!(begin < end)) throw std::invalid_argument("histories: share no time");
  std::vector<double> time{begin, end};
  for (const History* h : {&history, &reference}) {
    for (const double t : h->time) {
      if (t > begin && t < end) time.push_back(t);
    }
  }
  std::sort(time.begin(), time.end());
  time.erase(std::unique(time.begin(), time.end()), time.end());
  std::vector<double> f, g;
  for (const double t : time) {
    f.push_back(history_value(history, t));
    g.push_back(history_value(reference, t));
  }
  const double size_f = norm(time, f), size_g = norm(time, g);
  if (!(size_f > 0) || !(size_g > 0)) return {unknown, unknown, unknown};
  // The angle between f and g from the sides of their rhombus: arccos would lose half the digits of a small one.
  std::vector<double> sum, difference;
  for (std::size_t i = 0; i < time.size(); ++i) {
    sum.push_back(f[i] / size_f + g[i] / size_g);
    difference.push_back(f[i] / size_f - g[i] / size_g);
  }
  const double phase = 2 * std::atan2(norm(time, difference), norm(time, sum)) / std::numbers::pi;
  const double magnitude = size_f / size_g - 1;
  return {magnitude, phase, std::hypot(magnitude, phase)};
}

Uncertainty discretisation_uncertainty(const std::vector<double>& cell_size, const std::vector<double>& value) {
  const std::size_t n = cell_size.size();
  std::vector<double> sorted = cell_size;
  std::sort(sorted.begin(), sorted.end());
  const bool differ = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  if (n < levels_for_uncertainty || value.size() != n || !differ || !(sorted.front() > 0) ||
      !std::isfinite(sorted.back()))
    throw std::invalid_argument("discretisation uncertainty: needs four levels or more, of different cell sizes > 0");
  const auto [least, largest] = std::minmax_element(value.begin(), value.end());
  const double span = *largest - *least, shift = *least;
  const bool finite = std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); });
  if (!finite || !std::isfinite(span)) {
    return {unknown, unknown, ErrorModel::power, false, unknown, unknown, unknown, std::vector<double>(n, unknown)};
  }
  const double range = span / static_cast<double>(n - 1);
  if (span == 0) return {value[0], unknown, ErrorModel::power, false, 0, 0, 1.25, std::vector<double>(n, 0.0)};

  // In units of the least cell and the values' span, so that the fits are well scaled.
  Levels levels;
  for (std::size_t i = 0; i < n; ++i) {
    levels.h.push_back(cell_size[i] / sorted.front());
    levels.value.push_back((value[i] - shift) / span);
  }
  const Fit power = better(fit_power(levels, false), fit_power(levels, true));
  const double p = power.order;
  Fit chosen = power;
  if (p < 0.5 || p > 2) {
    chosen = better(either_weight(levels, ErrorModel::first), either_weight(levels, ErrorModel::second));
    if (p < 0.5) chosen = better(chosen, either_weight(levels, ErrorModel::mixed));
  }
  const double scaled_range = 1 / static_cast<double>(n - 1);
  const bool good = chosen.deviation < scaled_range;
  Uncertainty result;
  result.extrapolated = shift + span * chosen.extrapolated;
  result.order = p > least_order && p < largest_order ? p : unknown;
  result.model = chosen.model;
  result.weighted = chosen.weighted;
  result.deviation = span * chosen.deviation;
  result.range = range;
  result.safety = p >= 0.5 && p <= 2.1 && good ? 1.25 : 3;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = std::abs(chosen.value[i] - chosen.extrapolated);
    const double scatter = chosen.deviation + std::abs(levels.value[i] - chosen.value[i]);
    const double band =
        good ? result.safety * error + scatter : result.safety * chosen.deviation / scaled_range * (error + scatter);
    result.band.push_back(span * band);
  }
  return result;
}

}  // namespace diptych::runner
