#include "gateway/interpreter/dialects/rs274ngc/execution/execution.hpp"

#include <utility>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

bool is_compensating(const Run& run) {
  return run.state.compensation.side != Side::Off;
}

bool select_plane(Run& run, int code) {
  Modes& modes = run.state.modes;
  const bool is_tilted = code % 10 != 0;
  const Plane plane = code < 180 ? Plane::XY : code < 190 ? Plane::ZX : Plane::YZ;
  const bool is_same = plane == modes.plane && is_tilted == modes.has_tilted_plane;
  if (is_compensating(run) && (run.is_linuxcnc() ? !is_same : plane != Plane::XY)) {
    return run.fail(ErrorCode::CompPlane, 0);
  }
  modes.plane = plane;
  modes.has_tilted_plane = is_tilted;
  return true;
}

/// F comes into force before the units of its line.
[[gnu::cold]] void warn_of_feed(Run& run) {
  if (run.state.modes.feed == FeedMode::InverseTime) return;
  const bool is_inch = run.state.feed_units == Units::Inch;
  run.warn(kFeedBeforeUnits, is_inch ? "F counts in inches: this line's G21 comes after it"
                                     : "F counts in millimeters: this line's G20 comes after it");
}

bool select_units(Run& run, int code) {
  const Units units = code == 200 ? Units::Inch : Units::Millimeter;
  if (is_compensating(run) && !run.is_linuxcnc()) return run.fail(ErrorCode::CompUnits, 0);
  const bool changes = units != run.state.units;
  change_units(run, units);
  if (changes && run.is_linuxcnc() && run.block.words.has('F')) warn_of_feed(run);
  return true;
}

bool select_path(Run& run, int code) {
  if (is_compensating(run) && run.is_linuxcnc()) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the path mode");
  }
  Modes& modes = run.state.modes;
  modes.path = static_cast<std::int16_t>(code);
  modes.path_tolerance = run.block.words.value_or('P', 0);
  modes.cam_tolerance = run.block.words.value_or('Q', modes.path_tolerance);
  return true;
}

/// X of the same line, which was read in the mode before, is a diameter with G7 and none with G8.
void select_diameters(Run& run, bool is_diameter) {
  Words& words = run.block.words;
  const bool changes = std::exchange(run.state.modes.is_diameter, is_diameter) != is_diameter;
  if (changes && words.has('X'))
    words.set(address_of('X'), words['X'] * (is_diameter ? 0.5 : 2), words.column('X'));
}

/// Those that few lines have.
bool apply_rare_modes(Run& run) {
  const Block& block = run.block;
  if (const int code = block.g(GGroup::Plane); code >= 0 && !select_plane(run, code)) return false;
  if (const int code = block.g(GGroup::Units); code >= 0 && !select_units(run, code)) return false;
  if (const int code = block.g(GGroup::Lathe); code >= 0) select_diameters(run, code == 70);
  if (const int code = block.g(GGroup::Radius); code >= 0 && !switch_compensation(run, code)) {
    return false;
  }
  if (const int code = block.g(GGroup::Length); code >= 0 && !set_length_offset(run, code)) {
    return false;
  }
  if (const int code = block.g(GGroup::System); code >= 0 && !select_system(run, code)) {
    return false;
  }
  if (const int code = block.g(GGroup::Path); code >= 0 && !select_path(run, code)) return false;
  return true;
}

}  // namespace

void change_units(Run& run, Units units) {
  State& state = run.state;
  if (units == state.units) return;
  state.units = units;
  // NIST's F is a number that the units in force give its meaning; LinuxCNC's is a speed.
  if (!run.is_linuxcnc()) state.feed_units = units;
  if (state.has_header) run.events().on_units({run.origin, units});
}

bool apply_feed(Run& run) {
  State& state = run.state;
  const Block& block = run.block;
  if (const int code = block.g(GGroup::FeedMode); code >= 0) {
    const FeedMode mode = code == 930   ? FeedMode::InverseTime
                          : code == 940 ? FeedMode::PerMinute
                                        : FeedMode::PerRevolution;
    // A rate means nothing in another mode. LinuxCNC forgets it with each G94 and G95, and
    // remembers it in G93 for M72.
    const bool forgets =
        run.is_linuxcnc() ? mode != FeedMode::InverseTime : mode != state.modes.feed;
    if (forgets) state.feed = 0;
    if (mode != state.modes.feed) state.has_lost_lead = false;
    state.modes.feed = mode;
  }
  if (block.words.has('F') && state.modes.feed != FeedMode::InverseTime) {
    state.feed = block.words['F'];
    state.feed_units = state.units;
    state.has_lost_lead = false;
  }
  return true;
}

bool apply_modes(Run& run) {
  const auto bit = [](GGroup group) { return 1u << static_cast<unsigned>(group); };
  constexpr unsigned kRare = bit(GGroup::Plane) | bit(GGroup::Units) | bit(GGroup::Lathe) |
                             bit(GGroup::Radius) | bit(GGroup::Length) | bit(GGroup::System) |
                             bit(GGroup::Path);
  const Block& block = run.block;
  if ((block.g_groups & kRare) != 0 && !apply_rare_modes(run)) return false;
  Modes& modes = run.state.modes;
  if (const int code = block.g(GGroup::Distance); code >= 0) modes.is_incremental = code == 910;
  if (const int code = block.g(GGroup::ArcDistance); code >= 0) {
    modes.is_arc_absolute = code == 901;
  }
  if (const int code = block.g(GGroup::Retract); code >= 0) {
    if (is_compensating(run) && run.is_linuxcnc()) {
      return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the retract mode");
    }
    modes.retracts_to_start = code == 980;
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
