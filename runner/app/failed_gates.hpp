// Which gates did not pass the last time they were judged: what `gate --failed` asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/results.hpp"

namespace diptych::runner {

/// As select_cases takes them, "bar.energy/repeat" or "my.toml/mine", sorted; empty where none is known.
std::vector<std::string> failed_gates(const std::filesystem::path& store);

/// Takes these gates' verdicts in, and leaves what is known of others. Gates of a file of the user's own go by its
/// path.
void note_failed_gates(const std::filesystem::path& store, const std::vector<reports::Case>&);

}  // namespace diptych::runner
