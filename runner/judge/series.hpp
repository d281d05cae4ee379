// Runs of a method from mesh to mesh, and what is read of them.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "runner/compare/uncertainty.hpp"
#include "runner/judge/gate_kind.hpp"

namespace diptych::runner {

/// Runs of one method from the coarsest mesh to the finest.
using Series = std::vector<const reports::Run*>;

/// By method. Throws Stop where a run cannot be judged.
std::map<std::string, Series> by_method(const std::vector<JudgedRun>&);
/// Two methods on the same meshes, at least so many. Throws Stop where they are not.
std::array<Series, 2> both_methods(const std::vector<JudgedRun>&, std::size_t least);

/// The probe of this id at an asked time. Throws Stop where the run has none.
double probe_of(const reports::Run&, double time, const std::string& id);
const reports::Sample& sample_at(const reports::Run&, double time);
/// "platen.history" or "gauge.ID.xx", ".yy" or ".dilatancy". Throws Stop where the run has none.
History history_of(const reports::Run&, const std::string& quantity);

}  // namespace diptych::runner
