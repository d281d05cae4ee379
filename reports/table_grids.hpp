// The tables of a case, before they are text or LaTeX, and what all tables read from its runs. For reports/ alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/field_norms.hpp"
#include "reports/results.hpp"

namespace diptych::reports {

/// Runs that differ in the mesh alone, coarse to fine.
struct Group {
  std::vector<const Run*> runs;
  const Run& first() const { return *runs.front(); }
};

std::vector<Group> groups(const Case&);

bool has_numbers(const Run&);
std::vector<double> times(const Group&);
std::vector<std::string> fields(const Group&, double asked);  ///< compared at a time, in the order of first mention
/// Null where the run has none.
const FieldError* error_of(const Run&, double asked, const std::string& field);
/// Order between two neighbouring meshes: nothing where there is none (first row, zero error, same h), NaN where an
/// error is not finite.
std::optional<double> pair_order(const Run* coarse, const FieldError* coarse_error, const Run& fine,
                                 const FieldError& fine_error, const Norm&);
/// Unit of a quantity in the case's system. Cases in the paper's own units have no names for them.
std::string unit(const Case&, const std::string& quantity);

struct Row {
  std::vector<std::string> cells;
  std::string remark;  ///< stands in place of the cells after the first two
};

struct Grid {
  std::string title;
  std::vector<std::string> heads;
  std::vector<Row> rows;
  std::string foot;
};

std::string group_title(const Group&);
Grid cost_grid(const Case&, const Group&);
Grid error_grid(const Case&, const Group&, double asked, const std::string& field);
/// What a run's books and probes say, where it has any: all there is to see of a case without an exact solution.
Grid books_grid(const Case&, const Group&);
/// What came of an impact, measured / exact: empty where no bars met and nothing yielded.
Grid outcome_grid(const Case&, const Group&);

}  // namespace diptych::reports
