// Where the commands keep what their runs measured.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "runner/app/commands.hpp"
#include "runner/run/runner.hpp"

namespace diptych::runner {

/// What made this program's numbers: version, commit, compiler, flags, libraries, the hash of the program itself, and
/// what its environment tells it.
std::string build_of_this_program();

/// Where a command says nothing of it, the store stands with its results.
std::filesystem::path store_of(const Options&);

/// The store that --store names; null for "none".
std::unique_ptr<Keeping> keeping_of(const Options&);

/// "2/3", as --shard has it. Throws InputError where it is none.
Shard shard_of(const std::string&);

/// Makes the runs of one shard and keeps them, or tells of them with --dry-run; judges and shows nothing. Returns the
/// exit status.
int make_shard(const std::vector<Case>&, Running, const Options&);

/// What was taken from the store and what was kept there, on standard error; nothing where there was neither.
void tell_kept(const Keeping*);

}  // namespace diptych::runner
