// What commands have in common: threads, progress, and where results go.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/app/commands.hpp"

namespace diptych::runner {

int threads_of(const Options&);

/// A bar on a terminal, a plain line every quarter of the way elsewhere; on standard error, so results stay clean.
std::function<void(std::size_t done, std::size_t total)> progress();

/// Where results are to go must take them before the runs are paid for: throws InputError where it does not.
void prepare(const std::filesystem::path& out);

/// Draws every figure whose id is wanted (all for an empty list) and prints its path; returns how many pictures could
/// not be drawn.
int draw_figures(const std::vector<reports::Case>&, const std::filesystem::path& directory,
                 const std::set<std::string>& wanted);

}  // namespace diptych::runner
