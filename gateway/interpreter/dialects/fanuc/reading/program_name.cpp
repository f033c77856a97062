#include "gateway/interpreter/dialects/fanuc/reading/program_name.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"

namespace dripline::interpreter::fanuc {

bool read_program_name(Run& run, const char*& at) {
  Block::Parts& parts = run.block.parts;
  const std::uint32_t column = run.column(at);
  if (!run.options.has_program_names) return run.fail(ErrorCode::IllegalAddress, column, "<");
  const std::string_view name = take_program_name(at);
  if (name.empty() || name.size() > kMaxProgramName) {
    return run.fail(
        ErrorCode::IllegalProgramNumber, column,
        fmt::format("<NAME> has 1 to {} letters, digits, + - _ and .", kMaxProgramName));
  }
  if (!parts.has_code) {
    if (run.state.at.program == kMainProgram && !run.name_is_settled) run.name = name;
    parts.has_code = true;
    return true;
  }
  if (parts.name_end != 0 || parts.has_call_program || parts.call == CallKind::Code)
    return run.fail(ErrorCode::ImproperCommand, column, "two programs in one block");
  parts.name_begin = run.offset(name.data());
  parts.name_end = run.offset(name.data() + name.size());
  parts.has_call_program = true;
  return true;
}

bool check_program_name(Run& run) {
  const Block& block = run.block;
  if (block.parts.name_end == 0 || block.parts.kind != BlockKind::Nc) return true;
  const auto* end = block.m.begin() + block.parts.m_count;
  if (std::any_of(block.m.begin(), end, [](int code) { return code == 98 || code == 198; }))
    return true;
  return run.fail(ErrorCode::ImproperCommand, block.parts.name_begin, "nothing calls the program");
}

}  // namespace dripline::interpreter::fanuc
