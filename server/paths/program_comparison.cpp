#include "clients/tools/comparison/program_comparison.hpp"

#include <chrono>

#include <nlohmann/json.hpp>

#include "gateway/interpreter/registry.hpp"
#include "server/machines/stored_programs.hpp"
#include "server/paths/impl/interpretation.hpp"
#include "server/paths/program_paths.hpp"

namespace dripline::paths {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxLines = 5000;
constexpr std::size_t kMaxPlaces = 1000;
/// Some 13 MB for both programs.
constexpr std::size_t kMaxWindow = 16'384;

/// A revision with what its comparison needs; stays where it is.
struct Compared {
  Compared(const machines::RunSources& sources, const storage::Revision& revision,
           const std::string& machine)
      : run(interpreted_run(sources, revision, machine)), source(sources, run) {}

  storage::Run run;
  machines::StoredPrograms source;
};

/// Text is compared whatever the control is.
Result<comparison::ProgramSide> side_of(const machines::RunSources& sources, Compared& compared,
                                        CompareBy by) {
  comparison::ProgramSide side{.source = compared.source, .size = compared.run.size};
  const auto dialect = interpreter::find_dialect(compared.run.control);
  if (!dialect && by == CompareBy::Text) return side;
  if (!dialect) return fail(Errc::Unsupported, "{}", dialect.error().what);
  side.dialect = *dialect;
  if (by != CompareBy::Motion) return side;
  auto setup = interpretation_setup(sources, compared.run.machine, **dialect);
  if (!setup) return fail(setup.error());
  side.setup = *std::move(setup);
  return side;
}

json revision_json(const storage::Revision& revision) {
  return {
      {"program", revision.program}, {"revision", revision.number}, {"control", revision.control}};
}

comparison::ProgramOptions options_of(const ComparisonRequest& request) {
  using By = comparison::ProgramOptions::By;
  comparison::ProgramOptions options;
  options.by = request.by == CompareBy::Motion       ? By::Motion
               : request.by == CompareBy::Normalized ? By::Normalized
                                                     : By::Text;
  options.motion = {.tolerance = request.tolerance,
                    .max_places = kMaxPlaces,
                    .max_blocks = kLimits.max_blocks,
                    .max_repeated_blocks = kLimits.max_repeated_blocks,
                    .max_window = kMaxWindow};
  options.context = request.context;
  options.max_lines = kMaxLines;
  options.is_to_stop = [end = std::chrono::steady_clock::now() + ProgramPaths::kMaxComparison,
                        stop = request.stop] {
    return stop.stop_requested() || std::chrono::steady_clock::now() >= end;
  };
  return options;
}

}  // namespace

Result<std::string> ProgramPaths::compare(const ComparisonRequest& request) {
  const auto seat = Seat::take(readers_, kMaxReaders);
  if (!seat) {
    return fail(Errc::Busy, "{} programs are being interpreted: the limit; try again", kMaxReaders);
  }
  Compared first(sources_, request.first, request.machine);
  Compared second(sources_, request.second, request.machine);
  const auto first_side = side_of(sources_, first, request.by);
  if (!first_side) return fail(first_side.error());
  const auto second_side = side_of(sources_, second, request.by);
  if (!second_side) return fail(second_side.error());
  auto result = comparison::compare_programs(*first_side, *second_side, options_of(request));
  if (!result) return fail(result.error());
  (*result)["first"] = revision_json(request.first);
  (*result)["second"] = revision_json(request.second);
  (*result)["machine"] = request.machine.empty() ? json(nullptr) : json(request.machine);
  return result->dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace dripline::paths
