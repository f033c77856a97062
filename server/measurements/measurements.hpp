#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/measurements/derivation.hpp"
#include "storage/store.hpp"

namespace dripline::measurements {

/// Derives measurements from stored records, in the background: each record once, in order. The
/// cursor moves in the transaction that stores what was derived, so a kill repeats nothing and
/// loses nothing. Any thread; all of it must outlive the object.
class Measurements {
 public:
  /// Carries out what a verdict causes. May wait some seconds.
  /// At least once for each verdict that asks for it, over kills.
  using Hold =
      std::function<Result<void>(const storage::MeasuredPart& part, const std::string& reason)>;

  struct Parts {
    const storage::Store& store;
    const Clock& clock;
    /// A part has a verdict: outside its limits at once, otherwise when it is complete. Called
    /// after the commit; must return soon.
    std::function<void(const storage::MeasuredPart&)> on_part = {};
    /// A run of the machine was derived again. Must return soon.
    std::function<void(const std::string& machine)> on_derived = {};
    Hold hold_queue = {};                                       ///< empty: it holds none
    Hold hold_machine = {};                                     ///< empty: it holds nothing
    std::chrono::milliseconds retry = std::chrono::seconds(2);  ///< after a store that refuses
  };
  explicit Measurements(Parts parts);
  ~Measurements();
  Measurements(const Measurements&) = delete;
  Measurements& operator=(const Measurements&) = delete;

  /// Begins with what was stored since the last time.
  void begin();
  /// Derives and holds nothing more; what was not is left to the next beginning.
  void end();
  /// Records of some machine were stored. Never waits.
  void note();
  /// Returns when everything stored before the call is derived. Errors: Timeout.
  Result<void> wait(std::chrono::milliseconds limit);

  // Templates. Errors: those of ReportTemplateStore; of the text, those of read_template.
  Result<storage::ReportTemplateVersion> push(const std::string& name, const std::string& text,
                                              const storage::Actor& who);
  Result<void> remove(const std::string& name, const storage::Actor& who);
  Result<void> assign(storage::TemplateAssignment assignment, const storage::Actor& who);
  Result<void> unassign(storage::TemplateAssignment assignment, const storage::Actor& who);
  storage::ReportTemplateStore& templates() { return parts_.store.report_templates; }

  /// Derives a run again: with `name`, by this template alone, otherwise by those that apply now.
  /// What was derived before is kept and marked. Returns the parts. Errors: NotFound, Conflict (the
  /// run has not ended, records of it are in an archive, or no template applies), LimitExceeded
  /// (more than kMaxRunRecords).
  Result<std::vector<storage::MeasuredPart>> derive(const std::string& run,
                                                    const std::optional<std::string>& name,
                                                    std::optional<std::uint64_t> version);
  storage::MeasurementStore& stored() { return parts_.store.measurements; }

  static constexpr std::uint64_t kMaxRunRecords = 2'000'000;

 private:
  Derivation::Sources sources();
  /// Errors: Conflict (records of the run are, or may be, in an archive; it is named).
  Result<void> check_is_whole(const storage::Run& run);
  void work(const std::stop_token& stop);
  /// False: the store refuses, or a machine's records cannot be derived now.
  bool derive_all(const std::stop_token& stop);
  Result<void> derive_piece(const storage::UnderivedRecords& records);
  Result<MachineState> state_of(const std::string& machine);
  void announce(const std::vector<Judged>& judged);
  void act(const std::stop_token& stop);
  void take_due(const std::string& machine, const std::vector<DueAction>& due);
  void carry_out(const DueAction& due);
  /// It is not due any more, also after a restart.
  void resolve_due(const std::string& machine, const DueAction& due);
  /// What was not carried out before the last end of the server.
  void take_all_due();
  void wake();

  Parts parts_;
  TemplateCache cache_;
  std::mutex derive_mutex_;  ///< one derivation at a time
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool is_woken_ = true;
  std::uint64_t begun_ = 0, done_ = 0;  ///< rounds
  std::set<std::string> failed_;        ///< machines whose records cannot be derived; logged once
  struct Due {
    std::string machine;
    DueAction action;
  };
  std::mutex due_mutex_;
  std::condition_variable_any due_changed_;
  std::deque<Due> due_;
  std::jthread actor_;
  std::jthread worker_;  // last: it uses the others
};

}  // namespace dripline::measurements
