#pragma once

#include <cstdint>
#include <string_view>

namespace dripline::line {

/// What a word of a program sets until another one of the group does. In the order in which words
/// of one block are listed.
enum class ModalGroup : std::uint8_t {
  Header,
  Units,
  Diameter,
  Plane,
  Distance,
  ArcDistance,
  FeedMode,
  ReturnLevel,
  Compensation,
  Length,
  WorkOffset,
  Shift,
  LocalSystem,
  Scale,
  Mirror,
  Rotation,
  Interpolation,
  StrokeZone,
  Polar,
  PathMode,
  LookAhead,
  ModalCall,
  SpeedLimit,
  SpeedMode,
  Motion,
  Cycle,
  RigidTapping,
  Overrides,
  Tool,
  NextTool,
  EventBegin,
  EventOffset,
  // Needed by feed moves only.
  Feed,
  Speed,
  Spindle,
  Coolant,
  Mist,
};

/// How what a word put in force can be put in force again.
enum class Resend : std::uint8_t {
  Word,   ///< by the word, with those in `with` that stand in its block
  Block,  ///< by its block, which moves nothing
  Never,  ///< by none: it depends on where the machine was, or on data of its block
};

/// A G code and its group, as most controls have them.
struct ModalCode {
  int code = 0;  ///< tenths: G54.1 is 541
  ModalGroup group{};
  Resend resend = Resend::Word;
  std::string_view with = {};
};

/// nullptr: no modal code that is known.
const ModalCode* find_modal_code(int code);
/// The code is of its block alone, as most controls have it. Of a code that is neither modal nor
/// this nothing is known: what it leaves in force cannot be sent again.
bool is_one_shot_code(int code);

}  // namespace dripline::line
