// What a table of a case file declares, as cases/gates.lock keeps it.
#pragma once

#include <map>
#include <string>

namespace diptych::runner {

/// A line for each value: the path to its key, "where.method" or "axes[0].cells", and the value as it is written there.
/// An entry of a list of tables goes by its id where it has one, "variant[heals].set.damage.heals", else by its place,
/// from 0. Prose is left out. The order of keys, spaces and comments do not matter to it.
using Declaration = std::map<std::string, std::string>;

/// All of it in one line: "kind="exact" max=0.2".
std::string words(const Declaration&);

}  // namespace diptych::runner
