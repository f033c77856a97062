#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace dripline::interpreter::centurion {

/// One program of a text that holds several (spec 20.2): from its O line up to the next one. A line
/// that holds nothing but % belongs to none.
struct ExtractedProgram {
  std::uint32_t number = 0;  ///< 0: text in front of the first O line
  std::string_view text;     ///< of the text given
};

/// In their order; a number may come twice, as on the control the later one then stays. Blank text
/// in front of the first O line counts as none. Pure; any thread.
std::vector<ExtractedProgram> extract_programs(std::string_view text);

}  // namespace dripline::interpreter::centurion
