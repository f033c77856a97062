#include "gateway/interpreter/stages/tilting/kinematic_options.hpp"

#include <cmath>

namespace dripline::interpreter::tilting {
namespace {

constexpr std::string_view kMaster = "rotary_master", kSlave = "rotary_slave",
                           kTables = "table_centers", kHeads = "head_centers",
                           kLimits = "rotary_limits", kTolerance = "tip_tolerance",
                           kFrame = "table_frame";

const OptionKey& key_of(std::string_view name) {
  for (const OptionKey& row : kKinematicKeys) {
    if (row.key == name) return row;
  }
  return kKinematicKeys.front();
}

Result<void> refuse_keys_without(const Options& options) {
  for (const OptionKey& row : kKinematicKeys) {
    if (row.key == kKinematicKeys.front().key || options.find(row.key) == nullptr) continue;
    return fail(Errc::Syntax, "[control] {}: it needs kinematics, which is none", row.key);
  }
  return {};
}

Result<void> read_axis(const Options& options, std::string_view name, RotaryAxis& rotary) {
  if (options.find(name) == nullptr)
    return fail(Errc::Syntax, "[control] {}: kinematics needs it", name);
  const auto word = read_word(options, key_of(name), 0);
  if (!word) return fail(word.error());
  rotary.axis = static_cast<Axis>(static_cast<std::size_t>(Axis::A) + *word / 2);
  rotary.is_reversed = *word % 2 != 0;
  return {};
}

/// With parallel axes, or one that rotates a table or a tool about the tool's own axis, there are
/// directions that the tool cannot take.
Result<void> check_axes(const Kinematics& machine) {
  if (machine.master.axis == machine.slave.axis) {
    return fail(Errc::Syntax, "[control] rotary_slave: {} is the master's axis, too",
                letter(machine.slave.axis));
  }
  const bool is_slave = machine.type == KinematicType::HeadHead;
  if ((is_slave ? machine.slave : machine.master).axis == Axis::C) {
    return fail(Errc::Syntax, "[control] {}: C does not tilt the tool against the {}",
                is_slave ? kSlave : kMaster,
                machine.type == KinematicType::TableTable ? "table" : "workpiece");
  }
  return {};
}

/// Two of the coordinates place an axis; the third, along it, is free.
Result<void> read_center(std::string_view name, const Position& given, RotaryAxis& rotary) {
  constexpr double kFar = 100'000;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (!given.has(axis) && i != rotary.direction()) {
      return fail(Errc::Syntax, "[control] {}: the point on the axis of {} has no {}", name,
                  letter(rotary.axis), letter(axis));
    }
    const double at = given.raw(axis);
    if (!(std::fabs(at) <= kFar)) {
      return fail(Errc::Syntax, "[control] {}: {} {} mm is beyond {}", name, letter(axis), at,
                  kFar);
    }
    rotary.center[i] = at;
  }
  return {};
}

Result<void> read_centers(const Options& options, Kinematics& machine) {
  for (const bool of_tables : {true, false}) {
    const std::string_view name = of_tables ? kTables : kHeads;
    const auto points = options.positions(name);
    if (!points) return fail(points.error());
    std::size_t used = 0;
    for (RotaryAxis* rotary : {&machine.master, &machine.slave}) {
      if (rotary->is_table != of_tables) continue;
      if (used == points->size()) {
        return fail(Errc::Syntax, "[control] {}: no point for {}", name, letter(rotary->axis));
      }
      if (auto done = read_center(name, (*points)[used++], *rotary); !done) return done;
    }
    if (used != points->size()) {
      return fail(Errc::Syntax, "[control] {}: {} points, this machine has {} such axes", name,
                  points->size(), used);
    }
  }
  return {};
}

Result<void> read_limits(const Options& options, Kinematics& machine) {
  const auto corners = options.positions(kLimits);
  if (!corners) return fail(corners.error());
  if (corners->empty()) return {};
  if (corners->size() != 2)
    return fail(Errc::Syntax, "[control] rotary_limits: expected the lowest and the highest");
  machine.has_limits = true;
  for (RotaryAxis* rotary : {&machine.master, &machine.slave}) {
    const Position& low = (*corners)[0];
    const Position& high = (*corners)[1];
    if (low.has(rotary->axis)) rotary->low = low.raw(rotary->axis);
    if (high.has(rotary->axis)) rotary->high = high.raw(rotary->axis);
    if (rotary->low <= rotary->high) continue;
    return fail(Errc::Syntax, "[control] rotary_limits: {} {} to {} is no range",
                letter(rotary->axis), rotary->low, rotary->high);
  }
  return {};
}

Result<void> read_others(const Options& options, Kinematics& machine) {
  constexpr double kFinest = 0.0001;
  constexpr double kCoarsest = 1;
  if (auto done = read_value(options, key_of(kTolerance), machine.tip_tolerance); !done)
    return done;
  if (!(machine.tip_tolerance >= kFinest && machine.tip_tolerance <= kCoarsest)) {
    return fail(Errc::Syntax, "[control] tip_tolerance: {} mm is not {} to {}",
                machine.tip_tolerance, kFinest, kCoarsest);
  }
  return read_value(options, key_of(kFrame), machine.begins_at_present);
}

}  // namespace

Result<void> read_kinematics(const Options& options, const OptionKey& key, Kinematics& machine) {
  if (auto done = read_value(options, key, machine.type); !done) return done;
  if (!machine.exists()) return refuse_keys_without(options);
  machine.master.is_table = machine.type == KinematicType::TableTable;
  machine.slave.is_table = machine.type != KinematicType::HeadHead;
  if (auto done = read_axis(options, kMaster, machine.master); !done) return done;
  if (auto done = read_axis(options, kSlave, machine.slave); !done) return done;
  if (auto done = check_axes(machine); !done) return done;
  if (auto done = read_centers(options, machine); !done) return done;
  if (auto done = read_limits(options, machine); !done) return done;
  return read_others(options, machine);
}

}  // namespace dripline::interpreter::tilting
