#include "server/library/history/retention.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

/// Corrections whose parts retention moves into archives.
class ArchivedHistory : public OffsetsTest {
 protected:
  ArchivedHistory() { std::filesystem::create_directory(folder_.path() / "archives"); }

  /// All but the newest `rows` measurements, in archives of two rows.
  void archive(std::uint64_t rows) {
    library::Retention::Options options;
    options.measurements = {.age = {}, .rows = rows};
    options.file_rows = 2;
    library::Retention retention({.store = *store_,
                                  .clock = clock_,
                                  .folder = folder_.path() / "archives",
                                  .database = "db",
                                  .made_by = "test"},
                                 options);
    const auto made = retention.apply();
    ASSERT_TRUE(made) << made.error().what;
    ASSERT_GT(*made, 0U);
  }
  HistoryEntry only_entry() {
    const auto history = offsets_->history().list("lathe-1", "T3", {});
    EXPECT_TRUE(history) << history.error().what;
    EXPECT_EQ(history->size(), 1U);
    return history->front();
  }
};

TEST_F(ArchivedHistory, CountsThePartsThatAreInArchivesAndNamesThem) {
  for (int i = 0; i < 5; ++i) measure(40.01);
  archive(1);
  const auto left = store_->measurements.parts({.machine = "lathe-1"}, {});
  ASSERT_LT(left->size(), 3U) << "most are in archives";
  const HistoryEntry entry = only_entry();
  EXPECT_EQ(entry.runs.size(), 5U);
  EXPECT_EQ(entry.parts, 5U);
  EXPECT_EQ(entry.good, 5U);
  EXPECT_EQ(entry.archived, 5U - left->size());
  const auto archives = store_->archives.list({});
  ASSERT_EQ(entry.archives.size(), archives->size());
  for (const auto& archive : *archives) {
    EXPECT_NE(std::ranges::find(entry.archives, archive.file), entry.archives.end())
        << archive.file;
  }
  EXPECT_TRUE(entry.uncounted.empty());
}

/// Rows leave some at a time: a kill in between must neither lose a part nor count it twice.
TEST_F(ArchivedHistory, CountsEachPartOnceWhileItsArchiveIsTakenOut) {
  for (int i = 0; i < 4; ++i) measure(40.01);
  const auto id = store_->archives.add({.kind = storage::ArchiveKind::Measurements,
                                        .first = 1,
                                        .last = 4,
                                        .file = "measurements-1.jsonl.zst",
                                        .created = clock_.now()},
                                       "retention");
  ASSERT_TRUE(id) << id.error().what;
  std::uint64_t steps = 0;
  for (;; ++steps) {
    EXPECT_EQ(only_entry().parts, 4U) << "after " << steps;
    const auto removed = store_->archives.remove_rows(*id, 1);
    ASSERT_TRUE(removed) << removed.error().what;
    if (*removed == 0) break;
  }
  EXPECT_EQ(steps, 8U) << "four values and four parts";
  EXPECT_EQ(only_entry().archived, 4U);
}

/// Before version 17 of the database nothing was counted when parts left.
TEST_F(ArchivedHistory, NamesArchivesOfBeforeThereWereCounts) {
  measure(40.01);
  storage::Archive old{.kind = storage::ArchiveKind::Measurements,
                       .first = 100,
                       .last = 110,
                       .file = "measurements-100.jsonl.zst",
                       .first_time = clock_.now() - std::chrono::hours(1),
                       .last_time = clock_.now() + std::chrono::hours(1),
                       .created = clock_.now()};
  ASSERT_TRUE(store_->archives.add(old, "retention"));
  old.file = "measurements-1.jsonl.zst";  // of long before the run
  old.first_time -= std::chrono::hours(48);
  old.last_time = old.first_time;
  ASSERT_TRUE(store_->archives.add(old, "retention"));
  EXPECT_TRUE(only_entry().uncounted.empty());
  auto database = storage::sqlite::Database::open(file());
  ASSERT_TRUE(database->execute("UPDATE archive SET is_counted = 0"));
  EXPECT_EQ(only_entry().uncounted, std::vector<std::string>{"measurements-100.jsonl.zst"});
}

/// What was derived again does not count, wherever it is.
TEST_F(ArchivedHistory, LeavesOutWhatWasDerivedAgain) {
  const std::string run = measure(40.01);
  storage::DerivedBatch nothing;
  nothing.machine = "lathe-1";
  ASSERT_TRUE(store_->measurements.replace(run, nothing));
  measure(40.01);
  archive(1);
  EXPECT_TRUE(store_->measurements.parts({.run = run, .with_superseded = true}, {})->empty());
  EXPECT_EQ(only_entry().parts, 1U);
  EXPECT_EQ(only_entry().archived, 0U);
}

}  // namespace
}  // namespace dripline::offsets
