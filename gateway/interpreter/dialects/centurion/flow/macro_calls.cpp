#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::uint16_t kFirstCustomG = 9010;
constexpr std::uint16_t kFirstCustomM = 9020;

constexpr AddressSet kPassNothing =
    set_of(Address::G, Address::H, Address::M, Address::N, Address::T);

bool is_running(const Run& run, std::uint16_t program) {
  const auto& calls = run.state.calls;
  return std::any_of(calls.begin(), calls.end(),
                     [program](const CallFrame& frame) { return frame.custom == program; });
}

std::uint16_t bound_program(const Run& run, const std::array<int, 10>& codes, unsigned code,
                            std::uint16_t first) {
  if (code == 0) return 0;  // 0 is an entry not in use
  const auto* entry = std::find(codes.begin(), codes.end(), static_cast<int>(code));
  if (entry == codes.end()) return 0;
  const auto program = static_cast<std::uint16_t>(first + (entry - codes.begin()));
  return is_running(run, program) ? std::uint16_t{0} : program;
}

/// G65: calls the program that P names.
bool call_by_g65(Run& run) {
  const Words& words = run.block.words;
  const double number = std::round(words[Address::P]);
  if (!(number >= 1 && number <= 9999)) {
    return run.fail(ErrorCode::InvalidProgramNumber, words.column(Address::P),
                    fmt::format("P{}", words[Address::P]));
  }
  run.block.words.set(Address::P, number, words.column(Address::P));
  return request_macro(run, static_cast<std::uint16_t>(number), MacroCaller::G65,
                       words.column(Address::P));
}

/// G65 without P: the program and compensation advance to the end point, the machine does not move.
bool suppressed_move(Run& run) {
  suppress_output(run, true);
  const bool is_done = move(run);
  suppress_output(run, false);
  return is_done;
}

}  // namespace

std::uint16_t custom_program_of_g(const Run& run, unsigned code) {
  return bound_program(run, run.options.custom_g, code, kFirstCustomG);
}

std::uint16_t custom_program_of_m(const Run& run, unsigned code) {
  return bound_program(run, run.options.custom_m, code, kFirstCustomM);
}

std::uint16_t tool_change_program(const Run& run) {
  const std::uint16_t program = run.options.tool_change_program;
  return program == 0 || is_running(run, program) ? std::uint16_t{0} : program;
}

bool request_macro(Run& run, std::uint16_t program, MacroCaller caller, std::uint32_t column) {
  Block::Parts& parts = run.block.parts;
  if (run.options.refuses_loops_and_calls) {
    return run.fail(ErrorCode::NotInDnc, column, "a program call");
  }
  if (parts.macro != 0 || parts.jump != JumpKind::None || parts.ending != Ending::None) {
    return run.fail(ErrorCode::IllegalStatement, column, "a second jump or call in one block");
  }
  parts.macro = program;
  parts.caller = caller;
  return true;
}

bool passes_arguments(const Run& run) {
  if (run.axis_code() != 65) return false;
  return run.block.parts.macro != 0 || run.block.words.has(Address::P);
}

bool call_or_suppress(Run& run) {
  if (run.block.parts.macro != 0) return true;
  return passes_arguments(run) ? call_by_g65(run) : suppressed_move(run);
}

void pass_arguments(Run& run) {
  const Words& words = run.block.words;
  for (int letter = 0; letter < 26; ++letter) {
    const auto address = static_cast<Address>(letter);
    if ((kPassNothing & set_of(address)) != 0 || !words.has(address)) continue;
    run.start.note_set(letter + 1);
    run.parameters[letter + 1] = words[address];
  }
}

}  // namespace dripline::interpreter::centurion
