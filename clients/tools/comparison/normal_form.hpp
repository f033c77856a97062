#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dripline::comparison {

constexpr bool is_decimal_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

/// How the text of a control reads where it is compared and not interpreted. A rule that is not
/// sure is left out: then texts differ that mean the same, never the reverse.
struct LexicalRules {
  std::string_view control;
  bool has_parentheses = false;  ///< comments in parentheses
  bool has_semicolon = false;    ///< comments from a semicolon to the end of the line
  bool has_marks = false;        ///< a comment that begins with LOG, PRINT ... does something
  bool has_numbers = false;      ///< 1. = 1.0 = 01.000, and a sign + changes nothing
  bool point_counts =
      false;               ///< X1 is not X1., but X0 is X0.: counts of the increment have no point
  bool has_comma = false;  ///< a decimal comma is a point
  bool begins_with_number = false;  ///< a block's number is digits without N
  bool has_block_numbers = false;   ///< N and digits at the beginning of a block number it
  char variable = 0;                ///< what names a variable: # or Q; P of a Centurion
};
/// Of a control that is not known: spaces at the ends of a line alone are not significant.
const LexicalRules& lexical_rules(std::string_view control);

struct NormalForm {
  /// Blocks keep their numbers, which jumps and calls name.
  bool keeps_block_numbers = false;
};

/// Appends the line in its normal form: without comments and blanks, in capitals, numbers written
/// in one form, without the block's number. Empty: the line means nothing. Lines that print or name
/// something (DPRNT, quotes, <names>) stay as they are but for the blanks at their ends.
void append_normal(std::string_view line, const LexicalRules& rules, NormalForm form,
                   std::string& out);

/// Which of its words the change of a block is about, as far as its text can tell; from small to
/// large.
enum class TextChange : std::uint8_t { None, BlockNumbers, FeedAndSpeed, Offsets, Other };
/// `before` and `after`: normal forms without the numbers of blocks; one may be empty.
TextChange change_of(std::string_view before, std::string_view after);

}  // namespace dripline::comparison
