#include <gtest/gtest.h>

#include "clients/tools/program_editing/program_edit.hpp"
#include "clients/tools/program_editing/tnc155/whole_program.hpp"

// HD-061: blocks are taken out, put in and replaced as at the control.

namespace dripline::program_editing {

namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

// HD-056, HD-057
TEST(Tnc155Protection, IsSetAndTakenAwayInBothForms) {
  const std::string plain = "0 BEGIN PGM 6 MM\r\n1 END PGM 6 MM\r\n";
  const std::string locked = "0 BEGIN PGM 6 MM P\r\n1 END PGM 6 MM P\r\n";
  EXPECT_EQ(with_protection(plain, true).value(), locked);
  EXPECT_EQ(with_protection(locked, false).value(), plain);
  const std::string iso = "%6 G70 *\r\nN9999 %6 G70 *\r\n";
  EXPECT_EQ(with_protection(iso, true).value(), "%6 G70 G50 *\r\nN9999 %6 G70 *\r\n");
  EXPECT_EQ(with_protection("%6 G70 G50 *\r\nN9999 %6 G70 *\r\n", false).value(), iso);
}

// HD-058
TEST(Tnc155Description, SaysUnitsAndRefusesForeignEnds) {
  EXPECT_EQ(describe_program("0 BEGIN PGM 6 INCH\n1 END PGM 6 INCH")->units, Units::Inch);
  EXPECT_EQ(describe_program("0 BEGIN PGM 6 MM\n1 END PGM 7 MM").error().what,
            "line 2: END PGM 7 ends program 6");
  EXPECT_EQ(describe_program("1 CC\n").error().what, "line 1: no BEGIN PGM");
}

// HD-061, HD-066
TEST(Tnc155Renumbering, CountsFromZeroOrByTheIncrement) {
  EXPECT_EQ(renumbered("0 BEGIN PGM 6 MM\n4 CC\n7 STOP\n9 END PGM 6 MM").value(),
            "0 BEGIN PGM 6 MM\r\n1 CC\r\n2 STOP M\r\n3 END PGM 6 MM\r\n");
  EXPECT_EQ(renumbered("%6 G71\nN4 G29\nN5 L7\nN9999 %6 G71", 20).value(),
            "%6 G71 *\r\nN20 G29 *\r\nN40 L7 *\r\nN9999 %6 G71 *\r\n");
  EXPECT_EQ(renumbered("%6 G71\nN4 G29 *\nN9999 %6 G71", 0).value(),
            "%6 G71 *\r\nG29 *\r\nN9999 %6 G71 *\r\n");
}

// HD-055, HD-056
TEST(Tnc155Description, CountsBlocksAndCharactersAndSeesProtection) {
  const auto iso = describe_program("%450 G71 *\r\nN10 G29 *\r\nN9999 %450 G71 *\r\n");
  ASSERT_TRUE(iso) << iso.error().what;
  EXPECT_EQ(iso->number, 450);
  EXPECT_EQ(iso->form, Form::Iso);
  EXPECT_EQ(iso->blocks, 3u);
  EXPECT_EQ(iso->characters, 41u);
  EXPECT_FALSE(iso->is_protected);
  const auto plain = describe_program("0 BEGIN PGM 6 MM P\n1 END PGM 6 MM P\n");
  ASSERT_TRUE(plain) << plain.error().what;
  EXPECT_TRUE(plain->is_protected);
}

using Kind = BlockChange::Kind;

const std::string kPlain =
    "0 BEGIN PGM 15 MM\r\n"
    "1 TOOL DEF 1 L+0,000 R+5,000\r\n"
    "2 TOOL CALL 1 Z S500,000\r\n"
    "3 L Z+50,000\r\n"
    "  R0 F MAX M\r\n"
    "4 STOP M\r\n"
    "5 END PGM 15 MM\r\n";

Result<EditedProgram> edit(const std::string& text, const std::vector<BlockChange>& changes) {
  return edit_program(text, changes);
}

std::string change_list(const EditedProgram& edited) {
  std::string list;
  for (const auto& [mark, text] : edited.changes) list += mark + text + "\n";
  return list;
}

TEST(Tnc155Editing, TakesBlocksOutAndMovesTheOthersUp) {
  const auto edited = edit(kPlain, {{Kind::Delete, 1, 2, ""}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text,
            "0 BEGIN PGM 15 MM\r\n"
            "1 L Z+50,000\r\n"
            "  R0 F MAX M\r\n"
            "2 STOP M\r\n"
            "3 END PGM 15 MM\r\n");
  EXPECT_EQ(change_list(*edited), "-1 TOOL DEF 1 L+0,000 R+5,000\n-2 TOOL CALL 1 Z S500,000\n");
  EXPECT_EQ(edited->renumbered, 3u);
}

TEST(Tnc155Editing, PutsBlocksInAfterABlockInTheControlsLayout) {
  const auto edited = edit(kPlain, {{Kind::Insert, 3, 3, "LX10.5 Y-3F200\nCC"}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text,
            "0 BEGIN PGM 15 MM\r\n"
            "1 TOOL DEF 1 L+0,000 R+5,000\r\n"
            "2 TOOL CALL 1 Z S500,000\r\n"
            "3 L Z+50,000\r\n"
            "  R0 F MAX M\r\n"
            "4 L X+10,500 Y-3,000 R F200 M\r\n"
            "5 CC\r\n"
            "6 STOP M\r\n"
            "7 END PGM 15 MM\r\n");
  EXPECT_EQ(change_list(*edited), "+4 L X+10,500 Y-3,000 R F200 M\n+5 CC\n");
}

TEST(Tnc155Editing, NumbersOfAllChangesAreThoseBefore) {
  const auto edited = edit(kPlain, {{Kind::Replace, 4, 4, "STOP M05"},
                                    {Kind::Delete, 1, 1, ""},
                                    {Kind::Insert, 1, 1, "LBL 1"},
                                    {Kind::Insert, 4, 4, "LBL 0"}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text,
            "0 BEGIN PGM 15 MM\r\n"
            "1 LBL 1\r\n"
            "2 TOOL CALL 1 Z S500,000\r\n"
            "3 L Z+50,000\r\n"
            "  R0 F MAX M\r\n"
            "4 STOP M05\r\n"
            "5 LBL 0\r\n"
            "6 END PGM 15 MM\r\n");
  EXPECT_EQ(change_list(*edited),
            "-1 TOOL DEF 1 L+0,000 R+5,000\n+1 LBL 1\n-4 STOP M\n+4 STOP M05\n+5 LBL 0\n");
}

TEST(Tnc155Editing, RefusesAWrongBlockInTheControlsWords) {
  EXPECT_EQ(edit(kPlain, {{Kind::Insert, 3, 3, "CALL LBL 0"}}).error().what,
            "\"CALL LBL 0\", column 10: JUMP TO LABEL 0 NOT PERMITTED: CALL LBL 0");
  EXPECT_EQ(
      edit(kPlain, {{Kind::Insert, 3, 3, "TOOL CALL 255"}}).error().what,
      "\"TOOL CALL 255\", column 11: ENTRY VALUE INCORRECT: TOOL CALL 255 is not within 0 to 254");
  EXPECT_FALSE(edit(kPlain, {{Kind::Insert, 3, 3, "BEGIN PGM 3 MM"}}));
}

TEST(Tnc155Editing, KeepsTheFirstAndTheLastBlock) {
  EXPECT_EQ(edit(kPlain, {{Kind::Insert, 5, 5, "CC"}}).error().what,
            "PROGRAM MEMORY EXCEEDED: nothing may follow the last block, 5 \"5 END PGM 15 MM\"");
  EXPECT_EQ(edit(kPlain, {{Kind::Delete, 0, 0, ""}}).error().what,
            "block 0 \"0 BEGIN PGM 15 MM\" begins or ends the program: it stays");
  EXPECT_FALSE(edit(kPlain, {{Kind::Delete, 4, 5, ""}}));
}

TEST(Tnc155Editing, NamesABlockThatIsNotThere) {
  EXPECT_EQ(edit(kPlain, {{Kind::Delete, 6, 6, ""}}).error().what,
            "block 6 is not there: the program has blocks 0 to 5");
  EXPECT_EQ(edit(kPlain, {{Kind::Delete, 3, 2, ""}}).error().what,
            "blocks 3..2: the range runs backwards");
  EXPECT_EQ(edit(kPlain, {{Kind::Delete, 1, 3, ""}, {Kind::Replace, 3, 3, "CC"}}).error().what,
            "block 3 is taken out or replaced twice");
  EXPECT_EQ(edit(kPlain, {{Kind::Insert, 3, 3, " \n"}}).error().what,
            "nothing is there to put in at block 3");
}

TEST(Tnc155Editing, MendsAWrongBlock) {
  const auto edited =
      edit("0 BEGIN PGM 1 MM\n1 L Q\n2 END PGM 1 MM", {{Kind::Replace, 1, 1, "L X+Q3"}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text, "0 BEGIN PGM 1 MM\n1 L X+Q3 R F M\n2 END PGM 1 MM");
}

// Numbers with gaps are those of a blockwise transfer: they stay.
TEST(Tnc155Editing, FindsANumberBetweenItsNeighborsWhereThereAreGaps) {
  const std::string text = "0 BEGIN PGM 1 MM\n100 CC\n104 CC\n105 END PGM 1 MM\n";
  const auto edited = edit(text, {{Kind::Insert, 100, 100, "LBL 3"}, {Kind::Delete, 104, 104, ""}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text, "0 BEGIN PGM 1 MM\n100 CC\n102 LBL 3\n105 END PGM 1 MM\n");
  EXPECT_EQ(edit(text, {{Kind::Insert, 104, 104, "CC"}}).error().what,
            "1 blocks do not fit between block numbers 104 and 105: renumber first");
}

TEST(Tnc155Editing, EditsIsoByItsN) {
  const std::string iso = "%15 G71 *\nN10 G29 *\nN20 L3 *\nN9999 %15 G71 *\n";
  const auto edited = edit(iso, {{Kind::Insert, 20, 20, "L4"},
                                 {Kind::Insert, 0, 0, "N7 T1 G17 S500 *"},
                                 {Kind::Replace, 10, 10, "I+5 J+6"}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text,
            "%15 G71 *\nN7 T1 G17 S500 *\nN10 I+5 J+6 *\nN20 L3 *\nN30 L4 *\nN9999 %15 G71 *\n");
  EXPECT_EQ(edit(iso, {{Kind::Insert, 10, 10, "G33"}}).error().what,
            "\"G33\", column 1: ILLEGAL G-CODE: G33");
}

// The first block says the units, also with a blank before its end.
TEST(Tnc155Editing, EditsIsoInInches) {
  const auto edited =
      edit("%15 G70 *\nN10 X+1.5 *\nN9999 %15 G70 *\n", {{Kind::Replace, 10, 10, "X+1.2345"}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text, "%15 G70 *\nN10 X+1.2345 *\nN9999 %15 G70 *\n");
  EXPECT_EQ(edit("%15 G70 *\nN10 X+1.5 *\n", {{Kind::Delete, 0, 0, ""}}).error().what,
            "block 0 \"%15 G70\" begins or ends the program: it stays");
}

TEST(Tnc155Editing, LeavesATextWithoutNumbersWithoutThem) {
  const auto edited = edit("BEGIN PGM 1 MM\nCC\nSTOP\nEND PGM 1 MM\n",
                           {{Kind::Delete, 1, 1, ""}, {Kind::Insert, 2, 2, "LBL 1"}});
  ASSERT_TRUE(edited) << edited.error().what;
  EXPECT_EQ(edited->text, "BEGIN PGM 1 MM\nSTOP\nLBL 1\nEND PGM 1 MM\n");
}

}  // namespace

}  // namespace dripline::program_editing
