// Reading case files. Every mistake becomes a message that names the file, the key, what was found and what is allowed.
#pragma once

#include <filesystem>
#include <string>

#include "runner/input/case.hpp"
#include "runner/input/messages.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

/// Reads and checks one case file. Throws InputError listing every mistake found, one a line.
Case read_case(const std::filesystem::path&);
/// The same from text; `name` stands for the file in messages.
Case parse_case(const std::string& text, const std::filesystem::path& name);

/// The scene of a case file with some keys changed: its runs, without gates and figures, which may not fit it. Its runs
/// are labelled by what was changed; a run above the limit of its time step is made.
/// Throws InputError where a key is not one of the file and none is to be added, and where the scene is not one.
/// What the scene needs of [model] features follows from the change.
Case changed_case(const std::filesystem::path&, const std::vector<Change>&);
Case changed_case(const std::string& text, const std::filesystem::path& name, const std::vector<Change>&);
/// "material.nu=0.4999 without viscosity": how runs are labelled by what was changed.
std::string label_of(const std::vector<Change>&);

}  // namespace diptych::runner
