// What gates can judge: one row a quantity. Its name, its unit, the scenes that have it and what a case must hold for
// it stand here, and how it is made where the books of a run alone make it.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "hinge/step/record.hpp"
#include "runner/input/case.hpp"
#include "runner/input/toml_table.hpp"

namespace diptych::runner {

struct Quantity {
  enum class Scenes { bars, plates, both };
  /// What sort of number it is: kinds of gates take some sorts, see judge/.
  enum class Sort {
    error_norm,     ///< of a field less the exact solution's, at each sample time, in units of the field's scale
    probe,          ///< at each sample time
    outcome,        ///< of an impact or of yielding, once a run, which an exact solution knows, too
    outcome_error,  ///< what such a one differs by from the exact value
    distance,       ///< of two methods
    history,        ///< of a gauge
    gauge_reading,  ///< what a gauge's history says, which theory predicts
    failure,        ///< what the gauges together say of a failure wave
    invariant,      ///< once a run, and nothing where all is well
    limit,          ///< of what stays bounded
  };
  /// What a case lacks for it: "found NAME" goes on with `found`; and what is allowed.
  struct Lack {
    std::string found, allowed;
  };
  using Need = std::optional<Lack> (*)(const std::string& name, const Case&);

  std::string name;  ///< "energy.drift"; ID stands for each probe or gauge of the case: "probe.ID", "gauge.ID.xx"
  std::string unit;  ///< "" for parts and counts, "of the probe" for what a probe reads
  Sort sort;
  Scenes scenes;
  std::vector<Need> needs = {};
  bool of_books = false;  ///< the sums of the run's books are kept for it
  /// Its value where the books make it; `mass` [kg] of all bodies.
  double (*from_books)(const LedgerSums&, double mass) = nullptr;
};

const std::vector<Quantity>& quantities();
/// Names of these sorts as the gates of this case write them, in the order of the table.
Names quantity_names(const Case&, std::initializer_list<Quantity::Sort>);
/// The row of a quantity that a gate of this case names, or nothing.
const Quantity* find_quantity(const std::string& name, const Case&);
/// Notes what the case lacks for the quantity.
void check_quantity(const Place&, const std::string& name, const Case&);

}  // namespace diptych::runner
