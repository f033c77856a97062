#include "gateway/app/panel/panel_command.hpp"

#include <gtest/gtest.h>

namespace dripline::gateway {
namespace {

using Verb = PanelCommand::Verb;

struct Understood {
  const char* name;
  const char* line;
  PanelCommand command;
};
class PanelLine : public testing::TestWithParam<Understood> {};

TEST_P(PanelLine, IsUnderstood) {
  const auto command = parse_panel_command(GetParam().line);
  ASSERT_TRUE(command) << command.error().what;
  EXPECT_EQ(*command, GetParam().command);
}

INSTANTIATE_TEST_SUITE_P(
    , PanelLine,
    testing::Values(Understood{"start", "cycle-start", {Verb::CycleStart, "", 0}},
                    Understood{"enable", "remote-enable on", {Verb::RemoteEnable, "", 1}},
                    Understood{"disable", "remote-enable off", {Verb::RemoteEnable, "", 0}},
                    Understood{"stop_is_pressed", "emergency-stop", {Verb::EmergencyStop, "", 1}},
                    Understood{"release", "emergency-stop off", {Verb::EmergencyStop, "", 0}},
                    Understood{"answer_keeps_blanks", "answer 1  2", {Verb::Answer, "1  2", 0}},
                    Understood{
                        "switched", "switch single_block on", {Verb::Switch, "single_block", 1}},
                    Understood{"percent", "feed-override 85.5", {Verb::FeedOverride, "", 0.855}},
                    Understood{"clicks", "handwheel 3", {Verb::Handwheel, "", 3}}),
    [](const auto& i) { return std::string{i.param.name}; });

struct RefusedLine {
  const char* name;
  std::string line;
  const char* reason;
};
class WrongPanelLine : public testing::TestWithParam<RefusedLine> {};

TEST_P(WrongPanelLine, IsRefusedWithAReason) {
  const auto command = parse_panel_command(GetParam().line);
  ASSERT_FALSE(command);
  EXPECT_NE(command.error().what.find(GetParam().reason), std::string::npos)
      << command.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , WrongPanelLine,
    testing::Values(RefusedLine{"nothing", "", "'' is none of status, cycle-start"},
                    RefusedLine{"other", "start", "'start' is none of"},
                    RefusedLine{"no_state", "remote-enable", "'' is neither on nor off"},
                    RefusedLine{"more", "hold now", "'now': hold takes no argument"},
                    RefusedLine{"negative", "feed-override -1", "'-1' is not a number"},
                    RefusedLine{"not_a_number", "feed-override nan", "'nan' is not a number"},
                    RefusedLine{"control_character", "answer a\tb", "one line of UTF-8"},
                    RefusedLine{"broken_text", "answer \xC3", "one line of UTF-8"},
                    RefusedLine{"long_one", "answer " + std::string(250, 'x'), "at most 256"}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline::gateway
