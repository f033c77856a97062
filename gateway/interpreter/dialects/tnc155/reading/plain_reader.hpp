#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

namespace dripline::interpreter::tnc155 {

/// Reads one block of plain language, [begin, end) with all its lines; `*end` can be read and is a
/// line end. False: `fault` has the reason, and `block` is unspecified. Does not change `state`.
bool read_plain_block(const char* begin, const char* end, const ReadingState& state, Block& block,
                      Fault& fault);

/// Updates the reading state after a plain-language block.
void note_plain_block(const Block& block, ReadingState& state);

}  // namespace dripline::interpreter::tnc155

namespace dripline::interpreter::tnc155::plain {

// The parts of the plain-language reader, each from after its keyword to before the block's end.

bool read_line(TextCursor& cursor, Block& block);         ///< after L
bool read_polar_line(TextCursor& cursor, Block& block);   ///< after LP
bool read_center(TextCursor& cursor, Block& block);       ///< after CC
bool read_arc(TextCursor& cursor, Block& block);          ///< after C
bool read_polar_arc(TextCursor& cursor, Block& block);    ///< after CP
bool read_tangent_arc(TextCursor& cursor, Block& block);  ///< after CT
bool read_rounding(TextCursor& cursor, Block& block);     ///< after RND
bool read_single_axis(TextCursor& cursor, Block& block);  ///< before the axis
bool read_repeated_path(TextCursor& cursor, const ReadingState& state, Block& block);  ///< after *

bool read_function(TextCursor& cursor, Block& block);                  ///< after FN
bool read_cycle(TextCursor& cursor, Block& block);                     ///< after CYCL DEF
bool read_probe(TextCursor& cursor, Block& block);                     ///< after TCH PROBE
bool read_blank_form(TextCursor& cursor, Block& block, bool has_def);  ///< after BLK FORM

/// M and its number, or M alone; after the letter.
bool read_m(TextCursor& cursor, Block& block);
/// Axis words up to something else; each axis once.
bool read_coordinates(TextCursor& cursor, Block& block, std::size_t most);
/// One axis word; the cursor is at its letter or its I.
bool read_coordinate(TextCursor& cursor, Block& block);
/// F and its value, F MAX where `may_be_rapid`, or F alone; after the letter.
bool read_feed(TextCursor& cursor, Block& block, bool may_be_rapid);
/// DR+ or DR-; after the D.
bool read_turn(TextCursor& cursor, Block& block);

}  // namespace dripline::interpreter::tnc155::plain
