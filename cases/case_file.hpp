// Reading case files. Every mistake becomes a message that names the file, the key, what was found and what is allowed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cases/case.hpp"
#include "cases/messages.hpp"

namespace diptych::cases {

/// Reads and checks one case file. Throws InputError listing every mistake found, one a line.
Case read_case(const std::filesystem::path&);
/// The same from text; `name` stands for the file in messages.
Case parse_case(const std::string& text, const std::filesystem::path& name);

/// What expressions of this case may name besides x and t: L, E, rho, c = sqrt(E/rho), pi and its [parameters].
std::map<std::string, double> expression_constants(const Case&);

}  // namespace diptych::cases
