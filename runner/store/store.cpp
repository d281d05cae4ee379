#include "runner/store/store.hpp"

#include <fmt/core.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "reports/files.hpp"
#include "reports/run_record.hpp"

namespace diptych::runner {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_ending = ".run";
constexpr const char* first_word_of_record = "diptych-run-1";

/// A record between its first line and its end.
struct Payload {
  std::string build, words, case_id, label, run;
};

/// Texts after one another, each behind its length.
std::string packed(const Payload& payload) {
  std::string out;
  for (const std::string* part : {&payload.build, &payload.words, &payload.case_id, &payload.label, &payload.run})
    out += fmt::format("{}\n", part->size()) + *part + '\n';
  return out;
}

Payload unpacked(const std::string& bytes) {
  Payload payload;
  std::size_t at = 0;
  for (std::string* part : {&payload.build, &payload.words, &payload.case_id, &payload.label, &payload.run}) {
    std::size_t length = 0;
    const char* end = bytes.data() + bytes.size();
    const auto [digits_end, error] = std::from_chars(bytes.data() + at, end, length);
    if (error != std::errc() || digits_end == end || *digits_end != '\n')
      throw std::runtime_error("its parts do not fit");
    at = static_cast<std::size_t>(digits_end - bytes.data()) + 1;
    if (length >= bytes.size() - at) throw std::runtime_error("its parts do not fit");
    *part = bytes.substr(at, length);
    at += length + 1;
  }
  return payload;
}

/// Throws std::runtime_error with the reason where the file is not a whole record.
Payload read_record(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(std::string("it cannot be read: ") + std::strerror(errno));
  std::string head;
  std::getline(in, head);
  std::istringstream words(head);
  std::string mark, digest;
  std::size_t length = 0;
  if (!(words >> mark >> length >> digest) || mark != first_word_of_record)
    throw std::runtime_error("it does not begin as a record does");
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (bytes.size() != length)
    throw std::runtime_error(fmt::format("it has {} bytes behind its first line, not {}", bytes.size(), length));
  if (digest_of(bytes) != digest) throw std::runtime_error("its bytes are not those that were written");
  return unpacked(bytes);
}

bool is_record(const fs::directory_entry& entry) {
  std::error_code ignored;
  return entry.path().extension() == record_ending && entry.is_regular_file(ignored);
}

template <class Take>
void for_each_file(const fs::path& folder, const Take& take) {
  std::error_code none;
  for (fs::recursive_directory_iterator it(folder, none), end; !none && it != end; it.increment(none)) take(*it);
}

}  // namespace

std::uint64_t hash_of(const std::string& words) { return XXH3_64bits(words.data(), words.size()); }

std::string digest_of(const std::string& bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

Store::Store(fs::path folder, std::string build) : folder_(std::move(folder)), build_(std::move(build)) {}

fs::path Store::file_of(const std::string& words) const {
  const std::string key = digest_of(build_ + '\n' + words);
  return folder_ / key.substr(0, 2) / (key.substr(2) + record_ending);
}

std::optional<reports::Run> Store::find(const std::string& words) const {
  try {
    const fs::path file = file_of(words);
    std::error_code none;
    if (!fs::exists(file, none)) return {};
    const Payload payload = read_record(file);
    if (payload.build != build_ || payload.words != words) return {};
    return reports::run_of_record(payload.run);
  } catch (const std::exception&) {
    return {};  // it is run anew, and its record replaced
  }
}

bool Store::has(const std::string& words) const {
  std::error_code none;
  return fs::exists(file_of(words), none);
}

void Store::keep(const std::string& words, const reports::Run& run) const {
  const std::string bytes = packed({build_, words, run.case_id, run.label(), reports::run_record(run)});
  reports::write_file(file_of(words),
                      fmt::format("{} {} {}\n", first_word_of_record, bytes.size(), digest_of(bytes)) + bytes);
}

void Store::copy(const fs::path& record) const {
  std::ifstream in(record, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in) throw std::runtime_error(record.string() + ": cannot be read");
  reports::write_file(folder_ / record.parent_path().filename() / record.filename(), bytes);
}

std::vector<StoredRun> Store::records() const {
  std::vector<StoredRun> all;
  for_each_file(folder_, [&](const fs::directory_entry& entry) {
    if (!is_record(entry)) return;
    StoredRun record;
    record.file = entry.path();
    record.key = entry.path().parent_path().filename().string() + entry.path().stem().string();
    std::error_code ignored;
    record.bytes = entry.file_size(ignored);
    try {
      const Payload payload = read_record(entry.path());
      record.build = payload.build;
      record.words = payload.words;
      record.case_id = payload.case_id;
      record.label = payload.label;
      if (digest_of(payload.build + '\n' + payload.words) != record.key)
        record.damage = "it stands under another name than its own";
      else
        reports::run_of_record(payload.run);
    } catch (const std::exception& problem) {
      record.damage = problem.what();
    }
    all.push_back(std::move(record));
  });
  std::sort(all.begin(), all.end(), [](const StoredRun& a, const StoredRun& b) { return a.file < b.file; });
  return all;
}

std::vector<fs::path> Store::left_behind() const {
  std::vector<fs::path> files;
  const auto before = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for_each_file(folder_, [&](const fs::directory_entry& entry) {
    std::error_code ignored;
    if (entry.path().extension() == ".tmp" && entry.last_write_time(ignored) < before) files.push_back(entry.path());
  });
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace diptych::runner
