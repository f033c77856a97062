#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "protocol/measurement/measurement.hpp"
#include "storage/page.hpp"

namespace dripline::storage {

/// A workpiece that was measured, by one template.
struct MeasuredPart {
  std::uint64_t id = 0;
  std::string machine;
  std::string run;      ///< empty: outside any run
  std::string program;  ///< its name then
  std::uint64_t revision = 0;
  std::string template_name;
  std::uint64_t template_version = 0;
  std::string number, serial;  ///< as reported
  std::uint64_t measurements = 0, findings = 0;
  measurement::Verdict verdict = measurement::Verdict::Unknown;  ///< of all so far
  UtcTime begun{};
  std::optional<UtcTime> ended = {};  ///< absent: lines may follow
  bool is_superseded = false;         ///< its records were derived again
};

/// A line that was not understood, or what is missing, doubled or out of order.
struct ReportFinding {
  std::uint64_t id = 0;
  std::string machine, run;
  std::uint64_t part_id = 0;  ///< 0: of none
  measurement::RecordKey record;
  UtcTime time{};
  std::string kind, text;
};

/// What follows from a piece of a machine's records.
struct DerivedBatch {
  std::string machine;
  std::uint64_t epoch = 0;
  std::uint64_t after = 0;          ///< the cursor it begins after
  std::uint64_t through = 0;        ///< the cursor it ends with
  std::string state;                ///< of the interpretation, after it
  std::vector<MeasuredPart> parts;  ///< new ones and changed ones; ids are given by the caller
  std::vector<measurement::Measurement> measurements;
  std::vector<ReportFinding> findings;
};

/// A journal of a machine of which records are not derived yet.
struct UnderivedRecords {
  std::string machine;
  std::uint64_t epoch = 0;
  std::uint64_t derived = 0, last = 0;
};

/// A place in a list of measurements: the one after which the next page begins.
struct MeasurementPlace {
  UtcTime time{};
  std::uint64_t id = 0;
};

/// Absent: any. Times: since is included, until is not.
struct MeasurementFilter {
  std::optional<std::string> machine = {}, run = {}, characteristic = {};
  std::optional<std::uint64_t> part_id = {};
  std::optional<UtcTime> since = {}, until = {};
  std::optional<measurement::Verdict> verdict = {};
  bool with_superseded = false;
};

/// How many parts of a run have each verdict, by its number; without superseded ones.
struct RunParts {
  std::array<std::uint64_t, 4> verdicts{};  ///< of all, the archived ones too
  std::uint64_t archived = 0;               ///< of them, those that are in archives alone
  std::vector<std::string> archives = {};   ///< that have them: their files, oldest first

  std::uint64_t all() const { return verdicts[0] + verdicts[1] + verdicts[2] + verdicts[3]; }
};

struct PartFilter {
  std::optional<std::string> machine = {}, run = {};
  std::optional<measurement::Verdict> verdict = {};
  bool with_superseded = false;
};

/// Measurements, parts and findings. Promises of every store: storage/store.hpp.
class MeasurementStore {
 public:
  virtual ~MeasurementStore() = default;

  /// In the order of machines and journals.
  virtual Result<std::vector<UnderivedRecords>> underived() = 0;
  /// Empty: none yet.
  virtual Result<std::string> state(const std::string& machine) = 0;
  /// Without moving a cursor. Errors: NotFound (the machine).
  virtual Result<void> save_state(const std::string& machine, const std::string& state) = 0;
  /// A part that is new gets this id, the next one this and 1, ...
  virtual Result<std::uint64_t> next_part_id() = 0;
  /// All or nothing. Survives a kill of the process; a power cut may take the last ones together
  /// with their cursor, and they are derived again. Errors: Conflict (the cursor is elsewhere, or a
  /// record was derived already), NotFound (the machine).
  virtual Result<void> commit(const DerivedBatch& batch) = 0;
  /// The parts of a run, as another template version makes them: what was there is kept, marked as
  /// superseded. Cursor and state are not touched. Errors: NotFound, Conflict.
  virtual Result<void> replace(const std::string& run, const DerivedBatch& batch) = 0;

  /// Of a run or part in the order of their records; otherwise by time. `limit` rows after `after`.
  virtual Result<std::vector<measurement::Measurement>> list(
      const MeasurementFilter& filter, const std::optional<MeasurementPlace>& after,
      std::uint64_t limit) = 0;
  /// The same, newest first, before `before`.
  virtual Result<std::vector<measurement::Measurement>> list_newest(
      const MeasurementFilter& filter, const std::optional<MeasurementPlace>& before,
      std::uint64_t limit) = 0;
  /// Newest first.
  virtual Result<std::vector<MeasuredPart>> parts(const PartFilter& filter, Page page) = 0;
  /// Errors: NotFound.
  virtual Result<MeasuredPart> part(std::uint64_t id) = 0;
  virtual Result<RunParts> parts_of_run(const std::string& run) = 0;
  /// In their order.
  virtual Result<std::vector<ReportFinding>> findings(const PartFilter& filter, Page page) = 0;
  /// Names of what was measured; of a machine, or of all.
  virtual Result<std::vector<std::string>> characteristics(
      const std::optional<std::string>& machine) = 0;
};

}  // namespace dripline::storage
