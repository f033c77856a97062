#include <array>
#include <chrono>
#include <map>
#include <tuple>

#include <nlohmann/json.hpp>

#include "clients/tools/offline/check_summary.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/registry.hpp"
#include "server/machines/stored_programs.hpp"
#include "server/paths/impl/interpretation.hpp"
#include "server/paths/program_paths.hpp"

namespace dripline::paths {
namespace {

using interpreter::Diagnostic;
using interpreter::Origin;
using nlohmann::json;

/// Warnings and the alarm, each once for its place, however often that is executed: a loop must not
/// hide what is after it. Bounded.
class Findings final : public interpreter::EventSink {
 public:
  struct Finding {
    bool is_alarm = false;
    Diagnostic diagnostic;
    Origin origin;  ///< when it was met first
    std::uint64_t times = 1;
  };
  static constexpr std::size_t kMax = 1000;

  const std::vector<Finding>& all() const { return all_; }
  bool is_complete() const { return is_complete_; }

  void on_warning(const interpreter::Warning& event) override {
    if (Finding* known = find(event.origin, event.diagnostic); known != nullptr) ++known->times;
  }
  /// It is the last one, and listed whatever was before.
  void on_alarm(const interpreter::Alarm& event) override {
    all_.push_back({.is_alarm = true, .diagnostic = event.diagnostic, .origin = event.origin});
  }

 private:
  /// nullptr: it is new, and has been added if there was room.
  Finding* find(const Origin& origin, const Diagnostic& diagnostic) {
    const Place place{origin.program, diagnostic.line, diagnostic.column, diagnostic.id};
    const auto known = places_.find(place);
    if (known != places_.end()) return &all_[known->second];
    is_complete_ = is_complete_ && all_.size() < kMax;
    if (!is_complete_) return nullptr;
    places_.emplace(place, all_.size());
    all_.push_back({.diagnostic = diagnostic, .origin = origin});
    return nullptr;
  }

  using Place = std::tuple<interpreter::ProgramIndex, std::uint64_t, std::uint32_t,
                           std::string_view>;  ///< program, line, column, id
  std::vector<Finding> all_;
  std::map<Place, std::size_t> places_;
  bool is_complete_ = true;
};

/// How a check came to its end.
enum class Outcome { Ended, Alarm, Fault, Time };

std::string_view word_of(Outcome outcome) {
  constexpr std::array<std::string_view, 4> kWords{"ended", "alarm", "fault", "time"};
  return kWords[static_cast<std::size_t>(outcome)];
}

struct Checked {
  Outcome outcome = Outcome::Ended;
  std::string fault;  ///< why it was stopped that is no alarm of the control
};

Checked run_to_end(interpreter::OfflineRun& run, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  for (;;) {
    const auto is_over = run.step(kStepBlocks);
    if (!is_over) return {Outcome::Fault, is_over.error().what};
    if (*is_over) return {run.outcome().ended ? Outcome::Ended : Outcome::Alarm, {}};
    if (std::chrono::steady_clock::now() >= end) return {Outcome::Time, {}};
  }
}

json finding_json(const Findings::Finding& found, const machines::StoredPrograms& programs) {
  const std::string& program = programs.name_of(found.origin.program);
  const auto& [is_alarm, diagnostic, origin, times] = found;
  return {{"severity", is_alarm ? "alarm" : "warning"},
          {"id", std::string(diagnostic.id)},
          {"text", diagnostic.text},
          {"program", program.empty() ? json(nullptr) : json(program)},
          {"line", diagnostic.line},
          {"column", diagnostic.column},
          {"offset", origin.offset},
          {"times", times}};
}

json findings_json(const Findings& findings, const machines::StoredPrograms& programs) {
  auto list = json::array();
  for (const auto& found : findings.all()) list.push_back(finding_json(found, programs));
  return list;
}

}  // namespace

Result<std::string> ProgramPaths::check(const CheckRequest& request) {
  const storage::Revision& revision = request.revision;
  const auto dialect = interpreter::find_dialect(revision.control);
  if (!dialect) return fail(Errc::Unsupported, "{}", dialect.error().what);
  const auto setup = interpretation_setup(sources_, request.machine, **dialect);
  if (!setup) return fail(setup.error());
  const auto seat = Seat::take(readers_, kMaxReaders);
  if (!seat) {
    return fail(Errc::Busy, "{} programs are being interpreted: the limit; try again", kMaxReaders);
  }
  const storage::Run as_run = interpreted_run(sources_, revision, request.machine);
  machines::StoredPrograms programs(sources_, as_run);
  interpreter::CheckSummary sums(setup->start);
  Findings findings;
  interpreter::EventTee both(sums, findings);
  interpreter::OfflineLimits limits = kLimits;
  limits.reads_on = true;
  auto run = interpreter::OfflineRun::begin(**dialect, *setup, programs, both, limits);
  if (!run) return fail(run.error());
  const Checked checked = run_to_end(*run, request.limit);
  const interpreter::Summary& summary = sums.summary();
  const json result{{"program", revision.program},
                    {"revision", revision.number},
                    {"control", revision.control},
                    {"machine", request.machine.empty() ? json(nullptr) : json(request.machine)},
                    {"outcome", word_of(checked.outcome)},
                    {"fault", checked.fault.empty() ? json(nullptr) : json(checked.fault)},
                    {"blocks", summary.blocks},
                    {"moves", summary.moves},
                    {"seconds", summary.seconds},
                    {"rapid_mm", summary.rapid_length.mm()},
                    {"feed_mm", summary.feed_length.mm()},
                    {"inch", summary.units == interpreter::Units::Inch},
                    {"x_is_diameter", summary.x_is_diameter},
                    {"extents", extents_json(summary)},
                    {"warnings", summary.warning_count},
                    {"diagnostics", findings_json(findings, programs)},
                    {"complete", findings.is_complete()}};
  return result.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace dripline::paths
