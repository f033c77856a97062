#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clients/cli/context.hpp"
#include "clients/cli/measurements/archive_source.hpp"
#include "clients/tools/measurement_files/source.hpp"

namespace dripline::cli {

/// Which measurements a command is for: those of a file, or the server's.
struct MeasurementChoice {
  /// CSV, JSON Lines; by its suffix AQDEF (.dfq) or an archive (.jsonl.zst); empty: the server's
  std::string file;
  client::MeasurementQuery query;
  std::string tool;
  ArchiveChoice archive = {};  ///< with a file: its measurements
};

/// --machine, --run, --characteristic, --tool, --since, --until.
void add_measurement_choice(Command command, MeasurementChoice& choice);

/// Null: it has complained and set the status. The server's measurements are first copied into a
/// file without a name, so that every pass sees the same ones.
std::unique_ptr<measurement_files::MeasurementSource> open_measurements(
    Context& context, const MeasurementChoice& choice);

/// All of them in memory. Errors: LimitExceeded (over kMaxInMemory), those of the source.
Result<std::vector<measurement::Measurement>> all_measurements(
    measurement_files::MeasurementSource& source);
inline constexpr std::size_t kMaxInMemory = 2'000'000;

/// `path` ends with the suffix, in either case.
bool has_suffix(std::string_view path, std::string_view suffix);

}  // namespace dripline::cli
