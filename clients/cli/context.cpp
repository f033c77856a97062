#include "clients/cli/context.hpp"

#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <thread>

namespace dripline::cli {

std::optional<client::Client> Context::connect() {
  auto servers = client::locate_servers(location, process_environment, ::geteuid() == 0);
  if (!servers) {
    complain(servers.error());
    status = servers.error().code == Errc::NotFound ? kExitUnreachable : kExitUsage;
    return std::nullopt;
  }
  return std::optional<client::Client>(std::in_place, *std::move(servers));
}

bool Context::has_color() const {
  return terminal_of(STDOUT_FILENO).has_color;
}

void Context::print(std::string_view text) const {
  if (wants_json) return print_content(text);
  const std::string shown = visible(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

void Context::print_content(std::string_view bytes) const {
  const bool is_terminal = terminal_of(STDOUT_FILENO).is_terminal;
  const std::string shown = is_terminal ? visible(bytes) : std::string(bytes);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

void add_json_flag(Command command, Context& context) {
  command.add_flag("--json", context.wants_json, "Print JSON instead of text");
}

client::RetryPolicy retry_policy() {
  client::RetryPolicy policy;
  policy.wait = wait_unless_interrupted;
  return policy;
}

namespace {

volatile std::sig_atomic_t interrupted = 0;  // a signal handler can reach nothing but a global

void on_signal(int) {
  interrupted = 1;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() {
  return interrupted != 0;
}

bool wait_unless_interrupted(std::chrono::milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!is_interrupted() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return !is_interrupted();
}

}  // namespace dripline::cli
