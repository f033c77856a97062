#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// What is done at the panel, and starts, while records cannot be written.
namespace dripline::gateway {
namespace {

using dds::RecordKind;

constexpr std::uint64_t kSmallDisk = 160 * 1024;

std::size_t enables_on_record(const GatewayFixture& fixture) {
  return static_cast<std::size_t>(
      std::ranges::count_if(fixture.records, [](const dds::Record& record) {
        return record.text.find("remote enable") != std::string::npos;
      }));
}

TEST(PanelOnAFullDisk, IsOnRecordBeforeTheNextStart) {
  GatewayFixture fixture("1x");
  fixture.outbox_bytes = kSmallDisk;
  fixture.acknowledges = false;
  fixture.make_attended();
  fixture.push("O1", "X1\nEND\n");
  std::size_t done = 0;
  std::string answer = "ok";
  for (; answer == "ok" && done < 20'000; ++done)
    answer = fixture.panel(done % 2 == 0 ? "remote-enable on" : "remote-enable off");
  ASSERT_TRUE(answer.starts_with("ok done, but not on record yet")) << answer;
  const auto refused = fixture.start("O1");
  EXPECT_FALSE(refused.accepted);
  EXPECT_NE(refused.reason.find("what was done before cannot be kept yet"), std::string::npos)
      << refused.reason;
  fixture.acknowledges = true;
  ASSERT_TRUE(fixture.run_until([&] { return fixture.start("O1").accepted; }));
  EXPECT_TRUE(fixture.run_until([&] { return enables_on_record(fixture) == done; }))
      << enables_on_record(fixture) << " of " << done;
}

TEST(PanelOnAFullDisk, AStartThatCannotBeKeptLeavesNoRun) {
  GatewayFixture fixture("1x");
  fixture.outbox_bytes = kSmallDisk;
  fixture.acknowledges = false;
  fixture.make_attended();
  fixture.push("O1", "X1\nEND\n");
  dds::CommandResult result;
  for (int i = 0; i < 2000; ++i) {
    result = fixture.start("O1");
    if (!result.accepted) break;
    fixture.panel("abort");
    fixture.run_until([&] { return fixture.status->run.empty(); });
  }
  ASSERT_NE(result.reason.find("the start cannot be kept"), std::string::npos) << result.reason;
  fixture.acknowledges = true;
  ASSERT_TRUE(fixture.run_until([&] { return fixture.panel("remote-enable on") == "ok"; }));
  ASSERT_TRUE(fixture.run_until([&] { return enables_on_record(fixture) == 1; }));
  EXPECT_EQ(fixture.records.back().run, "") << "there is none";
}

}  // namespace
}  // namespace dripline::gateway
