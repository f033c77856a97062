#include "network.hpp"

namespace dripline::dds::test {
namespace {

class Endpoint : public Network {};

TEST_F(Endpoint, DeliversEveryKindOfMessageUnchanged) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  EXPECT_EQ(server->announces.take(), announce("lathe-1"));
  EXPECT_EQ(gateway->server.take(), true);
  EXPECT_TRUE(gateway->endpoint->is_connected());

  Status status;
  status.machine = "lathe-1";
  status.time = at(1'700'000'000'123'456);
  status.execution = Execution::Waiting;
  status.mode = ControllerMode::ManualDataInput;
  status.run = "run-1";
  status.program = "part 7.nc";
  status.sent = 1;
  status.accepted = 2;
  status.executed = 3;
  status.total_bytes = 4;
  status.offset = 5;
  status.line = 6;
  status.sequence = 70;
  status.position = {1.5, 0, -2.25, 0, 0, 0, 0, 0, 9};
  status.axes = 0b100000101;
  status.feed_mm_per_min = 120.5;
  status.spindle_rpm = 1500;
  status.feed_override = 0.8;
  status.rapid_override = 0.5;
  status.spindle_override = 1.1;
  status.buffered_seconds = 2.5;
  status.single_block = true;
  status.message = "Werkzeug prüfen";
  status.outbox = 9;
  status.modes = ActiveModes{.motion = MotionKind::Clockwise,
                             .compensation = CompensationSide::Right,
                             .is_inch = true,
                             .is_incremental = true,
                             .feed_unit = FeedUnit::PerRevolution,
                             .feed = 0.25,
                             .is_feed_limited = true,
                             .tool = 3,
                             .next_tool = 4,
                             .tool_offset = 13,
                             .tool_length_x = 1.5,
                             .tool_length_z = -2.5,
                             .tool_radius = 0.8,
                             .work_system = "G54.1 P7",
                             .cycle = "rough turning",
                             .dwell_seconds = 0.5,
                             .is_surface_speed = true,
                             .spindle_speed = 120'000,
                             .spindle_load = 0.5,
                             .flood = true,
                             .mist = true,
                             .tool_axis = 2,
                             .spindle = SpindleState::Counterclockwise};
  status.coordinates = Coordinates{
      .target = {1, 2, 3, 4, 5, 6, 7, 8, 9},
      .following_error = std::array<double, 9>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
      .program = ProgramFrame{.position = {9, 8, 7, 6, 5, 4, 3, 2, 1},
                              .target = {-1, -2, -3, -4, -5, -6, -7, -8, -9},
                              .datum = {10, 20, 30, 40, 50, 60, 70, 80, 90},
                              .shift = {11, 21, 31, 41, 51, 61, 71, 81, 91},
                              .rotation = 30,
                              .basic_rotation = 2.5,
                              .scale = {0.5, 1, 2},
                              .mirrored = 0b101,
                              .pole_axes = 0b011,
                              .pole = {3, 4, 5}}};
  status.emergency_stop = true;
  status.steady = 81'000'000us;
  status.remote_enable = RemoteEnable::NotGiven;
  status.waits_for = WaitsFor::CycleStart;
  ASSERT_TRUE(gateway->endpoint->write(status));
  EXPECT_EQ(server->statuses.take(), status);

  ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 1)));
  EXPECT_EQ(server->records.take(), record("lathe-1", 1));

  const RecordAck ack{"lathe-1", 7, 1};
  ASSERT_TRUE(server->endpoint->write(ack));
  EXPECT_EQ(gateway->acks.take(), ack);

  Command command;
  command.machine = "lathe-1";
  command.id = "order-1";
  command.expires = at(1'700'000'005'000'000);
  command.action = CommandAction::Start;
  command.run = "run-1";
  command.program = "part 7.nc";
  command.revision = std::string(64, 'a');
  command.size = 1000;
  command.control = "centurion";
  command.argument = "ja";
  command.value = 0.5;
  command.server = 4711;
  command.number = 12;
  command.deadline = 86'000'000us;
  ASSERT_TRUE(server->endpoint->write(command));
  EXPECT_EQ(gateway->commands.take(), command);

  const CommandResult result{"lathe-1", "order-1", false, "ein anderes Programm läuft"};
  ASSERT_TRUE(gateway->endpoint->write(result));
  EXPECT_EQ(server->results.take(), result);

  const BlockRequest request{"lathe-1", 1, "run-1", "", 4096, kMaxRequestBytes};
  ASSERT_TRUE(gateway->endpoint->write(request));
  EXPECT_EQ(server->requests.take(), request);

  const BlockData data = block_data("lathe-1", 4096, kMaxBlockBytes);
  ASSERT_TRUE(server->endpoint->write(data));
  EXPECT_EQ(gateway->blocks.take(), data);

  EXPECT_EQ(server->endpoint->rejected().messages, 0U) << server->endpoint->rejected().last_reason;
  EXPECT_EQ(gateway->endpoint->rejected().messages, 0U);
}

