#include "gateway/interpreter/dialects/tnc155/editing/program_memory.hpp"

#include <gtest/gtest.h>

namespace dripline::interpreter::tnc155 {
namespace {

StoredProgram program_of(std::int32_t number, std::size_t blocks) {
  StoredProgram program;
  program.number = number;
  program.blocks = blocks;
  return program;
}

// HD-051
TEST(Tnc155ProgramMemory, Keeps32Programs) {
  ProgramMemory memory;
  for (int number = 1; number <= 32; ++number) {
    ASSERT_TRUE(memory.store(program_of(number, 2)));
  }
  EXPECT_EQ(memory.store(program_of(33, 2)).error().what,
            "PROGRAM MEMORY EXCEEDED: program 33 is more than the 32 programs the control keeps");
  EXPECT_TRUE(memory.store(program_of(7, 40)));  // replaces
  EXPECT_EQ(memory.directory().size(), 32u);
}

// HD-052, HD-053
TEST(Tnc155ProgramMemory, Keeps3100BlocksAnd999OfAProgram) {
  ProgramMemory memory;
  EXPECT_EQ(memory.store(program_of(1, 1000)).error().what,
            "PROGRAM MEMORY EXCEEDED: program 1 has 1000 blocks, 999 is most");
  for (int number = 1; number <= 3; ++number) {
    ASSERT_TRUE(memory.store(program_of(number, 999)));
  }
  EXPECT_EQ(memory.vacant_blocks(), 103u);
  EXPECT_EQ(memory.store(program_of(4, 104)).error().what,
            "PROGRAM MEMORY EXCEEDED: program 4 has 104 blocks, 103 are vacant");
  EXPECT_EQ(memory.vacant_blocks(), 103u);
  EXPECT_TRUE(memory.store(program_of(3, 900)));
  EXPECT_TRUE(memory.store(program_of(4, 202)));
  EXPECT_EQ(memory.vacant_blocks(), 0u);
}

// HD-054, HD-055: by number, with blocks or characters.
TEST(Tnc155ProgramMemory, ListsItsPrograms) {
  ProgramMemory memory;
  const auto iso = describe_program("%450 G71 *\r\nN10 G29 *\r\nN9999 %450 G71 *\r\n");
  ASSERT_TRUE(iso);
  ASSERT_TRUE(memory.store(program_of(87654321, 12)));
  ASSERT_TRUE(memory.store(*iso));
  EXPECT_EQ(memory.listing(), "     450/   41\n87654321    12\nVACANT BLOCKS = 3085\n");
  EXPECT_FALSE(memory.store(program_of(100'000'000, 2)));
}

// HD-056, HD-060
TEST(Tnc155ProgramMemory, ErasesNothingProtected) {
  ProgramMemory memory;
  ASSERT_TRUE(memory.store(*describe_program("0 BEGIN PGM 6 MM P\n1 END PGM 6 MM P\n")));
  EXPECT_EQ(memory.erase(6).error().what, "program 6 is protected");
  EXPECT_EQ(memory.store(program_of(6, 2)).error().what, "program 6 is protected");
  EXPECT_EQ(memory.erase(5).error().what, "PGM 5 UNAVAILABLE");
  ASSERT_TRUE(memory.store(program_of(5, 2)));
  EXPECT_TRUE(memory.erase(5));
}

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

}  // namespace
}  // namespace dripline::interpreter::tnc155
