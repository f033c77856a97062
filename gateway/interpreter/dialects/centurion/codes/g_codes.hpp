#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "gateway/interpreter/dialects/centurion/reading/words.hpp"

/// The preparatory functions of this control as rows that reading, checks and execution share
/// (spec 4.1). A code without a row is error 549.
namespace dripline::interpreter::centurion {

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

/// What a row does when its block is executed.
enum class GAction : std::uint8_t {
  Later,  ///< known to the control, not to this version: an alarm that names it
  None,   ///< already so: cancels something that is never on in this version, or has no effect
  Motion,
  Dwell,
  DataOn,
  DataOff,
  ClearFloatingZero,
  Inch,
  Metric,
  InitialLevel,
  ClearanceLevel,
  ExactStop,
  PathMode,
  SafeZone,
  FirstReference,
  OtherReference,
  ReturnFromReference,
  Retract,
  SingleDirection,
  Mirror,
  MirrorOff,
  Scaling,
  ScalingOff,
  Rotation,
  RotationOff,
  Compensation,
  CancelToolLength,
  FloatingZero,
  LocalZero,
  MachineCoordinates,
  WorkSystem,
  ThreadLine,    ///< the block's line or arc is a thread
  PatternCycle,  ///< G70-G73
  TurningBox,
  FacingBox,
  SingleThread,
  MultipleThread,
  Incremental,
  Absolute,
  SurfaceSpeed,
  Revolutions,
  FeedPerMinute,
  FeedPerRevolution,
  MacroCall,  ///< the axis words are arguments, or points of a block without movement
  DrillingCycle,
  FaceGroove,
  DiameterGroove,
  SaveParameters,
  LoadParameters,
  ReadByte,
  WriteByte,
  ForceError,
  Beep,
  FatalError,
};

struct GRow {
  std::uint16_t code;
  ModalGroup group;
  GAction action;
  AddressSet words;  ///< that it takes besides those any block may have
  std::string_view name;
};

/// Of the words of a block, those that G0-G3 take.
inline constexpr AddressSet kLineWords =
    set_of(Address::X, Address::Z, Address::U, Address::W, Address::R, Address::AA, Address::AB,
           Address::XC, Address::ZC, Address::I, Address::K);
inline constexpr AddressSet kPolarWords =
    set_of(Address::R, Address::AA, Address::AB, Address::XC, Address::ZC, Address::I, Address::K);
inline constexpr AddressSet kEndWords = set_of(Address::X, Address::Z, Address::U, Address::W);

inline constexpr std::uint8_t kNoRow = 0xFF;
/// Index into `g_rows`, or kNoRow.
std::uint8_t g_row_index(unsigned code);
const GRow& g_row(std::uint8_t index);

}  // namespace dripline::interpreter::centurion
