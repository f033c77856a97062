#include "gateway/interpreter/dialects/fanuc/execution/rotary_plane.hpp"

#include <fmt/core.h>
#include <bit>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {
namespace {

bool refuse_mode(Run& run, std::string_view why) {
  return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column, why);
}

/// What both modes need of the state they begin and end in.
bool check_state(Run& run) {
  const ModalState& state = run.state;
  if (state.is_compensating()) return refuse_mode(run, "G12.1, G13.1 and G07.1 need G40");
  if (state.is_cycle()) return refuse_mode(run, "G12.1, G13.1 and G07.1 in a hole cycle");
  if (state.is_transformed || state.is_polar() || state.imaginary != 0) {
    return refuse_mode(run, "G12.1 and G07.1 under G16, G07, G51, G51.1 or G68");
  }
  if (run.tilted.is_on()) return refuse_mode(run, "G12.1 and G07.1 under G68.2 or G43.4");
  if (run.options.checks_stroke() || state.zone.is_on) {
    return refuse_mode(run, "G12.1 and G07.1 while stroke limits are checked");
  }
  if (!end_waiting(run)) return false;
  run.compensator.flush();
  return check_compensation(run);
}

void begin_mode(Run& run, RotaryPlane plane) {
  ModalState& state = run.state;
  run.events();  // the header first
  plane.held = state.position.raw(plane.slot);
  plane.slot_has_moved = state.position.has(plane.slot);
  plane.plane_before = state.g[kPlaneGroup];
  plane.start_degrees = state.position.raw(plane.rotary);
  plane.zero_slot = state.origin[static_cast<std::size_t>(plane.slot)];
  plane.zero_partner = state.origin[static_cast<std::size_t>(plane.partner)];
  state.position.set_raw(plane.slot, plane.zero_slot);
  state.rotary = plane;
  run.rotary.begin(plane, state.position);
  run.place_stages();
}

void end_mode(Run& run) {
  ModalState& state = run.state;
  const RotaryPlane& plane = state.rotary;
  if (run.state.uses_compensator) {
    run.blender.flush();
    run.compensator.flush();
  }
  // The partner is where the path has led it: at its distance from the center.
  if (plane.kind == RotaryPlane::Kind::Polar) {
    const double along = state.position.raw(plane.partner) - plane.zero_partner;
    const double across = state.position.raw(plane.slot) - plane.zero_slot;
    state.position.set_raw(plane.partner, plane.zero_partner + std::hypot(along, across));
  }
  state.position.set_raw(plane.slot, plane.held);
  if (!plane.slot_has_moved) state.position.unmark(plane.slot);
  state.position.set_raw(plane.rotary, run.rotary.degrees());
  state.g[kPlaneGroup] = plane.plane_before;
  run.rotary.end();
  state.rotary.kind = RotaryPlane::Kind::None;
  run.place_stages();
}

}  // namespace

bool set_polar_plane(Run& run) {
  ModalState& state = run.state;
  const bool begins = run.block.g[kInterpolationGroup] == kPolarPlaneOn;
  if (begins == (state.rotary.kind == RotaryPlane::Kind::Polar)) return true;
  if (begins && state.rotary.kind != RotaryPlane::Kind::None)
    return refuse_mode(run, "G12.1 in G07.1");
  if (!check_state(run)) return false;
  if (run.block.words.has_any(kAxisWords)) {
    return refuse_mode(run, "G12.1 and G13.1 are alone in their block");
  }
  if (begins) {
    const double from_center = state.position.raw(Axis::X) - state.origin[0];
    if (!(from_center > 0)) {
      return refuse_mode(run, "G12.1 begins at X above 0: the center of rotation is X0");
    }
    begin_mode(run, {.kind = RotaryPlane::Kind::Polar});
    state.g[kPlaneGroup] = 17;
  } else {
    end_mode(run);
  }
  state.g[kInterpolationGroup] = run.block.g[kInterpolationGroup];
  return true;
}

