#include "server/ports/gateways/gateway_requests.hpp"

#include <sstream>

#include "gateway/line/line_texts.hpp"
#include "gateway/line/recording/recording_file.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/process/log.hpp"

namespace dripline::ports {
namespace {

using dds::LineAction;
using std::chrono::milliseconds;

constexpr milliseconds kTestLimit{15'000};
constexpr milliseconds kLineLimit{10'000};  ///< for the line itself to answer

dds::LineRequest request_of(const std::string& machine, LineAction action) {
  dds::LineRequest request;
  request.machine = machine;
  request.action = action;
  return request;
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Result<void> ask_done(const AskLine& ask, dds::LineRequest request, milliseconds limit) {
  const auto done = ask(std::move(request), limit);
  if (!done) return fail(done.error());
  return {};
}

/// What cannot be read is left out: it would be no better the next time.
std::vector<PortTraffic> entries_of(const dds::LineData& data, const std::string& machine) {
  std::vector<PortTraffic> entries;
  std::istringstream lines(text_of(data));
  for (std::string text; std::getline(lines, text);) {
    auto entry = line::parse_recording_line(text);
    if (!entry) {
      process::log_warning("entry of a recording left out machine={}: {}", machine,
                           entry.error().what);
      continue;
    }
    entry->port = machine;
    entries.push_back(*std::move(entry));
  }
  return entries;
}

}  // namespace

std::string text_of(const dds::LineData& data) {
  return {reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()};
}

Result<PortTest> test_gateway(const AskLine& ask, const std::string& machine) {
  const auto data = ask(request_of(machine, LineAction::Test), kTestLimit);
  if (!data) return fail(data.error());
  return line::decode_port_test(text_of(*data));
}

Result<void> receive_at_gateway(const AskLine& ask, const std::string& machine) {
  return ask_done(ask, request_of(machine, LineAction::Receive), kLineLimit);
}

Result<std::string> push_text(const AskLine& ask, const std::string& machine, const SendJob& job) {
  if (job.size > kMaxGatewayTransfer) {
    return fail(Errc::LimitExceeded,
                "{} bytes: a gateway keeps the whole and takes at most {}; send fewer programs at "
                "once, or start a run",
                job.size, kMaxGatewayTransfer);
  }
  Sha256 hash;
  for (std::uint64_t at = 0; at < job.size;) {
    const auto piece =
        job.source->read(at, std::min<std::uint64_t>(dds::kMaxBlockBytes, job.size - at));
    if (!piece) return fail(piece.error());
    hash.update(*piece);
    auto request = request_of(machine, LineAction::Text);
    request.name = job.id;
    request.number = at;
    request.bytes = bytes_of(*piece);
    if (auto kept = ask_done(ask, std::move(request), kAnswerLimit); !kept)
      return fail(kept.error());
    at += piece->size();
  }
  return line::encode(line::TransferOrder{
      .content = hash.digest().hex(), .name = job.name, .programs = job.programs});
}

Result<void> send_at_gateway(const AskLine& ask, const std::string& machine, const SendJob& job) {
  auto order = push_text(ask, machine, job);
  if (!order) return fail(order.error());
  auto request = request_of(machine, LineAction::Send);
  request.name = job.id;
  request.text = *std::move(order);
  return ask_done(ask, std::move(request), kLineLimit);
}

Result<void> stop_at_gateway(const AskLine& ask, const std::string& machine,
                             const std::string& reason) {
  auto request = request_of(machine, LineAction::Stop);
  request.text = reason;
  return ask_done(ask, std::move(request), kLineLimit);
}

Result<RuleVerdict> judge_at_gateway(const AskLine& ask, const std::string& machine,
                                     const std::string& text) {
  if (text.size() > dds::kMaxBlockBytes) {
    return fail(Errc::LimitExceeded,
                "{} bytes: the rules of a gateway are tried with texts of at most {}", text.size(),
                dds::kMaxBlockBytes);
  }
  auto request = request_of(machine, LineAction::Judge);
  request.bytes = bytes_of(text);
  const auto data = ask(std::move(request), kAnswerLimit);
  if (!data) return fail(data.error());
  return line::decode_rule_verdict(text_of(*data));
}

Result<void> read_recording(const AskLine& ask, const std::string& machine, std::uint64_t& number,
                            const std::function<void(const RecordingPart&)>& on_part) {
  for (bool ends = false; !ends;) {
    auto request = request_of(machine, LineAction::Recording);
    request.number = number;
    const auto data = ask(std::move(request), kAnswerLimit);
    if (!data) return fail(data.error());
    RecordingPart part{.entries = entries_of(*data, machine)};
    const std::uint64_t first =
        data->next - std::min<std::uint64_t>(data->next, part.entries.size());
    part.lost = first - std::min(first, number);
    ends = data->ends || data->next == number;
    number = data->next;
    on_part(part);
  }
  return {};
}

}  // namespace dripline::ports
