#include "gateway/app/restart/checkpoint.hpp"

#include <gtest/gtest.h>

#include "gateway/app/restart/approach.hpp"
#include "gateway/app/restart/restart_argument.hpp"
#include "gateway/app/run/start_argument.hpp"
#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/report/outbox.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::gateway {
namespace {

using interpreter::Axis;
using interpreter::Position;

Checkpoint sample() {
  Checkpoint checkpoint;
  checkpoint.block = 1234;
  checkpoint.executed = {900, 1234, 1200, 77, 120, 4096, 42};
  checkpoint.time_us = 1'700'000'000'000'000;
  checkpoint.snapshot = {"fanuc", 6, {std::byte{1}, std::byte{2}, std::byte{3}}};
  checkpoint.delivered.position.set(Axis::X, Length::mm(12.5));
  checkpoint.delivered.tool = 3;
  checkpoint.delivered.feed = Feed::per_minute(Length::mm(150));
  checkpoint.delivered.codes = {8, 21};
  checkpoint.machine.set(Axis::Z, Length::mm(-3));
  checkpoint.answers = 5;
  checkpoint.programs = {{"O0007", std::string(64, 'a')}, {"O0008", {}, true}};
  return checkpoint;
}

TEST(Checkpoint, ReadsBackAsItWasWritten) {
  const auto bytes = encode("run-1", sample());
  const auto read = decode_checkpoint("run-1", bytes);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(encode("run-1", *read), bytes);
  EXPECT_EQ(read->block, 1234u);
  EXPECT_EQ(read->programs, sample().programs);
  EXPECT_EQ(read->delivered.tool, 3);
  EXPECT_EQ(read->snapshot.digest(), sample().snapshot.digest());
}

// Promise 8: what is damaged in any place starts nothing.
TEST(Checkpoint, IsCorruptWithAnyByteChanged) {
  const auto whole = encode("run-1", sample());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto damaged = whole;
    damaged[i] ^= std::byte{0x10};
    const auto read = decode_checkpoint("run-1", damaged);
    ASSERT_FALSE(read) << "byte " << i;
    EXPECT_EQ(read.error().code, Errc::Corrupt);
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_FALSE(decode_checkpoint(
        "run-1", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}));
  }
  EXPECT_FALSE(decode_ending("run-1", whole)) << "the seal covers what it is, too";
  EXPECT_FALSE(decode_checkpoint("run-2", whole)) << "and of which run";
}

TEST(Checkpoint, KeepsAnswersOfEveryKind) {
  const interpreter::Answer probe = interpreter::ProbeResult{true, sample().machine};
  const interpreter::Answer prompt = interpreter::PromptAnswer{"16.4"};
  const interpreter::Answer refused = interpreter::PromptAnswer{};
  const interpreter::Answer input = true;
  const interpreter::Answer time = interpreter::LocalTime{2026, 11, 23, 15, 4, 5, 678};
  for (const auto& answer : {probe, prompt, refused, input, time}) {
    const auto read = decode_answer("run-1", 7, encode("run-1", 7, answer));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->index(), answer.index());
    EXPECT_EQ(encode("run-1", 7, *read), encode("run-1", 7, answer));
    EXPECT_FALSE(decode_answer("run-1", 8, encode("run-1", 7, answer)));
  }
}

// Answers that were kept before times had milliseconds, and those of no known format.
TEST(Checkpoint, ReadsAnswersOfTheFormerFormat) {
  const auto kept = [](std::uint32_t format, auto value) {
    interpreter::language::StateWriter writer;
    std::uint8_t kind = 3;  // a time
    writer(format, kind, value);
    return sealed_answer("run-1", 7, writer.take());
  };
  const std::array<int, 6> time{2026, 11, 23, 15, 4, 5};
  const auto read = decode_answer("run-1", 7, kept(3, time));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(interpreter::milliseconds_of(std::get<interpreter::LocalTime>(*read)),
            interpreter::milliseconds_of({2026, 11, 23, 15, 4, 5, 0}));
  const auto unknown = decode_answer("run-1", 7, kept(2, time));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, Errc::Unsupported);
  EXPECT_NE(unknown.error().what.find("format 2; this is 4"), std::string::npos);
  EXPECT_EQ(decode_answer("run-1", 7, kept(4, time)).error().code, Errc::Corrupt);
}

