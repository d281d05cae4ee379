// Reading case files. Every mistake becomes a message that names the file, the key, what was found and what is allowed.
#pragma once

#include <filesystem>
#include <string>

#include "runner/input/case.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {

/// Reads and checks one case file. Throws InputError listing every mistake found, one a line.
Case read_case(const std::filesystem::path&);
/// The same from text; `name` stands for the file in messages.
Case parse_case(const std::string& text, const std::filesystem::path& name);

}  // namespace diptych::runner
