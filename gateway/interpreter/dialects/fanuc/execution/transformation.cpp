#include "gateway/interpreter/dialects/fanuc/execution/coordinates.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/dialects/fanuc/tilting/tilting.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr double kLeastFactor = 0.001;
constexpr double kMaxFactor = 999.999;

void rotate(const Rotation& rotation, double sine, Point3& point) {
  const PlaneAxes axes = axes_of(rotation.plane);
  const double first = point[place(axes.first)] - rotation.first;
  const double second = point[place(axes.second)] - rotation.second;
  point[place(axes.first)] = rotation.first + first * rotation.cosine - second * sine;
  point[place(axes.second)] = rotation.second + first * sine + second * rotation.cosine;
}

double mirrored(const Mirror& mirror, std::size_t i, double at) {
  return mirror.is_on[i] ? 2 * mirror.at[i] - at : at;
}

double scaled(const Scaling& scaling, std::size_t i, double at) {
  return scaling.center[i] + scaling.factor[i] * (at - scaling.center[i]);
}

/// P and I J K: thousandths without a point.
bool read_factor(Run& run, Address address, double& factor) {
  const Word& word = run.block.words[address];
  factor = word.form == WordForm::Whole ? word.value / 1000 : word.value;
  const double size = std::fabs(factor);
  if (size >= kLeastFactor && size <= kMaxFactor) return true;
  return run.fail(ErrorCode::IllegalScale, word.column,
                  fmt::format("{} is not {} to {}", size, kLeastFactor, kMaxFactor));
}

void update_transformed(Run& run) {
  ModalState& state = run.state;
  state.is_transformed =
      state.g[kScalingGroup] == 51 || state.g[kRotationGroup] == 68 || state.mirror.any();
  ++run.frame_changes;
}

bool begin_scaling(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  if (state.is_compensating())
    return run.fail(ErrorCode::ScalingInCompensation, run.block.parts.g_column);
  const Point3 present = program_position(run);
  Scaling scaling;
  constexpr std::array<Address, 3> kCenter{X, Y, Z};
  constexpr std::array<Address, 3> kFactors{I, J, K};
  double all = state.parameters.scale_default;
  if (words.has(P) && !read_factor(run, P, all)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    scaling.center[i] = mirrored(
        state.mirror, i, words.has(kCenter[i]) ? run.length(words[kCenter[i]]) : present[i]);
    scaling.factor[i] = all;
    if (words.has_any(kCenterWords)) scaling.factor[i] = state.parameters.scale_default;
    if (words.has(kFactors[i]) && !read_factor(run, kFactors[i], scaling.factor[i])) return false;
  }
  state.scaling = scaling;
  return true;
}

bool begin_rotation(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const bool was_on = state.g[kRotationGroup] == 68;
  const PlaneAxes axes = axes_of(state.plane());
  if (words.has_any(kCenterWords)) {
    return run.fail(ErrorCode::ImproperG, words.first_column(kCenterWords),
                    "G68 with I, J, K rotates about an axis in space: not supported");
  }
  if (was_on && state.rotation.plane != state.plane()) {
    return run.fail(ErrorCode::RotationPlane, run.block.parts.g_column);
  }
  const AddressSet center_words = set_of_axis(axes.first) | set_of_axis(axes.second);
  if (was_on && (words.present() & center_words) != center_words) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                    "another G68 names its center: the present place has two coordinates");
  }
  const Point3 present = program_position(run);
  constexpr std::array<Address, 3> kCenter{X, Y, Z};
  // Under scaling the center is scaled as any point is; a mirror image reverses the rotation.
  const auto center = [&](Axis axis) {
    const std::size_t i = place(axis);
    const Address address = kCenter[i];
    const double at =
        mirrored(state.mirror, i, words.has(address) ? run.length(words[address]) : present[i]);
    return state.g[kScalingGroup] == 51 ? scaled(state.scaling, i, at) : at;
  };
  Rotation rotation;
  rotation.plane = state.plane();
  rotation.first = center(axes.first);
  rotation.second = center(axes.second);
  rotation.degrees = words.has(R) ? run.angle(words[R]) : state.parameters.rotate_default;
  if (!(std::fabs(rotation.degrees) <= 360)) {
    return run.fail(ErrorCode::TooManyDigits, words.column(R), "R is beyond 360 degrees");
  }
  if (was_on && state.is_incremental() && run.options.rotate_incremental) {
    rotation.degrees += state.rotation.degrees;
  }
  if (is_plane_mirrored(state, state.plane())) rotation.degrees = -rotation.degrees;
  rotation.sine = language::sine(rotation.degrees).value;
  rotation.cosine = language::cosine(rotation.degrees).value;
  state.rotation = rotation;
  return true;
}

}  // namespace

