#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/setup.hpp"

/// The parameters as text: a program that sets them with G10 (manual: G10 and G11; RS-232 menu). P0
/// to P199 are the manual's. It does not have the control's numbers of tables and pages (its
/// appendix A is not known), so those from P500 on are the ones of parameters.hpp, and such a text
/// is for this software only. With a table that the machine's builder fills in it is the control's
/// own.
namespace dripline::interpreter::centurion {

/// The first line of a text in the numbering of parameters.hpp. A text without it, and without a
/// table, is in a numbering that is not known.
inline constexpr std::string_view kOwnNumbering =
    "(DRIPLINE'S OWN NUMBERS OF PARAMETERS: NOT FOR A CONTROL)";
/// That line is in the first kNumberingHead bytes, however it is spaced and wherever an O number, a
/// comment or `%` was put before it.
bool has_own_numbering(std::string_view text);
inline constexpr std::size_t kNumberingHead = 65536;

/// Which of our numbers is which of the control's.
struct ParameterMap {
  struct Row {
    int ours = 0;
    int control = 0;
  };
  std::vector<Row> rows;
};
/// One row a line, `P500 = P7012`, ours first; a row without the second number is not filled in
/// yet. `#` begins a comment. Errors: Syntax, LimitExceeded, naming the line (a number that is none
/// of a setup's tables and pages, one that is given twice).
Result<ParameterMap> read_parameter_map(std::string_view text);

/// Offsets, tools, axis and power parameters of a setup, all of them, and P0-P199 that are not 0.
/// With a map only what has a row. Errors: those of load_memory; NotFound (a value that is not 0
/// and has no row).
Result<std::string> write_parameter_text(const Setup& setup, const ParameterMap* map = nullptr);

/// The text of a setup file from such a program. Errors: Syntax, naming the line (anything besides
/// comments, an O number, G10, G11, G20, G21, M30 and P... = number; a number that has no name in a
/// setup, or no row); Unsupported (numbers from P200 on, without a map and not marked as ours).
Result<std::string> setup_of_parameter_text(std::string_view text,
                                            const ParameterMap* map = nullptr);

}  // namespace dripline::interpreter::centurion
