#include "clients/tools/offline/number_text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace dripline::interpreter {
namespace {

std::string printed(double value) {
  std::string text;
  append_number(text, value);
  return text;
}
std::string in_json(std::string_view value) {
  std::string text;
  append_json_string(text, value);
  return text;
}

TEST(NumberText, IsPlainAndShort) {
  EXPECT_EQ(printed(0), "0");
  EXPECT_EQ(printed(-0.0), "0");
  EXPECT_EQ(printed(8), "8");
  EXPECT_EQ(printed(-1.5), "-1.5");
  EXPECT_EQ(printed(100), "100");
  EXPECT_EQ(printed(0.000001), "0.000001");
  EXPECT_EQ(printed(10.01), "10.01");
  EXPECT_EQ(printed(16.4856 * 25.4 / 25.4), "16.4856");
  EXPECT_EQ(printed(1.0 / 3), "0.333333");
  EXPECT_EQ(printed(2.0 / 3), "0.666667");
  EXPECT_EQ(printed(0.9999999), "1");
}

TEST(NumberText, WhatRoundsToZeroHasNoSign) {
  EXPECT_EQ(printed(-0.0000004), "0");
  EXPECT_EQ(printed(-1e-300), "0");
  EXPECT_EQ(printed(-0.0000006), "-0.000001");
}

TEST(NumberText, LargeNumbersHaveNoExponent) {
  EXPECT_EQ(printed(123456789), "123456789");
  EXPECT_EQ(printed(1e9), "1000000000");
  EXPECT_EQ(printed(-1e21), "-1000000000000000000000");
  EXPECT_EQ(printed(1e9 + 0.5), "1000000000.5");
}

TEST(NumberText, WhatIsNoNumberIsNull) {
  EXPECT_EQ(printed(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(printed(std::nan("")), "null");
}

RC_GTEST_PROP(NumberText, ReadsBackWithinHalfAMillionth, ()) {
  const auto millionths = *rc::gen::inRange<std::int64_t>(-900'000'000'000, 900'000'000'000);
  const auto more = *rc::gen::inRange<int>(0, 1000);
  const double value = static_cast<double>(millionths) / 1e6 + more / 1e9;
  const std::string text = printed(value);
  double back = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), back);
  RC_ASSERT(read.ptr == text.data() + text.size());
  RC_ASSERT(std::fabs(back - value) <= 0.5e-6 + 1e-9);
  RC_ASSERT(text.find('e') == std::string::npos);
  RC_ASSERT(text != "-0");
  const auto point = text.find('.');
  if (point != std::string::npos) {
    RC_ASSERT(text.size() - point <= 7U);
    RC_ASSERT(text.back() != '0' && text.back() != '.');
  }
}

RC_GTEST_PROP(NumberText, DecimalsOfAProgramComeBackAsTheyWere, ()) {
  const auto digits = *rc::gen::inRange<std::int64_t>(-99'999'999, 99'999'999);
  const double value = static_cast<double>(digits) / 1e4;
  const double through_inches = value * 25.4 / 25.4;
  RC_ASSERT(printed(through_inches) == printed(value));
}

TEST(JsonString, EscapesWhatJsonDemands) {
  EXPECT_EQ(in_json("PART \"A\" \\ 1"), R"("PART \"A\" \\ 1")");
  EXPECT_EQ(in_json("a\tb\r\n"), R"("a\tb\r\n")");
  EXPECT_EQ(in_json(std::string_view("\0\x01\x1f\x7f", 4)), R"("\u0000\u0001\u001f\u007f")");
  EXPECT_EQ(in_json(""), "\"\"");
}

TEST(JsonString, KeepsValidUtf8AndReplacesTheRest) {
  EXPECT_EQ(in_json("Stück ≤ 5 😀"), "\"Stück ≤ 5 😀\"");
  EXPECT_EQ(in_json("a\xFF"
                    "b"),
            "\"a\xEF\xBF\xBD"
            "b\"");
  EXPECT_EQ(in_json("\xC0\x80"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\"") << "a NUL in disguise";
  EXPECT_EQ(in_json("\xE2\x82"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\"") << "cut off";
  EXPECT_EQ(in_json("\xED\xA0\x80"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"") << "a surrogate";
}

RC_GTEST_PROP(JsonString, IsAlwaysValidJson, (const std::string& text)) {
  const auto parsed = nlohmann::json::parse(in_json(text));
  RC_ASSERT(parsed.is_string());
}

RC_GTEST_PROP(JsonString, BytesOfEveryKindAreValidJson, ()) {
  const auto bytes =
      *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::arbitrary<std::uint8_t>());
  const std::string text(bytes.begin(), bytes.end());
  RC_ASSERT(nlohmann::json::parse(in_json(text)).is_string());
}

}  // namespace
}  // namespace dripline::interpreter
