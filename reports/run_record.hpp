// A run as bytes: what a store keeps of it and gives back, to the last bit.
#pragma once

#include <string>

#include "reports/results.hpp"

namespace diptych::reports {

/// All of a run, in little-endian order.
std::string run_record(const Run&);
/// The run of which these are the bytes. Throws std::runtime_error where they are not the whole of one.
Run run_of_record(const std::string& bytes);

}  // namespace diptych::reports
