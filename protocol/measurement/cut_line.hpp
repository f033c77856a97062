#pragma once

#include <string>
#include <string_view>

namespace dripline::measurement {

/// The end of a record's text that says: the printed line before it is not whole. It ended by
/// silence or with its line, without its end of block; 40.0 may be the beginning of 40.09.
inline constexpr std::string_view kCutLine = " \xe2\x80\xa6 (line not ended)";

/// `line` with that end, within what a record holds.
std::string cut_line(std::string line);

/// Of a record's text: whether the line is not whole.
inline bool is_cut(std::string_view text) {
  return text.ends_with(kCutLine);
}
/// The line as it was printed.
inline std::string_view printed_line(std::string_view text) {
  if (is_cut(text)) text.remove_suffix(kCutLine.size());
  return text;
}

}  // namespace dripline::measurement
