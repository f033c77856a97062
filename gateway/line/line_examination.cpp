#include "gateway/line/line_examination.hpp"

#include <algorithm>
#include <thread>

#include "gateway/line/port_line.hpp"

namespace dripline::line {
namespace {

constexpr std::chrono::milliseconds kMaxOpening{3000};  ///< of the line that is examined
constexpr std::chrono::milliseconds kListening{1500};
constexpr std::chrono::milliseconds kLook{20};

bool wait_open(const PortLine& line) {
  const auto end = std::chrono::steady_clock::now() + kMaxOpening;
  while (!line.view().is_open) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

/// The last report on the modem lines.
std::string modem_lines(PortLine& line) {
  auto entries = line.recorder().entries();
  const auto last = std::find_if(entries.rbegin(), entries.rend(), [](const PortTraffic& entry) {
    return entry.what == TrafficKind::Lines;
  });
  if (last == entries.rend()) return "the line reports nothing of its modem lines";
  return "modem lines: " + last->text;
}

void judge_modem_lines(PortLine& line, PortTest& test) {
  const std::string words = modem_lines(line);
  test.findings.push_back(words);
  if (words.find("DSR off") != std::string::npos) {
    test.findings.emplace_back("DSR is off: is the control switched on, and the cable complete?");
  }
}

void judge_flow(const LineView& view, PortTest& test) {
  if (view.line.is_stopped) {
    test.is_passed = false;
    test.findings.push_back(
        "the control holds the line (XOFF, or CTS off): nothing can be sent until it lets go");
  } else {
    test.findings.push_back("the control does not hold the line");
  }
}

/// What was received and recorded, without DC1 and DC3: a control that begins to listen sends them.
std::uint64_t characters_of_text(PortLine& line) {
  std::uint64_t count = 0;
  for (const PortTraffic& entry : line.recorder().entries()) {
    if (entry.what != TrafficKind::Received) continue;
    count += static_cast<std::uint64_t>(
        std::ranges::count_if(entry.bytes, [](char c) { return c != '\x11' && c != '\x13'; }));
  }
  return count;
}

void judge_strays(std::uint64_t characters, std::uint64_t faults, PortTest& test) {
  if (faults > 0) {
    test.is_passed = false;
    test.findings.push_back(fmt::format(
        "{} characters came with faults: baud, data bits or parity differ, or the line is noisy",
        faults));
  }
  if (characters > 0) {
    test.is_passed = false;
    test.findings.push_back(fmt::format("{} characters came unasked", characters));
  }
  if (characters == 0 && faults == 0) test.findings.push_back("the line is quiet");
}

}  // namespace

PortTest examine(PortLine& line) {
  PortTest test;
  if (!wait_open(line)) {
    const LineView view = line.view();
    test.findings.push_back(fmt::format("{} does not open: {}", view.names.address,
                                        view.fault.empty() ? "no answer" : view.fault));
    return test;
  }
  test.is_passed = true;
  const std::uint64_t faults = line.recorder().faults();
  const std::uint64_t received = characters_of_text(line);
  std::this_thread::sleep_for(kListening);
  const LineView view = line.view();
  if (!view.is_open) {
    test.is_passed = false;
    test.findings.push_back(fmt::format("{} was lost: {}", view.names.address, view.fault));
    return test;
  }
  test.findings.push_back(
      fmt::format("{} is open at {}", view.names.address, wire::short_form(view.settings)));
  judge_modem_lines(line, test);
  judge_flow(view, test);
  // Never less: old entries may have been dropped meanwhile.
  const std::uint64_t strays = std::max(characters_of_text(line), received) - received;
  judge_strays(strays, line.recorder().faults() - faults, test);
  return test;
}

}  // namespace dripline::line
