#include "gateway/interpreter/dialects/centurion/codes/modes.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/codes/reference_points.hpp"
#include "gateway/interpreter/dialects/centurion/motion/transform_stage.hpp"

namespace dripline::interpreter::centurion {
namespace {

// The parameters that show the transformation to programs (manual: ranges); X is a diameter.
constexpr int kMirrorPosition = 172;
constexpr int kScalePosition = 180;
constexpr int kScaleFactor = 188;
constexpr int kRotatePosition = 196;
constexpr int kRotateAngle = 198;

Point position_of(const Run& run, int first) {
  return {run.parameters[first + 1] / 2, run.parameters[first]};
}

void keep(Run& run, int first, Address address) {
  if (run.block.words.has(address)) run.parameters[first] = run.block.words[address];
}

/// The machine stays where it is, so the program's position changes.
template <class Change>
void transform(Run& run, Change change) {
  ModalState& state = run.state;
  const Point machine = machine_of(run, state.position);
  const bool was_on = state.transformation.is_on();
  change(state.transformation);
  state.nose_is_stale = true;
  if (!was_on && !state.transformation.is_on()) return;
  state.position = programmed_of(run, machine);
  state.previous = state.position;
  if (state.transformation.rotates) state.moved_axes = 3;
  run.update_stages();
}

bool check_factor(Run& run, Address address) {
  constexpr double kLeast = 0.0001;
  constexpr double kMax = 999.9999;
  const Words& words = run.block.words;
  if (!words.has(address)) return true;
  const double size = std::fabs(words[address]);
  if (size >= kLeast && size <= kMax) return true;
  return run.fail(ErrorCode::ParameterOutOfRange, words.column(address),
                  fmt::format("scale factor {}", words[address]));
}

bool refuse_both(Run& run, Address one, Address other) {
  return run.fail(ErrorCode::DuplicateAddress, run.block.words.column(other),
                  fmt::format("{} and {} mean the same", to_string(one), to_string(other)));
}

void reset(Run& run, int first, double value) {
  run.parameters[first] = run.parameters[first + 1] = value;
}

}  // namespace

/// The present position gets the given coordinates, whatever is scaled; every G50 ends G52.
bool set_floating_zero(Run& run) {
  const Words& words = run.block.words;
  ModalState& state = run.state;
  const bool has_axes = words.has_any(set_of(Address::X, Address::Z));
  if (has_axes && !check_untransformed(run, "G50")) return false;
  const Point machine = machine_of(run, state.position);
  state.local_zero = {};
  run.update_origin();
  if (words.has(Address::X)) {
    state.floating_zero.x += machine.x - state.origin.x - words[Address::X] / 2;
  }
  if (words.has(Address::Z)) {
    state.floating_zero.z += machine.z - state.origin.z - words[Address::Z];
  }
  run.update_origin();
  return true;
}

bool set_local_zero(Run& run) {
  const Words& words = run.block.words;
  if (words.has(Address::X)) run.state.local_zero.x = words[Address::X] / 2;
  if (words.has(Address::Z)) run.state.local_zero.z = words[Address::Z];
  run.update_origin();
  return true;
}

/// The axes named are mirrored in addition to those that are already.
bool set_mirror(Run& run) {
  const Words& words = run.block.words;
  if (!words.has_any(set_of(Address::X, Address::Z))) {
    return run.fail(ErrorCode::IllegalStatement, 0, "G511 needs X or Z");
  }
  keep(run, kMirrorPosition, Address::Z);
  keep(run, kMirrorPosition + 1, Address::X);
  transform(run, [&](Transformation& how) {
    how.mirrors_x |= words.has(Address::X);
    how.mirrors_z |= words.has(Address::Z);
    how.mirror = position_of(run, kMirrorPosition);
  });
  return true;
}

bool set_scaling(Run& run) {
  for (const Address address : {Address::X, Address::Z, Address::P}) {
    if (!check_factor(run, address)) return false;
  }
  const Words& words = run.block.words;
  if (words.has(Address::P) && words.has_any(set_of(Address::X, Address::Z))) {
    return run.fail(ErrorCode::IllegalStatement, words.column(Address::P),
                    "P is the factor of all axes");
  }
  keep(run, kScalePosition, Address::K);
  keep(run, kScalePosition + 1, Address::I);
  for (const Address address : {Address::Z, Address::P}) keep(run, kScaleFactor, address);
  for (const Address address : {Address::X, Address::P}) keep(run, kScaleFactor + 1, address);
  transform(run, [&](Transformation& how) {
    how.scales = true;
    how.scale_center = position_of(run, kScalePosition);
    how.factor = {run.parameters[kScaleFactor + 1], run.parameters[kScaleFactor]};
  });
  return true;
}

/// X, Z and R may be written for I, K and AA. A center that is set while scaling is on is scaled,
/// and keeps that place.
bool set_rotation(Run& run) {
  struct Twin {
    int parameter;
    Address word, other;
  };
  constexpr Twin kTwins[] = {{kRotatePosition, Address::K, Address::Z},
                             {kRotatePosition + 1, Address::I, Address::X},
                             {kRotateAngle, Address::AA, Address::R}};
  const Words& words = run.block.words;
  for (const Twin& twin : kTwins) {
    if (words.has(twin.word) && words.has(twin.other)) {
      return refuse_both(run, twin.word, twin.other);
    }
    keep(run, twin.parameter, twin.word);
    keep(run, twin.parameter, twin.other);
  }
  transform(run, [&](Transformation& how) {
    Point center = position_of(run, kRotatePosition);
    if (how.scales) {
      const Point& fixed = how.scale_center;
      center = {fixed.x + how.factor.x * (center.x - fixed.x),
                fixed.z + how.factor.z * (center.z - fixed.z)};
    }
    how.rotates = true;
    how.rotation_center = center;
    how.degrees = run.parameters[kRotateAngle];
  });
  return true;
}

bool clear_floating_zero(Run& run, const GRow&) {
  run.state.floating_zero = {};
  run.update_origin();
  return true;
}

bool end_mirror(Run& run, const GRow&) {
  transform(run, [](Transformation& how) { how.mirrors_x = how.mirrors_z = false; });
  return true;
}

bool end_scaling(Run& run, const GRow&) {
  reset(run, kScalePosition, 0);
  reset(run, kScaleFactor, 1);
  transform(run, [](Transformation& how) {
    how.scales = false;
    how.factor = {1, 1};
  });
  return true;
}

bool end_rotation(Run& run, const GRow&) {
  reset(run, kRotatePosition, 0);
  run.parameters[kRotateAngle] = 0;
  transform(run, [](Transformation& how) { how.rotates = false; });
  return true;
}

}  // namespace dripline::interpreter::centurion
