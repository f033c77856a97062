#include "tests/support/line/line_events.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "protocol/base/invariant.hpp"

namespace dripline::test_support {
namespace {

using namespace wire;

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
    } else if (c < ' ' || c == 0x7f) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      out += c;
    }
  }
  return out + '"';
}

struct InWords {
  std::string operator()(const TextReceived& event) const { return "text " + quoted(event.text); }
  std::string operator()(const TransferBegan& event) const {
    const std::string what = event.is_receiving ? "receiving" : "sending";
    return event.name.empty() ? what : what + ' ' + event.name;
  }
  std::string operator()(const TransferEnded& event) const {
    return event.is_receiving ? "received" : "sent";
  }
  std::string operator()(const FlowChanged& event) const {
    return event.is_stopped ? "stopped" : "resumed";
  }
  std::string operator()(const TextAccepted& event) const {
    return fmt::format("accepted {}", event.bytes);
  }
  std::string operator()(const TransferFailed& event) const {
    return fmt::format("failed {}: {}", to_string(event.error.code), event.error.what);
  }
  std::string operator()(const LineError& event) const {
    return fmt::format("error {}: {}", to_string(event.error.code), event.error.what);
  }
  std::string operator()(const TransferRequest& event) const {
    const std::string_view what =
        event.kind == TransferRequest::Kind::SendProgram   ? "wants a program"
        : event.kind == TransferRequest::Kind::TakeProgram ? "sends a program"
                                                           : "wants the directory";
    return event.name.empty() ? std::string(what) : fmt::format("{} {}", what, event.name);
  }
  std::string operator()(const ReleaseRefused&) const { return "refused the release"; }
};

}  // namespace

std::string event_lines(const std::vector<Event>& events) {
  std::string lines;
  std::string text;
  const auto flush = [&] {
    if (!text.empty()) lines += "text " + quoted(text) + '\n';
    text.clear();
  };
  for (const Event& event : events) {
    if (const auto* received = std::get_if<TextReceived>(&event)) {
      text += received->text;
      continue;
    }
    flush();
    lines += std::visit(InWords{}, event) + '\n';
  }
  flush();
  return lines;
}

void EventLog::add(const std::vector<Event>& events) {
  events_.insert(events_.end(), events.begin(), events.end());
}

TestedLine::TestedLine(const LineSettings& settings, Role role) {
  auto made = make_discipline(settings, role);
  invariant(made.has_value(), "a tested line's settings exclude each other");
  line = std::move(*made);
}

void TestedLine::hear(std::string_view characters) {
  line->receive(std::as_bytes(std::span(characters.data(), characters.size())), now);
}

void TestedLine::pass(LineTime after) {
  const LineTime end = now + after;
  for (auto at = line->deadline(); at && *at <= end; at = line->deadline()) {
    now = std::max(now, *at);
    line->tick(now);
  }
  now = end;
}

std::string TestedLine::say_now(std::size_t at_most) {
  std::string sent;
  std::byte room[64];
  while (sent.size() < at_most) {
    const std::size_t size = std::min(sizeof(room), at_most - sent.size());
    const std::size_t count = line->transmit(std::span(room).first(size), now);
    if (count == 0) break;
    sent.append(reinterpret_cast<const char*>(room), count);
  }
  return sent;
}

std::string TestedLine::say(std::size_t at_most) {
  std::string sent = say_now(at_most);
  while (sent.size() < at_most) {
    const auto at = line->deadline();
    if (!at) break;
    now = std::max(now, *at);
    line->tick(now);
    const std::string more = say_now(at_most - sent.size());
    if (more.empty()) break;
    sent += more;
  }
  return sent;
}

}  // namespace dripline::test_support
