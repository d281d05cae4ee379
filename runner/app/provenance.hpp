// What made the results, and where the program finds its cases.
#pragma once

#include <filesystem>

#include "reports/results.hpp"

namespace diptych::runner {

reports::Provenance provenance();
std::filesystem::path source_directory();  ///< of the checkout this program was built from
std::filesystem::path build_directory();

}  // namespace diptych::runner
