#include "clients/cli/context.hpp"

#include <unistd.h>
#include <cstdio>

#include "clients/cli/interrupt.hpp"

namespace dripline::cli {

std::optional<client::Client> Context::connect() {
  auto address = client::locate_server(location, process_environment, ::geteuid() == 0);
  if (!address) {
    complain(address.error());
    status = address.error().code == Errc::NotFound ? kExitUnreachable : kExitUsage;
    return std::nullopt;
  }
  return std::optional<client::Client>(std::in_place, std::move(*address));
}

bool Context::has_color() const {
  return terminal_of(STDOUT_FILENO).has_color;
}

void Context::print(std::string_view text) const {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

void add_json_flag(Command command, Context& context) {
  command.add_flag("--json", context.wants_json, "Print JSON instead of text");
}

client::RetryPolicy retry_policy() {
  client::RetryPolicy policy;
  policy.wait = wait_unless_interrupted;
  return policy;
}

}  // namespace dripline::cli