Point3 transform(const ModalState& state, Point3 point) {
  for (std::size_t i = 0; i < 3; ++i) point[i] = mirrored(state.mirror, i, point[i]);
  if (state.g[kScalingGroup] == 51) {
    for (std::size_t i = 0; i < 3; ++i) point[i] = scaled(state.scaling, i, point[i]);
  }
  if (state.g[kRotationGroup] == 68) rotate(state.rotation, state.rotation.sine, point);
  return point;
}

Point3 transform_back(const ModalState& state, Point3 point) {
  if (state.g[kRotationGroup] == 68) rotate(state.rotation, -state.rotation.sine, point);
  if (state.g[kScalingGroup] == 51) {
    const Scaling& scaling = state.scaling;
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] = scaling.center[i] + (point[i] - scaling.center[i]) / scaling.factor[i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) point[i] = mirrored(state.mirror, i, point[i]);
  return point;
}

Point3 program_point(const ModalState& state, const Position& at) {
  Point3 work{};
  for (std::size_t i = 0; i < 3; ++i) work[i] = at.raw(static_cast<Axis>(i)) - state.origin[i];
  return state.is_transformed ? transform_back(state, work) : work;
}

Point3 program_position(const Run& run) {
  return program_point(run.state, run.state.position);
}

CoordinateFrame frame_of(const Run& run) {
  const ModalState& state = run.state;
  const Coordinates& all = run.memory.coordinates;
  CoordinateFrame frame;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    frame.datum[i] = all.work[run.work_system()][i] + all.work[0][i];
    frame.shift[i] = all.shift[i] + all.local[i];
  }
  if (run.tilted.is_on()) {
    frame.learn([&run, &state](CoordinateFrame::Values at) {
      Position machine = run.tilted.machine();
      for (std::size_t i = 0; i < 3; ++i) machine.set_raw(static_cast<Axis>(i), at[i]);
      const Point3 flat = linear_of(run.tilted.flat_of(machine));
      std::copy(flat.begin(), flat.end(), at.begin());
      for (std::size_t i = 0; i < kAxisCount; ++i) at[i] -= state.origin[i];
      return at;
    });
    return frame;
  }
  if (!state.is_transformed) {
    frame.learn_offset(state.origin);
    return frame;
  }
  if (state.g[kRotationGroup] == 68) frame.rotation = state.rotation.degrees;
  for (std::size_t i = 0; i < 3 && state.g[kScalingGroup] == 51; ++i) {
    frame.scale[i] = std::fabs(state.scaling.factor[i]);
    frame.mirrored[i] = state.scaling.factor[i] < 0;
  }
  for (std::size_t i = 0; i < 3; ++i)
    frame.mirrored[i] = frame.mirrored[i] != state.mirror.is_on[i];
  frame.learn([&state](CoordinateFrame::Values at) {
    for (std::size_t i = 0; i < kAxisCount; ++i) at[i] -= state.origin[i];
    const Point3 back = transform_back(state, {at[0], at[1], at[2]});
    std::copy(back.begin(), back.end(), at.begin());
    return at;
  });
  return frame;
}

