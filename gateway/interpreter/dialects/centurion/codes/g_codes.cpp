#include "gateway/interpreter/dialects/centurion/codes/g_codes.hpp"

#include "gateway/interpreter/dialects/centurion/codes/modes.hpp"
#include "gateway/interpreter/dialects/centurion/codes/reference_points.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/cycle_words.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

using enum Address;
using Group = ModalGroup;
using Name = std::string_view;
using Set = bool (*)(Run&, const GRow&);
using Act = bool (*)(Run&);

constexpr AddressSet kNone = 0;
constexpr AddressSet kAllWords = (AddressSet{1} << kAddressCount) - 1;
constexpr AddressSet kHoleWords = set_of(R, Z);
constexpr AddressSet kGrooveWords = set_of(R, Z, X, V, Q, E, U, D, A, C);
constexpr AddressSet kRoughingWords = set_of(P, Q, U, W, I, K, V, D, R);
constexpr AddressSet kMultipleThreadWords = set_of(X, Z, U, W, I, Q, D, A, P, K);

constexpr GRow motion(std::uint16_t code, Name name) {
  return {.code = code,
          .group = Group::Motion,
          .words = kLineWords,
          .name = name,
          .set = set_motion,
          .kind = GKind::Motion};
}
constexpr GRow mode(std::uint16_t code, Group group, Set set, Name name) {
  return {.code = code, .group = group, .words = kNone, .name = name, .set = set};
}
/// It does its work with the modes of the block, and once.
constexpr GRow once(std::uint16_t code, AddressSet words, Set set, Name name) {
  return {.code = code, .group = Group::OneShot, .words = words, .name = name, .set = set};
}
constexpr GRow before_move(std::uint16_t code, Set function, Name name) {
  return {
      .code = code, .group = Group::OneShot, .words = kNone, .name = name, .before_move = function};
}
constexpr GRow action(std::uint16_t code, Group group, AddressSet words, Act act, Name name) {
  return {.code = code, .group = group, .words = words, .name = name, .act = act};
}
constexpr GRow action(std::uint16_t code, AddressSet words, Act act, Name name) {
  return action(code, Group::OneShot, words, act, name);
}
constexpr GRow cycle(std::uint16_t code, AddressSet words, Act act, Name name) {
  return {.code = code,
          .group = Group::OneShot,
          .words = words,
          .name = name,
          .act = act,
          .kind = GKind::Cycle};
}
constexpr GRow thread_line(std::uint16_t code, Name name) {
  return {.code = code,
          .group = Group::OneShot,
          .words = set_of(E, Q),
          .name = name,
          .kind = GKind::ThreadLine};
}
/// Cancels what is never on here, or has no effect on this control.
constexpr GRow without_effect(std::uint16_t code, Group group, Name name) {
  return {.code = code, .group = group, .words = kNone, .name = name};
}
constexpr GRow dwell(std::uint16_t code, Name name) {
  return {
      .code = code, .group = Group::OneShot, .words = kNone, .name = name, .kind = GKind::Dwell};
}

