#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dripline::line {

/// How much of a received program is looked at to find out what it is.
inline constexpr std::size_t kProgramHead = 4096;

/// Whether a line that comes from a control begins a program of its own accord: `O` or `:` and a
/// number, `%` and a name, a TNC's `BEGIN PGM`, a ProtoTRAK's `PN7`; after a line of `%` alone
/// also an N number, a G code, a comment or a block skip. What control prints (DPRNT) looks
/// otherwise, or a rule decides it.
bool begins_program(std::string_view line, bool is_after_percent);

/// The name a program gives itself in its head: "O9999", "O15" for `:15`, a TNC's "15", a
/// ProtoTRAK's "PN7"; empty: none.
std::string program_name(std::string_view head);
/// Whether two names are the same program's: `O0015`, `o15` and `15` are.
bool is_same_program(std::string_view a, std::string_view b);

/// The digits by which protocols with numbered programs know a stored one: "15" for `O0015`, `15.h`
/// and `15`; empty when it has no number of at most 8 digits.
std::string program_number(std::string_view stored_name);

/// Looks for a comment `(KEY)` or `(KEY=value)`, or `;KEY=value` to the end of its line. Letters of
/// either case; blanks around key and value do not count. The value; empty when it has none.
std::optional<std::string> find_trigger(std::string_view head, std::string_view key);

}  // namespace dripline::line
