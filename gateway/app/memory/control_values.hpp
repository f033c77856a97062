#pragma once

#include <string>

#include "gateway/app/execution_recorder.hpp"
#include "gateway/app/memory/control_memory.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

struct ValueQuery {
  std::string beginning;        ///< of the names; empty: all
  std::size_t passed_over = 0;  ///< of the values with such a name
};

/// What a query is answered with, as JSON of at most kMaxCommandSetup bytes: {"values": [{"name",
/// "value"}], "next", "outputs": [{"axis", "output", "on"}], "analog": [{"output", "value"}],
/// "codes", "functions", "inputs": [{"name", "on"}]}. `value` is null for a vacant one, `next` is
/// how many to pass over for the rest, or null; `outputs` are those that programs have switched,
/// `analog` those that M67 and M68 have set, `codes` the M functions handed to the machine, the
/// last one first, and `functions` the same with their words. `inputs` are those that the machine
/// reports at this moment.
std::string control_values(const ValueQuery& query, const ControlMemory& memory,
                           const ExecutionRecorder& recorder,
                           const machine::MotionBackend& machine);

}  // namespace dripline::gateway
