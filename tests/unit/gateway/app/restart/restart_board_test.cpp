// Approaches on a board of the Grbl class, whose axes are at the program's position + the length of
// the tool: no rapid move leads across where the program has cut, and the tool is out before
// another one is put in.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "tests/unit/gateway/app/restart/board_shop.hpp"

namespace dripline::gateway {
namespace {

using Json = nlohmann::json;

constexpr std::array<double, 4> kLengths{0, 60, 10, 35};  ///< of no tool, T1, T2 and T3

std::string tools() {
  std::string text = "[machine]\nmax_rpm = 10000\n";
  for (std::size_t tool = 1; tool < kLengths.size(); ++tool)
    text += fmt::format("[[tool]]\nnumber = {}\nlength = {:.1f}\n", tool, kLengths[tool]);
  return text;
}

double length_of(std::optional<int> tool) {
  return kLengths.at(static_cast<std::size_t>(tool.value_or(0)));
}

constexpr const char* kTwoTools =
    "O0107\nG21 G90 G94 G17 G40 G49 G54\nT1 M06\nG43 H1\nM03 S8000\nG00 Z20.\nG00 X5. Y5.\nG01 Z1. "
    "F900\nX25.\nG00 Z21.\nT2 M06\nG43 H2\nM03 S8000\nG00 Z20.\nG01 Z1. F900\nY25.\nX0\nG00 Z20.\n"
    "M30\n";

TEST(BoardRestart, RetractsTheToolBeforeAnotherOneIsPutIn) {
  BoardShop shop(tools(), {});
  const std::string run = shop.start_run(kTwoTools);
  ASSERT_FALSE(run.empty()) << shop.answer.reason;
  ASSERT_TRUE(shop.run_on([&] { return shop.tool == 2 && shop.board.position()[1] > 15; }));
  shop.abort();
  ASSERT_NEAR(shop.board.position()[2], 11, 1e-3);
  const auto report = shop.restart(run, "L9");
  ASSERT_TRUE(report.is_object()) << shop.answer.reason << shop.ended().reason;
  EXPECT_EQ(report["position"]["Z"], 1) << "as the tool counts it that is there";
  const Json& steps = report["approach"];
  EXPECT_EQ(steps[0]["to"], (Json{{"Z", 71}})) << steps << "81 of the axis, where the first was";
  EXPECT_EQ(steps[1], (Json{{"move", "change_tool"}, {"tool", 1}})) << steps;
  EXPECT_EQ(steps[2]["to"], (Json{{"X", 5}, {"Y", 5}})) << steps;
  EXPECT_EQ(steps.back()["to"], (Json{{"Z", 1}})) << steps;
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Resume)).accepted);
  ASSERT_FALSE(shop.run_on([] { return false; }));
  EXPECT_EQ(shop.ended().outcome, dds::RunOutcome::Completed);
  ASSERT_EQ(shop.stops.size(), 2u);
  EXPECT_NEAR(shop.stops[0].z, 81, 1e-3);
  EXPECT_EQ(shop.stops[0].out, 2);
  EXPECT_EQ(shop.stops[0].in, 1);
}

/// The board is where the program's first block would bring it.
TEST(BoardRestart, GoesOverThePlaceWhereTheRunBegan) {
  BoardShop shop("units = \"mm\"\n", {.start = {0, 0, 20, 0}});
  const std::string run = shop.start_run(
      "O0105\nG21 G90 G94 G17 G40 G49 G54\nM03 S1000\nG00 Z20.\nG01 Z1. F900\nX20.\nY20.\nX0\n"
      "G00 Z20.\nM30\n");
  ASSERT_FALSE(run.empty()) << shop.answer.reason;
  ASSERT_TRUE(shop.run_on([&] { return shop.board.position()[1] > 10; }));
  shop.abort();
  const auto report = shop.restart(run, "L6");
  ASSERT_TRUE(report.is_object()) << shop.answer.reason;
  EXPECT_EQ(report["approach"][0]["to"], (Json{{"Z", 20}})) << report["approach"];
}

/// Sections with a tool each. All cuts are below the heights at which tools are positioned.
class Program {
 public:
  static constexpr double kHighestCut = 12;

  explicit Program(std::mt19937& random) : random_(random) {
    text = "O0300\nG21 G90 G94 G17 G40 G49 G54\n";
    int former = 0;
    const int sections = number(1, 3);
    for (int i = 0; i < sections; ++i) {
      int tool = number(1, 3);
      if (tool == former) tool = tool % 3 + 1;
      add_section(former = tool, 20 + 3 * i);
      if (i == 0) first_height = 20 + length_of(tool);
    }
    text += "M30\n";
  }
  std::string text;
  double first_height = 0;  ///< of the axis, where the first section is positioned

