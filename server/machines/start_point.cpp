#include "server/machines/start_point.hpp"

#include <fmt/format.h>
#include <charconv>

namespace dripline::machines {

Result<StartPoint> parse_start_point(std::string_view text) {
  char letter = 'N';
  std::string_view digits = text;
  if (!digits.empty() && (digits[0] < '0' || digits[0] > '9')) {
    letter = static_cast<char>(digits[0] & ~0x20);
    digits.remove_prefix(1);
  }
  std::uint64_t value = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = read.ec == std::errc{} && read.ptr == digits.data() + digits.size();
  StartPoint point;
  if (is_whole && letter == 'N') {
    point.sequence = value;
  } else if (is_whole && letter == 'L') {
    point.line = value;
  } else if (is_whole && letter == 'B') {
    point.byte = value;
  } else if (is_whole && letter == 'T') {
    point.tool = value;
  } else if (is_whole && text.front() == '+') {
    point.skipped = value;
  } else {
    return fail(Errc::Syntax,
                "'{}' names no block: N120, L7 (line), B4096 (byte), T3 (tool) or +25 (skipped)",
                text);
  }
  return point;
}

std::string start_text(const StartPoint& point) {
  if (point.sequence) return fmt::format("N{}", *point.sequence);
  if (point.line) return fmt::format("L{}", *point.line);
  if (point.byte) return fmt::format("B{}", *point.byte);
  if (point.tool) return fmt::format("T{}", *point.tool);
  if (point.skipped) return fmt::format("+{}", *point.skipped);
  return {};
}

std::string start_argument(const StartRequest& request) {
  if (request.is_mdi) return std::string(dds::kMdiStart);
  if (request.restart)
    return fmt::format("restart={} at={}", request.restart->run, request.restart->at);
  std::string text = start_text(request.from);
  if (request.is_test) text += text.empty() ? "test=yes" : " test=yes";
  if (text.empty()) return text;
  if (request.from.pass) text += fmt::format(" pass={}", *request.from.pass);
  if (request.memory == StartMemory::Begin) text += " memory=begin";
  if (request.memory == StartMemory::Now) text += " memory=now";
  if (request.head == StartHead::Send) text += " head=send";
  if (request.head == StartHead::Set) text += " head=set";
  return text;
}

bool is_testing(const MachineView& view) {
  return view.status && view.status->switches &&
         view.status->switches->test_run == dds::SwitchState::On;
}

std::string audit_text(const MachineControl& machines, const storage::Run& run,
                       bool asks_for_test) {
  const auto view = machines.machine(run.machine);
  const bool is_on = view && is_testing(*view);
  return fmt::format("{}{} revision {} on {}", asks_for_test || is_on ? "test run of " : "",
                     run.program, run.revision, run.machine);
}

}  // namespace dripline::machines
