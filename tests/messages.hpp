// What a thrown error says.
#pragma once

#include <exception>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/text.hpp"

namespace diptych::tests {

/// The message of the error that `f` throws; empty if it throws none. Another error than the expected goes on its way.
template <class Expected = std::exception, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Expected& error) {
    return error.what();
  }
  return "";
}

/// For BOOST_CHECK_EXCEPTION: the message holds all of the parts.
inline auto says(std::vector<std::string> parts) {
  return [parts](const std::exception& error) { return holds_all(error.what(), parts); };
}

}  // namespace diptych::tests
