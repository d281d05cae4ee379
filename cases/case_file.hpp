// Reading case files. Every mistake becomes a message that names the file, the key, what was found and what is allowed.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace diptych::cases {

/// What is wrong with a case file or with the command line; what() is ready for the user.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads and checks one case file. Throws InputError listing every mistake found, one a line.
Case read_case(const std::filesystem::path&);
/// The same from text; `name` stands for the file in messages.
Case parse_case(const std::string& text, const std::filesystem::path& name);

/// What expressions of this case may name besides x and t: L, E, rho, c = sqrt(E/rho), pi and its [parameters].
std::map<std::string, double> expression_constants(const Case&);

/// Nearest of `allowed` to `word` by edit distance, or "" if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& allowed);

}  // namespace diptych::cases
