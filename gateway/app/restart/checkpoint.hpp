#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/app/restart/delivered_state.hpp"
#include "gateway/app/restart/in_hand.hpp"
#include "gateway/feed/line_feed.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/report/checkpoint_store.hpp"
#include "protocol/base/clock.hpp"

/// What is kept of a run for a restart. Every one of these is sealed by a SHA-256 at its end, which
/// covers the run that it belongs to: bytes that differ in any place from what was written, and
/// those of another run, are Corrupt, and start nothing. They are those of this machine and of
/// `kFormat`. Errors of decoding: Corrupt, Unsupported (another format).
namespace dripline::gateway {

/// A state between two blocks.
struct Checkpoint {
  std::uint64_t block = 0;    ///< interpreted
  report::Progress executed;  ///< by the machine, at that time
  std::int64_t time_us = 0;   ///< UTC
  interpreter::Snapshot snapshot;
  DeliveredState delivered;
  interpreter::Position machine;              ///< where the axes were at that time
  std::uint64_t answers = 0;                  ///< given to the interpreter by then
  std::uint64_t prompts = 0;                  ///< of these, to the operator's questions
  std::vector<feed::CalledProgram> programs;  ///< by then, in their order
};
report::Bytes encode(std::string_view run, Checkpoint checkpoint);
Result<Checkpoint> decode_checkpoint(std::string_view run, const report::Bytes& bytes);
/// For tests: any bytes with the seal of a checkpoint.
report::Bytes sealed_checkpoint(std::string_view run, report::Bytes content);

/// What decides, besides its text, how a program is interpreted.
struct Conditions {
  std::string machine;
  std::string server_setup;   ///< SHA-256 of its text; empty: the server gave none
  std::string gateway_setup;  ///< likewise of the gateway's own
  bool block_skip = false;
  std::string start;  ///< the place that its start named ("N120 pass=3"); empty: the first block
  interpreter::Position begun_at;  ///< where the machine was then
  std::string restart_of;          ///< the run that it continues; empty: it is no restart
  /// Switches that skip blocks and were changed within it: "block_skip on after block 12". Empty:
  /// none.
  std::string skip_changes;
  friend bool operator==(const Conditions&, const Conditions&) = default;
};
report::Bytes encode(std::string_view run, Conditions conditions);
/// Those that were kept without changes of switches are read, too.
Result<Conditions> decode_conditions(std::string_view run, const report::Bytes& bytes);
/// For tests: any bytes with the seal of conditions.
report::Bytes sealed_conditions(std::string_view run, report::Bytes content);

/// How far a run came.
struct RunEnding {
  report::Progress executed;
  std::int64_t time_us = 0;
  bool is_completed = false;
  /// Where the axes came to rest; absent after a kill, when it is not known.
  std::optional<interpreter::Position> stopped_at;
  std::string memory;         ///< digest of what the control had kept
  InHand in_hand;             ///< what may have been executed besides, or a part of it
  bool is_in_thread = false;  ///< it stopped in a thread or a tapped hole; false after a kill
  /// The first place at which the axes rested since, which shows what of `in_hand` they have done.
  /// Later they may be moved by hand. Absent: they have not rested while the gateway was there.
  std::optional<machine::GivenAction::Point> rested_at = {};
};
report::Bytes encode(std::string_view run, RunEnding ending);
/// Those that were kept without `is_in_thread` or `rested_at` are read, too.
Result<RunEnding> decode_ending(std::string_view run, const report::Bytes& bytes);
/// For tests: any bytes with the seal of an ending.
report::Bytes sealed_ending(std::string_view run, report::Bytes content);

/// The `number`th answer that the interpreter of a run was given. Times that were kept without
/// milliseconds are read, too.
report::Bytes encode(std::string_view run, std::uint64_t number, interpreter::Answer answer);
Result<interpreter::Answer> decode_answer(std::string_view run, std::uint64_t number,
                                          const report::Bytes& bytes);
/// For tests: any bytes with the seal of an answer.
report::Bytes sealed_answer(std::string_view run, std::uint64_t number, report::Bytes content);

}  // namespace dripline::gateway
