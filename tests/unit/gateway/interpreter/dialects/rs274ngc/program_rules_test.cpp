#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/rs274ngc/control_run.hpp"

/// Rows: NGC-001, NGC-002, NGC-014, NGC-088
namespace dripline::interpreter::rs274ngc {
namespace {

using testing::HasSubstr;

constexpr std::string_view kLater = "[control]\nprofile = \"linuxcnc\"\n";

struct RefusalCase {
  std::string name;
  std::string text;
  std::string id;
  bool is_later = false;
};

class Rs274Refusal : public testing::TestWithParam<RefusalCase> {};

TEST_P(Rs274Refusal, NamesTheErrorAndStaysSilentAfterIt) {
  ControlRun run(GetParam().text, GetParam().is_later ? kLater : "");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_THAT(run.last(), HasSubstr(GetParam().id));
  const std::size_t events = run.log().lines().size();
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_EQ(run.log().lines().size(), events);
}

INSTANTIATE_TEST_SUITE_P(
    , Rs274Refusal,
    testing::Values(
        RefusalCase{"nothing", "", "NGC0116"},
        RefusalCase{"second_percent", "%\nG0 X1\n", "NGC0115"},
        RefusalCase{"percent_inside", "G0 X1\n%\n", "NGC0100"},
        RefusalCase{"text_after_percent", "% G0\nM2\n", "NGC0100"},
        RefusalCase{"nul", std::string("G0 \0X1\n", 7), "NGC0100"},
        RefusalCase{"above_127", "G0 X1 \xE4\n", "NGC0100"},
        RefusalCase{"letter_alone", "G0 X\n", "NGC0104"},
        RefusalCase{"fifty_one_settings",
                    [] {
                      std::string text;
                      for (int i = 1; i <= 51; ++i) text += "#" + std::to_string(i) + "=1";
                      return text + "\n";
                    }(),
                    "NGC0114"},
        RefusalCase{"index_with_fraction", "#1.5=2\n", "NGC0108"},
        RefusalCase{"brackets_too_deep", "G0 X" + std::string(100, '['), "NGC0118"},
        RefusalCase{"g_fraction", "G1.25 X1\n", "NGC0150"},
        RefusalCase{"negative_t", "T-1\n", "NGC0197"},
        RefusalCase{"recursion", "o1 sub\no1 call\no1 endsub\no1 call\nM2\n", "NGC0296", true},
        RefusalCase{"endsub_without_call", "o1 endsub\n", "NGC0293", true},
        RefusalCase{"sub_in_sub_twice", "o1 sub\no1 endsub\no1 sub\no1 endsub\nM2\n", "NGC0294",
                    true},
        RefusalCase{"sub_in_sub", "o1 sub\no2 sub\no2 endsub\no1 endsub\nM2\n", "NGC0295", true},
        RefusalCase{"while_without_condition", "o1 while\no1 endwhile\n", "NGC0303", true},
        RefusalCase{"words_after_oword", "o1 repeat [2] G0 X1\n", "NGC0298", true},
        RefusalCase{"thirty_one_arguments",
                    [] {
                      std::string text = "o1 sub\no1 endsub\no1 call";
                      for (int i = 0; i < 31; ++i) text += "[1]";
                      return text + "\n";
                    }(),
                    "NGC0297", true},
        RefusalCase{"restarts_for_ever", "G0 X1\nM99\n", "NGC0300", true},
        RefusalCase{"continue_in_repeat", "o1 repeat [2]\no1 continue\no1 endrepeat\n", "NGC0293",
                    true},
        RefusalCase{"strokes", "G21 F1 G0 Z5\nG83 X1 Z-5 R1 Q0.0001\nM2\n", "NGC0350"}),
    [](const auto& each) { return each.param.name; });

TEST(Rs274Options, UnknownOnesAndForeignRecordsAreNamed) {
  for (const std::string_view text :
       {"[control]\nprofil = \"nist\"\n", "[control]\nprofile = \"mach3\"\n",
        "[[offset]]\nname = \"G54.1\"\nX = 1.0\n", "[[variable]]\nname = \"#6000\"\nvalue = 1.0\n",
        "[[variable]]\nname = \"#5220\"\nvalue = 12.0\n"}) {
    const auto setup = parse_setup(text);
    ASSERT_TRUE(setup) << text;
    MemorySource source("M2\n");
    EventLog log;
    const auto made = (*find_dialect("rs274ngc"))->make(*setup, source, log);
    EXPECT_FALSE(made) << text;
  }
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
