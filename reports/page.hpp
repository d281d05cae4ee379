// A page as a file: readable without script, well-formed XML.
#pragma once

#include <filesystem>
#include <string>

#include "reports/page_results.hpp"

namespace diptych::reports {

/// The page as XHTML. Throws std::invalid_argument for a row whose values do not fit its section's columns and for a
/// picture that is not a relative path.
std::string page_html(const Page&);

/// Writes it as write_file does.
void write_page(const Page&, const std::filesystem::path& path);

}  // namespace diptych::reports
