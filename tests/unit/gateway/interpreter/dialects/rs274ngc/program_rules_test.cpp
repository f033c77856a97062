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

struct StartupCase {
  std::string name;
  std::string code;
  std::string why;  ///< of the refusal; empty: it is taken
};
void PrintTo(const StartupCase& shown, std::ostream* out) {
  *out << shown.name;
}
class Rs274StartupCode : public testing::TestWithParam<StartupCase> {};

TEST_P(Rs274StartupCode, SetsModesThatM2LeavesOrIsRefused) {
  const StartupCase& given = GetParam();
  for (const std::string profile : {"linuxcnc", "nist"}) {
    const auto setup = parse_setup("[control]\nprofile = \"" + profile + "\"\nstartup_code = \"" +
                                   given.code + "\"\n");
    ASSERT_TRUE(setup) << setup.error().what;
    MemorySource source("M2\n");
    EventLog log;
    const auto made = (*find_dialect("rs274ngc"))->make(*setup, source, log);
    EXPECT_EQ(made.has_value(), given.why.empty()) << (made ? "" : made.error().what);
    if (!made) {
      EXPECT_THAT(made.error().what, HasSubstr(given.why));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Rs274StartupCode,
    testing::Values(
        StartupCase{"of_stepconf", "G21 G40 G49 G80 G90 G92.1 G94 G97 M52P1", ""},
        StartupCase{"of_pncconf", "G20 G40 G90 G94 G97 G64", ""},
        StartupCase{"of_a_mill", "F10 S300 G20 G17 G40 G43H0 G54 G64 P0.001 G80 G94 M5 M9", ""},
        StartupCase{"of_a_lathe", "G18 G21 G40 G49 G54 G80 G90 G94 G8 M9 M5 G64 P0.005", ""},
        StartupCase{"of_a_simulation", "G0 G21 G54 (debug, startup)", ""},
        StartupCase{"g91", "G91", "G91 would be in force until the first M2 only"},
        StartupCase{"g93", "G93", "G93 would"}, StartupCase{"g95", "G95", "G95 would"},
        StartupCase{"g55", "G55", "a work system other than G54 would"},
        StartupCase{"g41", "G41 D0", "G41 and G42 would"},
        StartupCase{"g96", "G96 D1000 S100", "G96 would"},
        StartupCase{"m3", "M3 S100", "a spindle that turns would"},
        StartupCase{"m8", "M8", "coolant would"},
        StartupCase{"m49", "M49", "an inhibited override"},
        StartupCase{"tilted_plane", "G17.1", "does more than set modes"},
        StartupCase{"offset", "G10 L2 P1 X1", "does more than set modes"},
        StartupCase{"g92", "G92 X1", "does more than set modes"},
        StartupCase{"length", "G43.1 Z5", "does more than set modes"},
        StartupCase{"tool", "M61 Q3", "does more than set modes"},
        StartupCase{"parameter", "#100 = 5", "does more than set modes"},
        StartupCase{"name", "#<_depth> = 5", "does more than set modes"},
        StartupCase{"move", "G0 X1", "does more than set modes"},
        StartupCase{"call", "o<begin> call", "NGC0"}, StartupCase{"question", "M66 P1 L0", "asks"},
        StartupCase{"error", "G21 G20", "NGC0"}, StartupCase{"restart", "M99", "NGC0"}),
    [](const auto& each) { return each.param.name; });

TEST(Rs274Options, StartupCodeOfNistHasNoDiametersAndAbsoluteCenters) {
  const auto setup = parse_setup("[control]\nstartup_code = \"G7\"\n");
  MemorySource source("M2\n");
  EventLog log;
  const auto made = (*find_dialect("rs274ngc"))->make(*setup, source, log);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().what, HasSubstr("nist has neither G7 nor G90.1"));
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
