#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Which call, return or end a block asks for: found while it is executed, done when it is left
/// (flow.hpp). False: an alarm.
namespace dripline::interpreter::fanuc {

/// M02, M30, M98, M99 of the block.
bool plan_flow_of_m_codes(Run& run);
/// G65, G66 and codes that call.
bool plan_macro_call(Run& run);
/// After a block with motion while G66 is in force.
bool plan_modal_call(Run& run);
/// G67
void cancel_modal_call(Run& run);

}  // namespace dripline::interpreter::fanuc
