#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/flow.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/saved_modes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

/// Flow: sub, call, return, and M98 with M99.
namespace dripline::interpreter::rs274ngc {
namespace {

void set_value(Run& run, double value, bool is_returned) {
  run.names.set(run.names.id_of("_value"), 0, value);
  run.names.set(run.names.id_of("_value_returned"), 0, is_returned ? 1 : 0);
}

}  // namespace

bool Flow::begin_sub(const OwordHead& head) {
  if (!end_of_oword(run_, head.after)) return false;
  // A sub inside a sub is passed over with it, so this one begins where it may not.
  if (!run_.state.calls.empty() && !run_.state.calls.back().is_fanuc) {
    return refuse(ErrorCode::OwordSubHere, head);
  }
  // It was called before, or a loop comes here again: the control takes it for another.
  const KnownLabel* known = find_label(Label{}, head.label);
  if (known != nullptr && known->is_subprogram) {
    return known->place == run_.here ? refuse(ErrorCode::OwordSubHere, head)
                                     : refuse(ErrorCode::OwordRedefined, head);
  }
  return know(head, true) && skip_to(SkipFor::EndOfSub, head.label);
}

/// endsub and return may bring a value back.
bool Flow::leave_sub(const OwordHead& head) {
  const char* at = skip_blanks(head.after);
  double value = 0;
  const bool has_value = *at == '[';
  if (has_value && !read_operand(run_, at, value)) return false;
  if (!end_of_oword(run_, at)) return false;
  const auto& calls = run_.state.calls;
  if (calls.empty()) return true;  // outside of a subprogram: nothing
  if (calls.back().is_fanuc) return refuse(ErrorCode::OwordMixed, head, "was called by M98");
  set_value(run_, value, has_value);
  return return_from_call();
}

bool Flow::end_sub(const OwordHead& head) {
  const auto& calls = run_.state.calls;
  if (calls.empty() || !(calls.back().scope == head.label)) {
    return refuse(ErrorCode::OwordUnmatched, head, "endsub without its call");
  }
  return leave_sub(head);
}

bool Flow::return_from_call() {
  State& state = run_.state;
  const CallFrame frame = state.calls.back();
  const bool restores = frame.modes.is_valid && frame.modes.restores_at_return;
  if (restores && !restore_modes(run_, frame.modes)) return false;
  state.frames.resize(frame.block_base);
  if (!frame.is_fanuc)
    std::copy(frame.saved.begin(), frame.saved.end(), run_.parameters.begin() + 1);
  run_.next = frame.back;
  state.calls.pop_back();
  return true;
}

bool Flow::push_call(const TextPlace& entry, Label scope, bool is_fanuc, std::uint64_t passes) {
  State& state = run_.state;
  if (state.calls.size() == kMaxCalls) {
    return run_.fail(ErrorCode::OwordNesting, 0, fmt::format("more than {} calls", kMaxCalls));
  }
  if (!count_pass()) return false;
  CallFrame frame;
  frame.scope = scope;
  frame.back = run_.next;
  frame.entry = entry;
  frame.is_fanuc = is_fanuc;
  frame.passes_left = passes - 1;
  frame.block_base = static_cast<std::uint32_t>(state.frames.size());
  std::copy_n(run_.parameters.begin() + 1, kArguments, frame.saved.begin());
  state.calls.push_back(frame);
  run_.names.enter(state.calls.size());
  return true;
}

bool Flow::read_arguments(const char* at) {
  argument_count_ = 0;
  arguments_.fill(0);
  for (;;) {
    if (!skip_comments(run_, at)) return false;
    if (*at != '[') break;
    if (argument_count_ == kArguments) {
      return run_.fail(ErrorCode::OwordArguments, run_.column(at),
                       fmt::format("more than {}", kArguments));
    }
    if (!read_expression(run_, at, arguments_[argument_count_])) return false;
    ++argument_count_;
  }
  return end_of_oword(run_, at);
}

bool Flow::call(const OwordHead& head) {
  return read_arguments(head.after) && enter_sub(head.label);
}

bool Flow::call_contour(std::int64_t number) {
  argument_count_ = 0;
  arguments_.fill(0);
  return enter_sub(Label{number});
}

bool Flow::enter_sub(Label label) {
  const KnownLabel* known = find_label(Label{}, label);
  if (known == nullptr || !known->is_subprogram) {
    if (!push_call(run_.next, label, false, 1)) return false;
    std::copy(arguments_.begin(), arguments_.end(), run_.parameters.begin() + 1);
    run_.state.skip = {SkipFor::SubFile, label, run_.here};
    return true;
  }
  const TextPlace line = known->place;
  // The line after `sub` was met when the sub was passed over.
  if (!push_call(line, label, false, 1)) return false;
  std::copy(arguments_.begin(), arguments_.end(), run_.parameters.begin() + 1);
  run_.next = line;
  run_.state.skip = {SkipFor::FileSub, label, line};
  const auto entry = places_.find(
      TextPlace{line.program, line.offset, static_cast<std::uint64_t>(SkipFor::FileSub)});
  if (entry != places_.end()) land(entry->second);
  return true;
}

bool Flow::execute_fanuc(int m_code) {
  State& state = run_.state;
  if (m_code == 98) {
    const Words& words = run_.block.words;
    constexpr double kMax = 1e9;
    const double number = words.value_or('P', -1);
    const double repeats = words.value_or('L', 1);
    if (!(number >= 0 && number <= kMax) || number != std::round(number) ||
        !(repeats >= 0 && repeats <= kMax)) {
      return run_.fail_word(ErrorCode::CallNotFound, 'P', "M98 needs P, and L from 0");
    }
    if (repeats < 1) return true;
    const Label label{static_cast<std::int64_t>(number)};
    if (!push_call({}, label, true, static_cast<std::uint64_t>(repeats))) return false;
    const TextPlace start{state.at.program, 0, 1};
    state.skip = {SkipFor::FanucLabel, label, start};
    run_.next = start;
    const auto known =
        places_.find(TextPlace{start.program, static_cast<std::uint64_t>(label.value),
                               static_cast<std::uint64_t>(SkipFor::FanucLabel)});
    if (known != places_.end()) land(known->second);
    return true;
  }
  if (state.calls.empty()) {  // the main program begins again
    if (++state.passes > run_.options.max_restarts) {
      return run_.fail(
          ErrorCode::LoopLimit, 0,
          fmt::format("M99 in the main program, more than {}", run_.options.max_restarts));
    }
    state.frames.clear();
    state.labels.clear();
    run_.next = TextPlace{};
    return true;
  }
  CallFrame& frame = state.calls.back();
  if (!frame.is_fanuc) {
    return run_.fail(ErrorCode::OwordMixed, 0, "M99 in a subprogram that was called by O call");
  }
  if (frame.passes_left == 0) return return_from_call();
  --frame.passes_left;
  state.frames.resize(frame.block_base);
  run_.next = frame.entry;
  return count_pass();
}

}  // namespace dripline::interpreter::rs274ngc
