#include "gateway/interpreter/dialects/fanuc/tilting/planes.hpp"

#include <fmt/core.h>
#include <algorithm>

namespace dripline::interpreter::fanuc {
namespace {

bool refuse_word(Run& run, Address address, std::string_view why) {
  const std::uint32_t column = run.block.words.column(address);
  return run.fail(ErrorCode::PlaneFormat, column != 0 ? column : run.block.parts.g_column, why);
}

/// I, J and K, degrees; one that is left out is 0.
bool read_angles(Run& run, std::array<double, 3>& angles) {
  constexpr std::array<Address, 3> kAngles{I, J, K};
  const Words& words = run.block.words;
  if (!words.has_any(kCenterWords)) return refuse_word(run, I, "I, J and K are the angles");
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.has(kAngles[i])) continue;
    angles[i] = run.angle(words[kAngles[i]]);
    if (!(std::fabs(angles[i]) <= 360)) {
      return refuse_word(run, kAngles[i],
                         fmt::format("{}{} is beyond 360 degrees", letter(kAngles[i]), angles[i]));
    }
  }
  return true;
}

/// About Z, about the X that this gives, about the Z that this gives.
Matrix3 by_euler(const std::array<double, 3>& angles) {
  return rotation_about(2, angles[0]) * rotation_about(0, angles[1]) * rotation_about(2, angles[2]);
}

/// Roll, pitch and yaw: about X, Y and Z of the workpiece, in the order of Q's digits.
bool by_roll_pitch_yaw(Run& run, const std::array<double, 3>& angles, Matrix3& frame) {
  constexpr std::array kOrders{123, 132, 213, 231, 312, 321};
  const Words& words = run.block.words;
  if (!words.has(Q)) return refuse_word(run, P, "G68.2 P1 needs Q, the order of the rotations");
  const double order = run.whole(words[Q]);
  if (std::find(kOrders.begin(), kOrders.end(), order) == kOrders.end()) {
    return refuse_word(run, Q, fmt::format("Q{} is not 123, 132, 213, 231, 312 or 321", order));
  }
  frame = Matrix3{};
  auto left = static_cast<int>(order);
  for (const int digit : {left / 100, left / 10 % 10, left % 10}) {
    const auto axis = static_cast<std::size_t>(digit - 1);
    frame = rotation_about(axis, angles[axis]) * frame;
  }
  return true;
}

bool takes_words_too(const Block& block) {
  return block.parts.one_shot != Block::kNoCode || block.names(kStrokeGroup) ||
         block.names(kInterpolationGroup) ||
         (block.names(kMirrorGroup) && block.g[kMirrorGroup] == kMirrorOn) ||
         (block.names(kScalingGroup) && block.g[kScalingGroup] == 51) ||
         (block.names(kCycleGroup) && block.g[kCycleGroup] != 80);
}

}  // namespace

bool read_plane(Run& run, Tilt& tilt) {
  constexpr std::array<Address, 3> kZero{X, Y, Z};
  constexpr AddressSet kOthers = (kAxisWords & ~set_of(X, Y, Z)) | set_of(L, R, H);
  constexpr double kMaxMillimeters = 99'999.999;
  const Words& words = run.block.words;
  const double form = words.has(P) ? run.whole(words[P]) : 0;
  if (form != 0 && form != 1) {
    return refuse_word(run, P,
                       fmt::format("G68.2 P{}: planes are given by P0 (Euler angles) and P1 "
                                   "(roll, pitch, yaw)",
                                   form));
  }
  const AddressSet excess = kOthers | (form == 0 ? set_of(Q) : 0);
  if (words.has_any(excess)) {
    return run.fail(ErrorCode::PlaneFormat, words.first_column(excess),
                    "a word that G68.2 does not take");
  }
  if (takes_words_too(run.block)) {
    return run.fail(ErrorCode::PlaneFormat, run.block.parts.g_column,
                    "another code that takes words beside G68.2");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.has(kZero[i])) {
      return refuse_word(run, kZero[i], "X, Y and Z are the zero of the plane in the work system");
    }
    const double value = run.length(words[kZero[i]]);
    if (!(std::fabs(value) <= kMaxMillimeters))
      return refuse_word(run, kZero[i], fmt::format("{}{}", letter(kZero[i]), value));
    tilt.at[i] = run.state.origin[i] + value;
  }
  std::array<double, 3> angles{};
  if (!read_angles(run, angles)) return false;
  if (form == 1) return by_roll_pitch_yaw(run, angles, tilt.frame);
  tilt.frame = by_euler(angles);
  return true;
}

}  // namespace dripline::interpreter::fanuc
