// What the helper of LinuxCNC writes, in any pieces. Properties: the pieces make no difference; no
// line is longer than the bound; a session that hears it sends no motion, and a bounded number of
// bytes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "gateway/machine/linuxcnc/session.hpp"
#include "tests/fuzz/gateway/lines_in_pieces.hpp"

namespace {

using namespace dripline::machine::linuxcnc;
using dripline::fuzz::require;

void check(const HelperReply& reply) {
  if (const auto* status = std::get_if<StatusReply>(&reply)) {
    for (const double value : status->at) require(std::fabs(value) <= 1e12);
    require(std::isfinite(status->velocity) && status->work_system <= 9);
  }
  if (const auto* hello = std::get_if<HelloReply>(&reply))
    require(hello->axes >= 1 && hello->axes < 512 && std::isfinite(hello->units_per_mm));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  for (const std::string& line : dripline::fuzz::lines_in_pieces<HelperLines>(bytes))
    check(parse_helper_reply(line));

  Session session;
  dripline::SteadyTime now{};
  session.opened(now);
  session.set_active(size % 2 == 0, now);
  std::string text, commands;
  for (std::size_t i = 0; i < size; i += 64) {
    session.receive(bytes.subspan(i, std::min<std::size_t>(64, size - i)),
                    now += std::chrono::milliseconds(10));
    if (session.check_ready()) (void)session.prepare(now);
    if (session.wants_feed() && !session.has_feed()) session.feed_opened("/fifo", now);
    session.tick(now, true);
    text += session.take_text();
    commands += session.take_commands();
  }
  require(text.find("G0") == std::string::npos && text.find("G1X") == std::string::npos);
  require(commands.find("resume") == std::string::npos);
  require(text.size() + commands.size() <= 256 + 64 * size);
  return 0;
}
