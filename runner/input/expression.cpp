#include "runner/input/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "runner/input/messages.hpp"

namespace diptych::runner {

namespace {

std::string in_quotes(const std::string& text) { return '"' + text + '"'; }

bool is_name(const std::string& token) {
  const auto letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !token.empty() && std::isdigit(static_cast<unsigned char>(token[0])) == 0 &&
         std::all_of(token.begin(), token.end(), letter);
}

/// muParser assigns with '=' (its variables could then be overwritten while they are read) and compares with '=='.
std::size_t assignment_in(const std::string& formula) {
  for (std::size_t i = 0; i < formula.size(); ++i) {
    if (formula[i] != '=') continue;
    if (i + 1 < formula.size() && formula[i + 1] == '=') {
      ++i;
    } else if (i == 0 || std::string("<>!").find(formula[i - 1]) == std::string::npos) {
      return i;
    }
  }
  return std::string::npos;
}

/// muParser's own words; its positions count from 0, those of a reader from 1.
std::string reason_of(const mu::ParserError& error) {
  std::string text = error.GetMsg();
  if (!text.empty() && text.back() == '.') text.pop_back();
  const std::string counted = "position " + std::to_string(error.GetPos());
  const std::size_t at = text.rfind(counted);
  if (at != std::string::npos && at + counted.size() == text.size())
    text.replace(at, counted.size(), "position " + std::to_string(error.GetPos() + 1));
  return text;
}

}  // namespace

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    const mu::Parser parser;
    for (const auto& function : parser.GetFunDef()) found.push_back(function.first);
    return found;
  }();
  return names;
}

/// muParser holds the addresses of the variables, so an Impl never moves, and a copy is built anew from its formula.
struct Expression::Impl {
  Impl(const std::string& formula_, const std::vector<std::string>& variables_,
       const std::map<std::string, double>& constants_)
      : formula(formula_), variables(variables_), constants(constants_) {
    if (variables.size() > values.size()) throw std::logic_error("an expression has at most three variables");
    if (formula.find_first_not_of(" \t\r\n") == std::string::npos)
      throw InputError("found an empty expression; allowed: a formula of " + names_in_words());
    if (formula.find('\0') != std::string::npos)  // where muParser would stop reading
      throw InputError("found a zero byte in an expression; allowed: a formula of " + names_in_words());
    if (const std::size_t at = assignment_in(formula); at != std::string::npos)
      throw InputError(in_quotes(formula) + ": found an assignment \"=\" at position " + std::to_string(at + 1) +
                       "; allowed: one value (a comparison is written ==)");
    try {
      for (const auto& [name, value] : constants) parser.DefineConst(name, value);
      for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &values[i]);
      parser.SetExpr(formula);
      int results = 0;
      const double* value = parser.Eval(results);
      if (results != 1)
        throw InputError(in_quotes(formula) + ": found " + std::to_string(results) +
                         " values separated by \",\"; allowed: one value (the decimal point is \".\")");
      if (parser.GetUsedVar().empty() && !std::isfinite(*value))
        throw InputError(in_quotes(formula) + ": found " + (std::isnan(*value) ? "NaN" : "an infinite value") +
                         "; allowed: a finite value");
    } catch (const mu::ParserError& error) {  // not derived from std::exception
      throw InputError(in_quotes(formula) + ": " + explained(error));
    }
  }

  std::string names_in_words() const {
    std::vector<std::string> names = variables;
    for (const auto& constant : constants) names.push_back(constant.first);
    return listed(names);
  }

  std::string explained(const mu::ParserError& error) const {
    const std::string& token = error.GetToken();
    if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN || token.empty()) return reason_of(error);
    const std::string where = " at position " + std::to_string(error.GetPos() + 1);
    if (!is_name(token)) {
      const bool digit = std::isdigit(static_cast<unsigned char>(token[0])) != 0;
      if (!digit) return reason_of(error);
      return "found " + in_quotes(token) + where + "; allowed: a number that a double can hold";
    }
    const std::vector<std::string>& functions = function_names();
    if (std::find(functions.begin(), functions.end(), token) != functions.end())
      return "function " + in_quotes(token) + where + " lacks its arguments in parentheses";
    std::vector<std::string> known = variables;
    for (const auto& constant : constants) known.push_back(constant.first);
    if (std::find(known.begin(), known.end(), token) != known.end()) return reason_of(error);  // known, misplaced
    known.insert(known.end(), functions.begin(), functions.end());
    const std::string near = nearest(token, known);
    return "unknown name " + in_quotes(token) + where + "; allowed: " + names_in_words() + " and the functions " +
           listed(functions) + (near.empty() ? "" : "; did you mean " + in_quotes(near) + "?");
  }

  std::string formula;
  std::vector<std::string> variables;
  std::map<std::string, double> constants;
  std::array<double, 3> values{};
  mu::Parser parser;
};

Expression::Expression(const std::string& formula, const std::vector<std::string>& variables,
                       const std::map<std::string, double>& constants)
    : impl_(std::make_unique<Impl>(formula, variables, constants)) {}

Expression::Expression(const Expression& other)
    : impl_(other.impl_ ? std::make_unique<Impl>(other.impl_->formula, other.impl_->variables, other.impl_->constants)
                        : nullptr) {}

Expression::Expression(Expression&&) noexcept = default;

Expression& Expression::operator=(Expression other) noexcept {
  impl_ = std::move(other.impl_);
  return *this;
}

Expression::~Expression() = default;

double Expression::operator()() const {
  if (!impl_->variables.empty()) throw std::logic_error("expression called with no argument: " + impl_->formula);
  return impl_->parser.Eval();
}

double Expression::operator()(double first) const {
  if (impl_->variables.size() != 1) throw std::logic_error("expression called with 1 argument: " + impl_->formula);
  impl_->values[0] = first;
  return impl_->parser.Eval();
}

double Expression::operator()(double first, double second) const {
  if (impl_->variables.size() != 2) throw std::logic_error("expression called with 2 arguments: " + impl_->formula);
  impl_->values[0] = first;
  impl_->values[1] = second;
  return impl_->parser.Eval();
}

double Expression::operator()(double first, double second, double third) const {
  if (impl_->variables.size() != 3) throw std::logic_error("expression called with 3 arguments: " + impl_->formula);
  impl_->values = {first, second, third};
  return impl_->parser.Eval();
}

void Expression::refuse(const char* of, double value, const std::vector<double>& at) const {
  Names where;
  for (std::size_t i = 0; i < at.size(); ++i) where.push_back(impl_->variables[i] + " = " + words(at[i]));
  throw InputError(fmt::format("{}: found {}, which is {} at {}; allowed: finite values", of, words(impl_->formula),
                               std::isnan(value) ? "NaN" : words(value), listed(where)));
}

}  // namespace diptych::runner
