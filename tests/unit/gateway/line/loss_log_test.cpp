#include "gateway/line/loss_log.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace dripline::line {
namespace {

using namespace std::chrono_literals;

/// A line and the log of it.
struct Line {
  LossLog log{"tcp://10.0.0.7:4001"};
  SteadyTime now{};
  std::vector<std::string> texts;

  void note(const std::optional<LossLog::Message>& message) {
    if (message) texts.push_back(message->text);
  }
  void open() { note(log.on_open()); }
  void lose(const std::string& why = "it ended the connection") { note(log.on_lost(why, now)); }
  /// As such a device server does it.
  void come_and_go(std::chrono::seconds time) {
    for (const SteadyTime end = now + time; now < end; now += 1s) {
      open();
      lose();
    }
  }
};

TEST(LossLog, ReportsAPulledCableAndTheLineThatIsBackAtOnce) {
  Line line;
  line.open();
  line.note(line.log.on_steady());
  line.lose("hung up");
  line.open();
  line.note(line.log.on_steady());
  EXPECT_EQ(line.texts, (std::vector<std::string>{"is open", "has no line: hung up", "is open"}));
}

TEST(LossLog, ReportsALineThatComesAndGoesOnceAndThenAtGrowingIntervals) {
  Line line;
  line.come_and_go(59s);
  ASSERT_EQ(line.texts.size(), 4u);
  EXPECT_NE(line.texts[3].find("again and again: it ended the connection. Another client"),
            std::string::npos)
      << line.texts[3];
  line.come_and_go(5s);
  ASSERT_EQ(line.texts.size(), 5u);
  EXPECT_EQ(line.texts[4],
            "is still opened and lost again, 62 times in 1 min: it ended the connection");
  line.come_and_go(24h);
  EXPECT_LT(line.texts.size(), 40u) << "two a second were 172,800";
  EXPECT_GT(line.texts.size(), 24u) << "at least each hour";
}

TEST(LossLog, ReportsThatSuchALineIsSteadyAgainAndBeginsFromTheStart) {
  Line line;
  line.come_and_go(10s);
  line.texts.clear();
  line.open();
  EXPECT_TRUE(line.texts.empty()) << "it may be lost again at once";
  line.note(line.log.on_steady());
  EXPECT_EQ(line.texts.back(), "is open and stays so; it was lost 10 times");
  line.lose();
  EXPECT_EQ(line.texts.back(), "has no line: it ended the connection");
}

TEST(LossLog, ReportsAnotherReasonAtOnceButNotEachOfMany) {
  Line line;
  line.come_and_go(10s);
  line.texts.clear();
  line.lose("connection refused");
  EXPECT_EQ(line.texts.back(), "has no line: connection refused");
  for (int i = 0; i < 100; ++i) line.lose(std::to_string(i));
  EXPECT_LE(line.texts.size(), LossLog::kMaxReasons);
}

TEST(LossLog, BlamesNoDeviceServerForADevice) {
  LossLog log("/dev/ttyUSB0");
  std::optional<LossLog::Message> last;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(log.on_open());
    last = log.on_lost("hung up", {});
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->text, "is opened and lost again and again: hung up");
  EXPECT_TRUE(last->is_warning);
}

}  // namespace
}  // namespace dripline::line
