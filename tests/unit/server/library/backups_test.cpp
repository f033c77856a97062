#include "server/library/backups.hpp"

#include <algorithm>

#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

using library::Backups;
using library::Health;
using std::chrono::hours;
using test_support::eventually;

class BackupsTest : public ServerTest {
 protected:
  void begin(hours every = hours(24)) {
    auto folder = backup::BackupFolder::open(folder_.path() / "backups");
    ASSERT_TRUE(folder) << folder.error().what;
    backup::Source source{
        .folder = folder_.path(),
        .database = "store.sqlite",
        .files = {},
        .made_by = "dncd 1",
        .copy = [this](const std::filesystem::path& copy, const auto& proceed) -> Result<bool> {
          if (is_broken) return fail(Errc::Io, "disk full: /backups");
          return store_->copy_to(copy, proceed);
        }};
    backups_ = std::make_unique<Backups>(
        Backups::Parts{.folder = *std::move(folder),
                       .source = std::move(source),
                       .audit = *audit_,
                       .health = health_,
                       .clock = clock_},
        Backups::Options{
            .every = every,
            .retention = {.every = std::chrono::days(14), .weekly = std::chrono::weeks(26)},
            .look_every = std::chrono::milliseconds(2)});
  }
  std::size_t count() { return backups_->state().list.backups.size(); }
  /// Another backup than those that are there, and read once.
  bool reaches(std::size_t wanted) {
    return eventually([&] {
      const auto state = backups_->state();
      return !state.work && state.list.backups.size() == wanted &&
             std::ranges::any_of(state.list.backups,
                                 [](const auto& made) { return made.verified.has_value(); });
    });
  }
  std::string finding() {
    for (const auto& found : health_.state().findings)
      if (found.subject == "backup") return found.what + ": " + found.detail;
    return {};
  }

  Health health_{clock_};
  std::atomic<bool> is_broken = false;
  std::unique_ptr<Backups> backups_;
};

TEST_F(BackupsTest, AreMadeWhenTheyAreDueAndReadOnce) {
  push("O0100", "O0100\nM30\n");
  begin();
  ASSERT_TRUE(reaches(1));
  clock_.advance(hours(23));
  EXPECT_FALSE(eventually([&] { return count() > 1; }, std::chrono::milliseconds(50)));
  clock_.advance(hours(1));
  ASSERT_TRUE(reaches(2));
  EXPECT_EQ(finding(), "");
}

TEST_F(BackupsTest, SurviveARestartOfTheServer) {
  begin();
  ASSERT_TRUE(reaches(1));
  backups_.reset();
  begin();
  EXPECT_EQ(count(), 1u);
  EXPECT_FALSE(eventually([&] { return count() > 1; }, std::chrono::milliseconds(50)));
}

TEST_F(BackupsTest, WithoutAScheduleAreMadeOnRequest) {
  begin(hours(0));
  clock_.advance(hours(24 * 365));
  EXPECT_FALSE(eventually([&] { return count() > 0; }, std::chrono::milliseconds(50)));
  EXPECT_FALSE(backups_->state().is_overdue);
  ASSERT_TRUE(backups_->begin_make("anna"));
  ASSERT_TRUE(eventually([&] { return backups_->state().last.has_value(); }));
  const auto state = backups_->state();
  EXPECT_EQ(state.last->error, "");
  ASSERT_EQ(state.list.backups.size(), 1u);
  EXPECT_EQ(state.last->id, state.list.backups[0].id);
  const auto entries = audit_->entries({});
  ASSERT_TRUE(entries);
  EXPECT_EQ(entries->at(0).action, "backup.make");
  EXPECT_EQ(entries->at(0).who.name, "anna");
}

TEST_F(BackupsTest, ThatFailIsAFindingAndTriedAgain) {
  is_broken = true;
  begin();
  ASSERT_TRUE(eventually([&] { return !finding().empty(); }));
  EXPECT_NE(finding().find("disk full"), std::string::npos) << finding();
  EXPECT_EQ(count(), 0u);
  is_broken = false;
  EXPECT_FALSE(eventually([&] { return count() > 0; }, std::chrono::milliseconds(50)))
      << "not again and again at once";
  clock_.advance(hours(1));
  ASSERT_TRUE(reaches(1));
  EXPECT_TRUE(eventually([&] { return finding().empty(); })) << finding();
}

TEST_F(BackupsTest, ThatAreOverdueAreAFinding) {
  begin();
  ASSERT_TRUE(reaches(1));
  is_broken = true;
  clock_.advance(hours(49));
  ASSERT_TRUE(eventually([&] { return backups_->state().is_overdue; }));
  EXPECT_TRUE(eventually([&] { return !finding().empty(); }));
}

/// The clock was a year ahead for one backup.
TEST_F(BackupsTest, OfATimeThatHasNotComeReplaceNoneAndAreAFinding) {
  begin();
  ASSERT_TRUE(reaches(1));
  clock_.advance(hours(24 * 400));
  ASSERT_TRUE(reaches(2)) << "the one before is still there";
  clock_.advance(-hours(24 * 400));
  ASSERT_TRUE(eventually([&] { return finding().find("has not come") != std::string::npos; }));
  clock_.advance(hours(24));
  ASSERT_TRUE(reaches(3)) << "they are made beside it";
  EXPECT_FALSE(backups_->state().is_overdue);
  const std::string ahead = backups_->state().list.backups.back().id;
  ASSERT_TRUE(backups_->remove(storage::Actor("cam", "test"), ahead));
  EXPECT_TRUE(eventually([&] { return finding().empty(); })) << finding();
}

TEST_F(BackupsTest, ThatAreDamagedAreFoundByTheWeeklyReading) {
  push("O0100", "O0100\nM30\n");
  begin();
  ASSERT_TRUE(reaches(1));
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(folder_.path() / "backups" / "chunks"))
    if (entry.is_regular_file()) std::filesystem::resize_file(entry.path(), 5);
  clock_.advance(hours(24 * 8));  // the next is made of chunks that seem to be there
  ASSERT_TRUE(eventually([&] { return finding().find("damaged") != std::string::npos; }))
      << finding();
  clock_.advance(hours(24));  // and the one after it stores them again
  EXPECT_TRUE(eventually([&] { return finding().empty(); })) << finding();
}

TEST_F(BackupsTest, AreRemovedOnRequestButNotTheOnlyOne) {
  begin();
  ASSERT_TRUE(reaches(1));
  const std::string only = backups_->state().list.backups.at(0).id;
  EXPECT_EQ(backups_->remove("anna", only).error().code, Errc::Conflict);
  clock_.advance(hours(24));
  ASSERT_TRUE(reaches(2));
  EXPECT_TRUE(backups_->remove("anna", only));
  EXPECT_EQ(count(), 1u);
  EXPECT_EQ(backups_->remove("anna", only).error().code, Errc::NotFound);
  EXPECT_EQ(backups_->begin_verify("anna", only).error().code, Errc::NotFound);
}

}  // namespace
}  // namespace dripline::server_test
