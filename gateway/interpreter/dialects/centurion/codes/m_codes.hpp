#pragma once

#include <cstdint>
#include <string_view>

/// The miscellaneous functions of this control as rows (manual: M codes). A number without a row
/// goes to the machine as it is, before the move.
namespace dripline::interpreter::centurion {

struct Run;

/// PostMove: the codes that the machine's builder has put last (option `post_m`).
enum class MTiming : std::uint8_t { BeforeMove, AfterMove, PostMove, Flow };

struct MRow {
  std::uint8_t code;
  MTiming timing;
  std::string_view name;
  /// False: the block pauses. None: flow.cpp ends the block with it.
  bool (*apply)(Run&, const MRow&) = nullptr;
};

inline constexpr unsigned kHighestM = 99;
/// Also for numbers the table does not name: a strobe before the move.
const MRow& m_row(unsigned code);

}  // namespace dripline::interpreter::centurion
