// The body of POST /runs/{id}/commands. Property: a value that is taken can be sent to a machine.
#include <cmath>
#include <cstdlib>

#include "server/api/bodies/run_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto command = api::decode_command({reinterpret_cast<const char*>(data), size});
  if (!command) return command.error().what.empty() ? (std::abort(), 0) : 0;
  if (!std::isfinite(command->value) || command->value < 0 || command->value > api::kMaxOverride) {
    std::abort();
  }
  if (command->action == dds::CommandAction::Start || command->argument.size() > 255) std::abort();
  if (command->argument.find('\0') != std::string::npos) std::abort();
  return 0;
}
