// Both ends of a plain line; the first two bytes select its flow control and the characters around
// a text.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size < 2) return 0;
  constexpr wire::Flow kFlows[] = {wire::Flow::None, wire::Flow::XonXoff, wire::Flow::RtsCts,
                                   wire::Flow::DcCodes};
  wire::LineSettings settings;
  settings.flow = kFlows[data[0] / 2 % 4];
  settings.wait_for_xon = (data[0] & 8) != 0;
  if ((data[0] & 16) != 0) settings.code = wire::CharacterCode::Iso;
  if ((data[0] & 32) != 0) settings.hold_limit = std::chrono::seconds(30);
  if ((data[0] & 64) != 0) settings.line_delay = std::chrono::milliseconds(20);
  if ((data[1] & 1) != 0) settings.start_character = '%';
  if ((data[1] & 2) != 0) settings.start_character = '\x12';
  if ((data[1] & 4) != 0) settings.end_character = '%';
  if ((data[1] & 8) != 0) settings.end_character = '\x03';
  settings.leader = data[1] / 16 % 4;
  settings.trailer = data[1] / 64;
  const auto role = (data[0] & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  if (!wire::make_discipline(settings, role)) return 0;  // DC2 steers such a line
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 2, size - 2)));
  return 0;
}
