#include "protocol/dds/impl/check.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace dripline::dds {
namespace {

struct TextCase {
  std::string name, text;
  bool is_fine;
  friend std::ostream& operator<<(std::ostream& out, const TextCase& c) { return out << c.name; }
};

class SendableText : public testing::TestWithParam<TextCase> {};

TEST_P(SendableText, IsRecognized) {
  EXPECT_EQ(is_sendable_text(GetParam().text), GetParam().is_fine);
  EXPECT_TRUE(is_sendable_text(make_sendable(GetParam().text, 64)));
  if (GetParam().is_fine) {
    EXPECT_EQ(make_sendable(GetParam().text, 64), GetParam().text);
  }
}

INSTANTIATE_TEST_SUITE_P(, SendableText,
                         testing::Values(TextCase{"empty", "", true},
                                         TextCase{"ascii", "G1 X1\t\r\n", true},
                                         TextCase{"two_bytes", "\xC3\xBC", true},
                                         TextCase{"three_bytes", "\xE2\x82\xAC", true},
                                         TextCase{"four_bytes", "\xF0\x9F\x94\xA7", true},
                                         TextCase{"nul", std::string("a\0b", 3), false},
                                         TextCase{"lone_continuation", "\x80", false},
                                         TextCase{"cut_off", "\xE2\x82", false},
                                         TextCase{"overlong_two", "\xC0\xAF", false},
                                         TextCase{"overlong_three", "\xE0\x80\xAF", false},
                                         TextCase{"overlong_four", "\xF0\x80\x80\xAF", false},
                                         TextCase{"surrogate", "\xED\xA0\x80", false},
                                         TextCase{"too_large", "\xF4\x90\x80\x80", false},
                                         TextCase{"latin_1",
                                                  "S\xFC"
                                                  "d",
                                                  false}),
                         [](const auto& i) { return i.param.name; });

TEST(MakeSendable, WritesEachBadByteAsHexadecimal) {
  EXPECT_EQ(make_sendable("S\xFC"
                          "d",
                          64),
            "S\\xFCd");
}

TEST(MakeSendable, CutsAtACharacterAndMarksIt) {
  EXPECT_EQ(make_sendable("0123456789", 10), "0123456789");
  EXPECT_EQ(make_sendable("0123456789a", 10), "0123456…");
  EXPECT_EQ(make_sendable("012345üüü", 10), "012345…");
}

TEST(MakeSendable, StaysWithinTheLimitWhateverTheBytes) {
  for (std::size_t size = 0; size < 40; ++size) {
    EXPECT_LE(make_sendable(std::string(size, '\xFF'), 16).size(), 16U) << size;
  }
}

}  // namespace
}  // namespace dripline::dds
