#pragma once

#include <vector>

#include "gateway/machine/streamed/text_rules.hpp"

namespace dripline::machine::streamed {

/// Makes lines of what is not motion, in a device's own words. Empty lines: there is nothing to
/// send, the event is only reported. Pure; called in the sequence of the program.
class CommandWriter {
 public:
  using Lines = std::vector<std::string>;
  virtual ~CommandWriter() = default;
  /// A program begins: spindle and coolant are off.
  virtual void begin(const TextRules& rules) = 0;
  virtual std::optional<Refusal> spindle(const interpreter::Spindle& event, Lines& lines) = 0;
  virtual std::optional<Refusal> coolant(const interpreter::Coolant& event, Lines& lines) = 0;
  virtual std::optional<Refusal> tool(const interpreter::ToolChange& event, Lines& lines) = 0;
  virtual std::optional<Refusal> miscellaneous(const interpreter::Miscellaneous& event,
                                               Lines& lines) = 0;
  virtual std::optional<Refusal> pin(const interpreter::PinChange& event, Lines& lines) = 0;
};

}  // namespace dripline::machine::streamed
