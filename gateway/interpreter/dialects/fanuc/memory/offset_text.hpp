#pragma once

#include <string>

#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter::fanuc {

/// Tools, work offsets and variables of a setup as a program that puts them into the control: G10
/// with L2, L20, L10 to L13 by the control's offset memory, on a lathe P1 and P10001 on; #500 = ...
/// In the setup's units, to the control's least increment. It has no O number: a control would keep
/// it under that in the place of another. Errors: those of read_options and load_memory;
/// Unsupported (what the control has no number for: a wear in offset memory A, a length and a
/// radius of one tool in A and B, G52 and G92, a cell of the kept memory); LimitExceeded (over
/// 999.999 mm).
Result<std::string> write_offset_text(const Setup& setup, bool is_lathe);

}  // namespace dripline::interpreter::fanuc
