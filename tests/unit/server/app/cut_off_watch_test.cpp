// What the watch of gateways does with the rule's decisions: log, audit trail, /health, and the
// hand-over itself.
#include "server/app/impl/cut_off_watch.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include "storage/sqlite_store.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::app {
namespace {

using namespace std::chrono_literals;

/// A store that another server waits for, which hears three gateways.
class WaitedForStore final : public storage::OpenedStore {
 public:
  explicit WaitedForStore(const storage::Store& inner) : OpenedStore(inner) {}
  using OpenedStore::check;
  Result<bool> check(std::chrono::milliseconds, const std::stop_token&) override { return true; }
  Result<void> probe() override { return {}; }
  Result<bool> copy_to(const std::filesystem::path&,
                       const std::function<bool(std::uint64_t, std::uint64_t)>&) override {
    return true;
  }
  Result<std::string> identity() override { return ""; }
  Result<std::vector<storage::WaitingServer>> waiting() override {
    seen += 1s;
    return std::vector{
        storage::WaitingServer{.described = "dncd 7 on srv-2", .seen = seen, .gateways = 3}};
  }
  Result<void> note_own_hand_overs(const storage::OwnHandOvers& now) override {
    if (is_away) return fail(Errc::Io, "the database is away");
    noted = now;
    return {};
  }

  UtcTime seen{};
  bool is_away = false;
  storage::OwnHandOvers noted;
};

class CutOffWatchTest : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = storage::SqliteStore::open({.file = folder_.path() / "store"}, clock_);
    ASSERT_TRUE(opened) << opened.error().what;
    sqlite_ = *std::move(opened);
    store_.emplace(*sqlite_);
    audit_.emplace(store_->audit, clock_);
  }
  void begin(std::chrono::milliseconds silence = 4s) {
    watch_.emplace(
        CutOffWatch::Parts{.store = *store_,
                           .health = health_,
                           .audit = *audit_,
                           .clock = clock_,
                           .server = "srv-1",
                           .heard = [this] { return heard_; },
                           .is_machine_known = [] { return true; },
                           .check_free = [this] { return free_; },
                           .leave = [this] { ++left_; }},
        CutOffRule::Options{
            .silence = silence, .lease = 2s, .before = {}, .began = clock_.steady_now()});
  }
  void look_for(std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed < time && left_ == 0; passed += 250ms) {
      clock_.advance(250ms);
      watch_->look();
    }
  }
  std::vector<std::string> trail() const {
    std::vector<std::string> actions;
    const auto entries = audit_->entries({});
    if (entries)
      for (const auto& entry : *entries) actions.push_back(entry.action + " " + entry.detail);
    return actions;
  }
  library::Health::Finding finding() const {
    const auto findings = health_.state().findings;
    const auto found =
        std::ranges::find(findings, CutOffWatch::kSubject, &library::Health::Finding::subject);
    return found == findings.end() ? library::Health::Finding{} : *found;
  }

  const test_support::TemporaryFolder folder_;
  test_support::ManualClock clock_;
  library::Health health_{clock_};
  std::unique_ptr<storage::SqliteStore> sqlite_;
  std::optional<WaitedForStore> store_;
  mutable std::optional<library::AuditTrail> audit_;
  std::optional<CutOffWatch> watch_;
  std::size_t heard_ = 0;
  Result<void> free_;
  int left_ = 0;
};

TEST_F(CutOffWatchTest, AHandOverIsInTheTrailAndCountedBeforeItIsDone) {
  begin();
  heard_ = 1;
  look_for(5s);
  heard_ = 0;
  look_for(1min);
  EXPECT_EQ(left_, 1);
  EXPECT_EQ(store_->noted, (storage::OwnHandOvers{1, false}));
  ASSERT_EQ(trail().size(), 1u);
  EXPECT_EQ(trail()[0].find("server.hand_over this server hears no gateway, and one that waits"),
            0u)
      << trail()[0];
}

TEST_F(CutOffWatchTest, NothingIsHandedOverThatCannotBeCounted) {
  begin();
  store_->is_away = true;
  look_for(20s);
  EXPECT_EQ(left_, 0);
  EXPECT_EQ(finding().detail, "the database is away");
  store_->is_away = false;
  look_for(20s);
  EXPECT_EQ(left_, 1);
}

TEST_F(CutOffWatchTest, ALineAtWorkKeepsTheLibraryAndHealthSaysSo) {
  begin();
  free_ = fail(Errc::Busy, "port 'l-1' is in a run");
  look_for(1min);
  EXPECT_EQ(left_, 0);
  EXPECT_EQ(finding().level, library::Health::Level::Degraded);
  EXPECT_EQ(finding().detail, "port 'l-1' is in a run");
  ASSERT_EQ(trail().size(), 1u) << "once";
  EXPECT_EQ(trail()[0].find("server.stay "), 0u) << trail()[0];
  free_ = {};
  look_for(1min);
  EXPECT_EQ(left_, 1);
}

/// A forger could fill the audit trail otherwise.
TEST_F(CutOffWatchTest, AReasonThatComesAndGoesIsInTheTrailOnceAnHour) {
  begin(0ms);
  for (int i = 0; i < 30; ++i) {
    heard_ = 3;
    look_for(5s);
    EXPECT_EQ(finding().what, "");
    heard_ = 0;
    look_for(20s);
    EXPECT_EQ(finding().detail, "handover-s is 0: only people hand over");
  }
  EXPECT_EQ(trail().size(), 1u);
  clock_.advance(1h);
  heard_ = 3;
  look_for(5s);
  heard_ = 0;
  look_for(20s);
  EXPECT_EQ(trail().size(), 2u);
}

}  // namespace
}  // namespace dripline::app
