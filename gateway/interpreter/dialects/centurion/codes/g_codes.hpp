#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "gateway/interpreter/dialects/centurion/reading/words.hpp"

/// The preparatory functions of this control as rows that reading, checks and execution share
/// (manual: list of G codes). A code without a row is error 549.
namespace dripline::interpreter::centurion {

struct Run;

enum class ModalGroup : std::uint8_t {
  OneShot,
  Motion,
  Data,
  Units,
  SafeZone,
  ReturnLevel,
  Compensation,
  WorkSystem,
  PathMode,
  Cycle,
  Distance,
  SpindleUnit,
  FeedUnit,
  Mirror,
  Scaling,
  Rotation,
};

/// What the reader of a block and the status window have to know of a code.
enum class GKind : std::uint8_t {
  Other,
  Motion,
  Dwell,       ///< the next word is its time
  ThreadLine,  ///< the block's line or arc is a thread
  Cycle,
};

/// A row names its functions; all of them return false when the block pauses.
struct GRow {
  std::uint16_t code;
  ModalGroup group;
  AddressSet words;  ///< that it takes besides those any block may have
  std::string_view name;
  /// Changes the modes of the block, before anything moves.
  bool (*set)(Run&, const GRow&) = nullptr;
  /// Acts in the order written, before the axis words do.
  bool (*before_move)(Run&, const GRow&) = nullptr;
  /// Uses the axis words, in place of a move.
  bool (*act)(Run&) = nullptr;
  GKind kind = GKind::Other;
};

/// The words that G0 to G3 take.
inline constexpr AddressSet kLineWords =
    set_of(Address::X, Address::Z, Address::U, Address::W, Address::R, Address::AA, Address::AB,
           Address::XC, Address::ZC, Address::I, Address::K);
inline constexpr AddressSet kPolarWords =
    set_of(Address::R, Address::AA, Address::AB, Address::XC, Address::ZC, Address::I, Address::K);
inline constexpr AddressSet kEndWords = set_of(Address::X, Address::Z, Address::U, Address::W);

inline constexpr std::uint8_t kNoRow = 0xFF;
/// Index into the table for `g_row`, or kNoRow.
std::uint8_t g_row_index(unsigned code);
const GRow& g_row(std::uint8_t index);

}  // namespace dripline::interpreter::centurion
