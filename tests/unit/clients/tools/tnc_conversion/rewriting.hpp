#pragma once

#include <string>
#include <string_view>

#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

namespace dripline::tnc_conversion {

using interpreter::tnc155::Form;
using interpreter::tnc155::ReadingState;

/// Reads a text and writes it in the control's layout, LF at line ends; a fault ends it as
/// "line:column text".
std::string rewritten(std::string_view text, Form form = Form::Unknown);

/// The parts of all blocks, as plain language without numbers; faults as above.
std::string parts_of(std::string_view text, ReadingState state = {});

/// In windows of this many bytes.
std::string rewritten_in_windows(std::string_view text, std::size_t window);

}  // namespace dripline::tnc_conversion
