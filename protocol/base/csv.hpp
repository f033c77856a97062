#pragma once

#include <string>
#include <string_view>

namespace dripline {

/// One text cell of a CSV file (RFC 4180): in quotes where it needs them. What a spreadsheet would
/// take for a formula, which can send the rest of the sheet away, gets an apostrophe before it, as
/// OWASP's "CSV injection" recommends: a text that begins with = + - @, a tab or a line end and is
/// no plain number. A number keeps its sign. For cells of numbers this is not needed.
/// So does what follows a ; or tab or line end in it: a spreadsheet that splits at ; (as where the
/// comma is the decimal point) takes no notice of the quotes, for its cell begins before them.
std::string csv_field(std::string_view text);
/// The text of a cell that csv_field wrote, its quotes already taken off: without those
/// apostrophes.
std::string unguarded(std::string_view cell);

}  // namespace dripline
