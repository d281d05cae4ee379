#include "runner/run/measures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/input/messages.hpp"

namespace diptych::runner {

bool asks_for(const Case& c, const Leaf& leaf, const std::string& quantity) {
  return std::any_of(c.gates.begin(), c.gates.end(),
                     [&](const GateSpec& gate) { return gate.quantity == quantity && matches(gate.where, leaf); });
}

Books books_of(const Case& c, const Leaf& leaf, Books least) {
  if (!c.ledger) return Books::off;
  const bool asked = std::any_of(c.gates.begin(), c.gates.end(), [&](const GateSpec& gate) {
    const auto of = [&](const char* what) { return gate.quantity.starts_with(what); };
    return (of("energy.") || of("momentum.") || of("plastic.work") || of("stable")) && matches(gate.where, leaf);
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
    run.ledger.push_back({line.time, line.kinetic, line.strain, line.dissipated, line.viscous, line.contact,
                          line.scheme, line.work, line.lost, line.momentum, line.impulse});
  }
  run.finite = run.finite && sums.finite;
  if (!sums.finite || !(sums.held > 0)) return;  // where nothing moved there is no measure, and a gate on it is INVALID
  const auto relative = [](double value, double scale) { return scale > 0 ? value / scale : value; };
  run.measures["energy.drift"] = relative(sums.taken, sums.held);
  run.measures["energy.lost"] = relative(sums.last.contact + sums.last.scheme + sums.last.lost, sums.held);
  run.measures["energy.dissipated"] = relative(sums.last.dissipated, sums.held);
  run.measures["energy.closure"] = relative(sums.lost, sums.held);
  run.measures["energy.given-back"] = relative(sums.given_back, sums.held);
  run.measures["energy.excess"] = relative(sums.excess, sums.put_in);
  run.measures["momentum.drift"] = relative(sums.momentum, std::sqrt(2 * mass * sums.kinetic));
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
