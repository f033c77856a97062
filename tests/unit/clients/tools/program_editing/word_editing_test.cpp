// HD-062, HD-064, HD-065: searching by address; words with new values, left out, shortened blocks.
#include <gtest/gtest.h>

#include "clients/tools/program_editing/program_edit.hpp"
#include "clients/tools/program_editing/tnc155/block_words.hpp"
#include "clients/tools/program_editing/tnc155/cut_program.hpp"
#include "tests/golden/golden_case.hpp"

namespace dripline::program_editing {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

using enum WordChange::Kind;

const std::string kPlain =
    "0 BEGIN PGM 15 MM\n"
    "1 TOOL DEF 1 L+0,000 R+5,000\n"
    "2 TOOL CALL 1 Z S 500,000\n"
    "3 L X+10,000 Y+20,000 R0 F15999 M03\n"
    "4 L IX+5,000\n"
    "  RL F100 M08\n"
    "5 CALL LBL 3 REP 2/2\n"
    "6 CYCL DEF 8.1 X Y\n"
    "7 FN 1: Q5 = +Q2 + +7,000\n"
    "8 * Y+Q5\n"
    "9 END PGM 15 MM\n";
const std::string kIso =
    "%15 G71 *\n"
    "N10 T1 G17 S500 *\n"
    "N20 G00 G90 X+10 G91 Y+5 G41 F200 M03 *\n"
    "N30 G83 P01 -2 P02 -20 P03 -5 P04 1 P05 100 *\n"
    "N40 L3.2 *\n"
    "N9999 %15 G71 *\n";

/// The changed blocks of a program, without what they were; or the error.
std::string changed(const std::string& text, const std::vector<WordChange>& changes) {
  const auto blocks = change_words(text, changes);
  if (!blocks) return blocks.error().what;
  const auto edited = edit_program(text, *blocks);
  if (!edited) return edited.error().what;
  std::string list;
  for (const auto& [mark, block] : edited->changes) {
    if (mark == '+') list += (list.empty() ? "" : "\n") + block;
  }
  return list;
}

struct ChangeCase {
  const char* name;
  const std::string* text;
  WordChange change;
  const char* result;
};

class Tnc155WordEditing : public testing::TestWithParam<ChangeCase> {};

TEST_P(Tnc155WordEditing, MakesTheBlockOrNamesTheReason) {
  EXPECT_EQ(changed(*GetParam().text, {GetParam().change}), GetParam().result);
}

INSTANTIATE_TEST_SUITE_P(
    Set, Tnc155WordEditing,
    testing::Values(
        ChangeCase{"coordinate", &kPlain, {Set, 3, "X12.5"}, "3 L X+12,500 Y+20,000 R0 F15999 M03"},
        ChangeCase{"parameter", &kPlain, {Set, 3, "Y-Q7"}, "3 L X+10,000 Y-Q7 R0 F15999 M03"},
        ChangeCase{"continued", &kPlain, {Set, 4, "F MAX"}, "4 L IX+5,000 RL F MAX M08"},
        ChangeCase{"compensation", &kPlain, {Set, 4, "R0"}, "4 L IX+5,000 R0 F100 M08"},
        ChangeCase{"tool", &kPlain, {Set, 2, "TOOL CALL 7"}, "2 TOOL CALL 7 Z S 500,000"},
        ChangeCase{"speed", &kPlain, {Set, 2, "S800"}, "2 TOOL CALL 1 Z S 800,000"},
        ChangeCase{"spindle_axis", &kPlain, {Set, 2, "Y"}, "2 TOOL CALL 1 Y S 500,000"},
        ChangeCase{"repeats", &kPlain, {Set, 5, "REP 9"}, "5 CALL LBL 3 REP 9/9"},
        ChangeCase{"operand", &kPlain, {Set, 7, "+ -Q9"}, "7 FN 1: Q5 = +Q2 + -Q9"},
        ChangeCase{"first_operand", &kPlain, {Set, 7, "=4"}, "7 FN 1: Q5 = +4,000 + +7,000"},
        ChangeCase{"repeated_path", &kPlain, {Set, 8, "Y7"}, "8 L Y+7,000 R F M"},
        ChangeCase{
            "iso_coordinate", &kIso, {Set, 20, "Y-3"}, "N20 G00 G41 G90 X+10 G91 Y-3 F200 M03 *"},
        ChangeCase{
            "iso_function", &kIso, {Set, 20, "G40"}, "N20 G00 G40 G90 X+10 G91 Y+5 F200 M03 *"},
        ChangeCase{"iso_parameter",
                   &kIso,
                   {Set, 30, "P02 -25.5"},
                   "N30 G83 P01 -2 P02 -25.5 P03 -5 P04 1 P05 100 *"},
        ChangeCase{"iso_label", &kIso, {Set, 40, "L3.5"}, "N40 L3.5 *"}),
    [](const auto& i) { return std::string{i.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    SetRefused, Tnc155WordEditing,
    testing::Values(
        ChangeCase{"no_word",
                   &kPlain,
                   {Set, 4, "Y+1"},
                   "block 4 has no word Y: \"L IX+5,000 RL F100 M08\""},
        ChangeCase{"absolute_is_not_incremental",
                   &kPlain,
                   {Set, 4, "X+1"},
                   "block 4 has no word X: \"L IX+5,000 RL F100 M08\""},
        ChangeCase{
            "range",
            &kPlain,
            {Set, 3, "X30000.001"},
            "block 3: \"L X30000.001 Y+20,000 R0 F15999 M03\", column 4: ENTRY VALUE INCORRECT: X "
            "30000.001 is not within -30000 to 30000"},
        ChangeCase{
            "mirrored_axis",
            &kPlain,
            {Set, 6, "X+1"},
            "block 6: \"CYCL DEF 8.1 X+1 Y\", column 15: WRONG AXIS PROGRAMMED: mirrored axes have "
            "no values"},
        ChangeCase{"no_value",
                   &kPlain,
                   {Set, 3, "X"},
                   "block 3: \"L X Y+20,000 R0 F15999 M03\", column 5: BLOCK FORMAT INCORRECT: X "
                   "has no value"},
        ChangeCase{"kind",
                   &kPlain,
                   {Set, 6, "CYCL DEF 7.1"},
                   "block 6: CYCL DEF determines the kind of the block, --replace changes it"},
        ChangeCase{"no_block",
                   &kPlain,
                   {Set, 12, "X"},
                   "block 12 is not there: the program has blocks 0 to 9"},
        ChangeCase{"frame",
                   &kPlain,
                   {Set, 9, "END PGM 3"},
                   "block 9: END PGM determines the kind of the block, --replace changes it"},
        ChangeCase{"iso_no_group",
                   &kIso,
                   {Set, 10, "G41"},
                   "block 10 has no word G41: \"N10 T1 G17 S500\""},
        ChangeCase{"iso_distance",
                   &kIso,
                   {Set, 20, "G90"},
                   "block 20: G90 is for the words after it, --replace changes both"},
        ChangeCase{"iso_range",
                   &kIso,
                   {Set, 20, "F16000"},
                   "block 20: \"N20 G00 G41 G90 X+10 G91 Y+5 F16000 M03\", column 31: ENTRY VALUE "
                   "INCORRECT: "
                   "F 16000 is not a whole number within 0 to 15999"}),
    [](const auto& i) { return std::string{i.param.name}; });

// NO ENT: the value in force before the block stays.
INSTANTIATE_TEST_SUITE_P(
    LeaveOut, Tnc155WordEditing,
    testing::Values(
        ChangeCase{"feed", &kPlain, {LeaveOut, 3, "F"}, "3 L X+10,000 Y+20,000 R0 F M03"},
        ChangeCase{"axis", &kPlain, {LeaveOut, 3, "X"}, "3 L Y+20,000 R0 F15999 M03"},
        ChangeCase{"tool_number", &kPlain, {LeaveOut, 2, "TOOL CALL"}, "2 TOOL CALL Z S 500,000"},
        ChangeCase{"spindle_axis", &kPlain, {LeaveOut, 2, "Z"}, "2 TOOL CALL 1 S 500,000"},
        ChangeCase{"length", &kPlain, {LeaveOut, 1, "L"}, "1 TOOL DEF 1 R+5,000"},
        ChangeCase{"repeats", &kPlain, {LeaveOut, 5, "REP"}, "5 CALL LBL 3 REP"},
        ChangeCase{"mirrored_axis", &kPlain, {LeaveOut, 6, "Y"}, "6 CYCL DEF 8.1 X"},
        ChangeCase{
            "iso_idle_distance", &kIso, {LeaveOut, 20, "X"}, "N20 G00 G41 G91 Y+5 F200 M03 *"},
        ChangeCase{
            "iso_function", &kIso, {LeaveOut, 20, "G0"}, "N20 G41 G90 X+10 G91 Y+5 F200 M03 *"},
        ChangeCase{"needed",
                   &kPlain,
                   {LeaveOut, 7, "+"},
                   "block 7: \"FN 1: Q5 = +Q2\", column 15: BLOCK FORMAT INCORRECT: + is missing"},
        ChangeCase{"already",
                   &kPlain,
                   {LeaveOut, 8, "M"},
                   "M of block 8 is left out already: \"L Y+Q5 R F M\""},
        ChangeCase{"beginning",
                   &kPlain,
                   {LeaveOut, 3, "L"},
                   "L begins block 3, \"L X+10,000 Y+20,000 R0 F15999 M03\": it stays"},
        ChangeCase{
            "absent", &kPlain, {LeaveOut, 5, "X"}, "block 5 has no word X: \"CALL LBL 3 REP 2/2\""},
        ChangeCase{"iso_number",
                   &kIso,
                   {LeaveOut, 10, "N"},
                   "N begins block 10, \"N10 T1 G17 S500\": it stays"}),
    [](const auto& i) { return std::string{i.param.name}; });

// END: all that remains is left out.
INSTANTIATE_TEST_SUITE_P(
    Shorten, Tnc155WordEditing,
    testing::Values(ChangeCase{"tail", &kPlain, {Shorten, 3, "R"}, "3 L X+10,000 Y+20,000 R F M"},
                    ChangeCase{"axis", &kPlain, {Shorten, 3, "Y"}, "3 L X+10,000 R F M"},
                    ChangeCase{"tool_call", &kPlain, {Shorten, 2, "Z"}, "2 TOOL CALL 1"},
                    ChangeCase{"mirror", &kPlain, {Shorten, 6, "X"}, "6 CYCL DEF 8.1"},
                    ChangeCase{"iso", &kIso, {Shorten, 20, "F"}, "N20 G00 G41 G90 X+10 G91 Y+5 *"},
                    ChangeCase{"iso_cycle",
                               &kIso,
                               {Shorten, 30, "P05"},
                               "block 30: \"N30 G83 P01 -2 P02 -20 P03 -5 P04 1\", column 1: BLOCK "
                               "FORMAT INCORRECT: P05 of G83 is missing"},
                    ChangeCase{
                        "needed",
                        &kPlain,
                        {Shorten, 7, "="},
                        "block 7: \"FN 1: Q5\", column 9: BLOCK FORMAT INCORRECT: = has no value"},
                    ChangeCase{"already",
                               &kPlain,
                               {Shorten, 8, "R"},
                               "R of block 8 is left out already: \"L Y+Q5 R F M\""}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(Tnc155WordEdits, OfOneBlockGoTogether) {
  EXPECT_EQ(changed(kPlain, {{LeaveOut, 3, "M"}, {Set, 3, "X1"}, {Set, 4, "M9"}, {Set, 3, "F300"}}),
            "3 L X+1,000 Y+20,000 R0 F300 M\n4 L IX+5,000 RL F100 M09");
  EXPECT_EQ(changed(kPlain, {{Set, 3, "F1"}, {Set, 3, "F2"}}), "F of block 3 is given two values");
  EXPECT_EQ(changed(kPlain, {{Shorten, 3, "R"}, {Set, 3, "F2"}}),
            "F of block 3 is given a value and left out");
}

TEST(Tnc155WordEdits, DoNotTouchABlockThatCannotBeRead) {
  EXPECT_EQ(changed("0 BEGIN PGM 1 MM\n1 L Q\n2 STOP M\n3 END PGM 1 MM\n", {{Set, 1, "X1"}})
                .substr(0, 59),
            "block 1 \"1 L Q\" cannot be read, --replace repairs it: BLOCK");
  EXPECT_EQ(
      changed("0 BEGIN PGM 1 INCH\n1 L Q\n2 L X+1.5\n3 END PGM 1 INCH\n", {{Set, 2, "X.0001"}}),
      "2 L X+0.0001 R F M");
  EXPECT_EQ(changed("hello", {{Set, 1, "X1"}}), "line 1: neither plain language nor ISO of a TNC");
}

TEST(Tnc155WordEdits, ReadBlocksWithBlanksAfterThem) {
  EXPECT_EQ(
      changed("0 BEGIN PGM 1 MM  \r\n1 L X+1  \r\n2 L Y+2 \n3 END PGM 1 MM", {{Set, 1, "X3"}}),
      "1 L X+3,000 R F M");
  EXPECT_EQ(changed("0 BEGIN PGM 1 MM\n1 L X+1\n2 L Y+2  ", {{Set, 2, "Y3"}}), "2 L Y+3,000 R F M");
  EXPECT_EQ(changed("%1 G70*\nN1 X+1.0625*\nN9999 %1 G70*\n", {{Set, 1, "X.0005"}}),
            "N1 X+0.0005 *");
}

/// How many words of the block have been given the value they have; the block is `written` as it
/// was then.
int set_all_words(const std::string& text, std::int64_t number, const std::string& written,
                  Form form) {
  int count = 0;
  const bool is_numbered = form == Form::Plain && written.front() <= '9';
  const std::size_t skipped = is_numbered ? written.find(' ') + 1 : 0;
  for (const BlockWord& word : words_of(std::string_view(written).substr(skipped), form)) {
    if (word.address == "*" || word.address == "CYCL DEF") continue;
    const std::string typed = std::string(word.address) + std::string(word.value);
    const std::string result = changed(text, {{Set, number, typed}});
    const bool is_refused = result.find("--replace changes") != std::string::npos;
    if (is_refused) continue;
    EXPECT_EQ(result, written) << typed;
    ++count;
  }
  return count;
}

// Whatever a block is, each of its words is found again by what it says.
TEST(Tnc155WordEdits, OfEveryWordToItsOwnValueChangeNothing) {
  int count = 0;
  for (const GoldenCase& golden : golden_cases("tnc155")) {
    SCOPED_TRACE(golden.name);
    const std::string text = golden.program();
    const CutProgram program(text);
    for (const TextBlock& block : program.blocks()) {
      const BlockChange same{BlockChange::Kind::Replace, block.number, block.number, block.text()};
      const auto edited = edit_program(text, {&same, 1});
      if (!edited || edited->changes.size() != 2 || edited->renumbered > 0) continue;
      count += set_all_words(text, block.number, edited->changes[1].text, program.form());
    }
  }
  EXPECT_GE(count, 2000);
}

std::string found(const std::string& text, const std::vector<std::string>& addresses) {
  const auto search = search_words(text, addresses);
  if (!search) return search.error().what;
  std::string list;
  for (const auto& [block, line, shown] : search->found) {
    list += std::to_string(block) + " in " + std::to_string(line) + ", ";
  }
  for (const auto& [block, reason] : search->unread) list += "not " + block.text + ", ";
  return list;
}

TEST(Tnc155Search, ShowsTheBlocksThatHaveTheAddress) {
  EXPECT_EQ(found(kPlain, {"X"}), "3 in 4, 6 in 8, ");
  EXPECT_EQ(found(kPlain, {"IX"}), "4 in 5, ");
  EXPECT_EQ(found(kPlain, {"tool call"}), "2 in 3, ");
  EXPECT_EQ(found(kPlain, {"LBL"}), "");
  EXPECT_EQ(found(kPlain, {"CALL LBL", "FN"}), "5 in 7, 7 in 9, ");
  EXPECT_EQ(found(kPlain, {"Q"}), "7 in 9, 8 in 10, ");
  EXPECT_EQ(found(kPlain, {"F"}), "3 in 4, 4 in 5, ");
  EXPECT_EQ(found(kIso, {"G90"}), "20 in 3, ");
  EXPECT_EQ(found(kIso, {"G"}), "0 in 1, 10 in 2, 20 in 3, 30 in 4, 9999 in 6, ");
  EXPECT_EQ(found(kIso, {"p"}), "30 in 4, ");
  EXPECT_EQ(found(kIso, {"M"}), "20 in 3, ");
  EXPECT_EQ(found("BEGIN PGM 1 MM\nSTOP\nL Q\nSTOP M5\nEND PGM 1 MM\n", {"M"}),
            "3 in 4, not L Q, ");
  EXPECT_EQ(found(kPlain, {"F100"}), "\"F100\": expected an address alone, as F");
}

}  // namespace
}  // namespace dripline::program_editing
