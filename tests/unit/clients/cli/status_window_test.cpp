#include "clients/cli/server/status_window.hpp"

#include <gtest/gtest.h>

#include "clients/cli/server/machine_text.hpp"

/// What the status window of a control has: what it has itself, as it has it.
namespace dripline::cli {
namespace {

client::Machine idle_tnc() {
  client::Machine machine;
  machine.name = "mill-3";
  machine.connected = true;
  machine.display = client::Display{
      .units = "inch", .x = "radius", .fields = {{"compensation", "tool_length_z", "tool_radius"}}};
  machine.status.emplace().execution = "READY";
  machine.status->modes.emplace().tool_length_z = 25.4;
  machine.status->position = {{"X", 25.4}, {"Y", 0}, {"Z", 0}, {"C", 0}};
  machine.status->coordinates = client::Coordinates{.target = {{"X", 50.8}},
                                                    .distance_to_go = {{"X", 12.7}, {"Y", 0}},
                                                    .following_error = {{{"X", 0.0}}}};
  machine.status->screen = client::Screen{.units = "inch", .position = "distance_to_go"};
  return machine;
}

/// HD-081, HD-082: a TNC shows no fields of other controls, and what its MOD functions choose.
TEST(MachineDetails, ShowWhatTheControlHasAndNothingElse) {
  client::Machine machine = idle_tnc();
  const std::string text = machine_details(machine).render(false);
  for (const char* foreign : {"tool lengths", "work system", "words", "cycle  "})
    EXPECT_EQ(text.find(foreign), std::string::npos) << text;
  for (const char* own : {"tool length ", "1.0000 in\n", "position (DIST)", "X 0.5000 Y 0.0000 in",
                          "reference (REF)", "0.00 in/min"})
    EXPECT_NE(text.find(own), std::string::npos) << own << " in\n" << text;
  EXPECT_EQ(status_line(machine), "mill-3  READY  X 0.5000 Y 0.0000 in  F 0.00 in/min");
  machine.status->screen->position.clear();
  const std::string other = machine_details(machine).render(false);
  EXPECT_EQ(other.find("(REF)"), std::string::npos) << "no other control has these names";
  EXPECT_NE(other.find("X 1.0000 Y 0.0000 Z 0.0000 C 0.000 in"), std::string::npos) << other;
}

TEST(ShownPosition, IsWhatTheOperatorChose) {
  client::MachineStatus status = *idle_tnc().status;
  status.coordinates->program.emplace().position = {{"X", 3}};
  status.coordinates->program->target = {{"X", 4}};
  const std::pair<const char*, double> kChoices[] = {
      {"distance_to_go", 12.7}, {"following_error", 0}, {"actual", 3},
      {"nominal", 4},           {"reference", 25.4},    {"", 25.4}};
  for (const auto& [choice, x] : kChoices) {
    status.screen->position = choice;
    EXPECT_EQ(shown_position(status).at("X"), x) << choice;
  }
  status.coordinates->program.reset();
  status.screen->position = "nominal";
  EXPECT_EQ(shown_position(status).at("X"), 50.8) << "without a program on the machine";
  status.screen->position = "actual";
  EXPECT_EQ(shown_position(status).at("X"), 25.4);
}

/// The position on the machine is not called one of a program's.
TEST(MachineDetails, NameThePositionOnTheMachineAsSuch) {
  client::Machine machine = idle_tnc();
  const auto shows = [&machine](const std::string& choice, const std::string& name) {
    machine.status->screen->position = choice;
    const std::string text = machine_details(machine).render(false);
    return text.find("\n" + name + " ") == std::string::npos ? text : "";
  };
  EXPECT_EQ(shows("actual", "machine position (REF)"), "");
  EXPECT_EQ(shows("nominal", "machine position, where the move ends"), "");
  EXPECT_EQ(shows("reference", "position (REF)"), "");
  machine.status->coordinates->program.emplace().position = {{"X", 3}};
  machine.status->coordinates->program->target = {{"X", 4}};
  EXPECT_EQ(shows("actual", "position (ACTL)"), "");
  EXPECT_EQ(shows("nominal", "position (NOML)"), "");
}

/// Rotation, scale and pole under a TNC's names are a TNC's.
TEST(MachineDetails, ShowTheFieldsOfAFrameWhereTheControlHasThem) {
  client::Machine machine = idle_tnc();
  client::ProgramFrame& frame = machine.status->coordinates->program.emplace();
  frame.scale = {{"X", 1}, {"Y", 1}, {"Z", 1}};
  const std::string own = machine_details(machine).render(false);
  for (const char* field : {"rotation (ROT)", "scale (SCL)", "mirrored", "pole (CC)"})
    EXPECT_NE(own.find(field), std::string::npos) << field << " in\n" << own;
  machine.status->screen->position.clear();
  const std::string plain = machine_details(machine).render(false);
  for (const char* field : {"ROT", "SCL", "(CC)", "rotation", "scale", "mirrored", "pole"})
    EXPECT_EQ(plain.find(field), std::string::npos) << field << " in\n" << plain;
  frame.rotation = 30;
  frame.mirrored = {"X"};
  const std::string turned = machine_details(machine).render(false);
  for (const char* field : {"rotation  ", "30.000 degrees", "mirrored"})
    EXPECT_NE(turned.find(field), std::string::npos) << field << " in\n" << turned;
  EXPECT_EQ(turned.find("(ROT)"), std::string::npos) << turned;
}

/// CEN-203: what DNC FAST shows of a program that was fed.
TEST(RunStatistics, AreShownInTheUnitsOfTheControl) {
  const client::RunStatistics statistics{.motion_seconds = 60,
                                         .distance_mm = 254,
                                         .average_feed_mm_per_min = 254,
                                         .average_block_seconds = 0.25,
                                         .blocks_per_second = 4};
  Details details;
  add_statistics(details, statistics, {.units = "inch"});
  const std::string text = details.render(false);
  for (const char* line :
       {"60.0 s", "10.0000 in", "10.00 in/min", "0.2500 s on average, 4.0 blocks/s"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " in\n" << text;
  Details none;
  add_statistics(none, {}, {});
  EXPECT_EQ(none.render(false).find("average"), std::string::npos) << "without motion";
}

/// HD-083: as text, in the status and while watching.
TEST(MachineDetails, ShowTheBlocksAroundTheExecutingOne) {
  client::Machine machine;
  machine.name = "mill-3";
  machine.connected = true;
  machine.status.emplace().execution = "ACTIVE";
  machine.status->run = "0192aabbccdd";
  machine.status->program = "O0200";
  machine.status->screen = client::Screen{.previous_block = "N1 G0 X1",
                                          .block = "N2 G1 X2 F3",
                                          .next_block = "N3 X4",
                                          .further_block = "M30"};
  const std::string text = machine_details(machine).render(false);
  for (const char* line :
       {"previous block", "N1 G0 X1", "N2 G1 X2 F3", "next block", "N3 X4", "M30"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " in\n" << text;
  EXPECT_NE(status_line(machine).find("N2 G1 X2 F3"), std::string::npos);
  EXPECT_EQ(run_lines({}, &*machine.status).at(2), "N2 G1 X2 F3");
}

}  // namespace
}  // namespace dripline::cli
