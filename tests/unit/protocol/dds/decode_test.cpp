#include "protocol/dds/impl/decode.hpp"

#include <cstring>
#include <limits>

#include "network.hpp"
#include "protocol/dds/impl/encode.hpp"

namespace dripline::dds::test {
namespace {

template <class Message>
SampleOf<Message> sample_of(const Message& message) {
  SampleOf<Message> sample;
  const auto encoded = encode(message, sample);
  EXPECT_TRUE(encoded) << (encoded ? "" : encoded.error().what);
  return sample;
}

Status status() {
  Status m;
  m.machine = "lathe-1";
  return m;
}

TEST(Decode, RefusesBlockDataWithAWrongCrc) {
  const BlockData data = block_data("lathe-1", 0, 10);
  auto sample = sample_of(data);
  sample.crc ^= 1;
  const auto decoded = decode(sample);
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, Errc::Corrupt);
}

TEST(Decode, RefusesBlockDataBeyondItsTotal) {
  const BlockData data = block_data("lathe-1", 100, 10);
  auto sample = sample_of(data);
  sample.total_bytes = 109;
  EXPECT_FALSE(decode(sample));
  sample.total_bytes = 111;  // "ends" is set but it does not
  EXPECT_FALSE(decode(sample));
  sample.offset = UINT64_MAX - 5;  // the sum must not wrap
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesAContentThatIsNoDigest) {
  BlockData data = block_data("lathe-1", 0, 10);
  data.content = std::string(64, 'a');
  auto sample = sample_of(data);
  EXPECT_TRUE(decode(sample));
  sample.content[0] = 'x';
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesBytesThatComeWithAFailure) {
  const BlockData data = block_data("lathe-1", 0, 10);
  auto sample = sample_of(data);
  sample.status = static_cast<std::uint8_t>(BlockStatus::Corrupt);
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesAnEpochThatNoStoreCanKeep) {
  const Record message = record("lathe-1", 1);
  auto sample = sample_of(message);
  sample.epoch = 1ULL << 63;
  EXPECT_FALSE(decode(sample));
  sample.epoch = 0;
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesEnumeratorsWithoutMeaning) {
  const Status message = status();
  auto sample = sample_of(message);
  sample.execution = 9;
  EXPECT_FALSE(decode(sample));
  auto kind = sample_of(record("lathe-1", 1));
  kind.kind = 10;
  EXPECT_FALSE(decode(kind));
  const BlockData data = block_data("lathe-1", 0, 0);
  auto data_status = sample_of(data);
  data_status.status = 6;
  EXPECT_FALSE(decode(data_status));
}

/// A gateway from before there were modes sends none: the sample's members stay zero.
TEST(Decode, TakesAStatusWithoutModes) {
  const Status message = status();
  auto sample = sample_of(message);
  EXPECT_FALSE(sample.modes.is_present);
  sample.modes = {};
  EXPECT_EQ(*decode(sample), message);
}

TEST(Decode, ChecksTheModes) {
  Status message = status();
  message.modes = ActiveModes{};
  auto sample = sample_of(message);
  EXPECT_EQ(decode(sample)->modes, message.modes);
  sample.modes.motion = 6;
  EXPECT_FALSE(decode(sample));
  message.modes->feed = std::numeric_limits<double>::infinity();
  SampleOf<Status> unused;
  EXPECT_FALSE(encode(message, unused));
  message.modes->feed = 0;
  message.modes->cycle = std::string(33, 'x');
  EXPECT_FALSE(encode(message, unused));
}

/// A gateway from before there were coordinates, and one that shows modes without the newer ones.
TEST(Decode, TakesAStatusWithoutCoordinates) {
  Status message = status();
  message.modes = ActiveModes{};
  auto sample = sample_of(message);
  sample.coordinates = {};
  sample.modes.tool_axis = sample.modes.spindle = 0;
  EXPECT_EQ(*decode(sample), message);
  EXPECT_FALSE(decode(sample)->coordinates);
  EXPECT_FALSE(decode(sample)->modes->tool_axis);
}

/// A gateway from before there was a screen.
TEST(Decode, TakesAStatusWithoutAScreen) {
  Status message = status();
  message.screen = Screen{.is_inch = true, .position = PositionDisplay::Actual, .block = "N1"};
  auto sample = sample_of(message);
  EXPECT_EQ(decode(sample)->screen, message.screen);
  sample.screen_position = 6;
  EXPECT_FALSE(decode(sample));
  sample.has_screen = false;
  EXPECT_FALSE(decode(sample)->screen);
  message.screen->block = std::string(400, 'x');
  EXPECT_LE(decode(sample_of(message))->screen->block.size(), kMaxBlockText);
}

TEST(Decode, ChecksTheCoordinates) {
  Status message = status();
  message.modes.emplace().tool_axis = 8;
  message.modes->spindle = SpindleState::Off;
  message.coordinates = Coordinates{.program = ProgramFrame{.mirrored = 7, .pole_axes = 7}};
  auto sample = sample_of(message);
  EXPECT_EQ(*decode(sample), message);
  sample.modes.tool_axis = 10;
  EXPECT_FALSE(decode(sample));
  sample.modes.tool_axis = 9;
  sample.modes.spindle = 5;
  EXPECT_FALSE(decode(sample));
  sample.modes.spindle = 0;
  sample.coordinates.pole_axes = 8;
  EXPECT_FALSE(decode(sample));
  SampleOf<Status> unused;
  message.coordinates->program->datum[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(encode(message, unused));
  message.coordinates = Coordinates{.target = {std::numeric_limits<double>::infinity()}};
  EXPECT_FALSE(encode(message, unused));
}

TEST(Decode, RefusesNumbersThatAreNotFinite) {
  const Status message = status();
  auto sample = sample_of(message);
  sample.feed_mm_per_min = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(decode(sample));
  Status at_infinity = status();
  at_infinity.position[8] = std::numeric_limits<double>::infinity();
  SampleOf<Status> unused;
  EXPECT_FALSE(encode(at_infinity, unused));
}

TEST(Decode, RefusesAPositionWithoutNineAxes) {
  const Status message = status();
  auto sample = sample_of(message);
  sample.position._length = 8;
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesNamesThatCouldLeaveTheirPlace) {
  auto sample = sample_of(RecordAck{"lathe-1", 1, 1});
  for (const char* name : {"", "*", "../x", "Lathe", "a b"}) {
    std::strcpy(sample.machine, name);
    EXPECT_FALSE(decode(sample)) << name;
  }
  auto request = sample_of(BlockRequest{"lathe-1", 1, "run-1", "", 0, 1});
  std::strcpy(request.program, "../secret");
  EXPECT_FALSE(decode(request));
}

TEST(Decode, RefusesRequestsOutOfRange) {
  auto sample = sample_of(BlockRequest{"lathe-1", 1, "run-1", "", 0, 1});
  sample.length = 0;
  EXPECT_FALSE(decode(sample));
  sample.length = kMaxRequestBytes + 1;
  EXPECT_FALSE(decode(sample));
  sample.length = 2;
  sample.offset = UINT64_MAX - 1;
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesTextThatIsNotUtf8) {
  auto sample = sample_of(record("lathe-1", 1));
  std::strcpy(sample.text, "\xC3(");
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, RefusesAStartWithoutAProgram) {
  Command command;
  command.machine = "lathe-1";
  command.id = "1";
  auto sample = sample_of(command);
  ASSERT_TRUE(decode(sample));
  sample.action = static_cast<std::uint8_t>(CommandAction::Start);
  EXPECT_FALSE(decode(sample));
}

TEST(Decode, KeepsTheSetupOfAStart) {
  Command command;
  command.machine = "lathe-1";
  command.id = "1";
  command.setup = "# Drehl\xC3\xA4nge\n[[tool]]\nnumber = 1\n";
  const auto sample = sample_of(command);
  EXPECT_EQ(decode(sample)->setup, command.setup);
  command.setup = "\xC3(";
  SampleOf<Command> refused;
  EXPECT_FALSE(encode(command, refused));
  command.setup.assign(kMaxCommandSetup + 1, ' ');
  EXPECT_FALSE(encode(command, refused));
}

TEST(Encode, RefusesWhatDoesNotFitInsteadOfCuttingIt) {
  Record long_text = record("lathe-1", 1);
  long_text.text.assign(kMaxRecordText + 1, 'x');
  SampleOf<Record> sample;
  const auto encoded = encode(long_text, sample);
  ASSERT_FALSE(encoded);
  EXPECT_EQ(encoded.error().code, Errc::LimitExceeded);
  Record long_run = record("lathe-1", 1);
  long_run.run.assign(41, 'x');
  EXPECT_FALSE(encode(long_run, sample));
}

TEST(Encode, ShortensAStatusMessageVisibly) {
  Status message = status();
  message.message.assign(1000, 'x');
  const auto decoded = decode(sample_of(message));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->message.size(), 512U);
  EXPECT_TRUE(decoded->message.ends_with("…"));
}

}  // namespace
}  // namespace dripline::dds::test
