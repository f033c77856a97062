#pragma once

#include <string_view>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/dialects/tektronix1704/diagnostics.hpp"
#include "gateway/interpreter/dialects/tektronix1704/state.hpp"

namespace dripline::interpreter::tektronix1704 {

using Counts = std::array<std::int64_t, kAxes>;

/// One run: what the files of this folder work on. Functions that cannot go on give false and
/// leave the reason in `alarm`.
struct Run : BlockRun {
  Run(ControlOptions control_options, EventSink& event_sink);

  /// The sink, after the header has been delivered.
  EventSink& events() {
    if (!state.has_header) [[unlikely]]
      deliver_header();
    return sink;
  }

  using BlockRun::fail;
  [[gnu::cold]] bool fail(const DiagnosticRow& fault) { return fail(fault, 0); }
  [[gnu::cold]] void warn(const DiagnosticRow& fault, const Origin& at, std::uint32_t column = 0,
                          std::string_view detail = {});
  /// What the manual forbids without naming an effect: a warning, or an alarm when strict.
  [[gnu::cold]] bool object(const DiagnosticRow& fault, std::uint32_t column = 0,
                            std::string_view detail = {});

  double machine_mm(std::size_t axis, double program_counts) const {
    const double sign = options.mirror[axis] ? -1 : 1;
    return (static_cast<double>(state.origin[axis]) + sign * program_counts) * mm_per_count;
  }

  const ControlOptions options;
  const double mm_per_count;
  EventSink& sink;
  State state;
  Position position;            ///< of the machine; axes that have moved are marked
  language::WordLedger ledger;  ///< of the block being executed

 private:
  [[gnu::cold]] void deliver_header();
};

/// The state between two blocks; snapshot.cpp.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::tektronix1704
