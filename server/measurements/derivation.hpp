#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "clients/tools/report_template/report_interpreter.hpp"
#include "server/measurements/template_cache.hpp"
#include "storage/measurement_store.hpp"
#include "storage/record_store.hpp"

namespace dripline::measurements {

/// What a verdict causes, besides being known.
struct DueAction {
  std::uint64_t part = 0;
  report_template::Action action = report_template::Action::None;
  friend bool operator==(const DueAction&, const DueAction&) = default;
};

/// One template at work on a machine's lines.
struct Session {
  explicit Session(UsedTemplate one, report_template::ReportState state = {})
      : used(std::move(one)), interpreter(used.content, std::move(state)) {}

  UsedTemplate used;
  report_template::ReportInterpreter interpreter;
  storage::MeasuredPart part;                                   ///< id 0: none is open
  std::uint64_t unmatched = 0;                                  ///< lines in the open part
  measurement::Verdict announced = measurement::Verdict::Good;  ///< of the open part
};

/// Everything that the derivation of a machine's records depends on besides the records.
struct MachineState {
  std::string run, program;
  std::uint64_t revision = 0;
  bool is_foreign = false;  ///< the run is another machine's: nothing is derived of it
  std::vector<Session> sessions;
  std::vector<DueAction> due;  ///< not carried out yet
};

std::string to_json(const MachineState& state);
/// `find` gives a template by name and version. Errors: Corrupt, those of `find`.
Result<MachineState> parse_machine_state(
    const std::string& json,
    const std::function<Result<UsedTemplate>(const std::string&, std::uint64_t)>& find);

/// A part whose verdict is news: outside its limits, or final.
struct Judged {
  storage::MeasuredPart part;
  report_template::Action action = report_template::Action::None;
};

struct RunFacts {
  std::string machine, program;
  std::uint64_t revision = 0;
  storage::RunState state = storage::RunState::Active;
};

/// Records of one machine, in their order, to what is stored of them. Deterministic.
class Derivation {
 public:
  struct Sources {
    /// nullopt: the server does not know the run.
    std::function<Result<std::optional<RunFacts>>(const std::string& run)> run;
    std::function<Result<std::vector<UsedTemplate>>(const std::string& machine,
                                                    const std::string& program)>
        templates;
  };
  Derivation(std::string machine, MachineState state, Sources sources, std::uint64_t next_part_id);

  /// Templates that were assigned since apply outside runs at once, to a run from its beginning
  /// only: a run has one version of each. Errors: those of the sources; then it is not to be used
  /// further.
  Result<void> begin();
  Result<void> take(const storage::Record& record);
  /// The run's parts are over: whole only if it completed. Errors: those of the sources.
  Result<void> end_parts(const storage::Record& record);

  const MachineState& state() const { return state_; }
  std::uint64_t next_part_id() const { return next_part_id_; }
  /// What came since the beginning: parts, measurements, findings; not the cursor.
  const storage::DerivedBatch& batch() const { return batch_; }
  const std::vector<Judged>& judged() const { return judged_; }

 private:
  Result<void> enter_run(const storage::Record& record);
  /// How the run ended; empty: it completed, or the lines are of no run that the server knows.
  Result<std::string> cut_of_run() const;
  Result<std::vector<UsedTemplate>> templates();
  void take_line(const storage::Record& record);
  void take_cut(const storage::Record& record, const report_template::ReportLine& line);
  void apply(Session& session, const storage::Record& record,
             const std::vector<report_template::ReportEvent>& events);
  void begin_part(Session& session, const storage::Record& record);
  void end_part(Session& session, const storage::Record& record,
                const report_template::PartSummary& summary);
  void add(Session& session, const storage::Record& record, const report_template::Value& value);
  void add(const Session* session, const storage::Record& record,
           const report_template::Finding& finding);
  void update_part(Session& session, const report_template::PartSummary& summary);
  void announce(Session& session, bool is_final);
  void save_part(const storage::MeasuredPart& part);

  const std::string machine_;
  MachineState state_;
  const Sources sources_;
  std::uint64_t next_part_id_;
  std::uint32_t item_ = 0;  ///< of the record
  storage::DerivedBatch batch_;
  std::vector<Judged> judged_;
};

}  // namespace dripline::measurements
