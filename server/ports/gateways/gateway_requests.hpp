#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/ports/line_types.hpp"
#include "server/ports/port_control.hpp"
#include "server/ports/requests/gateway_at_control.hpp"

/// What a gateway is asked to do with its line, and to tell of it. The functions wait for its
/// answers. Errors of all: those of `ask`.
namespace dripline::ports {

/// Texts are pushed in pieces, which the gateway keeps until it has the whole.
inline constexpr std::uint64_t kMaxGatewayTransfer = 16 * 1024 * 1024;

std::string text_of(const dds::LineData& data);

Result<PortTest> test_gateway(const AskLine& ask, const std::string& machine);
Result<void> receive_at_gateway(const AskLine& ask, const std::string& machine);
/// The text of a job, which the gateway keeps under its id; the order to send it. Errors:
/// LimitExceeded, those of the job's source.
Result<std::string> push_text(const AskLine& ask, const std::string& machine, const SendJob& job);
/// Errors: those of push_text.
Result<void> send_at_gateway(const AskLine& ask, const std::string& machine, const SendJob& job);
Result<void> stop_at_gateway(const AskLine& ask, const std::string& machine,
                             const std::string& reason);
/// Errors: LimitExceeded (the text is longer than a message).
Result<RuleVerdict> judge_at_gateway(const AskLine& ask, const std::string& machine,
                                     const std::string& text);

/// Entries of a gateway's recording from `number` on until its end; `number` is then the next one.
/// Each part is given whole or not at all, so that asking again after an error loses and doubles
/// nothing; `lost`: entries that are not there any more.
struct RecordingPart {
  std::uint64_t lost = 0;
  std::vector<PortTraffic> entries;
};
Result<void> read_recording(const AskLine& ask, const std::string& machine, std::uint64_t& number,
                            const std::function<void(const RecordingPart&)>& on_part);

}  // namespace dripline::ports
