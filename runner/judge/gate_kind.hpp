// What a kind of gate is made of. Each kind stands in a file of its own here and has a row in gate_kinds.cpp; nothing
// else decides by a kind's name.
#pragma once

#include <string>
#include <vector>

#include "reports/results.hpp"
#include "runner/input/case.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/messages.hpp"
#include "runner/registry.hpp"

namespace diptych::runner {

class Table;
struct Place;

/// A run that a gate speaks of, with where it stands in the case's sweep.
struct JudgedRun {
  const reports::Run* run;
  Leaf leaf;
};

/// What a gate holds its runs against: the keys that its kind alone has, and the judging by them.
struct Criterion {
  Criterion() = default;
  Criterion(const Criterion&) = default;
  Criterion& operator=(const Criterion&) = default;
  virtual ~Criterion() = default;

  /// Fills in the formula and holds each number by a check. Throws Stop (judging.hpp) where it cannot be judged; a gate
  /// without a check is INVALID.
  virtual void judge(const Case&, const GateSpec&, const std::vector<JudgedRun>&, reports::Gate&) const = 0;
  /// Bounds numbers one by one, so that the gate has failed as soon as one run fails it.
  virtual bool of_single_numbers() const { return false; }
  /// Sees a wrong solution that converges as the right one would.
  virtual bool sees_wrong_solutions() const { return false; }
};

/// A key of [[gate]] that a kind has beside those of all gates.
struct GateKey {
  std::string name;
  Names of = {};  ///< with quantities that begin so; none: with all
};

struct GateKind {
  enum class Scenes { all, plates };

  std::string id;    ///< as case files name it
  std::string says;  ///< what it judges, in a line for people
  Scenes scenes = Scenes::all;
  std::vector<GateKey> keys;         ///< `times` is read for those that have it
  Names (*quantities)(const Case&);  ///< that it can judge in this case
  /// Reads the keys (those above alone), checks them against the case and fills in the criterion. Id, quantity, where
  /// and times are read already.
  void (*read)(Table&, const Case&, GateSpec&);
  /// What only all gates of the case tell; mistakes are said at the place. Null where there is nothing.
  void (*check_all)(const Place& gates, const Case&) = nullptr;

  bool takes(const Case&) const;
  bool has(const std::string& key, const std::string& quantity) const;
};

/// Those that take the scene, in the order of the table.
std::vector<const GateKind*> gate_kinds(const Case&);
/// The kind of this id. Throws std::invalid_argument where there is none.
const GateKind& gate_kind(const std::string& id);

Registry<GateKind>& all_gate_kinds();
using AddedGateKind = Added<GateKind, all_gate_kinds>;

}  // namespace diptych::runner
