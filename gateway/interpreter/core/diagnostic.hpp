#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dripline::interpreter {

/// One fault of a program, with an id that never changes. Tests and callers compare ids, people
/// read texts. The id is a dialect prefix and a number (CEN0103): the control's own number where
/// its manual numbers its errors.
struct Diagnostic {
  std::string_view id;  ///< static storage
  /// The control's own wording where its manual has one, then the value and the limit.
  std::string text;
  std::uint64_t line = 0;    ///< 1-based
  std::uint32_t column = 0;  ///< 1-based byte within the line; 0 where it concerns the whole block
};

/// A row of a control's table of alarms and warnings: its id, and the control's wording.
struct DiagnosticRow {
  std::string_view id;    ///< static storage
  std::string_view text;  ///< static storage
  bool operator==(const DiagnosticRow&) const = default;
};

/// `detail` follows the text: which value, which limit.
Diagnostic diagnostic(const DiagnosticRow& row, std::string_view detail, std::uint64_t line,
                      std::uint32_t column = 0);

}  // namespace dripline::interpreter
