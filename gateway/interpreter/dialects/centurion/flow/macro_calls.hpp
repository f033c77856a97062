#pragma once

#include <cstdint>

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Programs that are called with words as arguments: G65 P n, the custom G and M codes, and the
/// tool change when it is a program (manual: G65; custom G and M codes, M6 macro).
namespace dripline::interpreter::centurion {

/// The program bound to a custom G or M code, or 0. A code means its own again while its program
/// runs, so that the program can use it.
std::uint16_t custom_program_of_g(const Run& run, unsigned code);
std::uint16_t custom_program_of_m(const Run& run, unsigned code);
/// The program in the place of M6, or 0.
std::uint16_t tool_change_program(const Run& run);

/// The block calls `program` when its move is done. Errors: 518, the block calls or jumps already.
bool request_macro(Run& run, std::uint16_t program, MacroCaller caller, std::uint32_t column);

/// Whether the block's words are arguments and nothing else: of G65 with P, of a custom G code. G65
/// without P is a block without movement.
bool passes_arguments(const Run& run);
/// G65: calls the program that P names; without P it moves without output.
bool call_or_suppress(Run& run);

/// The block's words become P1-P26, by their place in the alphabet (manual: G65): not G, H, M, N
/// and T, nor the two-letter words.
void pass_arguments(Run& run);

}  // namespace dripline::interpreter::centurion
