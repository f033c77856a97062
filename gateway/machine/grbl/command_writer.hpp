#pragma once

#include "gateway/machine/streamed/command_writer.hpp"

namespace dripline::machine::grbl {

/// A board changes no tools, switches no outputs and has no other M functions than those of spindle
/// and coolant: a clamp or a chuck that is not switched is no detail.
class BoardCommands final : public streamed::CommandWriter {
 public:
  /// Only reported: the operator changes it (operator_tool_change.hpp).
  std::optional<streamed::Refusal> tool(const interpreter::ToolChange& event,
                                        Lines& lines) override;
  std::optional<streamed::Refusal> miscellaneous(const interpreter::Miscellaneous& event,
                                                 Lines& lines) override;
  std::optional<streamed::Refusal> done_function(const interpreter::Miscellaneous& event,
                                                 Lines& lines) override;
  std::optional<streamed::Refusal> pin(const interpreter::PinChange& event, Lines& lines) override;
};

}  // namespace dripline::machine::grbl
