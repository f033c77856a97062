#include <gtest/gtest.h>
#include <atomic>
#include <fstream>
#include <thread>

#include "gateway/line/block_ledger.hpp"
#include "gateway/line/recording/flight_recorder.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::line {
namespace {

using What = serial::LineTraffic::What;

class RecorderTest : public testing::Test {
 protected:
  void add(FlightRecorder& recorder, What what, std::string_view text) {
    const bool has_bytes = what == What::Sent || what == What::Received;
    recorder.add(
        {.what = what,
         .time = {},
         .bytes = has_bytes ? std::as_bytes(std::span(text)) : std::span<const std::byte>{},
         .text = has_bytes ? std::string_view{} : text});
  }
  FlightRecorder make(FlightRecorder::Options options) {
    options.port = "com1";
    return FlightRecorder(std::move(options), clock_,
                          [this](const PortTraffic& entry) { notified_.push_back(entry); });
  }
  test_support::TemporaryFolder folder_;
  test_support::ManualClock clock_;
  std::vector<PortTraffic> notified_;
};

TEST_F(RecorderTest, JoinsCharactersThatFollowEachOther) {
  auto recorder = make({.port = {}, .folder = {}});
  add(recorder, What::Sent, "G");
  add(recorder, What::Sent, "0");
  add(recorder, What::Received, "\x13");
  add(recorder, What::Fault, "parity error");
  add(recorder, What::Sent, "X");
  clock_.advance(std::chrono::milliseconds(100));
  add(recorder, What::Sent, "1");
  const auto entries = recorder.entries();
  ASSERT_EQ(entries.size(), 5u);
  EXPECT_EQ(entries[0].what, What::Sent);
  EXPECT_EQ(entries[0].bytes, "G0");
  EXPECT_EQ(entries[1].bytes, "\x13");
  EXPECT_EQ(entries[2].text, "parity error");
  EXPECT_EQ(entries[3].bytes, "X");
  EXPECT_EQ(entries[4].bytes, "1");
  EXPECT_EQ(recorder.sent(), 4u);
  EXPECT_EQ(recorder.received(), 1u);
  EXPECT_EQ(recorder.faults(), 1u);
}

// The end of a server flushes beside the thread that does so all the time.
TEST_F(RecorderTest, WritesEveryEntryOnceAndInOrderWhoeverFlushes) {
  constexpr int kEntries = 500;
  {
    auto recorder = make({.port = {}, .folder = folder_.path()});
    std::atomic<bool> is_over = false;
    std::thread other([&] {
      while (!is_over) recorder.flush();
    });
    for (int i = 0; i < kEntries; ++i) {
      add(recorder, What::Note, std::to_string(i));
      recorder.flush();
    }
    is_over = true;
    other.join();
  }
  EXPECT_EQ(notified_.size(), kEntries);
  const auto kept = make({.port = {}, .folder = folder_.path()}).entries();
  ASSERT_EQ(kept.size(), kEntries);
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i].text, std::to_string(i));
}

