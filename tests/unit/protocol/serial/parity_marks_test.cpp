#include "protocol/serial/impl/parity_marks.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace dripline::serial {
namespace {

/// Characters as they are, "(41)" for a faulty one, "(break)".
std::string decoded(const std::vector<std::uint8_t>& bytes) {
  ParityMarks marks;
  std::string text;
  for (const std::uint8_t byte : bytes) {
    const auto item = marks.feed(byte);
    if (!item) continue;
    if (const auto* faulty = std::get_if<ParityMarks::Faulty>(&*item)) {
      text += faulty->is_break ? "(break)" : "(" + std::to_string(faulty->character) + ")";
    } else {
      text += static_cast<char>(std::get<std::uint8_t>(*item));
    }
  }
  return text;
}

TEST(ParityMarks, PassesCharactersThrough) {
  EXPECT_EQ(decoded({'G', '0', 0, 'X'}), std::string("G0\0X", 4));
}

TEST(ParityMarks, TakesADoubledFfForOne) {
  EXPECT_EQ(decoded({'A', 0xFF, 0xFF, 'B'}),
            "A\xFF"
            "B");
}

TEST(ParityMarks, ReportsAFaultyCharacterAndContinues) {
  EXPECT_EQ(decoded({'A', 0xFF, 0x00, 41, 'B'}), "A(41)B");
}

TEST(ParityMarks, ReportsABreak) {
  EXPECT_EQ(decoded({0xFF, 0x00, 0x00, 'B'}), "(break)B");
}

TEST(ParityMarks, ReportsAFaultyFf) {
  EXPECT_EQ(decoded({0xFF, 0x00, 0xFF, 'B'}), "(255)B");
}

}  // namespace
}  // namespace dripline::serial
