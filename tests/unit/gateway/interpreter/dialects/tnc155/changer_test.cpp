#include "gateway/interpreter/dialects/tnc155/memory/changer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

/// HD-069: the tool that leaves goes into the pocket of the one that comes.
namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

/// `pockets` of tools 1, 2 ...: "3", "S7" of a special one, "" for none.
std::string store(const std::vector<std::string>& pockets, int magazine = 20) {
  std::string text =
      "[control]\ncentral_tool_file = true\nrandom_changer = true\nmagazine_pockets = " +
      std::to_string(magazine) + "\n";
  int number = 0;
  for (std::string pocket : pockets) {
    text += "[[tool]]\nnumber = " + std::to_string(++number) + "\n";
    if (pocket.starts_with('S')) {
      text += "special = true\n";
      pocket.erase(0, 1);
    }
    if (!pocket.empty()) text += "pocket = " + pocket + "\n";
  }
  return text;
}

/// What the run reports, each call's changes and then the whole store.
std::vector<std::string> reports(const std::vector<int>& calls,
                                 const std::vector<std::string>& pockets, int magazine = 20) {
  std::vector<std::string> blocks;
  blocks.reserve(calls.size());
  for (const int tool : calls) blocks.push_back("TOOL CALL " + std::to_string(tool) + " Z S100");
  std::vector<std::string> lines;
  for (const std::string& event : run_blocks(blocks, {store(pockets, magazine), {}}).events) {
    if (event.starts_with("out ")) lines.push_back(event.substr(4));
    if (event.starts_with("! ")) lines.push_back(event);
  }
  return lines;
}

TEST(RandomChanger, PutsTheToolThatLeavesIntoThePocketOfTheOneThatComes) {
  EXPECT_THAT(reports({1, 2, 3}, {"4", "9", "5"}),
              ElementsAre("T1 P0",                      // the spindle was empty
                          "T1 P9", "T2 P0",             // 1 for 2
                          "T2 P5", "T3 P0",             // 2 for 3
                          "T1 P9", "T2 P5", "T3 P0"));  // at the end
}

TEST(RandomChanger, KnowsTheToolThatIsInTheSpindleAtTheStart) {
  EXPECT_THAT(reports({2}, {"0", "9"}), ElementsAre("T1 P9", "T2 P0", "T1 P9", "T2 P0"));
  EXPECT_THAT(reports({1}, {"0", "9"}), ElementsAre("T1 P0", "T2 P9")) << "it is there already";
}

TEST(RandomChanger, LetsASpecialToolKeepItsThreePockets) {
  // 2 goes out for the special tool: 1 is taken, 3 to 5 are the special tool's, 2 is free.
  EXPECT_THAT(reports({2, 3, 1}, {"1", "6", "S4"}),
              ElementsAre("T2 P0", "T2 P2", "T1 P0", "T1 P0", "T2 P2", "T3 SP4"));
  // Nothing but 3 to 5 would be free: the tool has nowhere to go.
  EXPECT_THAT(reports({2, 3}, {"1", "0", "S4", "2", "6"}, 6),
              ElementsAre("! NO FREE POCKET: tool 2 leaves the spindle for tool 3, and all of 1 to "
                          "6 are taken"));
}

TEST(RandomChanger, LeavesToolsWithoutAPocketToTheHand) {
  EXPECT_THAT(reports({1, 2, 1}, {"3", ""}),
              ElementsAre("T1 P0", "T1 P1", "T1 P0", "T1 P0", "T2 P"));
}

TEST(RandomChanger, ChangesNothingForAToolThatIsCalledOff) {
  EXPECT_THAT(reports({1, 0, 1}, {"3"}), ElementsAre("T1 P0", "T1 P0"));
  EXPECT_THAT(
      run_blocks({"TOOL CALL 1 Z S100"},
                 {"[control]\ncentral_tool_file = true\n[[tool]]\nnumber = 1\npocket = 3\n", {}})
          .events,
      ElementsAre("T1 L0 R0", "end 3"))
      << "without a random changer pockets belong to no tool";
}

