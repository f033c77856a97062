#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"

/// A start at an event, and files with another form of head. Rows: PT-06, PT-42
namespace dripline::interpreter {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> events_of(const std::string& text, std::string_view setup = "") {
  MemorySource source(text);
  EventLog log;
  auto made =
      (*find_dialect("prototrak-plus"))->make(*parse_setup(setup, Units::Inch), source, log);
  EXPECT_TRUE(made) << made.error().what;
  while (made && (*made)->step(100) == StepState::Ran) {
  }
  std::vector<std::string> lines;
  for (const auto& line : log.lines())
    if (!line.starts_with("block ") && !line.starts_with("program ")) lines.push_back(line);
  return lines;
}

constexpr std::string_view kProgram =
    "PN1 G20 ;\nG100 X1.A Y1.A T1 ;\nG100 X2.A Y1.A ;\n"
    "G101 XB2.A YB1.A XE4.A YE1.A TC0 D0.5 F10.0 CR- ;\n%\n";

// What an event needs is in it, whatever came before; the axes go there when the operator has seen
// it.
TEST(StartEvent, ExecutesNothingBeforeIt) {
  EXPECT_THAT(events_of(std::string(kProgram),
                        "position = { X = 5.0, Y = 5.0 }\n[control]\nstart_at = \"N3\"\n"),
              ElementsAre(HasSubstr("start at event 3"), StartsWith("stop "), StartsWith("tool "),
                          StartsWith("stop "), HasSubstr("X50.8 Y25.4"), StartsWith("stop "),
                          HasSubstr("X101.6 Y25.4"), StartsWith("stop "), StartsWith("end ")));
}

TEST(StartEvent, IsRefusedWhereThereIsNone) {
  EXPECT_THAT(events_of(std::string(kProgram), "[control]\nstart_at = \"4\"\n"),
              ElementsAre(HasSubstr("PTK0113")));
  for (const char* place : {"N0", "N256", "L3", "T1", "N1x"}) {
    MemorySource source(kProgram);
    EventSink sink;
    const auto setup = parse_setup(std::string("[control]\nstart_at = \"") + place + "\"\n");
    EXPECT_FALSE((*find_dialect("prototrak-plus"))->make(*setup, source, sink)) << place;
  }
}

/// A square of connected cuts from the left, and a cut on the centerline that follows.
constexpr std::string_view kChain =
    "PN1 G21 ;\nG100 X10.A Y10.A T1 ;\n"
    "G101 XB10.A YB10.A XE30.A YE10.A TC2 D2.0 F100 CR0 ;\n"
    "G101 XB30.A YB10.A XE30.A YE40.A CR0 ;\n"
    "G101 XB30.A YB40.A XE10.A YE40.A CR- ;\n"
    "G101 XB10.A YB40.A XE10.A YE10.A TC0 CR- ;\n%\n";

// The join of two cuts comes from both: without the first the tool would be in its edge.
TEST(StartEvent, IsRefusedWithinAChainBesideAnEdge) {
  for (const char* event : {"3", "4"}) {
    const std::string setup = std::string("[control]\nstart_at = \"") + event + "\"\n";
    EXPECT_THAT(events_of(std::string(kChain), setup),
                ElementsAre(AllOf(HasSubstr("PTK0114"), HasSubstr("begin at event 2"))))
        << event;
  }
}

// The first of a chain, and a cut after one.
TEST(StartEvent, IsWhereNoJoinIsLost) {
  EXPECT_THAT(events_of(std::string(kChain), "[control]\nwaits = false\nstart_at = \"2\"\n"),
              ElementsAre(HasSubstr("start at event 2"), StartsWith("stop "), StartsWith("tool "),
                          HasSubstr("X10 Y11"), HasSubstr("X29 Y11"), HasSubstr("X29 Y39"),
                          HasSubstr("X10 Y39"), HasSubstr("X10 Y40"), HasSubstr("X10 Y10"),
                          StartsWith("end ")));
  EXPECT_THAT(events_of(std::string(kChain), "[control]\nwaits = false\nstart_at = \"5\"\n"),
              ElementsAre(HasSubstr("start at event 5"), StartsWith("stop "), StartsWith("tool "),
                          HasSubstr("X10 Y40"), HasSubstr("X10 Y10"), StartsWith("end ")));
}

// Cuts on the centerline without a conrad between them end where they are programmed.
TEST(StartEvent, IsAnyOfAChainOnTheCenterline) {
  EXPECT_THAT(events_of("PN1 G21 ;\nG101 XB10.A YB10.A XE30.A YE10.A TC0 D2.0 F100 T1 CR0 ;\n"
                        "G101 XB30.A YB10.A XE30.A YE40.A CR- ;\n%\n",
                        "[control]\nwaits = false\nstart_at = \"2\"\n"),
              ElementsAre(HasSubstr("start at event 2"), StartsWith("stop "), StartsWith("tool "),
                          HasSubstr("X30 Y10"), HasSubstr("X30 Y40"), StartsWith("end ")));
}

// CAM systems write the % alone in its line; the header with the units must not pass for a title.
TEST(HeadAfterPercent, HasTheUnits) {
  for (const char* head : {"%\nPN12 G21 ;\n", "%PN12 G21 ;\n", "%:A TITLE ;\nPN12 G21 ;\n",
                           "%\n:A TITLE ;\nPN12 G21 ;\n", "%\n(A COMMENT;)\nPN12 G21 ;\n"}) {
    EXPECT_THAT(events_of(std::string(head) + "G100 X10.A Y20.A T1 ;\n%\n"),
                testing::Contains(HasSubstr("X10 Y20")))
        << head;
  }
}

}  // namespace
}  // namespace dripline::interpreter
