#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Macro calls: G65, G66 and the codes that call a program; how their words become local variables.
namespace dripline::interpreter::fanuc {

enum class CodeCall : std::uint8_t { G, M, T };

/// The block is a macro call from here on: its words are arguments.
bool begin_call(Run& run, bool is_modal, std::uint32_t column);
bool begin_code_call(Run& run, CodeCall by, double code, std::uint32_t column);
bool calls_macro_by_g(const Run& run, double code);
bool calls_macro_by_m(const Run& run, double code);
/// Within a program that a code has called, codes do not call again.
bool is_in_code_call(const Run& run);

bool add_argument(Run& run, char letter, const Word& word);
/// The block's arguments as local variables, by assignment I or II.
bool assign_arguments(Run& run, Locals& locals);

}  // namespace dripline::interpreter::fanuc
