/// What one port is asked for besides runs: tests, its recording, programs to and fro.
#include "gateway/line/line_examination.hpp"
#include "gateway/line/port_transfer.hpp"
#include "gateway/line/recording/recording_file.hpp"
#include "server/ports/line_transfer.hpp"
#include "server/ports/port_service.hpp"

namespace dripline::ports {
namespace {

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
  if (entry->line) return line::examine(*entry->line);
  if (!entry->fault.empty()) return PortTest{.is_passed = false, .findings = {entry->fault}};
  const auto line = make_line(*entry, {Strand(pool_), Strand(near_pool_)}, no_listener());
  line->open();
  auto test = line::examine(*line);
  line->close("the test is over");
  return test;
}

Result<LineInUse> PortService::find_line(const std::string& name) const {
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  if (entry->line) return LineInUse{entry->line, entry->transfers, resets_};
  return fail(Errc::Conflict, "port '{}' is {}", name,
              entry->fault.empty() ? "disabled" : "not open: " + entry->fault);
}

Result<PortTransfer> PortService::send(const std::string& name,
                                       const std::vector<ProgramChoice>& programs) {
  const auto line = find_line(name);
  return line ? send_programs(*line, sources_, programs) : fail(line.error());
}

Result<std::string> PortService::confirm_reset(const std::string& name) {
  const auto entry = find(name);
  return entry ? resets_.confirm(reset_view(*entry), name) : fail(entry.error());
}

Result<void> PortService::receive(const std::string& name) {
  const auto line = find_line(name);
  return line ? receive_program(*line) : fail(line.error());
}

Result<void> PortService::stop_transfer(const std::string& name, const std::string& reason) {
  const auto line = find_line(name);
  return line ? ports::stop_transfer(line->line, reason) : fail(line.error());
}

/// For monitors of the line, and the recording.
void PortService::note_transfer(const std::string& machine, const SendEnd& end) {
  const auto line = line_of(machine);
  if (!line) return;
  line->note(line::transfer_words(end));
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
  return line::RecordingFile(options_.recordings, name).read();
}

}  // namespace dripline::ports
