// What commands have in common: threads, progress, and where results go.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.hpp"
#include "runner/app/commands.hpp"
#include "runner/input/case.hpp"
#include "runner/run/run_leaf.hpp"

namespace diptych::runner {

/// Writes to standard output. That a terminal or a pipe takes no more costs no result: main() looks at the end whether
/// all was written, and says so by the exit status.
template <class... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  std::fwrite(text.data(), 1, text.size(), stdout);
}
/// The same to standard error, where it is nothing if it is lost.
template <class... Args>
void tell(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// A headline, and below it up to ten lines of a list.
std::string some_of(const std::string& headline, const std::vector<std::string>& lines);

int threads_of(const Options&);

/// A bar on a terminal, a plain line every quarter of the way elsewhere; on standard error, so results stay clean.
std::function<void(std::size_t done, std::size_t total)> progress();

/// A file that is to be written must not be one that is read, nor a folder: throws InputError before a run is paid for.
/// option: "--json".
void prepare_file(const std::string& option, const std::filesystem::path&, const std::vector<Case>&);
/// "about 40 s", "about 3 min", "about 2.5 h", "about 12 days", and what is less than a second.
std::string duration_words(double seconds);
/// Tells on standard error what runs will take, where `aloud`; throws InputError where that is more than an hour and
/// nobody has said --yes.
std::function<void(const Ahead&)> warning_of(const Options&, bool aloud);

/// Where results are to go must take them before the runs are paid for: throws InputError where it does not.
void prepare(const std::filesystem::path& out, const std::string& option = "--out");

/// Draws every figure whose id is wanted (all for an empty list) and prints its path; returns how many pictures could
/// not be drawn.
int draw_figures(const std::vector<reports::Case>&, const std::filesystem::path& directory,
                 const std::set<std::string>& wanted);

}  // namespace diptych::runner
