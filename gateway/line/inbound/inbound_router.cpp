#include "gateway/line/inbound/inbound_router.hpp"

#include <utility>

#include "protocol/base/utf8.hpp"
#include "protocol/measurement/cut_line.hpp"

namespace dripline::line {
namespace {

constexpr std::size_t kMaxWaiting = 8;
constexpr const char* kRest =
    "what came right after the line was opened does not begin as a program: it may be the rest of "
    "one, and is kept as printed lines; send the program again";

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

void InboundRouter::take(const Incoming& incoming, std::function<void()> kept) {
  auto items = split(incoming);
  sink_.note_kind(incoming.what != Incoming::What::Text || splitter_.may_be_program());
  std::vector<PrintedLine> lines;
  for (auto& item : items) handle(item, lines);
  if (lines.empty()) {
    kept();
  } else {
    sink_.print(std::move(lines), std::move(kept));
  }
  if (incoming.what == Incoming::What::Ended || incoming.what == Incoming::What::Failed) {
    is_in_transfer_ = false;
    early_damage_.clear();
  }
  if (!is_in_transfer_) do_calls();
}

std::vector<InboundSplitter::Item> InboundRouter::split(const Incoming& incoming) {
  switch (incoming.what) {
    case Incoming::What::Began:
      is_in_transfer_ = true;
      program_name_ = incoming.text;
      splitter_.take_programs_only(sink_.sends_programs_only());
      if (incoming.may_be_rest) splitter_.expect_rest();
      if (incoming.may_be_rest || incoming.is_first) splitter_.mark_rest();
      splitter_.begin(incoming.text, incoming.is_program);
      break;
    case Incoming::What::Text:
      return splitter_.take(incoming.text);
    case Incoming::What::Damaged:
      if (has_program_) sink_.damage(incoming.text);
      early_damage_ = incoming.text;
      if (incoming.is_cut) splitter_.lose();
      break;
    case Incoming::What::Ended:
      if (splitter_.has_rest()) report(kRest);
      return incoming.is_cut ? splitter_.end_silent() : splitter_.end();
    case Incoming::What::Failed:
      failure_ = incoming.text;
      return splitter_.fail();
  }
  return {};
}

void InboundRouter::handle(InboundSplitter::Item& item, std::vector<PrintedLine>& lines) {
  switch (item.what) {
    case InboundSplitter::Item::What::Line:
      return handle_line(item, lines);
    case InboundSplitter::Item::What::ProgramBegan:
      return begin_program(item.text);
    case InboundSplitter::Item::What::ProgramText:
      if (has_program_) sink_.add_text(item.text);
      return;
    case InboundSplitter::Item::What::ProgramEnded:
      return end_program(item.text);
    case InboundSplitter::Item::What::ProgramFailed:
      if (std::exchange(has_program_, false)) sink_.cut_off_program(failure_);
      return report("a program was cut off and not stored");
  }
}

void InboundRouter::handle_line(const InboundSplitter::Item& line,
                                std::vector<PrintedLine>& lines) {
  const RuleHit hit = rules_->judge(TextKind::Line, line.text);
  if (hit.action == RuleAction::Ignore) return;
  if (hit.action != RuleAction::Report) return call(hit.action, hit.argument);
  std::string text = printed_text(line.text);
  if (line.may_be_rest) text = measurement::rest_line(std::move(text));
  if (line.is_cut) text = measurement::cut_line(std::move(text));
  lines.push_back({std::move(text), hit.is_probe});
}

void InboundRouter::begin_program(const std::string& name) {
  program_name_ = name;
  has_program_ = true;
  sink_.begin_program();
  if (!early_damage_.empty()) sink_.damage(std::exchange(early_damage_, {}));
}

void InboundRouter::end_program(const std::string& head) {
  if (!std::exchange(has_program_, false)) return;
  const RuleHit hit = rules_->judge(TextKind::Program, head);
  if (hit.action == RuleAction::Program) {
    // A rule's name overrides the protocol's, that overrides the text's own.
    const bool is_named = hit.rule != nullptr && !hit.argument.empty();
    return sink_.store_program(is_named || program_name_.empty() ? hit.argument : program_name_);
  }
  sink_.drop_program();
  if (hit.action != RuleAction::Report && hit.action != RuleAction::Ignore)
    call(hit.action, hit.argument);
}

void InboundRouter::report(const std::string& words) {
  sink_.note(words);
  call(RuleAction::Report, words);
}

void InboundRouter::tell(const std::string& words) {
  report(words);
  if (!is_in_transfer_) do_calls();
}

void InboundRouter::call(RuleAction action, const std::string& argument) {
  if (waiting_.size() < kMaxWaiting) waiting_.push_back({action, argument});
}

void InboundRouter::do_calls() {
  for (const auto& call : std::exchange(waiting_, {})) {
    if (call.action == RuleAction::Report) {
      sink_.answer(call.argument);
    } else {
      sink_.carry_out(call.action, call.argument);
    }
  }
}

}  // namespace dripline::line
