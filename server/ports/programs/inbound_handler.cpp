#include "server/ports/programs/inbound_handler.hpp"

#include "gateway/interpreter/registry.hpp"
#include "protocol/base/utf8.hpp"
#include "protocol/dds/message.hpp"
#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"

namespace dripline::ports {
namespace {

constexpr std::size_t kMaxWaiting = 8;

bool prints_nothing(const std::string& control) {
  const auto dialect = interpreter::find_dialect(control);
  return dialect && (*dialect)->text.is_all_programs;
}

/// The line as it was printed; other control characters than TAB become escapes.
std::string printed_text(const std::string& line) {
  std::string text;
  for (const char c : line) {
    if (c == '\t') {
      text += c;
    } else {
      text += one_line({&c, 1});
    }
  }
  return text;
}

}  // namespace

InboundHandler::InboundHandler(Parts parts)
    : parts_(std::move(parts)),
      calls_(parts_.calls),
      splitter_(*parts_.rules, parts_.extracts_programs) {}

void InboundHandler::take(const Incoming& incoming, std::function<void()> kept) {
  std::vector<InboundSplitter::Item> items;
  switch (incoming.what) {
    case Incoming::What::Began:
      is_in_transfer_ = true;
      program_name_ = incoming.text;
      splitter_.take_programs_only(parts_.sends_programs_only || prints_nothing(machine_control()));
      splitter_.begin(incoming.text, incoming.is_program);
      break;
    case Incoming::What::Text:
      items = splitter_.take(incoming.text);
      break;
    case Incoming::What::Damaged:
      if (program_) program_->damage(incoming.text);
      early_damage_ = incoming.text;
      break;
    case Incoming::What::Ended:
      items = splitter_.end();
      break;
    case Incoming::What::Failed:
      items = splitter_.fail();
      break;
  }
  if (const auto line = parts_.calls.directory.line_of(parts_.machine)) {
    line->note_kind(incoming.what != Incoming::What::Text || splitter_.may_be_program());
  }
  std::vector<LineRecords::Entry> entries;
  for (auto& item : items) handle(item, entries);
  if (entries.empty()) {
    kept();
  } else {
    entries.back().on_stored = std::move(kept);
    parts_.records->add(std::move(entries));
  }
  if (incoming.what == Incoming::What::Ended || incoming.what == Incoming::What::Failed) {
    is_in_transfer_ = false;
    early_damage_.clear();
  }
  if (!is_in_transfer_) do_calls();
}

void InboundHandler::handle(InboundSplitter::Item& item, std::vector<LineRecords::Entry>& entries) {
  switch (item.what) {
    case InboundSplitter::Item::What::Line:
      return handle_line(item.text, entries);
    case InboundSplitter::Item::What::ProgramBegan:
      return begin_program(item.text);
    case InboundSplitter::Item::What::ProgramText:
      // Its error comes again with the end.
      if (program_) (void)program_->append(item.text).has_value();
      return;
    case InboundSplitter::Item::What::ProgramEnded:
      return end_program(item.text);
    case InboundSplitter::Item::What::ProgramFailed:
      program_.reset();
      return report("a program was cut off and not stored");
  }
}

void InboundHandler::handle_line(const std::string& line,
                                 std::vector<LineRecords::Entry>& entries) {
  const RuleHit hit = parts_.rules->judge(TextKind::Line, line);
  if (hit.action == RuleAction::Ignore) return;
  if (hit.action != RuleAction::Report) return call(hit.action, hit.argument);
  LineRecords::Entry entry;
  entry.record.run = current_run();
  entry.record.kind =
      std::string(to_string(hit.is_probe ? dds::RecordKind::Probe : dds::RecordKind::Output));
  entry.record.device = parts_.port;
  entry.record.text = printed_text(line);
  entries.push_back(std::move(entry));
}

std::string InboundHandler::current_run() {
  const auto line = parts_.calls.directory.line_of(parts_.machine);
  if (line) on_run(line->view().run);
  return run_;
}

std::string InboundHandler::machine_control() const {
  const auto machine = parts_.machines.find(parts_.machine);
  return machine ? machine->control : std::string();
}

void InboundHandler::begin_program(const std::string& name) {
  program_name_ = name;
  program_.emplace(parts_.programs, UploadedProgram::Origin{.machine = parts_.machine,
                                                            .control = machine_control()});
  if (!early_damage_.empty()) program_->damage(std::exchange(early_damage_, {}));
}

void InboundHandler::end_program(const std::string& head) {
  if (!program_) return;
  const RuleHit hit = parts_.rules->judge(TextKind::Program, head);
  if (hit.action == RuleAction::Program) {
    // A rule's name overrides the protocol's, that overrides the text's own.
    const bool is_named = hit.rule != nullptr && !hit.argument.empty();
    store_program(is_named || program_name_.empty() ? hit.argument : program_name_);
  } else if (hit.action != RuleAction::Report && hit.action != RuleAction::Ignore) {
    call(hit.action, hit.argument);
  }
  program_.reset();
}

void InboundHandler::store_program(const std::string& name) {
  const auto stored = program_->store(name);
  if (!stored) {
    process::log_error("uploaded program not stored machine={}: {}", parts_.machine,
                       stored.error().what);
    const bool is_full = stored.error().code == Errc::Io;
    return report(library::with_control_words(
                      {stored.error().code, "program not stored: " + stored.error().what},
                      machine_control(),
                      is_full ? library::Refusal::DiskFull : library::Refusal::NotSaved)
                      .what);
  }
  const auto& revision = stored->revision;
  report(fmt::format("program {} is revision {}{}", revision.program, revision.number,
                     revision.is_held ? ", held for acceptance" : ""));
}

/// To monitors of the line; and to the control, where the rules define how.
void InboundHandler::report(const std::string& words) {
  if (const auto line = parts_.calls.directory.line_of(parts_.machine)) line->note(words);
  call(RuleAction::Report, words);
}

void InboundHandler::call(RuleAction action, const std::string& argument) {
  if (waiting_.size() < kMaxWaiting) waiting_.push_back({action, argument});
}

void InboundHandler::do_calls() {
  for (const auto& call : std::exchange(waiting_, {})) {
    if (call.action == RuleAction::Report) {
      calls_.report({call.argument});
    } else {
      calls_.carry_out(call.action, call.argument);
    }
  }
}

}  // namespace dripline::ports
