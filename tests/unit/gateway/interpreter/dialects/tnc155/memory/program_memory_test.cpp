#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"

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
  StoredProgram iso = program_of(450, 3);
  iso.form = Form::Iso;
  iso.characters = 41;
  ASSERT_TRUE(memory.store(program_of(87654321, 12)));
  ASSERT_TRUE(memory.store(iso));
  EXPECT_EQ(memory.listing(), "     450/   41\n87654321    12\nVACANT BLOCKS = 3085\n");
  EXPECT_FALSE(memory.store(program_of(100'000'000, 2)));
}

// HD-056, HD-060
TEST(Tnc155ProgramMemory, ErasesNothingProtected) {
  ProgramMemory memory;
  StoredProgram locked = program_of(6, 2);
  locked.is_protected = true;
  ASSERT_TRUE(memory.store(locked));
  EXPECT_EQ(memory.erase(6).error().what, "program 6 is protected");
  EXPECT_EQ(memory.store(program_of(6, 2)).error().what, "program 6 is protected");
  EXPECT_EQ(memory.erase(5).error().what, "PGM 5 UNAVAILABLE");
  ASSERT_TRUE(memory.store(program_of(5, 2)));
  EXPECT_TRUE(memory.erase(5));
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
