// Convergence tables as text, CSV and LaTeX: cost beside error, order, prediction and ratio.
#pragma once

#include <string>

#include "reports/order_fit.hpp"
#include "reports/results.hpp"

namespace diptych::reports {

/// Aligned text of at most 150 columns for the terminal: for each method, particle layout and Courant number first
/// the cost of every mesh, then for each time and field the errors, their orders, predictions and ratios.
std::string text_table(const Case&);
/// One row per run, time and field, one header line with units in the names; numbers round-trip, RFC 4180 quoting
/// with LF. A run without numbers has one row with its status and message.
std::string csv_table(const Case&);
/// The same tables as in the text, as a fragment to \input into a document that loads booktabs.
std::string latex_table(const Case&);

/// One line a step: energies, work, loss, momentum, impulse [case units].
std::string ledger_csv(const Run&);

}  // namespace diptych::reports
