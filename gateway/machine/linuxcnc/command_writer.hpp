#pragma once

#include "gateway/machine/streamed/command_writer.hpp"

namespace dripline::machine::linuxcnc {

/// LinuxCNC's words for tools, outputs and other functions. M functions 100 to 199 are programs of
/// the machine's builder there; others are refused: a clamp that is not switched is no detail.
class LinuxCncCommands final : public streamed::CommandWriter {
 public:
  void begin(const streamed::TextRules& rules) override;
  std::optional<streamed::Refusal> spindle(const interpreter::Spindle& event,
                                           Lines& lines) override;
  /// A preselection is T. M6 stops the spindle there; a program that has not stopped it itself gets
  /// it back.
  std::optional<streamed::Refusal> tool(const interpreter::ToolChange& event,
                                        Lines& lines) override;
  std::optional<streamed::Refusal> miscellaneous(const interpreter::Miscellaneous& event,
                                                 Lines& lines) override;
  std::optional<streamed::Refusal> pin(const interpreter::PinChange& event, Lines& lines) override;

 private:
  std::string spindle_;  ///< the line that has turned it on; empty: it is off
};

}  // namespace dripline::machine::linuxcnc
