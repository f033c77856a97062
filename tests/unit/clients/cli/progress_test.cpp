#include "clients/cli/text/progress.hpp"

#include <gtest/gtest.h>

#include "clients/cli/setup/change_log.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;

class FakeClock final : public Clock {
 public:
  UtcTime now() const override { return {}; }
  SteadyTime steady_now() const override { return time; }
  SteadyTime time{};
};

struct FakeTerminal {
  Terminal terminal{true, false, 80};
  std::string written;
  LiveArea area() {
    return LiveArea([this] { return terminal; },
                    [this](std::string_view text) { written += text; });
  }
};

TEST(RenderProgress, ShowsBytesRateAndWhatIsLeft) {
  EXPECT_EQ(render_progress({"O1", 5'000'000, 10'000'000, 2.0}, 200),
            "O1 [############............]  50 %  5.0 MB of 10.0 MB  2.5 MB/s  0:02 left");
}

TEST(RenderProgress, GuessesNoRateAtTheBeginning) {
  EXPECT_EQ(render_progress({"O1", 100, 200, 0.1}, 200),
            "O1 [############............]  50 %  100 B of 200 B");
}

TEST(RenderProgress, HoldsTheEnds) {
  EXPECT_EQ(render_progress({"O1", 0, 0, 0}, 200),
            "O1 [########################] 100 %  0 B of 0 B");
  EXPECT_EQ(render_bar(7.0, 4), "[####]");
  EXPECT_EQ(render_bar(-1.0, 4), "[....]");
}

TEST(RenderProgress, FitsTheWidth) {
  EXPECT_EQ(columns(render_progress({"O1", 5, 10, 2.0}, 20)), 20u);
}

TEST(Progress, DrawsAtMostTenTimesASecondAndVanishes) {
  FakeTerminal fake;
  FakeClock clock;
  LiveArea area = fake.area();
  {
    Progress progress(area, clock, "O1");
    progress.update(1, 10);
    const std::string first = fake.written;
    EXPECT_NE(first, "");
    clock.time += 99ms;
    progress.update(2, 10);
    EXPECT_EQ(fake.written, first);
    clock.time += 1ms;
    progress.update(3, 10);
    EXPECT_NE(fake.written, first);
    fake.written.clear();
  }
  EXPECT_EQ(fake.written, "\r\x1b[J");
}

TEST(Progress, WritesNothingInAPipe) {
  FakeTerminal fake;
  fake.terminal.is_terminal = false;
  FakeClock clock;
  LiveArea area = fake.area();
  { Progress(area, clock, "O1").update(5, 10); }
  EXPECT_EQ(fake.written, "");
}

TEST(LiveArea, RedrawsAllItsLines) {
  FakeTerminal fake;
  LiveArea area = fake.area();
  area.show({"a", "b", "c"});
  EXPECT_EQ(fake.written, "a\nb\nc");
  fake.written.clear();
  area.show({"d"});
  EXPECT_EQ(fake.written, "\r\x1b[2A\x1b[Jd");
  fake.written.clear();
  area.clear();
  area.clear();
  EXPECT_EQ(fake.written, "\r\x1b[J");
}

TEST(LiveArea, CutsLinesThatWouldWrap) {
  FakeTerminal fake;
  fake.terminal.width = 8;
  LiveArea area = fake.area();
  area.show({"1234567"});
  EXPECT_EQ(fake.written, "1234\u2026");
}

TEST(ChangeLog, TellsStatesAtOnceAndCountersEveryFiveSeconds) {
  ChangeLog log;
  SteadyTime now{};
  now += 1h;
  EXPECT_TRUE(log.is_worth_a_line("Active", "1", now));
  EXPECT_FALSE(log.is_worth_a_line("Active", "2", now + 4s));
  EXPECT_TRUE(log.is_worth_a_line("Active", "3", now + 5s));
  EXPECT_FALSE(log.is_worth_a_line("Active", "3", now + 60s));
  EXPECT_TRUE(log.is_worth_a_line("FeedHold", "3", now + 61s));
}

}  // namespace
}  // namespace dripline::cli
