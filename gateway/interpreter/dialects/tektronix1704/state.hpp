#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/dialects/tektronix1704/options.hpp"
#include "gateway/interpreter/dialects/tektronix1704/words.hpp"

namespace dripline::interpreter::tektronix1704 {

enum class Motion : std::uint8_t {
  G00,  ///< line, rest at the end
  G01,  ///< line
  G02,  ///< arc clockwise
  G03,  ///< arc counterclockwise
  G20,  ///< arc clockwise, rest at the end
  G30,  ///< arc counterclockwise, rest at the end
  G50,  ///< rapid
  Cycle,
};
constexpr bool is_arc(Motion motion) {
  return motion >= Motion::G02 && motion <= Motion::G30;
}
/// The slides do not come to rest at the end.
constexpr bool flows_on(Motion motion) {
  return motion >= Motion::G01 && motion <= Motion::G03;
}

enum class ReaderState : std::uint8_t {
  Hunt,  ///< ignores everything up to the first end of block
  Data,
  Search,  ///< reads forward to a sequence number, executing nothing
};

/// A block as far as it has been read: a comment can hold ends of blocks, so a block can take
/// several lines.
struct BlockInProgress {
  Words words;
  bool in_comment = false;
  bool is_begun = false;  ///< `origin` holds its first line
  bool has_word = false;  ///< a letter waits for its digits
  bool has_sign = false, is_negative = false, has_digit = false, has_tab = false;
  bool tab_is_told = false;
  Address address{};
  std::int32_t value = 0;
  std::uint8_t digits = 0;       ///< significant
  std::uint32_t characters = 0;  ///< on the tape, end of block included
  std::bitset<500> faults;       ///< reported already, by the numbers of their ids
  bool is_bad = false;           ///< a fault that leaves the block out
};

/// The last move, for the rules about stops and for the reader's time (manual: G01, buffering).
struct LastMove {
  bool flows = false;  ///< it was in G01, G02 or G03 and nothing has stopped since
  std::array<double, kAxes> direction{};  ///< at its end; not of unit length
  Origin origin;
  std::uint64_t block = 0;  ///< that made it
  double feed = 0;          ///< mm per minute
  double length = 0;
};

struct State {
  RunPhase phase = RunPhase::Running;
  ReaderState reader = ReaderState::Hunt;
  bool has_header = false;
  std::uint64_t blocks = 0;
  std::uint32_t mdi_done = 0;
  TextPlace place;

  Motion motion = Motion::G00;
  std::uint8_t cycle = 0;  ///< 80 to 89
  bool is_incremental = false;
  bool drills = false;                        ///< G99
  std::array<std::int64_t, kAxes> program{};  ///< counts
  std::array<std::int64_t, kAxes> origin{};   ///< machine counts of program zero
  std::array<std::int64_t, kAxes> center{};   ///< I, J, K stores, program counts
  std::array<bool, kAxes> has_moved{};
  Plane plane = Plane::XY;
  std::int32_t feed = -1;  ///< counts; -1: never set
  std::int32_t spindle_code = 0, tool_code = 0;
  bool has_clearance = false, has_depth = false;
  std::int64_t clearance = 0, depth = 0;  ///< R and Z of cycles, program counts
  SpindleState spindle = SpindleState::Off;
  bool flood = false, mist = false;
  LastMove last;
  BlockInProgress block;
};

}  // namespace dripline::interpreter::tektronix1704
