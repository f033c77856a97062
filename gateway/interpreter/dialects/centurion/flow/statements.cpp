#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/cycles/cycle_words.hpp"
#include "gateway/interpreter/dialects/centurion/flow/output_text.hpp"
#include "gateway/interpreter/dialects/centurion/memory/pins.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::uint32_t kHighestLabel = 99999;
constexpr std::uint32_t kHighestProgram = 9999;

void keep_for_g11(std::vector<DataChange>& changes, int number, double value) {
  const auto same = [number](const DataChange& change) { return change.number == number; };
  const auto found = std::find_if(changes.begin(), changes.end(), same);
  if (found != changes.end()) {
    found->value = value;
  } else {
    changes.push_back({static_cast<std::uint16_t>(number), value});
  }
}

const char* end_of_block(const char* at) {
  while (!is_end_of_block(*at)) ++at;
  return at;
}

/// A block can jump once only.
bool claim_flow(Run& run, const char* start) {
  const Block::Parts& parts = run.block.parts;
  if (parts.jump == JumpKind::None && parts.ending == Ending::None) return true;
  return run.fail(ErrorCode::IllegalStatement, run.column(start), "a second jump in one block");
}

bool read_jump(Run& run, JumpKind kind, std::uint32_t limit, const char* start, const char*& at) {
  if (!claim_flow(run, start)) return false;
  Block::Parts& parts = run.block.parts;
  if (!read_whole(run, at, limit, parts.jump_number)) return false;
  parts.jump = kind;
  return true;
}

bool refuse_in_dnc(Run& run, const char* start) {
  return run.fail(ErrorCode::NotInDnc, run.column(start));
}

bool read_if(Run& run, const char*& at) {
  bool holds = false;
  if (!read_condition(run, at, holds)) return false;
  take_word(at, "THEN");
  if (!holds) at = end_of_block(at);
  return true;
}

bool read_while(Run& run, const char* start, const char*& at) {
  if (run.options.refuses_loops_and_calls) return refuse_in_dnc(run, start);
  if (!claim_flow(run, start)) return false;
  bool holds = false;
  if (!read_condition(run, at, holds)) return false;
  run.block.parts.jump = JumpKind::While;
  run.block.parts.while_condition = holds;
  return true;
}

bool end_with(Run& run, Ending ending, const char* start) {
  if (!claim_flow(run, start)) return false;
  run.block.parts.ending = ending;
  return true;
}

bool answer_input(Run& run, const PromptQuestion& question, std::uint32_t number,
                  std::uint32_t column, const char*& at) {
  const auto& answer = std::get<PromptAnswer>(*run.next_answer());
  if (!answer.text) {
    run.block.parts.ending = Ending::OperatorEnd;
    at = end_of_block(at);
    return true;
  }
  double value = 0;
  if (answer.text->empty()) {  // ENTER keeps the present value
    if (!read_parameter(run, number, column, value)) return false;
  } else {
    value = parse_decimal(*answer.text)->value();
  }
  if (!store_parameter(run, static_cast<int>(number), value, column)) return false;
  run.events().on_prompt({run.origin, question.text, question.variable, *answer.text});
  return true;
}

/// INPUT (prompt) P n
bool read_input(Run& run, const char* start, const char*& at) {
  constexpr AddressSet kAxisWords = kEndWords | kPolarWords;
  if (run.block.words.has_any(kAxisWords)) {
    return run.fail(ErrorCode::InputAfterMove, run.column(start));
  }
  PromptQuestion question;
  at = skip_blanks(at);
  if (*at == '(') {
    const char* text = at + 1;
    if (!skip_gaps(run, at)) return false;
    const char* close = text;
    while (*close != ')') ++close;
    question.text.assign(text, close);
  }
  const std::uint32_t column = run.column(at);
  if (!take_word(at, "P")) {
    return run.fail(ErrorCode::IllegalStatement, column, "INPUT needs a parameter");
  }
  std::uint32_t number = 0;
  if (!read_whole(run, at, kParameterCount - 1, number)) return false;
  question.variable = fmt::format("P{}", number);
  if (run.answers_used == run.answers.size()) return run.ask(std::move(question));
  return answer_input(run, question, number, column, at);
}

/// HDW (prompt): the operator moves the axes by the handwheel until CYCLE START; a simulated
/// machine stays where it is.
bool read_handwheel(Run& run, const char*& at) {
  at = skip_blanks(at);
  std::string_view text;
  if (*at == '(') {
    const char* open = at;
    if (!skip_gaps(run, at)) return false;
    const char* close = open;
    while (*close != ')') ++close;
    text = std::string_view(open + 1, static_cast<std::size_t>(close - open - 1));
  }
  if (run.options.is_verify || run.options.is_mdi) return true;
  if (!text.empty()) run.events().on_message({run.origin, text});
  run.loops.note_progress();
  run.events().on_stop({run.origin, StopKind::Operator});
  return true;
}

/// SET X 3: an axis letter and the number of its output.
bool read_pin_change(Run& run, bool state, bool is_pulse, const char*& at) {
  if (!skip_gaps(run, at)) return false;
  const std::uint32_t column = run.column(at);
  OutputPin pin;
  if (take_word(at, "Z")) {
    pin.axis = Axis::Z;
  } else if (!take_word(at, "X")) {
    return run.fail(ErrorCode::IllegalStatement, column, "an axis X or Z is expected here");
  }
  std::uint32_t number = 0;
  if (!read_whole(run, at, kPinsPerKind, number)) return false;
  if (number == 0)
    return run.fail(ErrorCode::ParameterOutOfRange, column, "outputs are numbered from 1");
  pin.number = static_cast<int>(number);
  if (is_pulse) {
    pulse_output(run, pin, state, run.options.pulse_ms);
  } else {
    set_output(run, pin, state);
  }
  return true;
}

