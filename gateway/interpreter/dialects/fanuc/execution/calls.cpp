#include "gateway/interpreter/dialects/fanuc/execution/flow.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/call_arguments.hpp"

namespace dripline::interpreter::fanuc {
namespace {

bool refuse_two(Run& run) {
  return run.fail(ErrorCode::ImproperCommand, 0, "two calls or ends in one block");
}

/// Of the block in hand; empty: it calls by number.
std::string called_name(const Run& run) {
  const Block::Parts& parts = run.block.parts;
  return {run.text.begin() + parts.name_begin, run.text.begin() + parts.name_end};
}

void open_call(Run& run, CallKind kind, std::uint32_t program, std::string name,
               std::uint32_t passes) {
  Jump& jump = run.state.jump;
  jump = Jump{};
  jump.kind = JumpKind::Call;
  jump.call = kind;
  jump.number = program;
  jump.name = std::move(name);
  jump.passes = passes;
  jump.from = run.state.at;
}

bool read_passes(Run& run, std::uint32_t& passes) {
  const Words& words = run.block.words;
  run.ledger.take(set_of(L));
  const double repeats = run.whole(words[L]);
  if (!(repeats >= 1 && repeats <= 9999)) {
    return run.fail(ErrorCode::TooManyDigits, words.column(L), fmt::format("L{}", repeats));
  }
  passes = static_cast<std::uint32_t>(repeats);
  return true;
}

/// M98 of a program with a name; its repeats are always in L. `folder`: that of M198.
bool plan_named_subprogram(Run& run, const std::string& folder) {
  const Words& words = run.block.words;
  if (words.has(P))
    return run.fail(ErrorCode::ImproperCommand, words.column(P), "two programs in one block");
  std::uint32_t passes = 1;
  if (words.has(L) && !read_passes(run, passes)) return false;
  open_call(run, CallKind::Subprogram, 0, folder + called_name(run), passes);
  return true;
}

/// P of M98: a program, with repeats before its last four digits where the form allows.
bool plan_subprogram(Run& run, int code) {
  const Words& words = run.block.words;
  const CallForm form = run.options.call_form;
  if (run.options.is_dnc && code == 198) return run.fail(ErrorCode::ExternalCall, 0);
  const bool has_name = run.block.parts.name_end != 0;
  if (!words.has(P) && !has_name) return run.fail(ErrorCode::NoP, 0);
  if (words.has(Q)) {
    // Later controls begin the program at block N of this number; from its head is another part.
    return run.fail(ErrorCode::ImproperCommand, words.column(Q),
                    fmt::format("M{} calls a program from its head, not from a block", code));
  }
  const std::string folder = code == 198 ? run.options.external_folder : std::string();
  if (has_name) return plan_named_subprogram(run, folder);
  const double value = run.whole(words[P]);
  const bool has_long_numbers = run.options.program_digits == 8;
  const bool takes_l = words.has(L) && (form != CallForm::EightDigits || has_long_numbers);
  if (words.has(L) && !takes_l) {
    return run.fail(ErrorCode::ImproperCommand, words.column(L),
                    fmt::format("repeats of M{} stand before the last four digits of P here, not "
                                "in L: m98_form, or the model, decides it",
                                code));
  }
  const bool splits = form != CallForm::L && !takes_l && !has_long_numbers;
  const double most = splits || has_long_numbers ? 99'999'999 : 9999;
  if (!(value >= 1 && value <= most) || value != std::trunc(value)) {
    return run.fail(ErrorCode::NumberNotFound, words.column(P), fmt::format("P{}", value));
  }
  if (has_long_numbers && form == CallForm::EightDigits && value > 9999) {
    return run.fail(ErrorCode::ImproperCommand, words.column(P),
                    fmt::format("P{:.0f} is a program, or repeats of one of four digits: m98_form "
                                "decides it with program_digits = 8",
                                value));
  }
  auto program = static_cast<std::uint32_t>(value);
  std::uint32_t passes = 1;
  if (splits && program > 9999) {
    passes = program / 10000;
    program %= 10000;
  }
  if (takes_l && !read_passes(run, passes)) return false;
  if (program == 0) return run.fail(ErrorCode::NumberNotFound, words.column(P), "O0000");
  std::string name;
  if (!folder.empty()) name = fmt::format("{}O{:04}", folder, program);
  open_call(run, CallKind::Subprogram, program, std::move(name), passes);
  return true;
}

bool plan_return(Run& run) {
  const Words& words = run.block.words;
  run.block.parts.ending = Ending::Return;
  if (words.has(L)) {
    run.ledger.take(set_of(L));
    const double passes = run.whole(words[L]);
    if (!(passes >= 0 && passes <= 9999)) {
      return run.fail(ErrorCode::TooManyDigits, words.column(L), fmt::format("L{}", passes));
    }
    run.block.parts.passes_left = static_cast<std::uint32_t>(passes);
  }
  if (!words.has(P)) return true;
  const double value = run.whole(words[P]);
  if (!(value >= 1 && value <= std::max(run.options.last_sequence, 99'999u))) {
    return run.fail(ErrorCode::SequenceNotFound, words.column(P), fmt::format("P{}", value));
  }
  run.block.parts.ending_number = static_cast<std::uint32_t>(value);
  return true;
}

}  // namespace

bool plan_flow_of_m_codes(Run& run) {
  Block& block = run.block;
  for (std::size_t i = 0; i < block.parts.m_count; ++i) {
    const int code = block.m[i];
    const bool is_flow = code == 2 || code == 30 || code == 98 || code == 99 || code == 198;
    if (!is_flow) {
      if (code == 199 && run.options.is_dnc) return run.fail(ErrorCode::ExternalCall, 0);
      continue;
    }
    if (block.parts.ending != Ending::None || run.state.jump.kind != JumpKind::None) {
      return refuse_two(run);
    }
    if (code == 98 || code == 198) {
      if (!plan_subprogram(run, code)) return false;
    } else if (code == 99) {
      if (!plan_return(run)) return false;
    } else {
      block.parts.ending = Ending::EndOfProgram;
      block.parts.rewinds = code == 30;
    }
  }
  return true;
}

bool plan_macro_call(Run& run) {
  ModalState& state = run.state;
  const Block::Parts& parts = run.block.parts;
  if (!parts.has_call_program) {
    const bool is_macro_a = run.options.model == Model::M0;
    return is_macro_a ? run.fail(ErrorCode::ImproperG, parts.g_column, "MACRO A")
                      : run.fail(ErrorCode::NoP, parts.g_column);
  }
  Locals arguments;
  if (!assign_arguments(run, arguments)) return false;
  if (parts.call == CallKind::Code && parts.variable != 0) {
    if (!write_variable(run, parts.variable, parts.g_column, parts.value)) return false;
  }
  if (!parts.is_modal_call) {
    open_call(run, parts.call, parts.call_program, called_name(run), parts.call_passes);
    state.jump.arguments = arguments;
    return true;
  }
  if (state.modals.size() == kMaxModalCalls) {
    return run.fail(ErrorCode::TooManyModalCalls, parts.g_column);
  }
  state.modals.push_back(
      {parts.call_program, called_name(run), parts.call_passes, state.modal_active, arguments});
  state.modal_active = static_cast<std::int8_t>(state.modals.size() - 1);
  run.update_special();
  return true;
}

void cancel_modal_call(Run& run) {
  ModalState& state = run.state;
  if (state.modal_active < 0) return;
  const auto macro =
      std::find_if(state.calls.rbegin(), state.calls.rend(),
                   [](const CallFrame& frame) { return frame.kind != CallKind::Subprogram; });
  const std::size_t floor = macro == state.calls.rend() ? 0 : macro->modal_count;
  state.modal_active = state.modals[static_cast<std::size_t>(state.modal_active)].outer;
  if (state.modals.size() > floor) state.modals.pop_back();
  run.update_special();
}

bool plan_modal_call(Run& run) {
  ModalState& state = run.state;
  if (state.modal_active < 0 || !run.block.parts.has_motion) [[likely]]
    return true;
  if (state.jump.kind != JumpKind::None || run.block.parts.ending != Ending::None) return true;
  const ModalCall& call = state.modals[static_cast<std::size_t>(state.modal_active)];
  open_call(run, CallKind::Modal, call.program, call.name, call.passes);
  state.jump.arguments = call.arguments;
  state.jump.modal = state.modal_active;
  return true;
}

}  // namespace dripline::interpreter::fanuc
