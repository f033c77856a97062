#include "gateway/app/panel/kept_emergency_stop.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <fstream>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// The emergency stop outlives the gateway. Of a control on a line: serial/kept_stop_test.cpp.
namespace dripline::gateway {
namespace {

using dds::CommandAction;

struct FileFacts {
  ::ino_t node = 0;
  std::int64_t size = 0;
  friend bool operator==(const FileFacts&, const FileFacts&) = default;
};

FileFacts facts_of(const std::filesystem::path& file) {
  struct stat facts {};
  EXPECT_EQ(::stat(file.c_str(), &facts), 0);
  return {facts.st_ino, facts.st_size};
}

TEST(KeptEmergencyStop, IsAsItWasLeft) {
  test_support::TemporaryFolder folder;
  const auto file = folder.path() / "emergency-stop";
  EXPECT_FALSE(KeptEmergencyStop(file).is_pressed()) << "never pressed";
  ASSERT_TRUE(KeptEmergencyStop(file).press(false));
  EXPECT_TRUE(KeptEmergencyStop(file).is_pressed());
  EXPECT_FALSE(KeptEmergencyStop(file).is_pressed_at_panel());
  ASSERT_TRUE(KeptEmergencyStop(file).press(true));
  EXPECT_TRUE(KeptEmergencyStop(file).is_pressed_at_panel());
  ASSERT_TRUE(KeptEmergencyStop(file).press(false));
  EXPECT_TRUE(KeptEmergencyStop(file).is_pressed_at_panel()) << "the panel's is released there";
  ASSERT_TRUE(KeptEmergencyStop(file).release());
  EXPECT_FALSE(KeptEmergencyStop(file).is_pressed());
}

TEST(KeptEmergencyStop, NeedsNoRoomOnAFullDisk) {
  test_support::TemporaryFolder folder;
  const auto file = folder.path() / "emergency-stop";
  KeptEmergencyStop stop(file);
  const FileFacts before = facts_of(file);
  ASSERT_TRUE(stop.press(true));
  EXPECT_EQ(facts_of(file), before) << "in place, with its size";
  ASSERT_TRUE(stop.release());
  EXPECT_EQ(facts_of(file), before);
}

TEST(KeptEmergencyStop, IsPressedWhereItsFileCannotBeUnderstood) {
  test_support::TemporaryFolder folder;
  const auto file = folder.path() / "emergency-stop";
  std::ofstream(file) << "relea";
  EXPECT_TRUE(KeptEmergencyStop(file).is_pressed_at_panel());
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  EXPECT_TRUE(KeptEmergencyStop(file).is_pressed_at_panel());
}

dds::CommandResult release_from_network(GatewayFixture& fixture) {
  dds::Command command = fixture.command(CommandAction::Switch);
  command.argument = "emergency_stop";
  return fixture.send(command);
}

TEST(KeptEmergencyStop, PressedAtThePanelIsReleasedThereInTheNextLifeToo) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X4\nEND\n");
  ASSERT_EQ(fixture.panel("emergency-stop on"), "ok");
  for (const int life : {1, 2}) {
    fixture.restart_gateway();
    EXPECT_NE(fixture.panel("status").find("emergency_stop=pressed"), std::string::npos) << life;
    EXPECT_FALSE(fixture.start("O1").accepted) << life;
    EXPECT_FALSE(release_from_network(fixture).accepted) << life;
  }
  ASSERT_EQ(fixture.panel("emergency-stop off"), "ok");
  fixture.restart_gateway();
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Completed);
}

TEST(KeptEmergencyStop, PressedFromTheNetworkIsReleasedFromThere) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X4\nEND\n");
  dds::Command press = fixture.command(CommandAction::Switch);
  press.argument = "emergency_stop";
  press.value = 1;
  ASSERT_TRUE(fixture.send(press).accepted);
  fixture.restart_gateway();
  EXPECT_FALSE(fixture.start("O1").accepted);
  ASSERT_TRUE(release_from_network(fixture).accepted);
  fixture.restart_gateway();
  EXPECT_TRUE(fixture.start("O1").accepted);
}

TEST(KeptEmergencyStop, IsInForceWhereItCannotBeKeptAndSaysSo) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X400\nX0\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->feed_mm_per_min > 0; }));
  const auto file = fixture.folder() / "emergency-stop";
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  const std::string answer = fixture.panel("emergency-stop on");
  EXPECT_TRUE(answer.starts_with("ok pressed and in force, but it does not outlive")) << answer;
  EXPECT_TRUE(fixture.run_until([&] { return fixture.status->feed_mm_per_min == 0; }));
  EXPECT_FALSE(fixture.start("O1").accepted);
  std::filesystem::remove(file);
  EXPECT_EQ(fixture.panel("emergency-stop on"), "ok") << "pressed again, with room";
  fixture.restart_gateway();
  EXPECT_NE(fixture.panel("status").find("emergency_stop=pressed"), std::string::npos);
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  const std::string released = fixture.panel("emergency-stop off");
  EXPECT_TRUE(released.starts_with("ok released, but the gateway's next start")) << released;
}

}  // namespace
}  // namespace dripline::gateway
