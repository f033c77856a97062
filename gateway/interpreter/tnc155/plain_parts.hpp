#pragma once

#include "gateway/interpreter/tnc155/text_cursor.hpp"

/// The parts of the plain-language reader, each from behind its keyword to before the block's end.
namespace dripline::interpreter::tnc155::plain {

bool read_line(TextCursor& cursor, Block& block);         ///< behind L
bool read_polar_line(TextCursor& cursor, Block& block);   ///< behind LP
bool read_centre(TextCursor& cursor, Block& block);       ///< behind CC
bool read_arc(TextCursor& cursor, Block& block);          ///< behind C
bool read_polar_arc(TextCursor& cursor, Block& block);    ///< behind CP
bool read_tangent_arc(TextCursor& cursor, Block& block);  ///< behind CT
bool read_rounding(TextCursor& cursor, Block& block);     ///< behind RND
bool read_single_axis(TextCursor& cursor, Block& block);  ///< before the axis
bool read_repeated_path(TextCursor& cursor, const ReadingState& state, Block& block);  ///< behind *

bool read_function(TextCursor& cursor, Block& block);                  ///< behind FN
bool read_cycle(TextCursor& cursor, Block& block);                     ///< behind CYCL DEF
bool read_probe(TextCursor& cursor, Block& block);                     ///< behind TCH PROBE
bool read_blank_form(TextCursor& cursor, Block& block, bool has_def);  ///< behind BLK FORM

/// M and its number, or M alone; behind the letter.
bool read_m(TextCursor& cursor, Block& block);
/// Axis words up to something else; each axis once.
bool read_coordinates(TextCursor& cursor, Block& block, std::size_t most);
/// One axis word; the cursor stands on its letter or its I.
bool read_coordinate(TextCursor& cursor, Block& block);
/// F and its value, F MAX where `may_be_rapid`, or F alone; behind the letter.
bool read_feed(TextCursor& cursor, Block& block, bool may_be_rapid);
/// DR+ or DR-; behind the D.
bool read_turn(TextCursor& cursor, Block& block);

}  // namespace dripline::interpreter::tnc155::plain
