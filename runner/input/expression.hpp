// Expressions of x, y and t in case files (muParser behind a plain header).
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace diptych::runner {

/// Names of the functions that a formula may call, sorted: no constant may carry one of them.
const std::vector<std::string>& function_names();

/// A formula compiled once and evaluated often. An object is not to be shared between threads: copies are independent.
class Expression {
 public:
  /// `variables`: names in the order of the arguments of operator(); `constants`: name -> value.
  /// Throws InputError with the formula, the position and the reason where it does not parse, uses an unknown name
  /// (with the nearest known one), assigns, has several values, or has no variable and no finite value.
  Expression(const std::string& formula, const std::vector<std::string>& variables,
             const std::map<std::string, double>& constants);
  Expression(const Expression&);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression) noexcept;
  ~Expression();

  double operator()() const;                                           ///< for none
  double operator()(double first) const;                               ///< for one variable
  double operator()(double first, double second) const;                ///< for two
  double operator()(double first, double second, double third) const;  ///< for three

  /// Throws InputError: that this value of `of` at this place is none that a solver can take.
  [[noreturn]] void refuse(const char* of, double value, const std::vector<double>& at) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The value of an expression that a solver is given: throws InputError, naming `of`, the formula and the place, where
/// it is no finite number. A run would end of it later and elsewhere, as one whose energy grows.
template <class... Coordinates>
double finite_value(const char* of, const Expression& f, Coordinates... at) {
  const double value = f(at...);
  if (!std::isfinite(value)) f.refuse(of, value, {at...});
  return value;
}

}  // namespace diptych::runner
