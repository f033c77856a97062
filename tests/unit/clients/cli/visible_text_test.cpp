#include "clients/cli/text/visible_text.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

TEST(VisibleText, ShowsWhatCouldSteerATerminal) {
  VisibleText visible;
  EXPECT_EQ(visible.take("X1\x1b[2J\r\tY\x7f\n"), "X1\\x1b[2J\\x0d\tY\\x7f\n");
}

TEST(VisibleText, KeepsUtf8AndFindsControlsOfTwoBytesAcrossPieces) {
  VisibleText visible;
  std::string text(visible.take("20 \xc2\xb0 \xc3\xa9 \xc2"));
  text += visible.take(
      "\x9b"
      "31m \xc2");
  text += visible.take("\xb5");
  EXPECT_EQ(text,
            "20 \xc2\xb0 \xc3\xa9 \\x9b"
            "31m \xc2\xb5");
}

}  // namespace
}  // namespace dripline::cli
