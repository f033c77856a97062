#pragma once

#include <string>

#include "gateway/app/restart/checkpoint.hpp"
#include "gateway/app/restart/event_tracker.hpp"
#include "gateway/feed/line_feed.hpp"
#include "gateway/report/outbox.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::gateway {

/// How many answers the interpreter was given.
struct GivenAnswers {
  std::uint64_t all = 0;
  std::uint64_t prompts = 0;  ///< of these, to the operator's questions
};

/// Stages the checkpoints of one run, for the next commit of the outbox. One thread.
class CheckpointKeeper {
 public:
  /// `answers`: before this run began, where it continues another.
  CheckpointKeeper(std::string run, report::Outbox& outbox, const Clock& clock,
                   const GivenAnswers& answers = {})
      : run_(std::move(run)), outbox_(outbox), clock_(clock), answers_(answers) {}

  struct State {
    const interpreter::Interpreter& interpreter;  ///< between two blocks
    const DeliveredState& delivered;
    const feed::ProgramFeed& feed;
    const report::Progress& executed;
    const interpreter::Position& machine;
  };
  /// A state larger than kMaxBytes is left out, with a line in the log.
  void take(const State& state);
  /// The interpreter has taken it: the block that it belongs to is executed only when this is on
  /// disk.
  void note_answer(const interpreter::Answer& answer);

  /// Programs that are called in no checkpoint yet. Their content is on disk before the next block
  /// is executed: a restart compares it.
  bool lacks_programs(const feed::ProgramFeed& feed) const {
    return feed.called_program_count() > programs_;
  }
  /// Block of the checkpoint that was taken last.
  std::uint64_t last_block() const { return last_block_; }

  static constexpr std::size_t kMaxBytes = 4U << 20;

 private:
  std::string run_;
  report::Outbox& outbox_;
  const Clock& clock_;
  GivenAnswers answers_;
  std::uint64_t last_block_ = 0;
  std::size_t programs_ = 0;  ///< in the checkpoint that was taken last
};

}  // namespace dripline::gateway