TEST_F(Endpoint, KeepsTheOrderOfManyRecords) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  for (std::uint64_t n = 1; n <= kRecordWindow; ++n) {
    ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", n)));
  }
  for (std::uint64_t n = 1; n <= kRecordWindow; ++n) {
    const auto got = server->records.take();
    ASSERT_TRUE(got) << n;
    ASSERT_EQ(got->number, n);
  }
}

TEST_F(Endpoint, DeliversAWholeWindowOfBlocks) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());
  for (std::uint64_t n = 0; n < kBlockWindow; ++n) {
    ASSERT_TRUE(server->endpoint->write(block_data("lathe-1", n * kMaxBlockBytes, kMaxBlockBytes)));
  }
  for (std::uint64_t n = 0; n < kBlockWindow; ++n) {
    const auto got = gateway->blocks.take();
    ASSERT_TRUE(got) << n;
    ASSERT_EQ(*got, block_data("lathe-1", n * kMaxBlockBytes, kMaxBlockBytes));
  }
}

TEST_F(Endpoint, NoGatewayHearsAnother) {
  auto server = open_server();
  auto one = open_gateway("lathe-1");
  auto two = open_gateway("lathe-2");
  ASSERT_TRUE(server->announces.take());
  ASSERT_TRUE(server->announces.take());
  ASSERT_TRUE(server->endpoint->write(block_data("lathe-1", 0, 100)));
  ASSERT_TRUE(server->endpoint->write(RecordAck{"lathe-1", 7, 1}));
  // What lathe-2 gets afterwards shows that nothing of lathe-1's was before it.
  ASSERT_TRUE(server->endpoint->write(block_data("lathe-2", 50, 100)));
  ASSERT_TRUE(server->endpoint->write(RecordAck{"lathe-2", 7, 2}));
  EXPECT_EQ(two->blocks.take(), block_data("lathe-2", 50, 100));
  EXPECT_EQ(two->acks.take()->number, 2U);
  EXPECT_EQ(one->blocks.take(), block_data("lathe-1", 0, 100));
  EXPECT_EQ(one->acks.take()->number, 1U);
  EXPECT_EQ(one->blocks.size() + two->blocks.size(), 0U);
}

TEST_F(Endpoint, WritingToAnUnknownMachineIsNotFound) {
  auto server = open_server();
  const auto written = server->endpoint->write(RecordAck{"absent-1", 1, 1});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::NotFound);
}

TEST_F(Endpoint, RefusesAnotherMachinesMessageAtAGateway) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  const auto written = gateway->endpoint->write(record("lathe-2", 1));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::Syntax);
}

TEST_F(Endpoint, SystemsWithDifferentTagsDoNotMeet) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());
  options_.tag += "-other";
  auto stranger = open_gateway("lathe-2");
  options_.tag.resize(options_.tag.size() - 6);
  auto friendly = open_gateway("lathe-3");
  EXPECT_EQ(server->announces.take()->machine, "lathe-3");
  EXPECT_FALSE(stranger->endpoint->is_connected());
}

TEST_F(Endpoint, ASecondServerOfTheDomainIsRefused) {
  auto server = open_server();
  const auto second = ServerEndpoint::open(options_, {});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
}

TEST_F(Endpoint, AnnouncesAgainWhenTheAnnouncementChanges) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(server->announces.take(), announce("lathe-1"));
  Announce changed = announce("lathe-1");
  changed.epoch = 8;
  ASSERT_TRUE(gateway->endpoint->write(changed));
  EXPECT_EQ(server->announces.take(), changed);
}

TEST_F(Endpoint, MakesUnsendableRecordTextVisible) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  Record sent = record("lathe-1", 1);
  sent.text = std::string(
      "a\xFF"
      "b\0c",
      5);
  ASSERT_TRUE(gateway->endpoint->write(sent));
  EXPECT_EQ(server->records.take()->text, "a\\xFFb\\x00c");
}

}  // namespace
}  // namespace dripline::dds::test
