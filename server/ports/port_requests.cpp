/// What one port is asked for besides runs: tests, its recording, programs to and fro.
#include <algorithm>
#include <thread>

#include "server/ports/line_transfer.hpp"
#include "server/ports/port_line.hpp"
#include "server/ports/port_service.hpp"

namespace dripline::ports {
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

void judge_flow(const PortView& view, PortTest& test) {
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

/// Examines an idle line and reports in words what can be found without a program. Waits on the
/// caller's thread.
PortTest examine(PortLine& line) {
  PortTest test;
  if (!wait_open(line)) {
    const PortView view = line.view();
    test.findings.push_back(fmt::format("{} does not open: {}", view.port.address,
                                        view.fault.empty() ? "no answer" : view.fault));
    return test;
  }
  test.is_passed = true;
  const std::uint64_t faults = line.recorder().faults();
  const std::uint64_t received = characters_of_text(line);
  std::this_thread::sleep_for(kListening);
  const PortView view = line.view();
  if (!view.is_open) {
    test.is_passed = false;
    test.findings.push_back(fmt::format("{} was lost: {}", view.port.address, view.fault));
    return test;
  }
  test.findings.push_back(
      fmt::format("{} is open at {}", view.port.address, wire::short_form(view.settings)));
  judge_modem_lines(line, test);
  judge_flow(view, test);
  // Never less: old entries may have been dropped meanwhile.
  const std::uint64_t strays = std::max(characters_of_text(line), received) - received;
  judge_strays(strays, line.recorder().faults() - faults, test);
  return test;
}

PortListener no_listener() {
  return {.on_incoming = [](const Incoming&, const std::function<void()>& kept) { kept(); },
          .on_sent = [](const SendEnd&) {},
          .on_request = [](const wire::TransferRequest&) {},
          .on_change = [] {}};
}

}  // namespace

Result<PortTest> PortService::test(const std::string& name) {
  const std::lock_guard changing(change_mutex_);
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  if (auto idle = check_idle(name); !idle) return fail(idle.error());
  if (entry->line) return examine(*entry->line);
  if (!entry->fault.empty()) return PortTest{.is_passed = false, .findings = {entry->fault}};
  const auto line = make_line(*entry, Strand(pool_), no_listener());
  line->open();
  auto test = examine(*line);
  line->close("the test is over");
  return test;
}

Result<std::shared_ptr<PortLine>> PortService::find_line(const std::string& name) const {
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  if (entry->line) return entry->line;
  return fail(Errc::Conflict, "port '{}' is {}", name,
              entry->fault.empty() ? "disabled" : "not open: " + entry->fault);
}

Result<PortTransfer> PortService::send(const std::string& name,
                                       const std::vector<ProgramChoice>& programs) {
  const auto line = find_line(name);
  return line ? send_programs(*line, sources_, programs) : fail(line.error());
}

Result<void> PortService::receive(const std::string& name) {
  const auto line = find_line(name);
  return line ? receive_program(*line) : fail(line.error());
}

Result<void> PortService::stop_transfer(const std::string& name, const std::string& reason) {
  const auto line = find_line(name);
  return line ? ports::stop_transfer(*line, reason) : fail(line.error());
}

/// For monitors of the line, and the recording.
void PortService::note_transfer(const std::string& machine, const SendEnd& end) {
  const auto line = line_of(machine);
  if (!line) return;
  line->note(fmt::format("the transfer of programs {}: {} of {} bytes sent{}{}",
                         to_string(end.outcome), end.progress.sent.bytes, end.progress.size,
                         end.reason.empty() ? "" : ": ", end.reason));
  line_machines_.on_change(machine);
}

Result<RuleVerdict> PortService::test_rules(const std::string& name,
                                            const std::string& text) const {
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  return entry->rules->explain(text, entry->settings.extracts_programs);
}

Result<std::vector<PortTraffic>> PortService::recording(const std::string& name) const {
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  if (entry->line) return entry->line->recorder().entries();
  if (options_.recordings.empty()) return std::vector<PortTraffic>{};
  return RecordingFile(options_.recordings, name).read();
}

}  // namespace dripline::ports
