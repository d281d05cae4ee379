// What runs have measured, kept on disk: a record a run, found again by what made it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/results.hpp"

namespace diptych::runner {

/// A record of a store as it stands on disk.
struct StoredRun {
  std::filesystem::path file;
  std::string key;    ///< of its name
  std::string build;  ///< what made it
  std::string words;  ///< all that its run could see
  std::string case_id, label;
  std::uintmax_t bytes = 0;
  std::string damage;  ///< why it is not believed; empty: it is whole
};

/// A folder of records. A record's name is the hash (XXH3, 128 bits) of the build that made it and of all that its run
/// can see, in words; the words stand in it, so that two of one hash are told apart. It is written whole or not at all,
/// and what is read is believed only if its length and its hash are those that it says.
class Store {
 public:
  /// build: what made this program's numbers. The folder need not be there.
  Store(std::filesystem::path folder, std::string build);

  /// The run of these words that this build made, or nothing: none was kept, or it is not whole.
  std::optional<reports::Run> find(const std::string& words) const;
  /// Whether there is a record of these words, whole or not.
  bool has(const std::string& words) const;
  /// Throws std::runtime_error where it cannot be written, and leaves what was there.
  void keep(const std::string& words, const reports::Run&) const;

  /// Takes a whole record of another store in, as it stands. Throws std::runtime_error where it cannot.
  void copy(const std::filesystem::path& record) const;

  /// Every record that is there, sorted by file; those of other builds, and what is damaged, too.
  std::vector<StoredRun> records() const;
  /// Files that a writer left who was killed: older than an hour.
  std::vector<std::filesystem::path> left_behind() const;

  const std::filesystem::path& folder() const { return folder_; }
  const std::string& build() const { return build_; }
  std::filesystem::path file_of(const std::string& words) const;

 private:
  std::filesystem::path folder_;
  std::string build_;
};

/// A number that is the same for the same words on every machine: of which shard a run is.
std::uint64_t hash_of(const std::string& words);
/// 32 digits, of what may be long.
std::string digest_of(const std::string& bytes);

}  // namespace diptych::runner
