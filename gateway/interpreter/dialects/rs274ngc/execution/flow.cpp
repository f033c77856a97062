#include "gateway/interpreter/dialects/rs274ngc/execution/flow.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

std::string label_text(const Run& run, Label label) {
  constexpr std::int64_t kFirstName = std::int64_t{1} << 40;
  if (label.value < kFirstName) return fmt::format("{}", label.value);
  return run.state.label_names[static_cast<std::size_t>(label.value - kFirstName)];
}

/// Of the place cache: the line that asked, and what for.
TextPlace cache_key(const Skip& skip) {
  TextPlace key = skip.from;
  key.line = static_cast<std::uint64_t>(skip.until);
  if (skip.until == SkipFor::FanucLabel) key.offset = static_cast<std::uint64_t>(skip.label.value);
  return key;
}

bool is_wanted(SkipFor until, Oword word) {
  if (until == SkipFor::Branch)
    return word == Oword::ElseIf || word == Oword::Else || word == Oword::EndIf;
  struct Row {
    SkipFor until;
    Oword word;
  };
  constexpr std::array kRows{
      Row{SkipFor::EndOfSub, Oword::EndSub},     Row{SkipFor::EndOfIf, Oword::EndIf},
      Row{SkipFor::EndOfWhile, Oword::EndWhile}, Row{SkipFor::EndOfRepeat, Oword::EndRepeat},
      Row{SkipFor::EndOfDo, Oword::While},       Row{SkipFor::TestOfDo, Oword::While},
      Row{SkipFor::FileSub, Oword::Sub},         Row{SkipFor::LaterSub, Oword::Sub},
      Row{SkipFor::FanucLabel, Oword::Alone}};
  return std::any_of(kRows.begin(), kRows.end(),
                     [=](const Row& row) { return row.until == until && row.word == word; });
}

/// Words of the same label that may appear between.
bool is_passed(SkipFor until, Oword word) {
  if (word == Oword::Break || word == Oword::Continue || word == Oword::Return) return true;
  if (until == SkipFor::EndOfIf) return word == Oword::ElseIf || word == Oword::Else;
  return until == SkipFor::EndOfSub || until == SkipFor::FileSub || until == SkipFor::LaterSub ||
         until == SkipFor::FanucLabel;
}

/// M98 has found a subprogram of O call, or the reverse.
bool is_called_otherwise(SkipFor until, Oword word) {
  if (until == SkipFor::FanucLabel) return word == Oword::Sub;
  return (until == SkipFor::FileSub || until == SkipFor::LaterSub) && word == Oword::Alone;
}

/// The control reads a line up to its end before it passes over it.
bool check_comments(Run& run) {
  const char* open = nullptr;
  for (const char* at = run.line_begin; at != run.line_end; ++at) {
    if (*at == ';' && open == nullptr) return true;
    if (*at == ')') open = nullptr;
    if (*at != '(') continue;
    if (open != nullptr) return run.fail(ErrorCode::NestedComment, run.column(at));
    open = at;
  }
  return open == nullptr || run.fail(ErrorCode::UnclosedComment, run.column(open));
}

bool lands_on_line(SkipFor until) {
  return until == SkipFor::Branch || until == SkipFor::EndOfIf || until == SkipFor::TestOfDo;
}

SkipFor end_of(BlockKind kind) {
  if (kind == BlockKind::While) return SkipFor::EndOfWhile;
  return kind == BlockKind::Do ? SkipFor::EndOfDo : SkipFor::EndOfRepeat;
}

}  // namespace

bool Flow::refuse(const DiagnosticRow& code, const OwordHead& head, const char* detail) {
  return run_.fail(code, 1, fmt::format("O{} {}", label_text(run_, head.label), detail));
}

Label Flow::scope() const {
  return run_.state.calls.empty() ? Label{} : run_.state.calls.back().scope;
}

const KnownLabel* Flow::find_label(Label scope, Label label) {
  const auto& labels = run_.state.labels;
  if (label_index_.size() != labels.size()) {
    label_index_.clear();
    for (std::size_t i = 0; i < labels.size(); ++i) {
      label_index_[{labels[i].scope.value, labels[i].label.value}] = i;
    }
  }
  const auto at = label_index_.find({scope.value, label.value});
  return at == label_index_.end() ? nullptr : &labels[at->second];
}

/// A label begins one thing only, wherever it is met again.
bool Flow::know(const OwordHead& head, bool is_subprogram) {
  const Label in = is_subprogram ? Label{} : scope();
  if (const KnownLabel* known = find_label(in, head.label)) {
    if (known->place == run_.here) return true;
    return run_.fail(
        ErrorCode::OwordRedefined, 1,
        fmt::format("O{} is in line {}", label_text(run_, head.label), known->place.line));
  }
  auto& labels = run_.state.labels;
  if (labels.size() == kMaxLabels) return refuse(ErrorCode::OwordNesting, head, "too many labels");
  labels.push_back({in, head.label, is_subprogram, run_.here});
  return true;
}

