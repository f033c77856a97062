#include "gateway/interpreter/dialects/fanuc/execution/statements.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/output_text.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variable_names.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/expression_reader.hpp"

namespace dripline::interpreter::fanuc {
namespace {

bool refuse_format(Run& run, const char* at, std::string_view detail) {
  return run.fail(ErrorCode::MacroFormat, run.column(at), detail);
}

/// Nothing but N and / may stand in a block with a macro statement.
bool claim_block(Run& run, const char* start) {
  Block& block = run.block;
  if (block.parts.kind == BlockKind::Macro) {
    return run.fail(ErrorCode::MacroFormat2, run.column(start), "a second macro statement");
  }
  if (block.words.present() != 0 || block.parts.m_count != 0 || block.parts.groups != 0 ||
      block.parts.one_shot != Block::kNoCode || block.parts.kind == BlockKind::Call) {
    return run.fail(ErrorCode::MixedStatement, run.column(start));
  }
  block.parts.kind = BlockKind::Macro;
  block.parts.statement_column = run.column(start);
  return true;
}

/// Loops and jumps come from a program that can be gone back in.
bool refuse_in_dnc(Run& run, const char* start) {
  return run.fail(ErrorCode::MacroInDnc, run.column(start));
}
bool is_from_line(const Run& run) {
  return run.options.is_dnc && run.state.at.program == kMainProgram;
}

/// The comment after #3000 = n and #3006 = n; `at` is after the = sign.
void note_message(Run& run, const char* at) {
  const char* end = find_block_end(run, at);
  const char* open = std::find(at, end, '(');
  if (open == end) return;
  run.block.parts.message_begin = run.offset(open + 1);
  run.block.parts.message_end = run.offset(std::find(open, end, ')'));
}

bool read_assignment(Run& run, const char*& at) {
  Block::Parts& parts = run.block.parts;
  parts.statement_column = run.column(at);
  int number = 0;
  const bool has_name = is_named_variable(at);
  if (!(has_name ? read_variable_name(run, at, number) : read_variable_number(run, at, number)))
    return false;
  skip_gaps(run, at);
  if (*at != '=') return refuse_format(run, at, "= is expected here");
  ++at;
  note_message(run, at);
  double value = 0;
  if (!read_expression(run, at, value)) return false;
  parts.statement = StatementKind::Assign;
  parts.variable = number;
  parts.value = value;
  return true;
}

/// A number or an operand that must be whole; of GOTO, DO and END.
bool read_count(Run& run, const char*& at, double& value) {
  at = skip_blanks(at);
  const char* start = at;
  if (!is_digit(*at) && *at != '#' && *at != '[')
    return refuse_format(run, at, "a number is expected here");
  if (!read_operand(run, at, 1, value)) return false;
  if (std::isnan(value)) value = 0;
  if (is_digit(*start) && value != std::trunc(value)) {
    return run.fail(ErrorCode::DecimalPoint, run.column(start));
  }
  value = std::round(value);
  return true;
}

bool read_goto(Run& run, const char* start, const char*& at) {
  if (is_from_line(run)) return refuse_in_dnc(run, start);
  double number = 0;
  if (!read_count(run, at, number)) return false;
  if (!(number >= 1 && number <= std::max(run.options.last_sequence, 99'999u))) {
    return run.fail(ErrorCode::MacroSequence, run.column(start), fmt::format("{}", number));
  }
  run.block.parts.statement = StatementKind::Goto;
  run.block.parts.variable = static_cast<std::int32_t>(number);
  return true;
}

/// The number of DO or END.
bool read_loop_number(Run& run, const char* start, const char*& at) {
  double number = 0;
  if (!read_count(run, at, number)) return false;
  if (!(number >= 1 && number <= 3)) return run.fail(ErrorCode::LoopNumber, run.column(start));
  run.block.parts.loop_number = static_cast<std::uint8_t>(number);
  return true;
}

bool read_do(Run& run, const char* start, const char*& at, bool condition) {
  if (is_from_line(run)) return refuse_in_dnc(run, start);
  run.block.parts.statement = StatementKind::Loop;
  run.block.parts.condition = condition;
  return read_loop_number(run, start, at);
}

bool read_while(Run& run, const char* start, const char*& at) {
  if (is_from_line(run)) return refuse_in_dnc(run, start);
  bool holds = false;
  if (!read_condition(run, at, holds)) return false;
  skip_gaps(run, at);
  if (!take_word(at, "DO")) return refuse_format(run, at, "DO is expected here");
  return read_do(run, start, at, holds);
}

bool read_end(Run& run, const char* start, const char*& at) {
  if (is_from_line(run)) return refuse_in_dnc(run, start);
  run.block.parts.statement = StatementKind::EndLoop;
  return read_loop_number(run, start, at);
}

bool read_output(Run& run, Keyword keyword, const char*& at) {
  switch (keyword) {
    case Keyword::Popen:
      run.block.parts.statement = StatementKind::OpenPort;
      return true;
    case Keyword::Pclos:
      run.block.parts.statement = StatementKind::ClosePort;
      return true;
    default:
      run.block.parts.statement = StatementKind::Print;
      return keyword == Keyword::Dprnt ? read_decimal_output(run, at) : read_binary_output(run, at);
  }
}

bool read_if(Run& run, const char* start, const char*& at) {
  bool holds = false;
  if (!read_condition(run, at, holds)) return false;
  skip_gaps(run, at);
  if (take_word(at, "GOTO")) {
    if (!read_goto(run, start, at)) return false;
  } else if (take_word(at, "THEN")) {
    skip_gaps(run, at);
    const char* statement = at;
    if (*at == '#' || is_named_variable(at)) {
      if (!holds) {
        at = find_block_end(run, at);
      } else if (!read_assignment(run, at)) {
        return false;
      }
    } else {
      const Keyword keyword = take_keyword(at);
      const bool is_output = keyword >= Keyword::Popen;
      if (!is_output && keyword != Keyword::Goto) {
        return refuse_format(run, statement, "one macro statement is expected here");
      }
      if (!holds) {
        at = find_block_end(run, at);
      } else if (keyword == Keyword::Goto ? !read_goto(run, start, at)
                                          : !read_output(run, keyword, at)) {
        return false;
      }
    }
  } else {
    return refuse_format(run, at, "GOTO or THEN is expected here");
  }
  if (!holds) run.block.parts.statement = StatementKind::None;
  return true;
}

bool plan_jump(Run& run, JumpKind kind) {
  const Block::Parts& parts = run.block.parts;
  Jump& jump = run.state.jump;
  jump.kind = kind;
  jump.condition = parts.condition;
  jump.loop_number = parts.loop_number;
  jump.number = static_cast<std::uint32_t>(parts.variable);
  jump.from = run.state.at;
  return true;
}

}  // namespace

bool read_assignment_block(Run& run, const char*& at) {
  return claim_block(run, at) && read_assignment(run, at);
}

bool read_statement(Run& run, Keyword keyword, const char* start, const char*& at) {
  if (!claim_block(run, start)) return false;
  switch (keyword) {
    case Keyword::If:
      return read_if(run, start, at);
    case Keyword::Goto:
      return read_goto(run, start, at);
    case Keyword::While:
      return read_while(run, start, at);
    case Keyword::Do:
      return read_do(run, start, at, true);
    case Keyword::End:
      return read_end(run, start, at);
    case Keyword::Setvn:
      return read_naming(run, start, at);
    case Keyword::Popen:
    case Keyword::Pclos:
    case Keyword::Dprnt:
    case Keyword::Bprnt:
      return read_output(run, keyword, at);
    default:
      return refuse_format(run, start, "THEN without IF");
  }
}

bool execute_statement(Run& run) {
  const Block::Parts& parts = run.block.parts;
  switch (parts.statement) {
    case StatementKind::None:
      return true;
    case StatementKind::Assign:
      return write_variable(run, parts.variable, parts.statement_column, parts.value);
    case StatementKind::Goto:
      return plan_jump(run, JumpKind::Goto);
    case StatementKind::Loop:
      return plan_jump(run, JumpKind::Loop);
    case StatementKind::Name:
      return name_variables(run);
    case StatementKind::EndLoop:
      return true;  // flow.cpp goes back when the block is left
    default:
      return execute_output(run);
  }
}

}  // namespace dripline::interpreter::fanuc
