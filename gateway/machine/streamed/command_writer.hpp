#pragma once

#include <vector>

#include "gateway/machine/streamed/text_rules.hpp"

namespace dripline::machine::streamed {

/// M6, which comes after the number of its tool.
inline constexpr int kToolChangeFunction = 6;

/// Makes lines of what is not motion: spindle and coolant in the words that all devices share, the
/// rest in a device's own. Empty lines: there is nothing to send, the event is only reported. Pure;
/// called in the sequence of the program.
class CommandWriter {
 public:
  using Lines = std::vector<std::string>;
  virtual ~CommandWriter() = default;
  /// A program begins: spindle and coolant are off.
  virtual void begin(const TextRules& rules);
  virtual std::optional<Refusal> spindle(const interpreter::Spindle& event, Lines& lines);
  std::optional<Refusal> coolant(const interpreter::Coolant& event, Lines& lines);
  virtual std::optional<Refusal> tool(const interpreter::ToolChange& event, Lines& lines) = 0;
  virtual std::optional<Refusal> miscellaneous(const interpreter::Miscellaneous& event,
                                               Lines& lines) = 0;
  /// A function that is done by other events, or before it: nothing is written for it.
  virtual std::optional<Refusal> done_function(const interpreter::Miscellaneous&, Lines&) {
    return std::nullopt;
  }
  virtual std::optional<Refusal> pin(const interpreter::PinChange& event, Lines& lines) = 0;

 private:
  TextRules rules_;
  bool flood_ = false, mist_ = false;
};

}  // namespace dripline::machine::streamed
