#pragma once

#include "gateway/interpreter/centurion/modal_state.hpp"
#include "gateway/interpreter/centurion/parameters.hpp"
#include "gateway/interpreter/setup.hpp"

namespace dripline::interpreter::centurion {

/// The control's memory at the start of a run: modes, offsets, tools, parameters.
/// Errors: Unsupported, naming the record of the setup that this control does not have.
Result<void> load_memory(const Setup& setup, ModalState& state, Parameters& parameters);

}  // namespace dripline::interpreter::centurion
