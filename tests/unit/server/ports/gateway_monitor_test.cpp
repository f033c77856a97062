#include "server/ports/gateways/gateway_monitor.hpp"

#include <gtest/gtest.h>
#include <condition_variable>

#include "gateway/line/recording/flight_recorder.hpp"
#include "tests/support/manual_clock.hpp"

namespace dripline::ports {
namespace {

using namespace std::chrono_literals;

/// A gateway's recording in the test's hands, and someone who watches it, or no one.
class GatewayMonitorTest : public testing::Test {
 protected:
  GatewayMonitorTest() {
    monitor_.listen(
        [this](const PortTraffic& entry) {
          const std::lock_guard lock(mutex_);
          seen_.push_back(entry.text);
        },
        [this](const std::string& port) { return port == "mill-3" && is_watched_; });
  }
  ~GatewayMonitorTest() override { pool_.stop(); }

  Result<dds::LineData> answer(const dds::LineRequest& request) {
    ++asked_;
    if (fails_) return fail(Errc::Timeout, "no answer");
    dds::LineData data;
    const auto part = recorder_->entries_from(request.number, kPart);
    std::string text;
    for (const auto& entry : part.entries) text += line::to_recording_line(entry) + "\n";
    bytes_ += text.size();
    data.next = part.first + part.entries.size();
    data.ends = part.entries.size() < kPart;
    const auto bytes = std::as_bytes(std::span(text));
    data.bytes = {bytes.begin(), bytes.end()};
    return data;
  }
  /// The gateway's process begins, again.
  void restart() {
    recorder_.emplace(line::FlightRecorder::Options{.port = "mill-3", .folder = {}}, clock_,
                      [](const PortTraffic&) {});
    ++session_;
  }
  void record(const std::string& text) {
    recorder_->add(
        {.what = serial::LineTraffic::What::Note, .time = {}, .bytes = {}, .text = text});
  }
  void report() { monitor_.note("mill-3", session_, recorder_->next_number()); }
  std::vector<std::string> seen() {
    const std::lock_guard lock(mutex_);
    return seen_;
  }
  bool wait_seen(const std::string& text) {
    for (int i = 0; i < 500; ++i, std::this_thread::sleep_for(10ms)) {
      const auto all = seen();
      if (std::ranges::find(all, text) != all.end()) return true;
    }
    return false;
  }
  /// So long that the monitor has looked.
  static void let_look() { std::this_thread::sleep_for(2 * GatewayMonitor::kInterval); }

  static constexpr std::size_t kPart = 16;
  test_support::ManualClock clock_;
  std::optional<line::FlightRecorder> recorder_;
  std::atomic<bool> is_watched_ = false, fails_ = false;
  std::atomic<int> asked_ = 0;
  std::atomic<std::size_t> bytes_ = 0;
  std::uint64_t session_ = 0;
  machines::WorkerPool pool_{2};
  GatewayMonitor monitor_{[this](const dds::LineRequest& request, std::chrono::milliseconds) {
                            return answer(request);
                          },
                          clock_, pool_};

 private:
  std::mutex mutex_;
  std::vector<std::string> seen_;
};

TEST_F(GatewayMonitorTest, ReadsNoneOfWhatWasLongBeforeAndAllSince) {
  restart();
  for (int i = 0; i < 1000; ++i) record("old " + std::to_string(i));
  report();
  monitor_.begin();
  let_look();
  EXPECT_EQ(asked_, 0) << "no one watches it";
  is_watched_ = true;
  record("new 0");  // at once, before the monitor looks again, and without a status
  ASSERT_TRUE(wait_seen("new 0"));
  for (int i = 1; i < 50; ++i) record("new " + std::to_string(i));
  ASSERT_TRUE(wait_seen("new 49"));
  std::vector<std::string> expected;
  for (int i = 0; i < 50; ++i) expected.push_back("new " + std::to_string(i));
  EXPECT_EQ(seen(), expected);
  EXPECT_LT(bytes_, 20'000U) << "the old recording was transferred";
}

/// What was recorded between the last look and the watcher's coming is not left out.
TEST_F(GatewayMonitorTest, BeginsWithTheLastEntriesBefore) {
  restart();
  record("old");
  report();
  monitor_.begin();
  let_look();
  record("just before");
  report();
  is_watched_ = true;
  ASSERT_TRUE(wait_seen("just before"));
  EXPECT_EQ(seen().size(), 1U);
}

TEST_F(GatewayMonitorTest, LosesNothingWhileTheGatewayDoesNotAnswer) {
  restart();
  report();
  monitor_.begin();
  is_watched_ = true;
  record("one");
  ASSERT_TRUE(wait_seen("one"));
  fails_ = true;
  record("two");
  let_look();
  record("three");
  fails_ = false;
  ASSERT_TRUE(wait_seen("three"));
  EXPECT_EQ(seen(), (std::vector<std::string>{"one", "two", "three"}));
}

TEST_F(GatewayMonitorTest, GoesOnWithAnotherProcessOfTheGateway) {
  restart();
  report();
  monitor_.begin();
  is_watched_ = true;
  record("one");
  ASSERT_TRUE(wait_seen("one"));
  fails_ = true;  // while it is away
  let_look();
  restart();
  record("the line is opened");
  report();
  fails_ = false;
  ASSERT_TRUE(wait_seen("the line is opened"));
  EXPECT_EQ(seen().size(), 2U);
}

/// A gateway of before says nothing of its numbers: it is followed from its end on.
TEST_F(GatewayMonitorTest, FollowsAnOlderGatewayFromItsEndOn) {
  restart();
  record("old");
  monitor_.note("mill-3", session_, 0);
  monitor_.begin();
  is_watched_ = true;
  for (int i = 0; i < 500 && asked_ < 2; ++i) std::this_thread::sleep_for(10ms);
  record("new");
  ASSERT_TRUE(wait_seen("new"));
  EXPECT_EQ(seen().size(), 1U);
}

TEST(ReadRecording, StatesWhatIsNotThereAnyMore) {
  std::uint64_t number = 100;
  RecordingPart read;
  const auto done = read_recording(
      [](const dds::LineRequest& request, std::chrono::milliseconds) -> Result<dds::LineData> {
        EXPECT_EQ(request.number, 100U);
        dds::LineData data;
        data.next = 131;
        const std::string text =
            line::to_recording_line({.port = "x", .time = {}, .bytes = {}, .text = "left"}) + "\n";
        const auto bytes = std::as_bytes(std::span(text));
        data.bytes = {bytes.begin(), bytes.end()};
        return data;
      },
      "mill-3", number, [&](const RecordingPart& part) { read = part; });
  ASSERT_TRUE(done);
  EXPECT_EQ(read.lost, 30U);
  ASSERT_EQ(read.entries.size(), 1U);
  EXPECT_EQ(read.entries[0].port, "mill-3");
  EXPECT_EQ(number, 131U);
}

}  // namespace
}  // namespace dripline::ports
