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

std::optional<Refusal> BoardCommands::pin(const interpreter::PinChange& event, Lines&) {
  return Refusal{"MCH0008", fmt::format("this machine cannot switch output {}", event.output)};
}

}  // namespace dripline::machine::grbl