// The disk is bounded, and what was executed last is kept most densely.
TEST(Checkpoint, ThinsThoseOfLongAgo) {
  std::vector<report::CheckpointSize> kept;
  for (std::uint64_t block = 0; block <= 10'000; ++block) {
    kept.push_back({block, 1000});
    for (const std::uint64_t dropped : report::checkpoints_to_drop(kept, 48, 1'000'000))
      std::erase_if(kept, [&](const auto& one) { return one.block == dropped; });
    ASSERT_LE(kept.size(), 48u);
  }
  EXPECT_EQ(kept.front().block, 0u);
  EXPECT_EQ(kept.back().block, 10'000u);
  EXPECT_GE(kept[kept.size() - 2].block, 9'990u);
  EXPECT_GE(kept[kept.size() - 4].block, 9'900u);
  std::uint64_t widest = 0;
  for (std::size_t i = 1; i < kept.size(); ++i)
    widest = std::max(widest, kept[i].block - kept[i - 1].block);
  EXPECT_LE(widest, 5'000u);
}

TEST(Checkpoint, KeepsWithinItsBytes) {
  std::vector<report::CheckpointSize> kept;
  for (std::uint64_t block = 0; block < 20; ++block) kept.push_back({block, 1000});
  EXPECT_EQ(report::checkpoints_to_drop(kept, 48, 5000).size(), 15u);
}

TEST(CheckpointStore, OutlivesItsProcessAndKeepsTheLastRuns) {
  const test_support::TemporaryFolder folder;
  const auto file = folder.path() / "outbox.sqlite";
  {
    auto outbox = report::Outbox::open(file).value();
    for (int i = 0; i < 6; ++i) {
      const std::string run = "run-" + std::to_string(i);
      outbox.checkpoints().stage_run({{run, "P", "r", "fanuc", 10}, encode(run, Conditions{}), {}});
      outbox.checkpoints().stage(run, {7, 5, UtcTime{}, encode(run, sample())});
      outbox.checkpoints().stage_answer(run, 1, encode(run, 1, interpreter::Answer{true}));
      outbox.checkpoints().stage_ending(run, encode(run, RunEnding{}));
      ASSERT_TRUE(outbox.commit());
    }
  }
  auto outbox = report::Outbox::open(file).value();
  EXPECT_FALSE(report::CheckpointStore::find(outbox.database(), "run-1"));
  const auto run = report::CheckpointStore::find(outbox.database(), "run-2");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->run.control, "fanuc");
  EXPECT_TRUE(decode_ending("run-2", run->ending));
  const auto list = report::CheckpointStore::list(outbox.database(), "run-2").value();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].executed, 5u);
  EXPECT_TRUE(report::CheckpointStore::list(outbox.database(), "run-1").value().empty());
  EXPECT_EQ(report::CheckpointStore::answers(outbox.database(), "run-2", 0).value().size(), 1u);
}

/// As they were written before threads were among them.
struct FormerEnding {
  report::Progress executed;
  std::int64_t time_us = 0;
  bool is_completed = false;
  std::optional<Position> stopped_at;
  std::string memory;
  InHand in_hand;
};

TEST(RunEnding, OfTheFormerFormatReadsBack) {
  FormerEnding former;
  former.executed.executed = 7;
  former.time_us = 5;
  former.stopped_at.emplace();
  former.stopped_at->set(Axis::X, Length::mm(3));
  former.memory = "m";
  std::uint32_t format = 3;
  interpreter::language::StateWriter writer;
  writer(format, former);
  const auto read = decode_ending("run-1", sealed_ending("run-1", writer.take()));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->executed.executed, 7u);
  EXPECT_EQ(read->stopped_at->raw(Axis::X), 3);
  EXPECT_EQ(read->memory, "m");
  EXPECT_FALSE(read->is_in_thread);
  RunEnding now = *read;
  now.is_in_thread = true;
  now.rested_at = {1, 2, 3};
  const auto written = decode_ending("run-1", encode("run-1", now));
  ASSERT_TRUE(written);
  EXPECT_TRUE(written->is_in_thread);
  EXPECT_EQ(written->rested_at, now.rested_at);
}

