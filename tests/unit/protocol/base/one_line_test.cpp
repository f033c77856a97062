#include "protocol/base/one_line.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

TEST(OneLine, LeavesOrdinaryTextAlone) {
  EXPECT_EQ(one_line("run ended machine=lathe-1 \xC3\xA9"), "run ended machine=lathe-1 \xC3\xA9");
}

TEST(OneLine, LetsNoTextForgeAnEntryOrControlATerminal) {
  EXPECT_EQ(one_line("1.0\n2026 info run ended"), "1.0\\n2026 info run ended");
  EXPECT_EQ(one_line("\x1B[2J\r\x7F"), "\\x1b[2J\\x0d\\x7f");
  EXPECT_EQ(one_line(std::string_view("\0", 1)), "\\x00");
}

}  // namespace
}  // namespace dripline
