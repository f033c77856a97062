#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc server archive`, `archives`.
void add_archive_commands(Command server, Context& context);

/// Every row of an archive, in order. Gives the exit status; 0 only when the file is whole and
/// unchanged.
int read_archive(const std::string& file, const std::string& kind,
                 const std::function<void(const nlohmann::ordered_json&)>& take);

/// The report lines of a run in an archive of records.
int show_archived_report(Context& context, const std::string& file, const std::string& run);

struct ArchivedChoice {
  std::string run, machine, characteristic, verdict;
};
/// Measurements in an archive, as JSON Lines with --json.
int show_archived_measurements(Context& context, const std::string& file,
                               const ArchivedChoice& choice);

}  // namespace dripline::cli