TEST_F(RecorderTest, IsBoundedInBytesAndInTime) {
  auto recorder =
      make({.port = {}, .folder = {}, .max_bytes = 10'000, .max_age = std::chrono::seconds(60)});
  for (int i = 0; i < 10'000; ++i) {
    add(recorder, What::Sent, "some text of a block");
    add(recorder, What::Received, "x");
  }
  std::size_t bytes = 0;
  for (const auto& entry : recorder.entries()) bytes += sizeof(entry) + entry.bytes.size();
  EXPECT_LE(bytes, 11'000u);
  EXPECT_GE(bytes, 5'000u);
  clock_.advance(std::chrono::seconds(61));
  recorder.flush();
  EXPECT_TRUE(recorder.entries().empty());
}

TEST_F(RecorderTest, PublishesEachEntryOnceAndKeepsItOnDisk) {
  {
    auto recorder = make({.port = {}, .folder = folder_.path()});
    add(recorder, What::Note, "open");
    add(recorder, What::Sent, "G0\r\n");
    recorder.flush();
    EXPECT_EQ(notified_.size(), 1u);  // the other one may still grow
    clock_.advance(std::chrono::milliseconds(100));
    recorder.flush();
    recorder.flush();
    EXPECT_EQ(notified_.size(), 2u);
  }
  std::ofstream(folder_.path() / "com1.jsonl", std::ios::app) << "{\"time\": \"cut o";
  auto next = make({.port = {}, .folder = folder_.path()});
  const auto entries = next.entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1].bytes, "G0\r\n");
  EXPECT_EQ(entries[1].time, notified_[1].time);
  EXPECT_EQ(notified_.size(), 2u);
  add(next, What::Note, "open");
  next.flush();
  EXPECT_EQ(RecordingFile(folder_.path(), "com1").read().size(), 3u);
}

TEST_F(RecorderTest, ReadsNothingFromLinesOfAnotherForm) {
  for (const char* bad :
       {"", "[]", "{}", R"({"port":"a","time":"x","what":"sent","bytes":"","text":""})",
        R"({"port":"a","time":"2026-13-01T00:00:00.000000Z","what":"sent","bytes":"","text":""})",
        R"({"port":"a","time":"2026-11-01T00:00:00.000000Z","what":"sent","bytes":"0g","text":""})",
        R"({"port":"a","time":"2026-11-01T00:00:00.000000Z","what":"x","bytes":"","text":""})"}) {
    EXPECT_FALSE(parse_recording_line(bad)) << bad;
  }
}

TEST(BlockLedger, CountsWhatWasSentInBytesAndBlocks) {
  BlockLedger ledger(5);
  EXPECT_EQ(ledger.add("N10 G0\r\n/N20 X1\r", false), "N10 G0\n/N20 X1");
  EXPECT_EQ(ledger.add("\nM30", true), "\nM30\n");
  EXPECT_EQ(ledger.place(), BlockPlace{});
  ledger.advance(6);
  EXPECT_EQ(ledger.place().blocks, 0u);
  EXPECT_EQ(ledger.place().bytes, 6u);
  ledger.advance(7);
  EXPECT_EQ(ledger.place(), (BlockPlace{.bytes = 8, .blocks = 1, .line = 5, .sequence = 10}));
  ledger.advance(3);
  EXPECT_EQ(ledger.place().bytes, 8u);
  ledger.advance(15);
  EXPECT_EQ(ledger.place(), (BlockPlace{.bytes = 17, .blocks = 2, .line = 6, .sequence = 20}));
  ledger.advance_to_end();
  EXPECT_EQ(ledger.place(), (BlockPlace{.bytes = 20, .blocks = 3, .line = 7, .sequence = -1}));
}

TEST(BlockLedger, KnowsThatAHeadHasLeftThoughItCountsNoBytes) {
  BlockLedger ledger;
  EXPECT_EQ(ledger.add_head("G21\n"), "G21\n");
  EXPECT_EQ(ledger.add("N1 G0\n", true), "N1 G0\n");
  EXPECT_EQ(ledger.left(), 0u);
  ledger.advance(2);
  EXPECT_EQ(ledger.left(), 2u);
  EXPECT_EQ(ledger.place(), BlockPlace{});
  ledger.advance(6);
  EXPECT_EQ(ledger.place().bytes, 2u);
  EXPECT_EQ(ledger.left(), 6u);
}

TEST(BlockLedger, CountsTheSameHoweverTheTextIsCut) {
  const std::string text = "N1 G0\r\nN2 G1\r\n\r\nN3";
  for (std::size_t step = 1; step <= text.size(); ++step) {
    BlockLedger ledger;
    std::string offered;
    for (std::size_t at = 0; at < text.size(); at += step) {
      offered += ledger.add(std::string_view(text).substr(at, step), at + step >= text.size());
    }
    EXPECT_EQ(offered, "N1 G0\nN2 G1\n\nN3\n");
    ledger.advance_to_end();
    EXPECT_EQ(ledger.place(),
              (BlockPlace{.bytes = text.size(), .blocks = 4, .line = 4, .sequence = 3}));
  }
}

TEST(BlockLedger, ReadsSequenceNumbers) {
  EXPECT_EQ(sequence_number("N120 G0"), 120);
  EXPECT_EQ(sequence_number(" /n5"), 5);
  EXPECT_EQ(sequence_number("17 L X+5"), 17);
  EXPECT_EQ(sequence_number("G0 N5"), -1);
  EXPECT_EQ(sequence_number(""), -1);
}

/// A reader far away asks for what it has not seen.
TEST_F(RecorderTest, GivesPartsByNumber) {
  FlightRecorder recorder = make({.port = "", .folder = {}, .max_bytes = 3 * sizeof(PortTraffic)});
  EXPECT_TRUE(recorder.entries_from(0).entries.empty());
  for (const char* text : {"one", "two", "three", "four", "five", "six"})
    add(recorder, What::Note, text);
  recorder.flush();
  const auto all = recorder.entries_from(0);
  ASSERT_FALSE(all.entries.empty());
  constexpr auto kFirst = FlightRecorder::kFirst;
  EXPECT_GT(all.first, kFirst) << "the oldest are gone, and so are their numbers";
  EXPECT_EQ(all.first + all.entries.size(), kFirst + 6);
  EXPECT_EQ(recorder.next_number(), kFirst + 6);
  EXPECT_EQ(recorder.entries_from(kFirst + 5).entries.front().text, "six");
  EXPECT_TRUE(recorder.entries_from(kFirst + 6).entries.empty());
  EXPECT_EQ(recorder.entries_from(kFirst + 99).first, kFirst + 6);
}

/// A reader that has seen everything of an earlier life begins with what is new.
TEST_F(RecorderTest, GivesWhatAnEarlierLifeHasLeftNumbersBeforeItsOwn) {
  {
    auto earlier = make({.port = {}, .folder = folder_.path()});
    add(earlier, What::Note, "one");
    add(earlier, What::Note, "two");
    earlier.flush();
  }
  auto recorder = make({.port = {}, .folder = folder_.path()});
  EXPECT_EQ(recorder.next_number(), FlightRecorder::kFirst);
  EXPECT_EQ(recorder.entries_from(0).entries.size(), 2U);
  add(recorder, What::Note, "three");
  ASSERT_EQ(recorder.entries_from(FlightRecorder::kFirst).entries.size(), 1U);
  EXPECT_EQ(recorder.entries_from(FlightRecorder::kFirst).entries.front().text, "three");
}

}  // namespace
}  // namespace dripline::line
