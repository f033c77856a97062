#pragma once

/// Blanks vanish everywhere outside comments, case does not matter (NIST 3.3). All texts here end
/// in a byte that can be read and ends a line.
namespace dripline::interpreter::rs274ngc {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
inline bool is_end_of_line(char c) {
  return c == '\n' || c == '\r';
}
inline bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') <= 9;
}
/// Capital letter of a letter; other characters stay or become something that is no letter.
inline char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - ('a' - 'A')) : c;
}
inline bool is_letter(char c) {
  return static_cast<unsigned char>(upper(c) - 'A') < 26;
}
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) [[unlikely]]++ at;
  return at;
}

}  // namespace dripline::interpreter::rs274ngc
