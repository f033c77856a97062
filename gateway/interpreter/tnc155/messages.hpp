#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "gateway/interpreter/tnc155/errors.hpp"

/// Everything the control writes into its message line, as data: what a text that came from one
/// (over a line, from an operator) means.
namespace dripline::interpreter::tnc155 {

/// Where a message comes from.
enum class MessageSource : std::uint8_t {
  Program,   ///< a program or its data; raised by our runs with `code`
  Transfer,  ///< the data interface
  Machine,   ///< power, batteries, references, emergency stop
  Probe,     ///< the touch probe's hardware
  Graphics,
};

struct ControlMessage {
  std::string_view text;  ///< the control's wording; `?` stands for a number or an axis
  MessageSource source = MessageSource::Program;
  bool is_error = true;  ///< else it tells what the control is doing
  ErrorCode code = ErrorCode::None;
};

/// All of them, each text once.
std::span<const ControlMessage> control_messages();

struct RecognisedMessage {
  const ControlMessage* message = nullptr;
  std::string_view argument;  ///< what stands in the place of `?`
};
/// The message that a text is, whatever its blanks; a detail behind a colon does not count. The
/// spellings of the manual's index are known as well. Nothing: no message of this control.
std::optional<RecognisedMessage> recognise_message(std::string_view text);

}  // namespace dripline::interpreter::tnc155
