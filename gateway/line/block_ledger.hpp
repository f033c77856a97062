#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace dripline::line {

/// How far a program has come over a line.
struct BlockPlace {
  std::uint64_t bytes = 0;     ///< of the program, since the run's beginning
  std::uint64_t blocks = 0;    ///< whole ones
  std::uint64_t line = 0;      ///< of the last whole block, 1-based in the program; 0: none
  std::int64_t sequence = -1;  ///< its N number, -1 none
  friend bool operator==(const BlockPlace&, const BlockPlace&) = default;
};

/// The N number that a block begins with (`N120`, `/N120`, or a TNC's bare `120`); -1: none.
std::int64_t sequence_number(std::string_view block);

/// Turns stored program text into text that a line is offered (no CR, LF after every block) and
/// remembers the position of the blocks in transit in both, so that a number of characters sent can
/// be given in bytes and blocks of the program. Keeps a few numbers per block in transit. Pure; one
/// thread.
class BlockLedger {
 public:
  /// `first_line`: of the program, 1-based, where the run begins.
  explicit BlockLedger(std::uint64_t first_line = 1) : next_line_(first_line) {}

  /// Whole blocks that are offered before the program and do not belong to it; returns what to
  /// offer.
  std::string add_head(std::string_view head);
  /// The next piece of the program, cut anywhere; returns what to offer for it. `is_last`: the text
  /// ends with this piece, and an LF is added if its last block has none.
  std::string add(std::string_view piece, bool is_last);
  /// So many characters of what `add` returned were sent (or accepted). Never backwards.
  void advance(std::uint64_t offered);
  /// Everything added was sent.
  void advance_to_end() { advance(offered_); }

  const BlockPlace& place() const { return place_; }
  /// Characters that were sent, with those of the head.
  std::uint64_t left() const { return left_; }
  std::uint64_t offered() const { return offered_; }

 private:
  struct Mark {  ///< the end of a block
    std::uint64_t offered = 0, source = 0, line = 0;
    std::int64_t sequence = -1;
  };
  void end_block();

  std::deque<Mark> marks_;
  std::string head_;  ///< how the block that is being added begins
  std::uint64_t offered_ = 0, source_ = 0, next_line_ = 1;
  std::uint64_t block_begin_ = 0;  ///< in offered characters
  std::uint64_t passed_offered_ = 0, passed_source_ = 0;
  std::uint64_t left_ = 0;
  BlockPlace place_;
};

}  // namespace dripline::line