bool begin_probe(Run& run, ProbeUntil until, const char* start) {
  if (run.block.parts.probe) {
    return run.fail(ErrorCode::IllegalStatement, run.column(start), "a second PROBE in one block");
  }
  run.block.parts.probe = until;
  return true;
}

}  // namespace

bool read_statement(Run& run, Keyword keyword, const char* start, const char*& at) {
  run.block.parts.is_assignment_only = false;
  switch (keyword) {
    case Keyword::If:
      return read_if(run, at);
    case Keyword::While:
      return read_while(run, start, at);
    case Keyword::Wend:
      return end_with(run, Ending::Wend, start);
    case Keyword::Return:
      return end_with(run, Ending::Return, start);
    case Keyword::Goto:
      if (run.options.refuses_goto) return refuse_in_dnc(run, start);
      return read_jump(run, JumpKind::Goto, kHighestLabel, start, at);
    case Keyword::Gosub:
      if (run.options.refuses_loops_and_calls) return refuse_in_dnc(run, start);
      return read_jump(run, JumpKind::Gosub, kHighestLabel, start, at);
    case Keyword::Call:
      if (run.options.refuses_loops_and_calls) return refuse_in_dnc(run, start);
      run.block.parts.jump_is_call_word = true;
      return read_jump(run, JumpKind::Call, kHighestProgram, start, at);
    case Keyword::Print:
      return print_to_screen(run, at);
    case Keyword::Dprnt:
      return print_to_device(run, at);
    case Keyword::Popen:
      return open_device(run, at);
    case Keyword::Pclos:
      close_open_device(run);
      return true;
    case Keyword::Input:
      return read_input(run, start, at);
    case Keyword::Set:
      return read_pin_change(run, true, false, at);
    case Keyword::Clr:
      return read_pin_change(run, false, false, at);
    case Keyword::Pulse0:
      return read_pin_change(run, false, true, at);
    case Keyword::Pulse1:
      return read_pin_change(run, true, true, at);
    case Keyword::Probe1:
      return begin_probe(run, ProbeUntil::Contact, start);
    case Keyword::Probe2:
      return begin_probe(run, ProbeUntil::Release, start);
    case Keyword::Then:
    case Keyword::None:
      return run.fail(ErrorCode::IllegalStatement, run.column(start), to_string(keyword));
    case Keyword::Hdw:
      return read_handwheel(run, at);
    case Keyword::Tana:
    case Keyword::Tanl:
    case Keyword::Cgen:
      return solve_geometry(run, keyword, start, at);
    case Keyword::Back:
      return read_back_words(run, start, at);
  }
  return run.fail(ErrorCode::IllegalStatement, run.column(start), to_string(keyword));
}

bool store_parameter(Run& run, int number, double value, std::uint32_t column) {
  ModalState& state = run.state;
  if (number >= kFirstDataParameter && !state.modes.takes_data) {
    return run.fail(ErrorCode::ParameterOutOfRange, column,
                    fmt::format("P{} can be set between G10 and G11 only", number));
  }
  if (number >= kFirstDataParameter) {
    keep_for_g11(state.data_changes, number, value);
    return true;
  }
  if (number == 268) {  // the pending tool: a posted tool change sets it so
    if (!(value >= 0 && value <= kOffsetCount) || value != std::trunc(value)) {
      return run.fail(ErrorCode::IllegalTool, column, fmt::format("{}", value));
    }
    state.tool.pending = static_cast<int>(value);
    state.tool.pending_offset = -1;
    return true;
  }
  if (number >= kFirstStatus && number <= kLastStatus &&
      status_parameter(state, run.parameters, number)) {
    return run.fail(ErrorCode::StatusParameter, column, fmt::format("P{}", number));
  }
  run.start.note_set(number);
  run.parameters[number] = value;
  if (number == kCycleFeed) state.cycle_feed_code = 0;
  const bool is_material = number == kMaterialLength || number == kMaterialDiameter;
  if (is_material && state.has_header) run.report_blank();
  return true;
}

bool store_byte(Run& run, int number, double value, std::uint32_t column) {
  const double byte = std::round(value);
  if (run.options.is_verify) return true;  // manual: byte parameters
  if (!(byte >= 0 && byte <= 255)) {
    return run.fail(ErrorCode::ParameterOutOfRange, column,
                    fmt::format("{} is not a byte, 0 to 255", value));
  }
  // Flags that decide how the blocks before were read are in use whether they were named or not.
  if (number == kSpecialFlags) run.start.note_byte_read(number);
  run.start.note_byte_set(number);
  run.parameters.byte(number) = static_cast<std::uint8_t>(byte);
  if (number == kSpecialFlags) run.state.nose_is_stale = true;
  return true;
}

bool assign_parameter(Run& run, double number, const char* start, const char*& at) {
  double value = 0;
  if (!check_parameter_number(run, number, kParameterCount, run.column(start))) return false;
  if (!read_expression(run, at, value)) return false;
  return store_parameter(run, static_cast<int>(number), value, run.column(start));
}

bool assign_byte(Run& run, double number, const char* start, const char*& at) {
  double value = 0;
  if (!check_parameter_number(run, number, kByteCount, run.column(start))) return false;
  if (!read_expression(run, at, value)) return false;
  return store_byte(run, static_cast<int>(number), value, run.column(start));
}

bool is_input_answer(std::string_view text) {
  return text.empty() || parse_decimal(text).has_value();
}

}  // namespace dripline::interpreter::centurion
