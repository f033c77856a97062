#pragma once

#include "clients/cli/measurements/archive_source.hpp"
#include "clients/cli/measurements/measurement_input.hpp"

/// `dnc report ... --archive`: what retention moved into files, without a server. A file that is
/// not whole or was changed is refused before anything of it is printed.
namespace dripline::cli {

/// --archive and --sha256.
void add_archive_choice(Command command, ArchiveChoice& choice);

struct ArchivedReport {
  ArchiveChoice archive;
  std::string of;  ///< a run's id or its beginning, or a machine: what it printed outside runs
  bool is_raw = false;
};
/// The report lines, or the report as the server's JSON has it.
int show_archived_report(Context& context, const ArchivedReport& report);

/// The oldest (or newest) measurements of an archive, as the server lists its own.
int list_archived_measurements(Context& context, const MeasurementChoice& choice);

}  // namespace dripline::cli
