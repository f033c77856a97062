#include "gateway/interpreter/tnc155/cycles.hpp"

#include <fmt/core.h>

namespace dripline::interpreter::tnc155 {

bool define_cycle(Run& run, const Block& block) {
  return run.fail(ErrorCode::NotSupported, fmt::format("CYCL DEF {}", block.cycle));
}

bool is_defining(const Run&) {
  return false;
}

bool call_cycle(Run& run) {
  return run.fail(ErrorCode::NotSupported, "CYCL CALL");
}

void end_cycles(Run& run) {
  run.state.cycle = CycleState{};
  if (run.options.cancels_transformations) run.state.transformation.cancel_cycles();
}

bool probe(Run& run, const Block&) {
  return run.fail(ErrorCode::NotSupported, "TCH PROBE");
}

}  // namespace dripline::interpreter::tnc155
