// diptych store: what is kept of the runs that were made.
#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <system_error>

#include "runner/app/commands.hpp"
#include "runner/app/keeping.hpp"
#include "runner/app/showing.hpp"
#include "runner/input/messages.hpp"
#include "runner/judge/gates.hpp"

namespace diptych::runner {
namespace {

std::string size_in_words(std::uintmax_t bytes) {
  return bytes < 10'000       ? fmt::format("{} B", bytes)
         : bytes < 10'000'000 ? fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3)
                              : fmt::format("{:.0f} MB", static_cast<double>(bytes) / 1e6);
}

int list_records(const std::vector<StoredRun>& records, const Store& store) {
  struct Sum {
    std::size_t runs = 0;
    std::uintmax_t bytes = 0;
  };
  std::map<std::string, Sum> of_case;
  Sum others, damaged;
  for (const StoredRun& record : records) {
    Sum& sum = !record.damage.empty() ? damaged : record.build != store.build() ? others : of_case[record.case_id];
    ++sum.runs;
    sum.bytes += record.bytes;
  }
  for (const auto& [id, sum] : of_case) print("{:40} {:5} runs  {}\n", id, sum.runs, size_in_words(sum.bytes));
  if (others.runs > 0)
    print("{:40} {:5} runs  {}\n", "of other builds of the program", others.runs, size_in_words(others.bytes));
  if (damaged.runs > 0)
    print("{:40} {:5} runs  {}: see diptych store verify\n", "not whole, and not believed", damaged.runs,
          size_in_words(damaged.bytes));
  if (records.empty()) print("{}: no runs are kept here\n", store.folder().string());
  return all_passed;
}

int verify_records(const std::vector<StoredRun>& records, const Store& store) {
  std::size_t damaged = 0;
  for (const StoredRun& record : records) {
    if (record.damage.empty()) continue;
    ++damaged;
    print("{}: {}\n", record.file.string(), record.damage);
  }
  print("{}: {} runs, {} not whole\n", store.folder().string(), records.size(), damaged);
  return damaged == 0 ? all_passed : invalid;
}

int prune_records(const std::vector<StoredRun>& records, const Store& store, bool all) {
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
  const auto take_away = [&](const std::filesystem::path& file, std::uintmax_t size) {
    std::error_code problem;
    if (!std::filesystem::remove(file, problem) && problem)
      throw InputError(fmt::format("{}: cannot be removed: {}", file.string(), problem.message()));
    ++files;
    bytes += size;
  };
  for (const StoredRun& record : records)
    if (all || !record.damage.empty() || record.build != store.build()) take_away(record.file, record.bytes);
  for (const auto& file : store.left_behind()) {
    std::error_code ignored;
    take_away(file, std::filesystem::file_size(file, ignored));
  }
  print("{}: {} files removed, {}\n", store.folder().string(), files, size_in_words(bytes));
  return all_passed;
}

}  // namespace

int store_command(const Options& options) {
  const auto keeping = keeping_of(options);
  if (!keeping) throw InputError("--store none: found for the store itself; allowed: a folder");
  const Store& store = keeping->store;
  const std::string what = options.selectors.empty() ? "list" : options.selectors.front();
  require_one_of("store", what, {"list", "verify", "prune"});
  const auto records = store.records();
  if (what == "verify") return verify_records(records, store);
  if (what == "prune") return prune_records(records, store, options.all);
  return list_records(records, store);
}

}  // namespace diptych::runner
