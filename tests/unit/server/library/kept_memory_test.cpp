#include "server/library/history/kept_memory.hpp"

#include <gtest/gtest.h>

namespace dripline::library {
namespace {

constexpr const char* kFirst = R"({"part":1,"parts":2,"cells":{"P10":[7.5,0],"PB50":[2,1]}})";
constexpr const char* kSecond = R"({"part":2,"parts":2,"cells":{"#500":[null,3]}})";

TEST(MemoryTexts, AreReadPartByPart) {
  const auto cells = read_memory_texts({kFirst, kSecond});
  ASSERT_TRUE(cells) << cells.error().what;
  ASSERT_EQ(cells->size(), 3U);
  EXPECT_EQ(cells->at("P10"), (KeptCell{7.5, 0}));
  EXPECT_EQ(cells->at("#500"), (KeptCell{std::nullopt, 3}));
}

TEST(MemoryTexts, WithAPartMissingAreNoMemory) {
  for (const std::vector<std::string>& texts :
       {std::vector<std::string>{}, {kFirst}, {kSecond}, {kSecond, kFirst}}) {
    EXPECT_EQ(read_memory_texts(texts).error().code, Errc::NotFound);
  }
}

/// A gateway that was killed after its report reports it again.
TEST(MemoryTexts, ThatWereSentAgainReplaceThoseBefore) {
  const auto cells =
      read_memory_texts({kFirst, kSecond, R"({"part":1,"parts":1,"cells":{"P1":[1,0]}})"});
  ASSERT_TRUE(cells);
  EXPECT_EQ(cells->size(), 1U);
}

TEST(MemoryTexts, AreNotReadFromOtherTexts) {
  for (const char* text :
       {"", "DRILL", "[]", R"({"part":1,"parts":1,"cells":[]})",
        R"({"part":1,"parts":1,"cells":{"P1":1}})", R"({"part":1,"parts":1,"cells":{"P1":[1]}})",
        R"({"part":1,"parts":1,"cells":{"a\"b":[1,2]}})", R"({"cells":{"P1":[1,2]}})",
        R"({"part":-1,"parts":1,"cells":{}})", R"({"part":1,"parts":1,"cells":{"P1":["1",2]}})",
        "[[[[[[[[[[[["}) {
    EXPECT_FALSE(read_memory_texts({text})) << text;
  }
}

}  // namespace
}  // namespace dripline::library