bool is_plane_mirrored(const ModalState& state, Plane plane) {
  const PlaneAxes axes = axes_of(plane);
  const auto turns_round = [&state](Axis axis) {
    const bool is_scaled = state.g[kScalingGroup] == 51 && state.scaling.factor[place(axis)] < 0;
    return is_scaled != state.mirror.is_on[place(axis)];
  };
  return turns_round(axes.first) != turns_round(axes.second);
}

namespace {

bool ends_rotation(const Block& block) {
  return block.names(kRotationGroup) && block.g[kRotationGroup] == 69;
}

/// The manual leaves open what an axis whose coordinate has become another one does when the next
/// block does not name it: some controls move it, others leave it where it is.
void note_open_axes(Run& run, const Point3& before, FrameCode code) {
  constexpr double kSame = 1e-6;
  const Point3 now = program_position(run);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::fabs(now[i] - before[i]) <= kSame) continue;
    run.state.open_axes = static_cast<std::uint8_t>(run.state.open_axes | 1u << i);
    run.state.opened_by = code;
  }
}

bool apply_mirror(Run& run) {
  ModalState& state = run.state;
  const Point3 before = program_position(run);
  const Words& words = run.block.words;
  const std::uint32_t column = run.block.parts.g_column;
  const bool begins = run.block.g[kMirrorGroup] == kMirrorOn;
  run.ledger.take(set_of(X, Y, Z));
  if (state.is_compensating()) return run.fail(ErrorCode::ScalingInCompensation, column, "G51.1");
  if (state.g[kScalingGroup] == 51 || state.g[kRotationGroup] == 68) {
    return run.fail(ErrorCode::PositionUnderTransform, column,
                    "a mirror image begins and ends outside G51 and G68");
  }
  constexpr std::array<Address, 3> kMirrorAxes{X, Y, Z};
  const bool names_none = !words.has_any(set_of(X, Y, Z));
  if (begins && names_none)
    return run.fail(ErrorCode::ImproperCommand, column, "G51.1 without an axis");
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.has(kMirrorAxes[i]) && !(names_none && !begins)) continue;
    const Word& word = words[kMirrorAxes[i]];
    if (!begins && !names_none && word.value != 0 &&
        run.coordinate(static_cast<Axis>(i), word) != state.mirror.at[i]) {
      return run.fail(ErrorCode::ImproperCommand, word.column,
                      "G50.1 names its axes with 0, or with the place of the mirror");
    }
    state.mirror.is_on[i] = begins;
    state.mirror.at[i] = begins ? run.coordinate(static_cast<Axis>(i), words[kMirrorAxes[i]]) : 0;
  }
  state.g[kMirrorGroup] = state.mirror.any() ? kMirrorOn : kMirrorOff;
  update_transformed(run);
  note_open_axes(run, before, begins ? FrameCode::Mirror : FrameCode::MirrorEnd);
  return true;
}

bool apply_scaling(Run& run) {
  ModalState& state = run.state;
  const std::uint8_t code = run.block.g[kScalingGroup];
  const bool rotates = state.g[kRotationGroup] == 68 && !ends_rotation(run.block);
  if (rotates && (code == 51 || state.g[kScalingGroup] == 51)) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                    "scaling begins before G68 and ends after G69");
  }
  const Point3 before = program_position(run);
  if (code == 51 && !begin_scaling(run)) return false;
  state.g[kScalingGroup] = code;
  update_transformed(run);
  note_open_axes(run, before, code == 51 ? FrameCode::Scaling : FrameCode::ScalingEnd);
  return true;
}

