#pragma once

#include <string>
#include <vector>

#include "gateway/app/restart/checkpoint.hpp"
#include "gateway/app/restart/restart_argument.hpp"
#include "gateway/machine/position_trust.hpp"

namespace dripline::gateway {

/// What is in force now; a restart is refused where it is not what the run was executed under.
struct PresentState {
  std::string revision, control;
  std::uint64_t size = 0;
  Conditions conditions;                                ///< of a start at the first block
  std::optional<machine::GivenAction::Point> rests_at;  ///< the axes, where that is known
  machine::PositionTrust trust = machine::PositionTrust::Kept;
  std::string memory;  ///< digest of what the control keeps
};

/// The same axes report the same, in millimeters or degrees.
inline constexpr double kSameAxes = 0.002;

/// A restart that can begin: the run that was cut off, and its checkpoints.
struct RestartPlan {
  report::ActiveRun original;
  RestartPlace at;
  Conditions conditions;
  RunEnding ending;             ///< resolved by where the axes rest, for a restart after it
  std::uint64_t on_record = 0;  ///< the block executed last, as the run has it
  /// Why the position may be another, where only the place shows that it is not: the axes are where
  /// the program has left them. Empty: it is not in doubt.
  std::string doubt;
  std::vector<report::StoredCheckpoint> checkpoints;  ///< ascending, without their bytes

  /// The last block that is not executed again, where that is known before looking.
  std::optional<std::uint64_t> known_target() const;
  /// That switches were changed within the run, and what to do; empty: none was.
  std::string skip_text() const;
  /// Index of the newest checkpoint at or before the block.
  std::size_t nearest(std::uint64_t block) const;
};

/// Errors: NotFound (no checkpoints of the run), Conflict (it has not ended, was completed, is of
/// another revision, setup or memory: named; or what the machine had in hand may be executed or
/// not), LimitExceeded (the place is after the block
/// executed last), Corrupt.
Result<RestartPlan> plan_restart(storage::sqlite::Database& database,
                                 const RestartArgument& argument, const PresentState& present);

/// Reads one checkpoint of the run and checks that it is whole. Errors: Corrupt, NotFound.
Result<Checkpoint> read_checkpoint(storage::sqlite::Database& database, const std::string& run,
                                   std::uint64_t block);

}  // namespace dripline::gateway