bool Flow::count_pass() {
  if (++run_.state.passes <= run_.options.max_passes) return true;
  return run_.fail(ErrorCode::LoopLimit, 0, fmt::format("more than {}", run_.options.max_passes));
}

void Flow::land(const TextPlace& place) {
  const SkipFor until = std::exchange(run_.state.skip.until, SkipFor::Nothing);
  run_.next = place;
  if (until == SkipFor::FileSub || until == SkipFor::LaterSub || until == SkipFor::FanucLabel ||
      until == SkipFor::FanucFile) {
    run_.state.calls.back().entry = place;
  }
}

bool Flow::skip_to(SkipFor until, Label label) {
  run_.state.skip = {until, label, run_.here};
  const auto known = places_.find(cache_key(run_.state.skip));
  if (known != places_.end()) land(known->second);
  return true;
}

bool Flow::pass_over() {
  State& state = run_.state;
  if (!check_comments(run_)) return false;
  const OwordHead head = peek_oword(run_);
  if (head.word == Oword::None) {
    const bool is_end = *skip_blanks(run_.line_begin) == '%' &&
                        state.skip.until == SkipFor::LaterSub &&
                        state.demarcation == Demarcation::Percent;
    return !is_end || refuse_missing_sub();
  }
  if (!(head.label == state.skip.label)) {
    const bool is_nested = head.word == Oword::Sub && state.skip.until == SkipFor::EndOfSub;
    return !is_nested || refuse(ErrorCode::OwordSubHere, head, "within another");
  }
  if (!is_wanted(state.skip.until, head.word)) {
    if (is_called_otherwise(state.skip.until, head.word)) {
      return refuse(ErrorCode::OwordMixed, head, "");
    }
    if (is_passed(state.skip.until, head.word)) return true;
    return refuse(ErrorCode::OwordUnmatched, head, "meets another word of the same label");
  }
  if (state.skip.until == SkipFor::LaterSub && !know_later_sub(head)) return false;
  const TextPlace place = lands_on_line(state.skip.until) ? run_.here : run_.next;
  if (places_.size() == kMaxPlaces) places_.clear();
  places_[cache_key(state.skip)] = place;
  land(place);
  return true;
}

bool Flow::end_of_text() {
  State& state = run_.state;
  if (state.skip.until == SkipFor::FanucLabel) {  // not in this text: a file of its own
    state.skip.until = SkipFor::FanucFile;
    return true;
  }
  if (state.skip.until == SkipFor::LaterSub) return refuse_missing_sub();
  if (state.skip.until != SkipFor::Nothing) {
    return run_.fail(
        ErrorCode::OwordUnmatched, 0,
        fmt::format("O{} of line {}", label_text(run_, state.skip.label), state.skip.from.line));
  }
  if (!state.calls.empty() && state.calls.back().is_fanuc &&
      state.at.program == state.calls.back().entry.program && state.at.program != kMainProgram) {
    return execute_fanuc(99);
  }
  return run_.fail(
      state.demarcation == Demarcation::Percent ? ErrorCode::NoPercent : ErrorCode::NoEnd, 0);
}

/// Reported at the call.
bool Flow::refuse_missing_sub() {
  const TextPlace& call = run_.state.skip.from;
  run_.origin.line = call.line;
  run_.origin.offset = call.offset;
  run_.origin.program = call.program;
  return run_.fail(ErrorCode::CallNotFound, 1,
                   fmt::format("O{}: no subprogram in the text, and no file",
                               label_text(run_, run_.state.skip.label)));
}

/// Further calls go there at once. A label that begins something else in the main program stays
/// that; its subprogram is looked for again.
bool Flow::know_later_sub(const OwordHead& head) {
  return find_label(Label{}, head.label) != nullptr || know(head, true);
}

bool Flow::look_up_file() {
  State& state = run_.state;
  const std::string name = label_text(run_, state.skip.label);
  const auto found = run_.reader.find(name);
  if (found.state == ProgramLookup::State::NotYet) {
    run_.pause = Pause::ForText;
    return false;
  }
  if (found.state == ProgramLookup::State::NotFound) {
    if (state.skip.until == SkipFor::FanucFile) return refuse_missing_sub();
    // Not a file: in the same text, after the call.
    run_.next = state.calls.back().back;
    state.skip.until = SkipFor::LaterSub;
    return true;
  }
  const TextPlace start{found.program, 0, 1};
  run_.next = start;
  if (state.skip.until == SkipFor::FanucFile) {
    land(start);
  } else {
    state.skip = {SkipFor::FileSub, state.skip.label, start};
  }
  return true;
}

void Flow::reset() {
  heads_.fill({});
  places_.clear();
  label_index_.clear();
}

// Loops and conditions.

bool Flow::condition(const OwordHead& head, double& value) {
  const char* at = head.after;
  return read_operand(run_, at, value) && end_of_oword(run_, at);
}

