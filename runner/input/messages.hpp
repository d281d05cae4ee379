// Words for messages: what was found, what is allowed, the nearest valid name.
#pragma once

#include <fmt/core.h>

#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::runner {

using Names = std::vector<std::string>;

/// What is wrong with a case file or with the command line; what() is ready for the user.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

std::string words(double);  ///< the shortest that reads back as the same double
std::string words(int);
std::string words(const std::string&);          ///< in quotes
std::string words(const std::vector<double>&);  ///< in brackets

template <class Value>
std::string joined(const std::vector<Value>& values) {
  std::string out;
  for (const Value& value : values) out += (out.empty() ? "" : ", ") + words(value);
  return out;
}

/// Values as fmt writes them, with `between` each two. (fmt::join is compiled anew wherever it is called.)
template <class Values>
std::string listed(const Values& values, const char* between = ", ") {
  std::string out;
  for (const auto& value : values) out += (&value == &*std::begin(values) ? "" : between) + fmt::format("{}", value);
  return out;
}

/// What stands between each two of these characters.
Names parts_of(const std::string& text, char between);
/// The finite number that all of the text is, or nothing.
std::optional<double> number_in(const std::string& text);

bool contains(const Names&, const std::string& name);

/// Nearest of `allowed` to `word` by edit distance, or "" if none is near.
std::string nearest(const std::string& word, const Names& allowed);
/// "did you mean ...?", or "" if none is near.
std::string suggestion(const std::string& word, const Names& allowed);
/// The same after a semicolon, where a sentence goes on with it.
std::string hint_of(const std::string& word, const Names& allowed);
/// Throws InputError where what an option of the command line was given is none of these.
void require_one_of(const std::string& option, const std::string& found, const Names& allowed);

}  // namespace diptych::runner
