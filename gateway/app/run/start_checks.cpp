#include "gateway/app/run/start_checks.hpp"

#include <fmt/format.h>

#include "protocol/base/digest.hpp"
#include "protocol/base/names.hpp"

namespace dripline::gateway {
namespace {

constexpr std::uint64_t kMaxProgramBytes = 1ULL << 40;

}  // namespace

std::optional<Reply> refusal_of_program(const dds::Command& start, const GatewayOptions& options) {
  if (start.control != options.control)
    return refuse(fmt::format("this machine's control is {}, the program is for '{}'",
                              options.control, start.control));
  if (const auto name = check_program_name(start.program); !name) return refuse(name.error().what);
  if (const auto digest = parse_digest(start.revision); !digest)
    return refuse(fmt::format("revision: {}", digest.error().what));
  if (start.size == 0 || start.size > kMaxProgramBytes)
    return refuse(
        fmt::format("a program of {} bytes, expected 1 to {}", start.size, kMaxProgramBytes));
  return std::nullopt;
}

}  // namespace dripline::gateway
