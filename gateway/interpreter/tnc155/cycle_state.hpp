#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/event.hpp"
#include "gateway/interpreter/tnc155/block.hpp"

namespace dripline::interpreter::tnc155 {

/// What cycle definitions leave for calls and for later blocks. Part of the run's state; whoever
/// adds a member adds it to `visit_cycle_state` as well.
struct CycleState {
  bool is_modal_call = false;  ///< M89
};

template <class Archive>
void visit_cycle_state(Archive& archive, CycleState& cycle) {
  archive(cycle.is_modal_call);
}

}  // namespace dripline::interpreter::tnc155