/// As they were written before the place where the axes rested was among them.
struct ThreadEnding {
  report::Progress executed;
  std::int64_t time_us = 0;
  bool is_completed = false;
  std::optional<Position> stopped_at;
  std::string memory;
  InHand in_hand;
  bool is_in_thread = false;
};

TEST(RunEnding, WithoutThePlaceOfRestReadsBack) {
  ThreadEnding former{.executed = {}, .stopped_at = {}, .memory = "m", .in_hand = {}};
  former.executed.executed = 7;
  former.is_in_thread = true;
  std::uint32_t format = 6;
  interpreter::language::StateWriter writer;
  writer(format, former);
  const auto read = decode_ending("run-1", sealed_ending("run-1", writer.take()));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->executed.executed, 7u);
  EXPECT_EQ(read->memory, "m");
  EXPECT_TRUE(read->is_in_thread);
  EXPECT_FALSE(read->rested_at);
}

/// As they were written before changes of switches were among them.
struct FormerConditions {
  std::string machine, server_setup, gateway_setup;
  bool block_skip = false;
  std::string start;
  Position begun_at;
  std::string restart_of;
};

TEST(Conditions, OfTheFormerFormatReadBack) {
  FormerConditions former{.machine = "mill-1",
                          .server_setup = "s",
                          .gateway_setup = "g",
                          .block_skip = true,
                          .start = "N120",
                          .begun_at = {},
                          .restart_of = "run-0"};
  former.begun_at.set(Axis::X, Length::mm(3));
  std::uint32_t format = 3;
  interpreter::language::StateWriter writer;
  writer(format, former);
  const auto read = decode_conditions("run-1", sealed_conditions("run-1", writer.take()));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->machine, "mill-1");
  EXPECT_TRUE(read->block_skip);
  EXPECT_EQ(read->start, "N120");
  EXPECT_EQ(read->begun_at.raw(Axis::X), 3);
  EXPECT_EQ(read->restart_of, "run-0");
  EXPECT_EQ(read->skip_changes, "");
  Conditions now = *read;
  now.skip_changes = "switch block_skip on after block 7";
  EXPECT_EQ(decode_conditions("run-1", encode("run-1", now)).value(), now);
}

TEST(RestartPlace, IsReadInAllItsForms) {
  using Kind = RestartPlace::Kind;
  EXPECT_EQ(parse_restart_place("executed")->kind, Kind::Executed);
  EXPECT_EQ(parse_restart_place("block=12")->number, 12u);
  EXPECT_EQ(parse_restart_place("L7")->kind, Kind::Line);
  EXPECT_EQ(parse_restart_place("N120")->kind, Kind::Sequence);
  EXPECT_EQ(parse_restart_place("T3")->kind, Kind::Tool);
  const auto time = parse_restart_place("time=2026-11-23T15:04:05.25Z");
  ASSERT_TRUE(time) << time.error().what;
  EXPECT_EQ(to_iso8601(time->time), "2026-11-23T15:04:05.250000Z");
  for (const char* bad : {"", "12", "N", "Nx", "block=", "B7", "time=15:04",
                          "time=2026-13-01T00:00:00Z", "time=2026-11-23T15:04:05", "L-1"}) {
    EXPECT_FALSE(parse_restart_place(bad)) << bad;
  }
}

TEST(RestartPlace, ComesWithAStart) {
  const auto start = parse_start_argument("restart=run-7 at=N120");
  ASSERT_TRUE(start) << start.error().what;
  ASSERT_TRUE(start->restart);
  EXPECT_EQ(start->restart->run, "run-7");
  EXPECT_EQ(start->restart->at.number, 120u);
  EXPECT_TRUE(parse_start_argument("restart=run-7")->restart);
  EXPECT_FALSE(parse_start_argument("restart="));
  EXPECT_FALSE(parse_start_argument("restart=run-7 pass=2"));
  EXPECT_FALSE(parse_start_argument("restart=run-7 at=N1 at=N2"));
}

Position at(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}

Approach mill() {
  return {.from = at(0, 0, 10),
          .to = at(40, 30, -5),
          .highest = at(100, 100, 50),
          .is_clear = true,
          .feed = Feed::per_minute(Length::mm(150)),
          .spindle_turns = true};
}

