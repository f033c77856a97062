#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

/// The G and M codes as rows: group, profile and the words they take (NIST 3.4; LinuxCNC:
/// G-codes, M-codes).
namespace dripline::interpreter::rs274ngc {

/// `nist` is the language of the NIST interpreter, version 3; `linuxcnc` what grew out of it.
enum class Profile : std::uint8_t { Nist, LinuxCnc };

enum class GGroup : std::uint8_t {
  OneShot,
  Motion,
  Plane,
  Distance,
  ArcDistance,
  FeedMode,
  Units,
  Radius,
  Length,
  Retract,
  System,
  Path,
  SpindleMode,
  Lathe,
};
inline constexpr std::size_t kGGroups = 14;

enum class MGroup : std::uint8_t {
  Stop,
  InputOutput,
  Tool,
  Spindle,
  Coolant,
  Override,
  User,
};
inline constexpr std::size_t kMGroups = 7;

struct GRow {
  std::int16_t code;  ///< tenths: G38.2 is 382
  GGroup group;
  Profile since;     ///< Nist: both profiles know it
  AddressSet words;  ///< beside axis words
  bool takes_axes;   ///< of the one-shots: wants the axis words for itself
};
struct MRow {
  std::int16_t code;
  MGroup group;
  Profile since;
  AddressSet words;
};

/// nullptr: no such code in this profile.
const GRow* g_row(int tenths, Profile profile);
const MRow* m_row(int code, Profile profile);

/// The words a code takes beside axis words; the NIST program knows fewer for some.
AddressSet words_of(const GRow& row, Profile profile);

constexpr bool is_cycle(int tenths) {
  return tenths == 730 || tenths == 740 || (tenths >= 810 && tenths <= 890);
}
/// Lathe cycles whose contour is a subprogram.
constexpr bool is_turning_cycle(int tenths) {
  return tenths >= 700 && tenths <= 722;
}
constexpr bool is_probe(int tenths) {
  return tenths >= 382 && tenths <= 385;
}

}  // namespace dripline::interpreter::rs274ngc
