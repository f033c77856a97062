#include "gateway/machine/grbl/command_writer.hpp"

namespace dripline::machine::grbl {

using streamed::Refusal;

std::optional<Refusal> BoardCommands::tool(const interpreter::ToolChange&, Lines&) {
  return std::nullopt;
}

std::optional<Refusal> BoardCommands::miscellaneous(const interpreter::Miscellaneous& event,
                                                    Lines&) {
  if (event.code == streamed::kToolChangeFunction) return std::nullopt;
  return Refusal{"MCH0008", fmt::format("this machine cannot do M{}", event.code)};
}

/// It has no inputs for programs: what M66 has read is nothing.
std::optional<Refusal> BoardCommands::done_function(const interpreter::Miscellaneous& event,
                                                    Lines& lines) {
  constexpr int kReadsInput = 66;
  return event.code == kReadsInput ? miscellaneous(event, lines) : std::nullopt;
}

std::optional<Refusal> BoardCommands::pin(const interpreter::PinChange& event, Lines&) {
  return Refusal{"MCH0008", fmt::format("this machine cannot switch output {}", event.output)};
}

}  // namespace dripline::machine::grbl
