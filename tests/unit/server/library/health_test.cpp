#include "server/library/health.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

using library::Health;
using Level = Health::Level;

constexpr std::uint64_t kMega = 1024 * 1024;

class HealthState : public ServerTest {
 protected:
  Health health_{clock_};
};

TEST_F(HealthState, IsAsBadAsTheWorstOfItsFindings) {
  EXPECT_EQ(health_.state().level, Level::Ok);
  health_.report("lathe-1", {Level::Degraded, "records", "a", "lathe-1"});
  health_.report("lathe-2", {Level::Degraded, "records", "a", "lathe-2"});
  EXPECT_EQ(health_.state().level, Level::Degraded);
  health_.report("", {Level::Failed, "store", "b", ""});
  EXPECT_EQ(health_.state().level, Level::Failed);
  EXPECT_EQ(health_.state().findings.size(), 3u);
  health_.report("", {Level::Ok, "store", "", ""});
  health_.report("lathe-1", {Level::Ok, "records", "", ""});
  const auto state = health_.state();
  EXPECT_EQ(state.level, Level::Degraded);
  ASSERT_EQ(state.findings.size(), 1u);
  EXPECT_EQ(state.findings[0].detail, "lathe-2");
}

TEST_F(HealthState, AStoreThatDoesNotAnswerIsDegradedAndThenAFailure) {
  health_.looked();
  clock_.advance(Health::kPatience);
  EXPECT_EQ(health_.state().level, Level::Ok);
  clock_.advance(std::chrono::seconds(1));
  EXPECT_EQ(health_.state().level, Level::Degraded);
  EXPECT_EQ(health_.state().findings.at(0).subject, "store");
  EXPECT_EQ(health_.state().findings.at(0).what, "the store has not answered for 7 s");
  clock_.advance(Health::kSilence - Health::kPatience);
  EXPECT_EQ(health_.state().level, Level::Failed);
  health_.looked();
  EXPECT_EQ(health_.state().level, Level::Ok);
}

TEST_F(HealthState, TheWatchReportsTheErrorOfTheStore) {
  const test_support::TemporaryFolder folder;
  {
    auto opened = storage::SqliteStore::open({.file = folder.path() / "store.sqlite"}, clock_);
    ASSERT_TRUE(opened);
    const auto store = *std::move(opened);
    const library::HealthWatch watch({.health = health_,
                                      .probe = [&] { return store->probe(); },
                                      .folder = folder.path(),
                                      .clock = clock_});
    for (const auto& finding : health_.state().findings) EXPECT_NE(finding.subject, "store");
  }
  const library::HealthWatch watch(
      {.health = health_,
       .probe = []() -> Result<void> { return fail(Errc::Io, "disk full: /somewhere"); },
       .folder = folder.path(),
       .clock = clock_});
  const auto state = health_.state();
  EXPECT_EQ(state.level, Level::Failed);
  EXPECT_EQ(state.findings.back().detail, "disk full: /somewhere");
  EXPECT_EQ(state.findings.back().what.find('/'), std::string::npos);
}

TEST_F(HealthState, TheWatchReportsAClockThatIsNotTheStores) {
  const test_support::TemporaryFolder folder;
  const auto watch = [&](std::optional<UtcTime> store) {
    const library::HealthWatch looked({.health = health_,
                                       .probe = [] { return Result<void>(); },
                                       .folder = folder.path(),
                                       .clock = clock_,
                                       .store_time = [store] { return store; }});
    for (const auto& finding : health_.state().findings)
      if (finding.subject == "clock") return finding.detail;
    return std::string("agrees");
  };
  EXPECT_EQ(watch(std::nullopt), "agrees") << "a store on this computer";
  EXPECT_EQ(watch(clock_.now()), "agrees");
  EXPECT_EQ(watch(clock_.now() - std::chrono::hours(1)), "this server's is 3600 s ahead");
  EXPECT_EQ(watch(clock_.now() + std::chrono::seconds(40)), "this server's is 40 s late");
  EXPECT_EQ(watch(clock_.now()), "agrees") << "it is set right";
}

TEST(HealthClock, HasATolerance) {
  constexpr UtcTime kNow{std::chrono::hours(500'000)};
  const auto level = [&](auto before, auto after, bool did_differ = false) {
    return library::judge_clock(kNow + before, kNow, kNow + after, did_differ).level;
  };
  using namespace std::chrono_literals;
  EXPECT_EQ(level(4900ms, 4950ms), Level::Ok);
  EXPECT_EQ(level(5s, 5s), Level::Degraded);
  EXPECT_EQ(level(-5s, -5s), Level::Degraded);
  EXPECT_EQ(level(-30s, 30s), Level::Ok) << "the answer took a minute: nothing is known";
  EXPECT_EQ(level(4500ms, 4500ms, true), Level::Degraded) << "not to and fro";
  EXPECT_EQ(level(3900ms, 3900ms, true), Level::Ok);
}

TEST(HealthDisk, WarnsBeforeItIsFull) {
  EXPECT_EQ(library::judge_disk(1'000'000 * kMega, 3000 * kMega).level, Level::Ok);
  EXPECT_EQ(library::judge_disk(1'000'000 * kMega, 2000 * kMega).level, Level::Degraded);
  EXPECT_EQ(library::judge_disk(1000 * kMega, 100 * kMega).level, Level::Ok);
  EXPECT_EQ(library::judge_disk(1000 * kMega, 40 * kMega).level, Level::Degraded);
  EXPECT_EQ(library::judge_disk(1000 * kMega, 7 * kMega).level, Level::Failed);
}

}  // namespace
}  // namespace dripline::server_test
