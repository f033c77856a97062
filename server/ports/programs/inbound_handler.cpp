#include "server/ports/programs/inbound_handler.hpp"

#include "gateway/interpreter/registry.hpp"
#include "protocol/dds/message.hpp"
#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"

namespace dripline::ports {
namespace {

bool prints_nothing(const std::string& control) {
  const auto dialect = interpreter::find_dialect(control);
  return dialect && (*dialect)->text.is_all_programs;
}

}  // namespace

InboundHandler::InboundHandler(Parts parts)
    : parts_(std::move(parts)),
      calls_(parts_.calls),
      router_(parts_.rules, parts_.extracts_programs, *this) {}

bool InboundHandler::sends_programs_only() const {
  return parts_.sends_programs_only || prints_nothing(machine_control());
}

void InboundHandler::note_kind(bool may_be_program) {
  if (const auto line = parts_.directory.line_of(parts_.machine)) line->note_kind(may_be_program);
}

void InboundHandler::print(std::vector<line::PrintedLine> lines, std::function<void()> kept) {
  std::vector<LineRecords::Entry> entries;
  for (auto& line : lines) {
    LineRecords::Entry& entry = entries.emplace_back();
    entry.record.run = current_run();
    entry.record.kind =
        std::string(to_string(line.is_probe ? dds::RecordKind::Probe : dds::RecordKind::Output));
    entry.record.device = parts_.port;
    entry.record.text = std::move(line.text);
  }
  entries.back().on_stored = std::move(kept);
  parts_.records->add(std::move(entries));
}

std::string InboundHandler::current_run() {
  const auto line = parts_.directory.line_of(parts_.machine);
  if (line) on_run(line->view().run);
  return run_;
}

std::string InboundHandler::machine_control() const {
  const auto machine = parts_.machines.find(parts_.machine);
  return machine ? machine->control : std::string();
}

/// What cannot be stored now is tried again.
void InboundHandler::begin_program() {
  static_cast<void>(parts_.transfers->begin_reception());
  program_.emplace(parts_.programs, UploadedProgram::Origin{.machine = parts_.machine,
                                                            .control = machine_control()});
}

void InboundHandler::add_text(const std::string& text) {
  parts_.transfers->note_received(text.size());
  // Its error comes again with the end.
  if (program_) (void)program_->append(text).has_value();
}

void InboundHandler::damage(const std::string& how) {
  if (program_) program_->damage(how);
}

void InboundHandler::store_program(const std::string& name) {
  const auto stored = program_->store(name);
  program_.reset();
  using End = storage::TransferState;
  if (!stored) {
    parts_.transfers->end_reception(End::Interrupted, "",
                                    "it was not stored: " + stored.error().what);
    process::log_error("uploaded program not stored machine={}: {}", parts_.machine,
                       stored.error().what);
    const bool is_full = stored.error().code == Errc::Io;
    return router_.report(library::with_control_words(
                              {stored.error().code, "program not stored: " + stored.error().what},
                              machine_control(),
                              is_full ? library::Refusal::DiskFull : library::Refusal::NotSaved)
                              .what);
  }
  const auto& revision = stored->revision;
  parts_.transfers->end_reception(
      End::Completed, fmt::format("{} revision {}", revision.program, revision.number), "");
  router_.report(fmt::format("program {} is revision {}{}", revision.program, revision.number,
                             revision.is_held ? ", held for acceptance" : ""));
}

/// It was a request, or a rule leaves it out.
void InboundHandler::drop_program() {
  program_.reset();
  parts_.transfers->end_reception(storage::TransferState::Completed, "", "");
}

void InboundHandler::cut_off_program(const std::string& why) {
  program_.reset();
  parts_.transfers->end_reception(
      storage::TransferState::Interrupted, "",
      fmt::format("it was cut off, and nothing of it is stored: {}", why));
}

void InboundHandler::note(const std::string& words) {
  if (const auto line = parts_.directory.line_of(parts_.machine)) line->note(words);
}

void InboundHandler::carry_out(line::RuleAction action, const std::string& argument) {
  calls_.carry_out(action, argument, arrived_);
}

}  // namespace dripline::ports
