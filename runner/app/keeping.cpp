#include "runner/app/keeping.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "runner/app/provenance.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {

std::filesystem::path store_of(const Options& options) {
  return options.store.empty() ? options.out / "store" : options.store;
}

std::string build_of_this_program() {
  static const std::string build = [] {
    const reports::Provenance p = provenance();
    std::ifstream program("/proc/self/exe", std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(program), {});
    std::string words = fmt::format("{} {}{} {} [{}] {} program {}", p.version, p.commit, p.dirty ? " changed" : "",
                                    p.compiler, p.flags, p.libraries, digest_of(bytes));
    // A program may be told by its environment to compute something else, as the one with planted defects is.
    std::vector<std::string> told;
    for (char** entry = environ; *entry != nullptr; ++entry)
      if (const std::string one(*entry); one.starts_with("DIPTYCH_") && !one.starts_with("DIPTYCH_STORE="))
        told.push_back(one);
    std::sort(told.begin(), told.end());
    for (const std::string& one : told) words += ' ' + one;
    return words;
  }();
  return build;
}

std::unique_ptr<Keeping> keeping_of(const Options& options) {
  if (!options.from.empty()) {
    if (!std::filesystem::is_directory(options.from))
      throw InputError(options.from.string() + ": is no folder; allowed: a store");
    return std::make_unique<Keeping>(Store(options.from, build_of_this_program()), false, true);
  }
  if (options.store == "none") return nullptr;
  return std::make_unique<Keeping>(Store(store_of(options), build_of_this_program()), options.fresh);
}

void tell_kept(const Keeping* keeping) {
  if (!keeping) return;
  const std::string folder = keeping->store.folder().string();
  if (keeping->found > 0)
    tell("{} runs were made before and are taken from {} (--fresh makes them anew)\n", keeping->found.load(), folder);
  if (keeping->trouble) tell("not all runs could be kept, which this command does not need: {}\n", *keeping->trouble);
}

}  // namespace diptych::runner
