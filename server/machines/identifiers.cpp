#include "server/machines/identifiers.hpp"

#include <fmt/chrono.h>

#include "protocol/base/random.hpp"

namespace dripline::machines {
std::string make_run_id(UtcTime now) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{}-{:%Y%m%d-%H%M%S}", random_hex(4),
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

std::string make_command_id() {
  return random_hex(16);
}

}  // namespace dripline::machines
