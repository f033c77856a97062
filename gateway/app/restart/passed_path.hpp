#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gateway/app/restart/passed_route.hpp"
#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

/// Where the tool of a lathe has been since it was taken up, up to where the run stopped: what it
/// has cut or passed stays free for it, since material is only removed. An M function, an output, a
/// stop, and a move of an axis other than X and Z may change that: what was before them is dropped.
/// A thread is free at one angle of the spindle alone, so its moves are left out.
///
/// Of all controls: whether the place is within a thread. An event sink for the blocks from some
/// place before the target on.
class PassedPath final : public interpreter::EventSink {
 public:
  struct Begin {
    std::uint64_t target = 0;    ///< the last block that is not executed again
    std::uint64_t executed = 0;  ///< the last block that was executed
    interpreter::Position at;    ///< marks the axes whose place is known
    bool is_begin_of_run = false;
    /// A change of tool changes coordinates without a move.
    bool shifts_with_tool = false;
  };
  void begin(const Begin& begin);
  /// Where the run came to rest; of the block that it was in, the moves up to there were made.
  /// Nothing: not known, and none of them counts. After the last event.
  void stop_at(const std::optional<interpreter::Position>& place);

  /// The block's end has come.
  bool has_ended(std::uint64_t block) const { return ended_ >= block; }
  /// A move after the target has come.
  bool has_continued() const { return has_continued_; }
  /// The first one, if it is a straight line and no thread: `to` marks its axes.
  struct StraightMove {
    interpreter::Position to;
    bool is_rapid = false;
    std::optional<Feed> feed = {};  ///< not of a rapid
  };
  const std::optional<StraightMove>& continues_with() const { return continues_with_; }

  /// Those that were made; none where they are not known to be free any more.
  const std::vector<PassedMove>& moves() const { return moves_; }
  /// Where the tool was taken up, or the run began, if the moves begin there.
  std::optional<interpreter::PlaneVector> taken_up_at() const { return taken_up_at_; }
  /// Another tool was taken up after the target.
  bool has_other_tool() const { return has_other_tool_; }

  /// The block in which a thread begins that the target ends within; 0: in none.
  std::uint64_t thread_begins_in() const { return is_in_chain_ ? thread_block_ : 0; }
  /// On a thread of the block that the run was in, away from where it begins.
  bool is_in_thread(const interpreter::Position& place) const;

  static constexpr std::size_t kMaxMoves = 2048;

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_pin(const interpreter::PinChange& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_block_end(const interpreter::Origin& origin) override;

 private:
  struct ThreadMove {
    interpreter::Position from, to;
  };
  enum class Kind { Free, Thread };
  void add(const interpreter::Origin& origin, const interpreter::Position& to, PassedMove move,
           Kind kind = Kind::Free);
  void note_thread(const interpreter::Origin& origin, const interpreter::Position& to, Kind kind);
  void keep(const interpreter::Origin& origin, const PassedMove& move);
  bool moves_others(const interpreter::Position& to) const;
  void begin_again(std::uint64_t block);
  std::optional<interpreter::PlaneVector> place() const;

  Begin given_;
  interpreter::Position at_;
  std::vector<PassedMove> moves_;
  std::vector<PassedMove> last_moves_;  ///< of the block that the run was in
  std::optional<interpreter::PlaneVector> taken_up_at_;
  bool is_lost_ = false, has_other_tool_ = false;
  std::uint64_t ended_ = 0;
  bool has_continued_ = false;
  std::optional<StraightMove> continues_with_;
  std::uint64_t thread_block_ = 0;  ///< where the last move's thread begins; 0: it is none
  ThreadMove last_thread_;
  bool is_in_chain_ = false;
  std::vector<ThreadMove> threads_;  ///< of the block that the run was in
};

}  // namespace dripline::gateway
