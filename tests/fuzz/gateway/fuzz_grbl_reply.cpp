// What a board sends, in any pieces. Properties: the pieces make no difference; no line is longer
// than the bound; what is understood has finite values of a size that a machine can have.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "gateway/machine/grbl/board_session.hpp"
#include "gateway/machine/grbl/reply.hpp"
#include "tests/fuzz/gateway/lines_in_pieces.hpp"

namespace {

using namespace dripline::machine::grbl;
using dripline::fuzz::require;

void check(const AxisValues& values) {
  require(values.count >= 1 && values.count <= kMaxAxes);
  for (const double value : values.value) require(std::fabs(value) <= 1e9);
}

void check(const Reply& reply) {
  if (const auto* report = std::get_if<StatusReport>(&reply)) {
    for (const auto& point : {report->machine_position, report->work_position, report->work_offset})
      if (point) check(*point);
    if (report->buffers) require(report->buffers->free_blocks >= 0);
  }
  if (const auto* probe = std::get_if<ProbeReply>(&reply)) check(probe->at);
  if (const auto* setting = std::get_if<SettingReply>(&reply))
    require(setting->number >= 0 && std::isfinite(setting->value));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  for (const std::string& line : dripline::fuzz::lines_in_pieces<LineSplitter>(bytes))
    check(parse_reply(line));

  // A session that hears it sends no line that moves, and a bounded number of bytes.
  BoardSession session;
  dripline::SteadyTime now{};
  session.opened(now);
  session.set_active(size % 2 == 0, now);
  std::string sent;
  for (std::size_t i = 0; i < size; i += 16) {
    session.receive(bytes.subspan(i, std::min<std::size_t>(16, size - i)),
                    now += std::chrono::milliseconds(50));
    session.tick(now);
    const BoardOutput output = session.take_output();
    sent += output.real_time + output.lines;
  }
  require(sent.find('G') == std::string::npos && sent.find('~') == std::string::npos);
  require(sent.size() <= 64 + 128 * size);
  return 0;
}
