#include "clients/tools/program_editing/tnc155/whole_program.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dripline::program_editing
