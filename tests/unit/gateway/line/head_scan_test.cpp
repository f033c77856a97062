#include "gateway/line/heads/head_scan.hpp"

#include <gtest/gtest.h>

namespace dripline::line {
namespace {

const std::string kProgram = "O1\nG21 G90\nT2 M6\nN10 G0 X1.\nN20 G1 X2. F100\nM30";

ProgramPlace find(const WantedPlace& wanted, std::size_t step = 1000) {
  PlaceFinder finder(wanted, "fanuc");
  for (std::size_t at = 0; at < kProgram.size(); at += step) {
    if (finder.look(std::string_view(kProgram).substr(at, step))) return finder.place();
  }
  return finder.look_at_end() ? finder.place() : ProgramPlace{.byte = 0, .line = 0};
}

TEST(PlaceFinder, FindsLinesBytesAndNumbersHoweverTheTextIsCut) {
  for (const std::size_t step : {1U, 3U, 1000U}) {
    EXPECT_EQ(find({.line = 4}, step).byte, kProgram.find("N10"));
    EXPECT_EQ(find({.sequence = 20}, step).line, 5U);
    EXPECT_EQ(find({.byte = 7}, step).line, 2U);
    EXPECT_EQ(find({.line = 6}, step).byte, kProgram.find("M30")) << "without a line end";
    EXPECT_EQ(find({.sequence = 30}, step).line, 0U) << "there is none";
  }
}

TEST(HeadScan, NamesWhatTheRestReliesOnAndSendsIt) {
  for (const std::size_t step : {1U, 7U, 1000U}) {
    HeadScan scan("fanuc", find({.line = 5}));
    for (std::size_t at = 0; at < kProgram.size(); at += step) {
      if (!scan.take(std::string_view(kProgram).substr(at, step))) break;
    }
    scan.end();
    EXPECT_EQ(scan.head(HeadChoice::Send).value(), "G21 G90\nT2 M6\n");
    EXPECT_EQ(scan.head(HeadChoice::Set).value(), "");
    const auto asked = scan.head(HeadChoice::Ask);
    ASSERT_FALSE(asked);
    EXPECT_NE(asked.error().what.find("line 5 and what follows rely on G21 (line 2)"),
              std::string::npos)
        << asked.error().what;
  }
}

}  // namespace
}  // namespace dripline::line