bool apply_rotation(Run& run) {
  ModalState& state = run.state;
  const std::uint8_t code = run.block.g[kRotationGroup];
  const bool rotates = code == 68 || state.g[kRotationGroup] == 68;
  const Point3 before = rotates ? program_position(run) : Point3{};
  if (code == 68 && !begin_rotation(run)) return false;
  if (code == kTiltedPlane && !begin_tilted_plane(run)) return false;
  if (code == 69 && run.tilted.kind() == Tilt::Kind::Plane && !end_tilted_plane(run)) return false;
  state.g[kRotationGroup] = code;
  update_transformed(run);
  if (rotates)
    note_open_axes(run, before, code == 68 ? FrameCode::Rotation : FrameCode::RotationEnd);
  return true;
}

/// G51, G51.1 and G68 are alone among the codes that take X, Y and Z, which each would read.
bool check_frame_words(Run& run) {
  const Block& block = run.block;
  const bool scales = block.names(kScalingGroup) && block.g[kScalingGroup] == 51;
  const bool mirrors = block.names(kMirrorGroup) && block.g[kMirrorGroup] == kMirrorOn;
  const bool rotates = block.names(kRotationGroup) && block.g[kRotationGroup] == 68;
  const bool is_other = block.names(kStrokeGroup) ||
                        (block.parts.one_shot != Block::kNoCode && block.parts.one_shot != 9);
  const int users = int{scales} + int{mirrors} + int{rotates};
  if (users == 0 || users + int{is_other} == 1) return true;
  return run.fail(ErrorCode::ImproperCommand, block.parts.g_column,
                  "two codes of the block take X, Y and Z");
}

}  // namespace

bool apply_transformations(Run& run) {
  const Block& block = run.block;
  constexpr std::uint32_t kGroups = 1u << kMirrorGroup | 1u << kScalingGroup | 1u << kRotationGroup;
  if ((block.parts.groups & kGroups) == 0) return true;
  return check_frame_words(run) && (!block.names(kMirrorGroup) || apply_mirror(run)) &&
         (!block.names(kScalingGroup) || apply_scaling(run)) &&
         (!block.names(kRotationGroup) || apply_rotation(run));
}

void take_data_words(Run& run) {
  const Block& block = run.block;
  const std::uint8_t rotation = block.names(kRotationGroup) ? block.g[kRotationGroup] : 69;
  if (rotation == kTiltedPlane) return run.ledger.take_all();
  AddressSet taken = set_of(X, Y, Z);
  if (rotation == 68) {
    const PlaneAxes axes = axes_of(run.state.plane());
    taken = set_of_axis(axes.first) | set_of_axis(axes.second) | set_of(R);
  } else if (!block.names(kMirrorGroup)) {
    taken |= kCenterWords;
  }
  run.ledger.take(taken);
}

namespace {

std::string_view frame_code_name(FrameCode code) {
  constexpr std::array<std::string_view, 6> kNames{"G68", "G69", "G51", "G50", "G51.1", "G50.1"};
  return kNames[static_cast<std::size_t>(code)];
}

}  // namespace

bool check_open_axes(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  constexpr std::array<Address, 3> kNames{X, Y, Z};
  unsigned named = 0;
  for (std::size_t i = 0; i < 3; ++i) named |= unsigned{words.has(kNames[i])} << i;
  const std::uint8_t one_shot = run.block.parts.one_shot;
  if ((named & state.open_axes) == 0 || one_shot == 28 || one_shot == 30) return true;
  if (state.is_incremental()) {
    if (!ends_frame(state.opened_by)) return true;
    return run.fail(
        ErrorCode::ImproperCommand, words.first_column(kAxisWords),
        fmt::format("the first move after {} is one of G90", frame_code_name(state.opened_by)));
  }
  if (state.is_polar()) named = state.open_axes;
  if (const unsigned missing = state.open_axes & ~named; missing != 0) {
    const char name = letter(kNames[static_cast<std::size_t>(std::countr_zero(missing))]);
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kAxisWords),
                    fmt::format("the first move after {} names {} too",
                                frame_code_name(state.opened_by), name));
  }
  state.open_axes = static_cast<std::uint8_t>(state.open_axes & ~named);
  return true;
}

}  // namespace dripline::interpreter::fanuc
