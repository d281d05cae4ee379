// Results on disk: never half-written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/results.hpp"

namespace diptych::reports {

/// Writes to a temporary file beside `path`, flushes, checks and renames. Throws std::runtime_error with the path and
/// the system's reason (disk full, no permission) and leaves nothing behind; a file that was there before survives.
/// Creates missing folders. A device or pipe such as /dev/stdout is written to directly.
void write_file(const std::filesystem::path& path, const std::string& content);

/// One JSON object a line: one per run, one per gate, each with the provenance's commit, compiler, flags and CPU.
/// A number that is not finite is written as null, and the object it is in and all objects around that one say
/// "finite": false. Curves are left out.
std::string results_jsonl(const std::vector<Case>&, const Provenance&);

/// JUnit XML: one test case per gate, classname the case. FAIL is a failure; UNSTABLE, ERROR and INVALID are errors;
/// both carry the message and the checks.
std::string junit_xml(const std::vector<Case>&);

}  // namespace diptych::reports
