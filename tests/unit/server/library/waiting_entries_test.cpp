#include "server/library/waiting_entries.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "server/library/audit_trail.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;
using library::WaitingEntries;

/// A trail whose store is away, or takes nothing of what is asked.
class AwayAudit final : public storage::AuditStore {
 public:
  Result<void> add(const storage::AuditEntry& entry) override {
    if (is_away) return fail(Errc::Io, "the database is away");
    const std::lock_guard lock(mutex_);
    entries_.push_back(entry);
    return {};
  }
  Result<std::vector<storage::AuditEntry>> list(storage::Page) override {
    const std::lock_guard lock(mutex_);
    return entries_;
  }
  Result<std::vector<storage::ChainedEntry>> chained(std::uint64_t, std::uint64_t) override {
    return fail(Errc::Unsupported, "not here");
  }
  Result<std::vector<audit::Checkpoint>> checkpoints(std::uint64_t, std::uint64_t) override {
    return fail(Errc::Unsupported, "not here");
  }
  Result<void> add_checkpoint(const audit::Checkpoint&) override { return {}; }
  Result<std::optional<storage::ChainedEntry>> run_end(const std::string&) override {
    return std::nullopt;
  }
  Result<std::optional<std::string>> run_without_end() override { return std::nullopt; }

  std::atomic<bool> is_away = true;

 private:
  std::mutex mutex_;
  std::vector<storage::AuditEntry> entries_;
};

class WaitingEntriesTest : public testing::Test {
 protected:
  static library::AuditTrail::Change abort_of(const std::string& run) {
    return {.who = {"olga", "phone", "10.0.0.7"},
            .action = "run.abort",
            .subject = run,
            .detail = "smoke \"near\" the door\n\xff"};
  }
  std::filesystem::path path() const { return folder_.path() / "audit-waiting"; }
  std::size_t files() const {
    std::error_code ec;
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path(), ec), {}));
  }
  /// One life of a server.
  struct Life {
    Life(AwayAudit& store, const std::filesystem::path& folder)
        : kept(folder), trail(store, clock, library::AuditTrail::Late{writer, kept}) {}
    SystemClock clock;
    library::LateWriter writer{{.retry = 5ms, .patience = 20ms}};
    WaitingEntries kept;
    library::AuditTrail trail;
  };

  test_support::TemporaryFolder folder_;
  AwayAudit store_;
};

TEST_F(WaitingEntriesTest, AreWrittenByTheNextLifeInTheirOrderAndOnce) {
  {
    Life life(store_, path());
    for (int run = 1; run <= 5; ++run) life.trail.write_late(abort_of(fmt::format("r-{}", run)));
    EXPECT_EQ(files(), 5u);
  }
  EXPECT_TRUE(store_.list({})->empty());
  store_.is_away = false;
  Life life(store_, path());
  EXPECT_EQ(life.trail.write_kept(), 0u);
  const auto entries = [&] { return store_.list({}).value(); };
  ASSERT_TRUE(test_support::eventually([&] { return entries().size() == 5 && files() == 0; }));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(entries()[i].subject, fmt::format("r-{}", i + 1));
  const auto first = entries().front();
  EXPECT_EQ(first.who.name, "olga");
  EXPECT_EQ(first.who.credential, "phone");
  EXPECT_EQ(first.who.address, "10.0.0.7");
  EXPECT_EQ(first.action, "run.abort");
  EXPECT_EQ(first.detail, "smoke \"near\" the door\n\xef\xbf\xbd") << "no text of ours is bytes";
  EXPECT_LT(life.clock.now() - first.time, 60s);
  EXPECT_EQ(life.trail.write_kept(), 0u);
  EXPECT_EQ(entries().size(), 5u);
}

TEST_F(WaitingEntriesTest, AreNoFilesOnceTheStoreHasThem) {
  store_.is_away = false;
  Life life(store_, path());
  life.trail.write_late(abort_of("r-1"));
  EXPECT_TRUE(test_support::eventually([&] { return store_.list({})->size() == 1; }));
  EXPECT_TRUE(test_support::eventually([&] { return files() == 0; }));
}

/// A stop is written all the same, and its answer does not depend on a disk.
TEST_F(WaitingEntriesTest, AreWrittenWhereNoFileCanBeMade) {
  std::ofstream(path()) << "no folder";
  Life life(store_, path());
  life.trail.write_late(abort_of("r-1"));
  store_.is_away = false;
  EXPECT_TRUE(test_support::eventually([&] { return store_.list({})->size() == 1; }));
}

TEST_F(WaitingEntriesTest, AreTheServersAloneAndSkipWhatIsNoEntry) {
  WaitingEntries kept(path());
  const auto name = kept.keep(
      {.time = UtcTime(5us), .who = "a", .action = "run.hold", .subject = {}, .detail = {}});
  ASSERT_TRUE(name) << name.error().what;
  struct stat facts {};
  ASSERT_EQ(::stat((path() / *name).c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 077u, 0u);
  ASSERT_EQ(::stat(path().c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 077u, 0u);
  std::ofstream(path() / "0-bad.json") << "{\"time\": 5}";
  std::ofstream(path() / "1-cut.json") << "{\"time\": \"2026-11-2";
  std::ofstream(path() / "2.json.new") << "{}";
  std::filesystem::create_directory(path() / "3-folder.json");
  ASSERT_EQ(::mkfifo((path() / "4-pipe.json").c_str(), 0600), 0) << "read, it would wait for ever";
  const auto read = kept.read();
  ASSERT_EQ(read.kept.size(), 1u);
  EXPECT_EQ(read.kept.front().entry.time, UtcTime(5us));
  EXPECT_EQ(read.kept.front().entry.action, "run.hold");
  EXPECT_EQ(read.failures, 4u) << "and the health of the server says so";
  EXPECT_TRUE(std::filesystem::exists(path() / "1-cut.json")) << "a person may read it";
  EXPECT_FALSE(std::filesystem::exists(path() / "2.json.new"));
}

}  // namespace
}  // namespace dripline::server_test