bool set_cylinder(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const AddressSet axes = words.present() & kAxisWords;
  run.ledger.take(kAxisWords);
  if (std::popcount(axes) != 1 || (axes & kRotaryWords) == 0) {
    return refuse_mode(run, "G07.1 takes one of A, B and C, with the radius of the cylinder");
  }
  const auto address = static_cast<Address>(std::countr_zero(axes));
  const double radius = run.length(words[address]);
  const Axis rotary = address == A ? Axis::A : address == B ? Axis::B : Axis::C;
  if (radius < 0) return run.fail(ErrorCode::NegativeSign, words.column(address));
  if (!check_state(run)) return false;
  if (radius == 0) {
    if (state.rotary.kind != RotaryPlane::Kind::Cylinder) return true;
    if (state.rotary.rotary != rotary)
      return refuse_mode(run, "G07.1 ends with the axis it began with");
    end_mode(run);
    return true;
  }
  if (state.rotary.kind != RotaryPlane::Kind::None)
    return refuse_mode(run, "G07.1 in G12.1 or G07.1");
  // The axis of the cylinder is in the plane; the surface runs along the other axis.
  const Axis along = rotary == Axis::A ? Axis::X : rotary == Axis::B ? Axis::Y : Axis::Z;
  const PlaneAxes plane = axes_of(state.plane());
  if (plane.normal == along) {
    return refuse_mode(
        run, fmt::format("the plane of G07.1 {} needs {} in it", letter(rotary), letter(along)));
  }
  begin_mode(run, {.kind = RotaryPlane::Kind::Cylinder,
                   .rotary = rotary,
                   .slot = plane.first == along ? plane.second : plane.first,
                   .partner = along,
                   .radius = radius});
  return true;
}

bool check_rotary_block(Run& run) {
  const Block& block = run.block;
  const ModalState& state = run.state;
  const std::uint8_t one_shot = block.parts.one_shot;
  const bool is_allowed_shot = one_shot == Block::kNoCode || one_shot == 4 || one_shot == 9 ||
                               one_shot == 39 || one_shot == kCylinder;
  constexpr std::uint32_t kExcluded = 1u << kPlaneGroup | 1u << kCycleGroup | 1u << kScalingGroup |
                                      1u << kMirrorGroup | 1u << kRotationGroup | 1u << kWorkGroup |
                                      1u << kPolarGroup | 1u << kUnitsGroup | 1u << kStrokeGroup;
  if (is_allowed_shot && (block.parts.groups & kExcluded) == 0) {
    const bool is_move = one_shot == Block::kNoCode || one_shot == 9;
    if (!is_move || !block.words.has_any(kAxisWords)) return true;
    const std::uint8_t motion =
        block.names(kMotionGroup) ? block.g[kMotionGroup] : state.g[kMotionGroup];
    if (motion >= 1 && motion <= 3) return true;
  }
  return refuse_mode(run, "in G12.1 and G07.1 there are G01 to G03, G04, G09, G40 to G42 only");
}

bool read_rotary_target(Run& run, Position& to) {
  const RotaryPlane& plane = run.state.rotary;
  const Words& words = run.block.words;
  const Address rotary = kWordOfAxis[static_cast<std::size_t>(plane.rotary)];
  AddressSet taken = 0;
  const bool is_incremental = run.state.is_incremental();
  const auto take = [&](Axis axis, Address address) {
    if (!words.has(address)) return;
    taken |= set_of(address);
    const double value =
        address == rotary ? run.length(words[address]) : run.coordinate(axis, words[address]);
    const double base =
        is_incremental ? to.raw(axis) : run.state.origin[static_cast<std::size_t>(axis)];
    to.set_raw(axis, base + value);
  };
  const bool is_cylinder = plane.kind == RotaryPlane::Kind::Cylinder;
  if (is_cylinder && words.has(rotary)) {
    // degrees on the surface: the word keeps its unit, the path is its length
    taken |= set_of(rotary);
    const double degrees = run.angle(words[rotary]);
    const double zero = run.state.origin[static_cast<std::size_t>(plane.rotary)];
    const double on_surface = plane.radius * (Angle::kPi / 180);
    const double base = is_incremental
                            ? to.raw(plane.slot)
                            : plane.zero_slot + (zero - plane.start_degrees) * on_surface;
    to.set_raw(plane.slot, base + degrees * on_surface);
  } else if (!is_cylinder) {
    take(plane.slot, rotary);
  }
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    if (axis != plane.slot) take(axis, kWordOfAxis[static_cast<std::size_t>(axis)]);
  }
  const AddressSet left = words.present() & kAxisWords & ~taken;
  if (left == 0) return true;
  return run.fail(ErrorCode::ImproperCommand, words.first_column(left),
                  "an axis that is not of the plane of G12.1 or G07.1");
}

bool check_last_stage(Run& run) {
  if (const auto& fault = run.tilted.fault()) {
    run.origin.line = fault->origin.line;
    return run.fail(fault->is_travel ? ErrorCode::OverTravel : ErrorCode::TipControl, 0,
                    fault->text);
  }
  if (!run.rotary.has_fault()) return true;
  return run.fail(ErrorCode::ImproperCommand, 0,
                  "the path of G12.1 goes through the center of rotation");
}

}  // namespace dripline::interpreter::fanuc
