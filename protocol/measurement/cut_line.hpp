#pragma once

#include <string>
#include <string_view>

namespace dripline::measurement {

/// The end of a record's text that says: the printed line before it is not whole. It ended by
/// silence or with its line, without its end of block; 40.0 may be the beginning of 40.09.
inline constexpr std::string_view kCutLine = " \xe2\x80\xa6 (line not ended)";

/// The end of a record's text that says: the line may be the rest of what the control began to send
/// before the line was opened (by another server, or by this one before it was started again).
inline constexpr std::string_view kRestLine =
    " \xe2\x80\xa6 (may be the rest of an earlier transmission)";

/// `line` with that end, within what a record holds. A line that is both is the rest of one first.
std::string cut_line(std::string line);
std::string rest_line(std::string line);

/// Of a record's text: whether the line is not whole.
inline bool is_cut(std::string_view text) {
  return text.ends_with(kCutLine);
}
inline std::string_view without_end(std::string_view text, std::string_view end) {
  if (text.ends_with(end)) text.remove_suffix(end.size());
  return text;
}
/// Of a record's text: whether the line may be the rest of an earlier transmission.
inline bool may_be_rest(std::string_view text) {
  return without_end(text, kCutLine).ends_with(kRestLine);
}
/// The line as it was printed.
inline std::string_view printed_line(std::string_view text) {
  return without_end(without_end(text, kCutLine), kRestLine);
}

}  // namespace dripline::measurement
