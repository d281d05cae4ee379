// Which cases there are, and which of them the user means.
#pragma once

#include <string>
#include <vector>

#include "runner/input/case.hpp"

namespace diptych::runner {

/// Every case file that comes with the program, by id. Throws InputError where one is wrong or two share an id.
std::vector<Case> all_cases();

/// Cases by path, by id or by a glob over ids; all of them for an empty list. A selector may end in "/GATE": then only
/// that gate is kept. Throws InputError where a selector fits nothing, with the nearest id.
std::vector<Case> select_cases(const std::vector<std::string>& selectors);

/// The one case that the selectors mean. Throws InputError where they mean none or several.
Case select_one_case(const std::vector<std::string>& selectors);

/// Keeps of each case the runs whose label, "mpm-musl N=200 C=0.5 ppc=1", is one of `labels` or fits one that is a
/// pattern, and only cases that have some. Throws InputError where one fits no run, with the nearest that there are.
void keep_runs(std::vector<Case>&, const std::vector<std::string>& labels);

/// The content of cases/gates.lock: "[case]" and below it the keys of its scene, "[case/gate]" and below it the gate's,
/// a line each, sorted. A gate is loosened by a wider tolerance, and as well by fewer meshes or methods.
std::string declarations(const std::vector<Case>&);
/// How these cases and their gates differ from cases/gates.lock, one line a key, and what of it cannot be read; empty
/// where they agree. Cases that do not come with the program are not in the lock. With `whole`, gates in the lock that
/// no case declares are named too.
std::vector<std::string> differences_from_lock(const std::vector<Case>&, bool whole);

}  // namespace diptych::runner
