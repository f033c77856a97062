#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dripline::interpreter {

/// One thing wrong with a program, with an id that never changes. Tests and callers look at ids,
/// people at texts. `id`: dialect prefix and number (CEN0103); where the control's manual numbers
/// its errors, the same number.
struct Diagnostic {
  std::string_view id;  ///< static storage
  std::string
      text;  ///< the control's own wording where its manual has one, then the value and the limit
  std::uint64_t line = 0;    ///< 1-based
  std::uint32_t column = 0;  ///< 1-based byte within the line; 0 where it concerns the whole block
};

}  // namespace dripline::interpreter
