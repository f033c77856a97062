#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/block_parts.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

/// Plain language of the later controls. Numbers are kept as a Value, to 1/10000: what has more
/// decimals is rounded, as CAM systems write more than the control's resolution.
namespace dripline::interpreter::tnc155 {

/// Reads one block, [begin, end) with all its lines; `*end` can be read. False: `fault` has the
/// reason. `parts` has one block then.
bool read_itnc_block(const char* begin, const char* end, const ReadingState& state,
                     BlockParts& parts, Fault& fault);

}  // namespace dripline::interpreter::tnc155

namespace dripline::interpreter::tnc155::itnc {

/// A block in hand: the text, and where its words go.
struct Reading {
  TextCursor& cursor;
  Block& block;
  ItncWords& words;
  const char* end;                 ///< of the block's first line, without its comment
  bool takes_plane_angle = false;  ///< Q120 to Q122 may be the value
};

bool read_value(Reading& in, Value& value, std::string_view name);
/// After the Q: 5, L5 or R5.
bool read_parameter_number(Reading& in, std::int32_t& parameter);
/// Whether these characters begin a parameter.
bool is_parameter(const char* at);
/// The end of the first line without its comment, and without the `~` at its end.
const char* line_without_comment(const char* begin, const char* end);
/// 1 to 1000 characters up to a blank.
std::string read_word(Reading& in);
/// The text between two quotes.
bool read_quoted(Reading& in, std::string& text);
bool read_axis_word(Reading& in);
/// F and what follows it; `is_own`: of this block alone.
bool read_feed(Reading& in, bool is_own);
/// NOT SUPPORTED: the words up to the end of the block.
bool refuse(Reading& in, const char* start);
/// The same of a block's first word; of one that is none of the control's BLOCK FORMAT INCORRECT.
bool refuse_keyword(Reading& in, const char* start);

bool read_path(Reading& in, BlockKind kind);  ///< after L, LP, C, CP, CT, CR
/// After APPR or DEP and LT, LN, CT or LCT.
bool read_contour_end(Reading& in);
bool read_corner(Reading& in, BlockKind kind);  ///< after RND, CHF
bool read_center(Reading& in);                  ///< after CC
bool read_call_at(Reading& in);                 ///< after CYCL CALL POS
bool read_m_words(Reading& in);                 ///< up to the end of the block
bool read_tool_definition(Reading& in);
bool read_tool_call(Reading& in);
bool read_blank(Reading& in);       ///< after BLK FORM
bool read_assignment(Reading& in);  ///< after the Q
bool read_function(Reading& in);    ///< after FN
/// A number or a Q parameter with its sign.
bool read_signed(Reading& in, Formula& formula);
bool read_plane(Reading& in, const char* start);        ///< after PLANE
bool read_tip_control(Reading& in, const char* start);  ///< after FUNCTION TCPM
/// After CYCL DEF; `end` of the whole block.
bool read_cycle(Reading& in, const char* block_end);

}  // namespace dripline::interpreter::tnc155::itnc
