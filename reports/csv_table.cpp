#include <fmt/core.h>

#include "reports/csv.hpp"
#include "reports/table_grids.hpp"
#include "reports/tables.hpp"

namespace diptych::reports {
namespace {

std::string number(double value) { return csv_number(value); }
std::string number(const std::optional<double>& value) { return value ? csv_number(*value) : ""; }

}  // namespace

std::string csv_table(const Case& data) {
  const std::string length = "[" + unit(data, "length") + "]", time = "[" + data.time_unit + "]";
  const std::string seconds = data.units == "SI" ? "[s]" : "[" + data.units + " units]";
  std::string out = csv_line({"case",
                              "method",
                              "particles",
                              "parameters",
                              "cells",
                              "h " + length,
                              "unknowns",
                              "courant asked [-]",
                              "courant used [-]",
                              "time step " + seconds,
                              "time step limit " + seconds,
                              "steps",
                              "element steps",
                              "particle steps",
                              "node steps",
                              "bytes [B]",
                              "wall time [s]",
                              "status",
                              "message",
                              "time asked [" + data.time_unit + "]",
                              "time reached " + time,
                              "field",
                              "field time " + time,
                              "scale",
                              "scale unit",
                              "L1 [-]",
                              "L1 order [-]",
                              "L1 predicted [-]",
                              "L1 ratio [-]",
                              "L2 [-]",
                              "L2 order [-]",
                              "L2 predicted [-]",
                              "L2 ratio [-]",
                              "Linf [-]",
                              "Linf order [-]",
                              "Linf predicted [-]",
                              "Linf ratio [-]"});
  const std::size_t error_columns = 18;  // from "time asked" on

  for (const Group& group : groups(data)) {
    const Run* coarse = nullptr;
    for (const Run* run : group.runs) {
      const bool judged = has_numbers(*run);
      const std::string status = run->status == "completed" && !judged ? "invalid" : run->status;
      const std::string message = run->invalid.empty() || !run->message.empty() ? run->message : run->invalid;
      const std::vector<std::string> about{data.id,
                                           run->method,
                                           run->particles,
                                           run->parameters,
                                           std::to_string(run->cells),
                                           number(run->cell_size),
                                           std::to_string(run->unknowns),
                                           number(run->courant_asked),
                                           number(run->courant),
                                           number(run->time_step),
                                           number(run->time_step_limit),
                                           std::to_string(run->steps),
                                           std::to_string(run->element_steps),
                                           std::to_string(run->particle_steps),
                                           std::to_string(run->node_steps),
                                           std::to_string(run->bytes),
                                           number(run->wall_seconds),
                                           status,
                                           message};
      bool written = false;
      for (const Sample& sample : run->samples) {
        if (!judged) break;
        for (const FieldError& error : sample.errors) {
          std::vector<std::string> cells = about;
          cells.insert(cells.end(), {number(sample.asked), number(sample.time), error.field, number(error.time),
                                     number(error.scale), unit(data, error.field)});
          const FieldError* before = coarse == nullptr ? nullptr : error_of(*coarse, sample.asked, error.field);
          for (const Norm& norm : norms) {
            const double measured = error.*norm.measured;
            const std::optional<double>& expected = error.*norm.predicted;
            cells.insert(cells.end(), {number(measured), number(pair_order(coarse, before, *run, error, norm)),
                                       number(expected), expected ? number(measured / *expected) : ""});
          }
          out += csv_line(cells);
          written = true;
        }
      }
      if (!written) {
        std::vector<std::string> cells = about;
        cells.resize(about.size() + error_columns);
        out += csv_line(cells);
      }
      coarse = run;
    }
  }
  return out;
}

std::string ledger_csv(const Run& run) {
  std::string out = "time,kinetic,strain,dissipated,viscous,contact,scheme,work,lost,momentum,impulse\n";
  for (const LedgerLine& line : run.ledger) {
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", line.time, line.kinetic, line.strain, line.dissipated,
                       line.viscous, line.contact, line.scheme, line.work, line.lost, line.momentum, line.impulse);
  }
  return out;
}

}  // namespace diptych::reports
