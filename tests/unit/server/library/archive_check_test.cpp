#include "server/library/history/archive_check.hpp"

#include <filesystem>
#include <fstream>

#include "server/library/history/retention.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::library {
namespace {

/// Two archives of five records each.
class ArchiveCheckTest : public server_test::ServerTest {
 protected:
  ArchiveCheckTest() {
    add_machine("lathe-1");
    std::filesystem::create_directory(folder());
    archive();
    archive();
  }
  std::filesystem::path folder() const { return folder_.path() / "archives"; }
  std::filesystem::path file(std::uint64_t first) const {
    return folder() / fmt::format("records-lathe-1-7-{}.jsonl.zst", first);
  }
  void archive() {
    storage::RecordBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 7;
    for (int n = 0; n < 5; ++n) {
      storage::Record record;
      record.machine = "lathe-1";
      record.epoch = 7;
      record.number = ++last_;
      record.time = clock_.now();
      record.kind = "output";
      record.text = fmt::format("D {}", last_);
      batch.records.push_back(record);
    }
    ASSERT_TRUE(store_->records.store(batch));
    clock_.advance(std::chrono::hours(100));
    Retention::Options options;
    options.records.age = std::chrono::hours(24);
    Retention retention({.store = *store_,
                         .clock = clock_,
                         .folder = folder(),
                         .database = "db",
                         .made_by = "test"},
                        options);
    ASSERT_EQ(retention.apply(), 1u);
  }
  ArchiveCheck make() {
    return ArchiveCheck({.store = *store_, .clock = clock_, .folder = folder()});
  }
  /// "FILE: WHAT" of every fault.
  static std::vector<std::string> faults(const std::optional<ArchiveCheck::State>& state) {
    std::vector<std::string> all;
    if (!state) return {"not checked"};
    for (const auto& fault : state->faults) all.push_back(fault.file + ": " + fault.what);
    return all;
  }
  static std::vector<std::string> checked(ArchiveCheck& check) {
    const auto state = check.check();
    EXPECT_TRUE(state) << state.error().what;
    return faults(check.state());
  }
  /// In place, with the same size; the last byte is of the end's digest.
  static void change(const std::filesystem::path& path) {
    std::fstream bytes(path, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(-1, std::ios::end);
    const auto last = static_cast<char>(bytes.get());
    bytes.seekp(-1, std::ios::end);
    bytes.put(static_cast<char>(last ^ 1));
  }
  void run_sql(const std::string& sql) {
    close_store();
    {
      auto database = storage::sqlite::Database::open(folder_.path() / "store.sqlite");
      ASSERT_TRUE(database) << database.error().what;
      ASSERT_TRUE(database->execute(sql));
    }
    reopen();
  }

  std::uint64_t last_ = 0;
};

TEST_F(ArchiveCheckTest, FindsNothingWhereAllIsAsItWasWritten) {
  auto check = make();
  EXPECT_FALSE(check.state());
  EXPECT_EQ(check.finding().level, Health::Level::Ok);
  EXPECT_EQ(checked(check), std::vector<std::string>{});
  EXPECT_EQ(check.state()->archives, 2u);
  ASSERT_TRUE(check.look());
  EXPECT_EQ(check.finding().level, Health::Level::Ok);
}

TEST_F(ArchiveCheckTest, NamesAFileThatIsMissing) {
  std::filesystem::remove(file(6));
  auto check = make();
  EXPECT_EQ(checked(check),
            std::vector<std::string>{"records-lathe-1-7-6.jsonl.zst: it is missing"});
  EXPECT_EQ(check.finding().level, Health::Level::Degraded);
  EXPECT_EQ(check.finding().subject, "archives");
  EXPECT_EQ(check.finding().detail, "records-lathe-1-7-6.jsonl.zst: it is missing");
}

TEST_F(ArchiveCheckTest, NamesAFileThatWasChanged) {
  change(file(1));
  auto check = make();
  const auto found = checked(check);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(
      found[0].starts_with("records-lathe-1-7-1.jsonl.zst: it was changed: its SHA-256 is "))
      << found[0];
}

/// Without reading all files again.
TEST_F(ArchiveCheckTest, NoticesWithinSecondsWhatHappensLater) {
  auto check = make();
  ASSERT_TRUE(check.look());
  EXPECT_FALSE(check.state()) << "nothing is known before the first check";
  ASSERT_EQ(checked(check).size(), 0u);
  const auto kept = folder() / "kept";
  std::filesystem::copy_file(file(1), kept);
  change(file(1));
  ASSERT_TRUE(check.look());
  EXPECT_EQ(faults(check.state()).size(), 1u);
  std::filesystem::remove(file(1));
  ASSERT_TRUE(check.look());
  EXPECT_EQ(faults(check.state()),
            std::vector<std::string>{"records-lathe-1-7-1.jsonl.zst: it is missing"});
  std::filesystem::rename(kept, file(1));
  ASSERT_TRUE(check.look());
  EXPECT_EQ(check.finding().level, Health::Level::Ok) << "it is back as it was";
  archive();
  ASSERT_TRUE(check.look());
  EXPECT_EQ(check.state()->archives, 3u);
  change(file(11));
  ASSERT_TRUE(check.look());
  EXPECT_EQ(faults(check.state()).size(), 1u);
}

/// Who can write into the database can make the list fit his file, but not the chain.
TEST_F(ArchiveCheckTest, BelievesTheAuditTrailAndNotTheList) {
  run_sql("UPDATE archive SET sha256 = zeroblob(32) WHERE first = 1");
  auto first = make();
  auto found = checked(first);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("7-1.jsonl.zst: it is listed with the SHA-256 0000"), std::string::npos);
  run_sql("DELETE FROM archive WHERE first = 1");
  std::filesystem::remove(file(1));
  auto again = make();
  found = checked(again);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].find("it is not listed, audit entry "), std::string::npos);
  EXPECT_NE(found[1].find("it is missing"), std::string::npos);
}

}  // namespace
}  // namespace dripline::library
