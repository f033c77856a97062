// HD-062, HD-064: the words of a block, as the control writes it, and words as an operator types
// them.
#include "clients/tools/program_editing/tnc155/block_words.hpp"

#include <gtest/gtest.h>

namespace dripline::program_editing {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

struct WordsCase {
  const char* name;
  Form form;
  const char* text;
  const char* words;  ///< address:value, each after a blank
};

class Tnc155Words : public testing::TestWithParam<WordsCase> {};

TEST_P(Tnc155Words, HaveAddressAndValue) {
  const std::string_view text = GetParam().text;
  std::string words;
  for (const BlockWord& word : words_of(text, GetParam().form)) {
    words +=
        (words.empty() ? "" : " | ") + std::string(word.address) + ":" + std::string(word.value);
    const std::string_view both = text.substr(word.begin, word.end - word.begin);
    EXPECT_TRUE(both.starts_with(word.address)) << both;
    EXPECT_TRUE(both.ends_with(word.value)) << both;
  }
  EXPECT_EQ(words, GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(
    , Tnc155Words,
    testing::Values(
        WordsCase{"line", Form::Plain, "L X+10,000 IY-2,500 RL F200 M03",
                  "L: | X:+10,000 | IY:-2,500 | R:L | F:200 | M:03"},
        WordsCase{"placeholders", Form::Plain, "L Z+Q5 R F M", "L: | Z:+Q5 | R: | F: | M:"},
        WordsCase{"rapid", Form::Plain, "L Z+50,000 R0 F MAX M",
                  "L: | Z:+50,000 | R:0 | F:MAX | M:"},
        WordsCase{"chamfer", Form::Plain, "L 4,000", "L:4,000"},
        WordsCase{"polar", Form::Plain, "CP IPA+90,000 DR- R F M",
                  "CP: | IPA:+90,000 | DR:- | R: | F: | M:"},
        WordsCase{"axis_c", Form::Plain, "C+30,000 R+ F M", "C:+30,000 | R:+ | F: | M:"},
        WordsCase{"circle", Form::Plain, "C X+1,000 Y+2,000 DR+ R F M",
                  "C: | X:+1,000 | Y:+2,000 | DR:+ | R: | F: | M:"},
        WordsCase{"rounding", Form::Plain, "RND R5,000", "RND: | R:5,000"},
        WordsCase{"tool_definition", Form::Plain, "TOOL DEF 1 L+0,000 R+5,000",
                  "TOOL DEF:1 | L:+0,000 | R:+5,000"},
        WordsCase{"tool_call", Form::Plain, "TOOL CALL 1 Z S 500,000",
                  "TOOL CALL:1 | Z: | S:500,000"},
        WordsCase{"fourth_axis", Form::Plain, "TOOL CALL IV", "TOOL CALL: | IV:"},
        WordsCase{"label_call", Form::Plain, "CALL LBL 3 REP 2/2", "CALL LBL:3 | REP:2/2"},
        WordsCase{"calculation", Form::Plain, "FN 2: Q5 = +Q2 - -7,000",
                  "FN:2: | Q:5 | =:+Q2 | -:-7,000"},
        WordsCase{"root", Form::Plain, "FN 5: Q5 = SQRT +Q2", "FN:5: | Q:5 | =: | SQRT:+Q2"},
        WordsCase{"jump", Form::Plain, "FN 9: IF +Q1 EQU +5,000 GOTO LBL 3",
                  "FN:9: | IF:+Q1 | EQU:+5,000 | GOTO LBL:3"},
        WordsCase{"cycle_name", Form::Plain, "CYCL DEF 3.0 SLOT MILLING",
                  "CYCL DEF:3.0 SLOT MILLING"},
        WordsCase{"cycle_peck", Form::Plain, "CYCL DEF 4.3 PECKING -5,000 F100",
                  "CYCL DEF:4.3 | PECKING:-5,000 | F:100"},
        WordsCase{"mirror", Form::Plain, "CYCL DEF 8.1 X Y", "CYCL DEF:8.1 | X: | Y:"},
        WordsCase{"blank_form", Form::Plain, "DEF BLK FORM MIN Z X+0,000 Y+0,000 Z-40,000",
                  "DEF BLK FORM:MIN | Z: | X:+0,000 | Y:+0,000 | Z:-40,000"},
        WordsCase{"probe", Form::Plain, "TCH PROBE 0.0 REF. PLANE Q5 X-",
                  "TCH PROBE:0.0 | REF. PLANE: | Q:5 | X:-"},
        WordsCase{"iso_line", Form::Iso, "N30 G01 G41 G91 X+10 Y-Q2 F200 M03",
                  "N:30 | G01: | G41: | G91: | X:+10 | Y:-Q2 | F:200 | M:03"},
        WordsCase{"iso_cycle", Form::Iso, "N40 G74 P01 -2 P02 -20 P04 X+50 P06 100",
                  "N:40 | G74: | P01:-2 | P02:-20 | P04:X+50 | P06:100"},
        WordsCase{"iso_probe", Form::Iso, "G55 P01 10 P02 X- P03 X+1 Y+2",
                  "G55: | P01:10 | P02:X- | P03: | X:+1 | Y:+2"},
        WordsCase{"iso_label", Form::Iso, "L15.8", "L:15.8"},
        WordsCase{"iso_mirror", Form::Iso, "N5 G28 X Y", "N:5 | G28: | X: | Y:"}),
    [](const auto& i) { return std::string{i.param.name}; });

std::string typed(std::string_view text, Form form) {
  const auto word = read_typed_word(text, form);
  return word ? word->address + ":" + word->value : word.error().what;
}

TEST(Tnc155TypedWord, IsReadWithoutBlanksAndCapitals) {
  EXPECT_EQ(typed("x + 12.5", Form::Plain), "X:+12.5");
  EXPECT_EQ(typed("iX-1", Form::Plain), "IX:-1");
  EXPECT_EQ(typed("fmax", Form::Plain), "F:MAX");
  EXPECT_EQ(typed("RL", Form::Plain), "R:L");
  EXPECT_EQ(typed("R", Form::Plain), "R:");
  EXPECT_EQ(typed("tool call 3", Form::Plain), "TOOL CALL:3");
  EXPECT_EQ(typed("LBL12", Form::Plain), "LBL:12");
  EXPECT_EQ(typed("+ -Q3", Form::Plain), "+:-Q3");
  EXPECT_EQ(typed("g1", Form::Iso), "G01:");
  EXPECT_EQ(typed("P02 -20", Form::Iso), "P02:-20");
  EXPECT_EQ(typed("H+30", Form::Iso), "H:+30");
}

TEST(Tnc155TypedWord, IsRefusedWhereItIsNoneOrMore) {
  EXPECT_EQ(typed("E5", Form::Plain), "\"E5\" is no word of plain language");
  EXPECT_EQ(typed("L X+5", Form::Plain), "\"L X+5\" is no word of plain language");
  EXPECT_EQ(typed("X+5 Y+7", Form::Plain),
            "\"X+5 Y+7\" is not one word: X is followed by \"+5Y+7\"");
  EXPECT_EQ(typed("G01 X+5", Form::Iso), "\"G01 X+5\" is not one word: G01 is followed by \"X+5\"");
  EXPECT_EQ(typed("TOOL CALL 3", Form::Iso),
            "\"TOOL CALL 3\" is not one word: T is followed by \"OOLCALL3\"");
  EXPECT_EQ(typed("", Form::Iso), "\"\" is no word of ISO");
  EXPECT_EQ(read_typed_address("F200", Form::Plain).error().what,
            "\"F200\": expected an address alone, as F");
}

}  // namespace
}  // namespace dripline::program_editing
