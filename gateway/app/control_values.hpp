#pragma once

#include <string>

#include "gateway/app/control_memory.hpp"
#include "gateway/app/execution_recorder.hpp"

namespace dripline::gateway {

struct ValueQuery {
  std::string beginning;        ///< of the names; empty: all
  std::size_t passed_over = 0;  ///< of the values with such a name
};

/// What a query is answered with, as JSON of at most kMaxCommandSetup bytes: {"values": [{"name",
/// "value"}], "next", "outputs": [{"axis", "output", "on"}], "codes"}. `value` is null for a
/// vacant one, `next` is how many to pass over for the rest, or null; `outputs` are those that
/// programs have switched, `codes` the M functions handed to the machine, the last one first.
std::string control_values(const ValueQuery& query, const ControlMemory& memory,
                           const ExecutionRecorder& recorder);

}  // namespace dripline::gateway