bool Flow::push(BlockKind kind, const OwordHead& head, std::uint64_t left) {
  if (!know(head, false)) return false;
  if (run_.state.frames.size() == kMaxBlocks) {
    return run_.fail(ErrorCode::OwordNesting, 0, fmt::format("more than {}", kMaxBlocks));
  }
  const TextPlace& again = kind == BlockKind::Repeat ? run_.next : run_.here;
  run_.state.frames.push_back({kind, head.label, again, left});
  return true;
}

BlockFrame* Flow::frame_of(Label label) {
  State& state = run_.state;
  const std::size_t base = state.calls.empty() ? 0 : state.calls.back().block_base;
  for (std::size_t i = state.frames.size(); i > base; --i) {
    if (!(state.frames[i - 1].label == label)) continue;
    state.frames.resize(i);
    return &state.frames[i - 1];
  }
  return nullptr;
}

bool Flow::begin_if(const OwordHead& head) {
  double holds = 0;
  if (!condition(head, holds) || !push(BlockKind::If, head, holds != 0 ? 1 : 0)) return false;
  return holds != 0 || skip_to(SkipFor::Branch, head.label);
}

bool Flow::next_branch(const OwordHead& head) {
  BlockFrame* frame = frame_of(head.label);
  if (frame == nullptr || frame->kind != BlockKind::If) {
    return refuse(ErrorCode::OwordUndefined, head, "else without if");
  }
  double holds = 1;
  const bool is_ok =
      head.word == Oword::Else ? end_of_oword(run_, head.after) : condition(head, holds);
  if (!is_ok) return false;
  if (frame->left != 0) return skip_to(SkipFor::EndOfIf, head.label);
  if (holds == 0) return skip_to(SkipFor::Branch, head.label);
  frame->left = 1;
  return true;
}

bool Flow::end_if(const OwordHead& head) {
  const BlockFrame* frame = frame_of(head.label);
  if (frame == nullptr || frame->kind != BlockKind::If) {
    return refuse(ErrorCode::OwordUndefined, head, "endif without if");
  }
  run_.state.frames.pop_back();
  return end_of_oword(run_, head.after);
}

bool Flow::begin_while(const OwordHead& head) {
  BlockFrame* frame = frame_of(head.label);
  if (frame != nullptr && frame->kind == BlockKind::Do) return test_do(head, *frame);
  double holds = 0;
  if (!condition(head, holds)) return false;
  // Every pass comes here again with its frame still there.
  const bool is_again = frame != nullptr && frame->head == run_.here;
  if (holds != 0) return is_again || push(BlockKind::While, head, 0);
  if (is_again) {
    run_.state.frames.pop_back();
  } else if (!know(head, false)) {
    return false;
  }
  return skip_to(SkipFor::EndOfWhile, head.label);
}

bool Flow::test_do(const OwordHead& head, BlockFrame& frame) {
  double holds = 0;
  if (!condition(head, holds)) return false;
  if (holds == 0) {
    run_.state.frames.pop_back();
    return true;
  }
  run_.next = frame.head;
  return count_pass();
}

bool Flow::begin_do(const OwordHead& head) {
  if (!end_of_oword(run_, head.after)) return false;
  const BlockFrame* frame = frame_of(head.label);
  const bool is_again =
      frame != nullptr && frame->kind == BlockKind::Do && frame->head == run_.here;
  return is_again || push(BlockKind::Do, head, 0);
}

bool Flow::begin_repeat(const OwordHead& head) {
  constexpr double kMax = 1e15;
  double count = 0;
  if (!condition(head, count)) return false;
  count = std::round(count);
  if (!(count >= 1)) return know(head, false) && skip_to(SkipFor::EndOfRepeat, head.label);
  return push(BlockKind::Repeat, head, static_cast<std::uint64_t>(std::fmin(count, kMax)) - 1);
}

bool Flow::end_loop(const OwordHead& head) {
  const bool is_while = head.word == Oword::EndWhile;
  BlockFrame* frame = frame_of(head.label);
  if (frame == nullptr || frame->kind != (is_while ? BlockKind::While : BlockKind::Repeat)) {
    return refuse(ErrorCode::OwordUnmatched, head, is_while ? "endwhile" : "endrepeat");
  }
  if (!end_of_oword(run_, head.after)) return false;
  if (!is_while && frame->left-- == 0) {
    run_.state.frames.pop_back();
    return true;
  }
  run_.next = frame->head;
  return count_pass();
}

bool Flow::leave_loop(const OwordHead& head) {
  BlockFrame* frame = frame_of(head.label);
  const bool is_loop =
      frame != nullptr && (frame->kind == BlockKind::While || frame->kind == BlockKind::Do);
  if (!is_loop) return refuse(ErrorCode::OwordUnmatched, head, "is not a while or do here");
  if (!end_of_oword(run_, head.after)) return false;
  if (head.word == Oword::Break) {
    const SkipFor until = end_of(frame->kind);
    run_.state.frames.pop_back();
    return skip_to(until, head.label);
  }
  if (frame->kind == BlockKind::Do) return skip_to(SkipFor::TestOfDo, head.label);
  run_.next = frame->head;
  return count_pass();
}

}  // namespace dripline::interpreter::rs274ngc
