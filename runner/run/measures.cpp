#include "runner/run/measures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runner/compare/quantities.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {

bool takes_runs(const std::string& quantity) {
  return quantity.starts_with("bits.") || quantity.starts_with("cross.") || quantity == "critical_courant";
}

bool asks_for(const Case& c, const Leaf& leaf, const std::string& quantity) {
  if (!takes_runs(quantity)) throw std::logic_error("asks_for: " + quantity + " takes no runs of its own");
  return std::any_of(c.gates.begin(), c.gates.end(),
                     [&](const GateSpec& gate) { return gate.quantity == quantity && matches(gate.where, leaf); });
}

Books books_of(const Case& c, const Leaf& leaf, Books least) {
  if (!c.ledger) return Books::off;
  const bool asked = std::any_of(c.gates.begin(), c.gates.end(), [&](const GateSpec& gate) {
    const Quantity* quantity = find_quantity(gate.quantity, c);
    return quantity && quantity->of_books && matches(gate.where, leaf);
  });
  const bool shown = std::any_of(c.figures.begin(), c.figures.end(), [&](const FigureSpec& figure) {
    return figure.recorded.energy && figure.cells == leaf.cells;
  });
  return asked || shown ? std::max(least, Books::sums) : least;
}

std::string status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::completed: return "completed";
    case Outcome::unstable: return "unstable";
    case Outcome::left_grid: return "left-grid";
    case Outcome::cancelled: return "cancelled";
  }
  return "error";
}

void measure_ledger(double mass, const LedgerSums& sums, const std::vector<LedgerLine>& lines, reports::Run& run) {
  for (const LedgerLine& line : lines) {
    run.ledger.push_back({.time = line.time,
                          .kinetic = line.kinetic,
                          .strain = line.strain,
                          .dissipated = line.dissipated,
                          .viscous = line.viscous,
                          .contact = line.contact,
                          .scheme = line.scheme,
                          .work = line.work,
                          .lost = line.lost,
                          .momentum = line.momentum,
                          .impulse = line.impulse});
  }
  run.finite = run.finite && sums.finite;
  if (!sums.finite || !(sums.held > 0)) return;  // where nothing moved there is no measure, and a gate on it is INVALID
  for (const Quantity& quantity : quantities())
    if (quantity.from_books) run.measures[quantity.name] = quantity.from_books(sums, mass);
}

double bisect_limit(const std::function<bool(double courant)>& stable, double predicted) {
  double low = predicted / 2, high = predicted * 2;
  for (int wider = 0; wider < 6 && !stable(low); ++wider) low /= 2;
  for (int wider = 0; wider < 6 && stable(high); ++wider) high *= 2;
  if (!stable(low) || stable(high)) return std::nan("");
  while (high - low > 1e-3 * high) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

std::string why_invalid(const Case& c, const std::vector<std::string>& active, const std::vector<std::string>& declared,
                        const reports::Run& run) {
  if (!run.finite) return "a number is not finite";
  if (active != declared) {
    return fmt::format("active features [{}] are not the declared [{}]", listed(active), listed(declared));
  }
  if (run.samples.size() != c.times.size()) {
    return fmt::format("{} of {} sample times were reached", run.samples.size(), c.times.size());
  }
  for (const auto& sample : run.samples) {
    for (const auto& e : sample.errors) {
      if (!(std::isfinite(e.l1) && std::isfinite(e.l2) && std::isfinite(e.linf))) return "an error norm is not finite";
      const double slack = 1 + 1e-9;
      if (e.l1 > e.l2 * slack || e.l2 > e.linf * slack) {
        return fmt::format("L1 ≤ L2 ≤ L∞ is violated: {} {} {}", e.l1, e.l2, e.linf);
      }
    }
  }
  return {};
}

}  // namespace diptych::runner