TEST(Approach, GoesOverTheHighestPlaceOfTheProgram) {
  const auto plan = mill().plan();
  ASSERT_EQ(plan.before.size(), 2u);
  EXPECT_EQ(plan.before[0].to.raw(Axis::Z), 50);
  EXPECT_FALSE(plan.before[0].to.has(Axis::X));
  EXPECT_EQ(plan.before[1].to.raw(Axis::X), 40);
  EXPECT_FALSE(plan.before[1].to.has(Axis::Z));
  ASSERT_EQ(plan.after.size(), 2u);
  EXPECT_FALSE(plan.after[0].feed);
  EXPECT_EQ(plan.after[0].to.raw(Axis::Z), -5 + Approach::kPlunge);
  ASSERT_TRUE(plan.after[1].feed);
  EXPECT_EQ(plan.after[1].feed->length().mm(), 150);
  EXPECT_EQ(plan.after[1].to.raw(Axis::Z), -5);
}

TEST(Approach, RetractsEvenOverItsOwnPlaceInThePlane) {
  Approach approach = mill();
  approach.from = at(40, 30, -20);
  const auto plan = approach.plan();
  ASSERT_EQ(plan.before.size(), 1u);
  EXPECT_EQ(plan.before[0].to.raw(Axis::Z), 50);
}

TEST(Approach, IsNoneWhereTheAxesAreThere) {
  Approach approach = mill();
  approach.from = approach.to;
  EXPECT_TRUE(approach.plan().before.empty());
  EXPECT_TRUE(approach.plan().after.empty());
}

TEST(Approach, PlungesSlowlyWithoutAFeedThatCanBeUsed) {
  Approach approach = mill();
  approach.feed = Feed::per_revolution(Length::mm(0.2));
  EXPECT_EQ(approach.plan().after.back().feed->per(), Feed::Per::Revolution);
  approach.spindle_turns = false;
  EXPECT_EQ(approach.plan().after.back().feed->per(), Feed::Per::Minute);
  approach.feed = Feed::inverse_time(2);
  EXPECT_EQ(approach.plan().after.back().feed->length().mm(), Approach::kPlungeFeedPerMinute);
}

/// In front of the part is beyond the wall of a groove.
TEST(Approach, GoesStraightBackOutOfAGrooveOnALathe) {
  Approach approach = mill();
  approach.is_lathe = true;
  approach.to = at(30, 0, -20);
  approach.from = at(19.2, 0, -20);
  const auto plan = approach.plan();
  EXPECT_TRUE(plan.before.empty());
  ASSERT_EQ(plan.after.size(), 1u);
  EXPECT_EQ(plan.after[0].to.raw(Axis::X), 30);
  EXPECT_FALSE(plan.after[0].to.has(Axis::Z));
  EXPECT_TRUE(plan.after[0].feed);
  approach.from = at(19.2, 0, -21);
  EXPECT_TRUE(approach.plan().before.empty());
  EXPECT_FALSE(approach.plan().fault.empty()) << "both are elsewhere, and nothing is known";
  approach.from = at(30, 0, -26);
  const auto floor = approach.plan();
  EXPECT_TRUE(floor.before.empty()) << "along the floor of a groove";
  ASSERT_EQ(floor.after.size(), 1u);
  EXPECT_EQ(floor.after[0].to.raw(Axis::Z), -20);
  EXPECT_FALSE(floor.after[0].to.has(Axis::X));
  EXPECT_TRUE(floor.after[0].feed);
  approach.stopped_at = at(19.2, 0, -20);
  EXPECT_FALSE(approach.plan().fault.empty()) << "it stopped elsewhere";
  approach.is_lathe = false;
  approach.from = at(19.2, 0, -20);
  EXPECT_TRUE(approach.plan().before.front().to.has(Axis::Z)) << "a mill goes up";
}

// A two-axis mill: the quill is the operator's.
TEST(Approach, LeavesAnAxisThatTheProgramHasNotMoved) {
  Approach approach = mill();
  approach.to = Position();
  approach.to.set(Axis::X, Length::mm(5));
  const auto plan = approach.plan();
  ASSERT_EQ(plan.before.size(), 1u);
  EXPECT_TRUE(plan.after.empty());
}

}  // namespace
}  // namespace dripline::gateway
