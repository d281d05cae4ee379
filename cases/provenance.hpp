// What made the results, and where the program finds its cases.
#pragma once

#include <filesystem>

#include "reports/results.hpp"

namespace diptych::cases {

reports::Provenance provenance();
std::filesystem::path source_directory();  ///< of the checkout this program was built from
std::filesystem::path build_directory();

}  // namespace diptych::cases
