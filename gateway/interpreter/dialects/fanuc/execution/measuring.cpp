#include "gateway/interpreter/dialects/fanuc/execution/measuring.hpp"

#include <fmt/core.h>
#include <bit>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"

namespace dripline::interpreter::fanuc {
namespace {

bool check(Run& run) {
  const ModalState& state = run.state;
  const ControlOptions& options = run.options;
  const AddressSet axes = run.block.words.present() & kAxisWords;
  if (!(options.measuring_rapid_end > 0 && options.measuring_feed > 0)) {
    return run.fail_at_g(ErrorCode::ImproperG,
                         "G37 needs g37_clearance, g37_tolerance and g37_feed in the setup");
  }
  if (run.block.words.has(H)) return run.fail_at_g(ErrorCode::MeasuringWords, {});
  if (std::popcount(axes) != 1 || (axes & set_of(X, Y, Z)) == 0) {
    return run.fail_at_g(ErrorCode::MeasuringFormat, "one of X, Y and Z");
  }
  if (state.is_incremental()) return run.fail_at_g(ErrorCode::MeasuringFormat, "G37 in G91");
  if (state.h_number == 0) return run.fail_at_g(ErrorCode::MeasuringAxis, "no H before it");
  if (state.is_compensating()) return run.fail_at_g(ErrorCode::SkipInCompensation, "G37");
  if (state.is_cycle()) return run.fail_at_g(ErrorCode::HomeInCycle, "G37");
  if (state.is_transformed || state.is_polar())
    return run.fail_at_g(ErrorCode::RotationHome, "G37");
  return true;
}

Axis measured_axis(const Run& run) {
  const AddressSet axes = run.block.words.present() & set_of(X, Y, Z);
  return axes == set_of(X) ? Axis::X : axes == set_of(Y) ? Axis::Y : Axis::Z;
}

}  // namespace

bool start_measuring(Run& run) {
  run.ledger.take(kAxisWords);
  if (!check(run)) return false;
  Position at;
  if (!read_target(run, at)) return false;
  const Axis axis = measured_axis(run);
  const double travel = at.raw(axis) - run.state.position.raw(axis);
  const double sign = travel < 0 ? -1 : 1;
  if (!(std::fabs(travel) > run.options.measuring_tolerance)) {
    return run.fail_at_g(ErrorCode::NotMeasured, "the tool is at the position already");
  }
  Position before = at;
  before.set_raw(axis, at.raw(axis) - sign * run.options.measuring_rapid_end);
  const bool is_closer = std::fabs(travel) <= run.options.measuring_rapid_end;
  if (!is_closer && !rapid_to(run, before)) return false;
  Position beyond = at;
  beyond.set_raw(axis, at.raw(axis) + sign * run.options.measuring_tolerance);
  if (!check_stroke(run, beyond) || !end_waiting(run)) return false;
  ProbeQuestion question;
  question.probe = {run.origin,
                    run.state.position,
                    beyond,
                    ProbeUntil::Contact,
                    Feed::per_minute(Length::mm(run.options.measuring_feed)),
                    {}};
  question.probe.from.mark_all_of(beyond);
  run.events();  // the header comes before anything the question brings about
  return run.ask(question);
}

bool finish_measuring(Run& run, const ProbeResult& result) {
  const Axis axis = measured_axis(run);
  run.ledger.take(kAxisWords);
  const Position at = finish_probe(run, result);
  const auto i = static_cast<std::size_t>(axis);
  const double expected =
      run.state.origin[i] + run.coordinate(axis, run.block.words[kWordOfAxis[i]]);
  const double off = at.raw(axis) - expected;
  if (!result.tripped || std::fabs(off) > run.options.measuring_tolerance) {
    return run.fail_at_g(ErrorCode::NotMeasured,
                         result.tripped
                             ? fmt::format("{:.6g} from the position", run.in_units(axis, off))
                             : std::string("no signal"));
  }
  // G44 has the offset with the other sign.
  const double change = run.state.g[kLengthGroup] == 44 ? -off : off;
  const OffsetRegister cell = offset_of_g10(run, 11, run.state.h_number);
  write_register(run, cell, read_register(cell) + change, run.block.parts.g_column);
  return true;
}

}  // namespace dripline::interpreter::fanuc