constexpr std::array kGRows{
    motion(0, "positioning"),
    motion(1, "linear interpolation"),
    motion(2, "circular interpolation clockwise"),
    motion(3, "circular interpolation counterclockwise"),
    dwell(4, "dwell"),
    once(9, kNone, set_exact_stop, "exact stop"),
    mode(10, Group::Data, set_data_mode, "set data on"),
    mode(11, Group::Data, set_data_mode, "set data off"),
    before_move(12, clear_floating_zero, "clear floating zero"),
    without_effect(18, Group::OneShot, "ZX plane"),
    mode(20, Group::Units, set_units, "inch"),
    mode(21, Group::Units, set_units, "metric"),
    mode(22, Group::SafeZone, set_safe_zone, "safe zone check on"),
    mode(23, Group::SafeZone, set_safe_zone, "safe zone check off"),
    action(28, kEndWords, go_to_reference, "reference return"),
    action(29, kEndWords, return_from_reference, "return from reference"),
    action(30, kEndWords | set_of(P), go_to_reference, "return to 2nd-4th reference"),
    thread_line(32, "thread line"),
    thread_line(34, "thread line of variable lead"),
    thread_line(35, "thread line"),
    thread_line(36, "thread line"),
    mode(38, Group::ReturnLevel, set_return_level, "return to initial level"),
    mode(39, Group::ReturnLevel, set_return_level, "return to R level"),
    mode(40, Group::Compensation, set_compensation, "nose compensation off"),
    mode(41, Group::Compensation, set_compensation, "nose compensation left"),
    mode(42, Group::Compensation, set_compensation, "nose compensation right"),
    before_move(45, retract, "Z to clearance"),
    before_move(46, retract, "X to clearance"),
    before_move(47, retract, "Z to tool change position"),
    before_move(48, retract, "X to tool change position"),
    once(49, kNone, cancel_tool_length, "cancel tool length offsets"),
    action(50, set_of(X, Z), set_floating_zero, "set floating zero"),
    action(52, set_of(X, Z), set_local_zero, "local coordinates"),
    action(53, set_of(X, Z), move_in_machine, "machine coordinates"),
    mode(54, Group::WorkSystem, set_work_system, "work system 1"),
    mode(55, Group::WorkSystem, set_work_system, "work system 2"),
    mode(56, Group::WorkSystem, set_work_system, "work system 3"),
    mode(57, Group::WorkSystem, set_work_system, "work system 4"),
    mode(58, Group::WorkSystem, set_work_system, "work system 5"),
    mode(59, Group::WorkSystem, set_work_system, "work system 6"),
    action(60, kLineWords, move, "single direction rapid"),
    mode(61, Group::PathMode, set_path_mode, "exact stop mode"),
    mode(63, Group::PathMode, set_path_mode, "tapping mode"),
    mode(64, Group::PathMode, set_path_mode, "cutting mode"),
    action(65, kAllWords, call_or_suppress, "macro call or non-movement block"),
    cycle(70, set_of(P, Q), plan_pattern_cycle, "finish cycle"),
    cycle(71, kRoughingWords, plan_pattern_cycle, "rough turning"),
    cycle(72, kRoughingWords, plan_pattern_cycle, "rough facing"),
    cycle(73, set_of(P, Q, U, W, I, K, D), plan_pattern_cycle, "pattern repeat"),
    cycle(74, kGrooveWords | set_of(I), run_groove_cycle, "face grooving"),
    cycle(75, kGrooveWords | set_of(K), run_groove_cycle, "diameter grooving"),
    cycle(76, kMultipleThreadWords, cut_multiple_thread, "multiple thread cycle"),
    without_effect(80, Group::Cycle, "cancel canned cycle"),
    cycle(81, kHoleWords, run_drilling_cycle, "drill"),
    cycle(82, kHoleWords | set_of(P), run_drilling_cycle, "drill with dwell"),
    cycle(83, kHoleWords | set_of(V, Q, E), run_drilling_cycle, "peck drill"),
    cycle(84, kHoleWords, run_drilling_cycle, "tap"),
    cycle(85, kHoleWords, run_drilling_cycle, "bore"),
    cycle(86, kHoleWords, run_drilling_cycle, "bore with spindle stop"),
    cycle(89, kHoleWords | set_of(P), run_drilling_cycle, "bore with dwell"),
    cycle(90, set_of(X, Z, U, W, I), cut_turning_box, "turning cycle"),
    mode(91, Group::Distance, set_distance_mode, "incremental"),
    cycle(92, set_of(X, Z, U, W, I, Q), cut_single_thread, "thread cycle"),
    mode(93, Group::Distance, set_distance_mode, "absolute"),
    cycle(94, set_of(X, Z, U, W, K), cut_facing_box, "facing cycle"),
    mode(96, Group::SpindleUnit, set_spindle_unit, "constant surface speed"),
    mode(97, Group::SpindleUnit, set_spindle_unit, "revolutions per minute"),
    mode(98, Group::FeedUnit, set_feed_unit, "feed per minute"),
    mode(99, Group::FeedUnit, set_feed_unit, "feed per revolution"),
    mode(501, Group::Mirror, end_mirror, "mirror off"),
    action(511, Group::Mirror, set_of(X, Z), set_mirror, "mirror on"),
    mode(550, Group::Scaling, end_scaling, "scaling off"),
    action(551, Group::Scaling, set_of(I, K, X, Z, P), set_scaling, "scaling on"),
    action(568, Group::Rotation, set_of(AA, I, K, X, Z, R), set_rotation, "rotation on"),
    mode(569, Group::Rotation, end_rotation, "rotation off"),
    once(990, set_of(P, L, Q), save_parameters, "store parameters in a file"),
    once(991, set_of(P, L, Q), load_parameters, "restore parameters from a file"),
    once(995, kNone, read_byte_parameter, "read byte parameter"),
    once(996, kNone, write_byte_parameter, "write byte parameter"),
    once(997, kNone, force_error, "force error"),
    once(998, kNone, beep, "beep"),
    once(999, kNone, force_fatal_error, "force fatal error"),
};
static_assert(kGRows.size() < kNoRow);

constexpr std::array<std::uint8_t, 1000> index_by_code() {
  std::array<std::uint8_t, 1000> index{};
  for (auto& entry : index) entry = kNoRow;
  for (std::size_t row = 0; row < kGRows.size(); ++row) {
    index[kGRows[row].code] = static_cast<std::uint8_t>(row);
  }
  return index;
}
constexpr auto kIndex = index_by_code();

}  // namespace

std::uint8_t g_row_index(unsigned code) {
  return code < kIndex.size() ? kIndex[code] : kNoRow;
}
const GRow& g_row(std::uint8_t index) {
  return kGRows[index];
}

}  // namespace dripline::interpreter::centurion