 private:
  int number(int from, int to) { return std::uniform_int_distribution<>(from, to)(random_); }
  void add_section(int tool, int height) {
    text += fmt::format("T{0} M06\nG43 H{0}\nM03 S8000\nG00 Z{1}.\nX{2}. Y{3}.\nG01 Z{4}. F3000\n",
                        tool, height, number(0, 20), number(0, 20), number(-9, 12));
    const int cuts = number(1, 4);
    for (int i = 0; i < cuts; ++i) add_cut();
    text += fmt::format("G17 G00 Z{}.\n", height);
  }
  void add_cut() {
    switch (number(0, 4)) {
      case 0:
        // Over a hump of radius 6, from a depth at which its top is still a cut.
        text += "G01 Z5.\nG91 G18 G03 X12. Z0 I6. K0\nG90 G17\n";
        break;
      case 1:
        text += "G01 Z6.\nG91 G19 G02 Y8. Z0 J4. K0\nG90 G17\n";
        break;
      case 2:
        text += fmt::format("G01 Z{}.\n", number(-9, 12));
        break;
      default:
        text += fmt::format("G01 X{}. Y{}.\n", number(0, 30), number(0, 30));
    }
  }
  std::mt19937& random_;
};

class RandomApproach {
 public:
  explicit RandomApproach(unsigned seed) : random_(seed) {}
  int approaches = 0, changes = 0, refused = 0;

  void attempt() {
    const Program program(random_);
    SCOPED_TRACE(program.text);
    const bool is_there = number(0, 1) == 1;
    BoardShop shop(tools(), {.start = {0, 0, is_there ? program.first_height : 70, 0}});
    const std::string run = shop.start_run(program.text);
    ASSERT_FALSE(run.empty()) << shop.answer.reason;
    int rounds = number(3, 150);
    if (!shop.run_on([&] { return shop.tool && --rounds < 0; })) return;  // it has ended
    shop.abort();
    const int lines = static_cast<int>(std::ranges::count(program.text, '\n'));
    const std::string at = number(0, 3) == 0 ? "executed" : fmt::format("L{}", number(5, lines));
    SCOPED_TRACE(at);
    const auto report = shop.restart(run, at);
    if (!report.is_object()) {
      ++refused;
      return;
    }
    SCOPED_TRACE(report["approach"].dump());
    const bool begins_low = shop.board.position()[2] - length_of(shop.tool) < Program::kHighestCut;
    ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Resume)).accepted);
    (void)shop.run_on([] { return false; });
    check(shop, begins_low);
    ++approaches;
    changes += !shop.stops.empty() && shop.stops.front().in != shop.stops.front().out;
  }

 private:
  int number(int from, int to) { return std::uniform_int_distribution<>(from, to)(random_); }
  static void check(const BoardShop& shop, bool begins_low) {
    EXPECT_FALSE(shop.moves.empty());
    if (!shop.moves.empty() && begins_low && shop.moves.front().is_rapid) {
      EXPECT_FALSE(shop.moves.front().goes_across()) << "the tool is in the part";
    }
    for (const BoardShop::Move& move : shop.moves) {
      if (!move.is_rapid || !move.goes_across()) continue;
      EXPECT_GE(std::min(move.from[2], move.to[2]) - length_of(move.tool) + 1e-3,
                Program::kHighestCut)
          << "to X" << move.to[0] << " Y" << move.to[1] << " Z" << move.to[2];
    }
    for (const BoardShop::ToolStop& stop : shop.stops) {
      if (stop.out == stop.in) continue;
      EXPECT_GE(stop.z - length_of(stop.out) + 1e-3, Program::kHighestCut)
          << "to tool " << stop.in.value_or(0);
    }
  }
  std::mt19937 random_;
};

TEST(BoardRestart, LeadsAcrossAboveAllThatTheProgramHasCut) {
  const char* wanted = std::getenv("DRIPLINE_RESTARTS");
  const int attempts = wanted != nullptr ? 30 * std::atoi(wanted) : 30;
  RandomApproach approach(20'261'130);
  for (int i = 0; i < attempts && !testing::Test::HasFailure(); ++i) approach.attempt();
  std::printf("%d approaches, %d with another tool, %d refused\n", approach.approaches,
              approach.changes, approach.refused);
  EXPECT_GT(approach.approaches, attempts / 4);
  EXPECT_GT(approach.changes, 0);
}

}  // namespace
}  // namespace dripline::gateway