TEST(RandomChanger, ReportsChangesEvenWhenTheRunEndsInAnAlarm) {
  const auto run = run_blocks({"TOOL CALL 1 Z S100", "TOOL CALL 77 Z S100"}, {store({"3"}), {}});
  EXPECT_THAT(run.events,
              ElementsAre("out T1 P0", "T1 L0 R0", testing::StartsWith("! TOOL DEF MISSING")));
}

TEST(RandomChanger, RefusesAStoreThatDoesNotFitTheMagazine) {
  const auto refused = [](const std::string& setup) {
    MemorySource source("");
    EventSink sink;
    const auto made = (*find_dialect("tnc155"))->make(*parse_setup(setup), source, sink);
    return made ? std::string() : made.error().what;
  };
  EXPECT_EQ(refused(store({"3", "4", "S7", "", "9"})), "");
  EXPECT_EQ(refused(store({"21"})), "tool 1: pocket 21 is not 1 to magazine_pockets, 20");
  EXPECT_EQ(refused(store({"3", "3"})), "tool 2: pocket 3 has tool 1 already");
  EXPECT_EQ(refused(store({"0", "0"})), "tool 2: the spindle (pocket 0) has tool 1 already");
  EXPECT_EQ(refused(store({"S7", "8"})),
            "tool 2: pocket 8 is beside pocket 7 of tool 1: a special tool takes three");
  EXPECT_EQ(refused(store({"8", "S7"})),
            "tool 2: pocket 7 is beside pocket 8 of tool 1: a special tool takes three");
  EXPECT_EQ(refused(store({"S5", "S7"})),
            "tool 2: pocket 7 is beside pocket 5 of tool 1: a special tool takes three");
  EXPECT_EQ(refused(store({"S0"})),
            "tool 1: a special tool keeps its pocket, and pocket 0 is the spindle");
  EXPECT_EQ(refused(store({}, 0)),
            "option magazine_pockets: 0; with random_changer it is 1 to 9999");
  EXPECT_EQ(refused("[control]\nrandom_changer = true\nmagazine_pockets = 4\n"),
            "option random_changer: pockets are those of the tool store: central_tool_file is "
            "false");
}

TEST(RandomChanger, GoesOnFromASnapshot) {
  const std::string text =
      "0 BEGIN PGM 5 MM\n1 TOOL CALL 1 Z S100\n2 TOOL CALL 2 Z S100\n3 END PGM 5 MM\n";
  MemorySource source(text);
  std::vector<std::string> lines;
  struct Lines final : EventSink {
    explicit Lines(std::vector<std::string>& out) : lines(out) {}
    void on_output(const Output& output) override { lines.emplace_back(output.text); }
    std::vector<std::string>& lines;
  } sink(lines);
  const Dialect& dialect = **find_dialect("tnc155");
  const interpreter::Setup setup = *parse_setup(store({"4", "9"}));
  auto first = *dialect.make(setup, source, sink);
  first->step(2);
  ASSERT_THAT(lines, ElementsAre("T1 P0"));
  auto second = *dialect.make(setup, source, sink);
  EXPECT_NE(first->snapshot().digest(), second->snapshot().digest());
  ASSERT_TRUE(second->restore(first->snapshot()));
  EXPECT_EQ(first->snapshot().digest(), second->snapshot().digest());
  second->step(9);
  EXPECT_THAT(lines, ElementsAre("T1 P0", "T1 P9", "T2 P0", "T1 P9", "T2 P0"));
}

TEST(RandomChanger, ItsLinesAreReadBack) {
  for (const char* text : {"T5 P8", "T10 SP20", "T11 P", "T99 P0"}) {
    const auto tool = tnc155::read_pocket_text(text);
    ASSERT_TRUE(tool) << text;
    EXPECT_EQ(tnc155::pocket_text(*tool), text);
  }
  for (const char* text :
       {"", "T", "T5", "T5 8", "T5 P8 L+1", "T5 P-1", "X5 P8", "T5 P8 ", "T300 P1", "T-5 P8"}) {
    EXPECT_FALSE(tnc155::read_pocket_text(text)) << text;
  }
}

}  // namespace
}  // namespace dripline::interpreter
