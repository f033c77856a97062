#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <thread>

#include "storage/sqlite/database.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

using OpeningTest = StoreTest;

TEST_F(OpeningTest, OneProcessUsesAFile) {
  const auto second = SqliteStore::open(options_, clock_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  EXPECT_NE(second.error().what.find(options_.file.string()), std::string::npos);
  store_.reset();
  EXPECT_TRUE(SqliteStore::open(options_, clock_));
}

TEST_F(OpeningTest, ANewerVersionIsRefusedAndUntouched) {
  store_.reset();
  {
    auto database = sqlite::Database::open(options_.file);
    ASSERT_TRUE(database->execute("PRAGMA user_version = 1000"));
  }
  const auto refused = SqliteStore::open(options_, clock_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
  EXPECT_NE(refused.error().what.find("1000"), std::string::npos) << refused.error().what;
  EXPECT_EQ(query("PRAGMA user_version"), 1000);
}

TEST_F(OpeningTest, AMissingFolderIsAnIoErrorThatNamesIt) {
  options_.file = directory_ / "missing/store.sqlite";
  const auto refused = SqliteStore::open(options_, clock_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Io);
  EXPECT_NE(refused.error().what.find("missing"), std::string::npos) << refused.error().what;
}

/// A disk that fills up: the database may not grow beyond 3 MiB.
class FullDisk : public StoreTest {
 protected:
  void SetUp() override {
    options_.max_bytes = 3 << 20;
    options_.file = directory_ / "small.sqlite";
    reopen();
    ASSERT_TRUE(store_->runs.create(make_run("r1")));
    ballast_ = begin("ballast.nc");
    for (std::uint64_t at = 0;; at += kPiece) {
      const auto appended = store_->uploads.append(
          ballast_, at, bytes_of(nc_text(kPiece, static_cast<unsigned>(at))));
      if (appended) continue;
      expect_full(appended.error());
      break;
    }
  }
  static void expect_full(const Error& error) {
    EXPECT_EQ(error.code, Errc::Io);
    EXPECT_NE(error.what.find("disk full"), std::string::npos) << error.what;
  }
  /// Records until the last free page is used, too.
  std::uint64_t fill_with_records() {
    std::uint64_t last = 0;
    for (;;) {
      const auto stored = store_->records.store(make_batch(last + 1, last + 100));
      if (!stored) return expect_full(stored.error()), last;
      last = *stored;
    }
  }
  static constexpr std::size_t kPiece = 300'000;
  std::string ballast_;
};

TEST_F(FullDisk, ChangesNothingAndWorksAgainWhenThereIsRoom) {
  const std::uint64_t last = fill_with_records();
  EXPECT_EQ(store_->machines.find("m1")->last_record, last);
  EXPECT_EQ(store_->runs.find("r1")->outputs, last);
  EXPECT_EQ(query("SELECT count(*) FROM record"), static_cast<std::int64_t>(last));
  EXPECT_TRUE(store_->check());
  EXPECT_EQ(store_->programs.revision("p.nc", 1)->size, 12u) << "reading continues";

  ASSERT_TRUE(store_->uploads.abandon(ballast_)) << "making room needs none";
  EXPECT_EQ(store_->records.store(make_batch(last + 1, last + 100)), last + 100);
  EXPECT_TRUE(push("q.nc", nc_text(kPiece)));
  EXPECT_TRUE(store_->check());
}

TEST_F(FullDisk, LeavesAnUploadWhereItWas) {
  const std::uint64_t received = store_->uploads.find(ballast_)->received;
  ASSERT_FALSE(store_->uploads.append(ballast_, received, bytes_of(nc_text(2 << 20, 9))));
  EXPECT_EQ(store_->uploads.find(ballast_)->received, received);
  ASSERT_TRUE(store_->uploads.commit(ballast_, std::nullopt));
  EXPECT_EQ(pull(store_->programs.revision("ballast.nc", 1)->content).substr(0, kPiece),
            nc_text(kPiece, 0));
}

/// A child writes until it is killed and says through a pipe what was acknowledged to it.
class Killed : public StoreTest {
 protected:
  struct Acknowledged {
    std::uint64_t records = 0;
    std::uint64_t uploaded = 0;
    std::uint64_t revisions = 0;
  };

  [[noreturn]] void write_until_killed(int pipe) {
    auto store = SqliteStore::open(options_, clock_);
    if (!store) ::_exit(1);
    store_ = std::move(*store);
    Acknowledged done;
    const auto machine = store_->machines.find("m1");
    if (machine) done.records = machine->last_record;
    const auto known = store_->programs.revisions("loop.nc");
    if (known) done.revisions = known->size();
    for (;;) {
      const auto stored = store_->records.store(make_batch(done.records + 1, done.records + 20));
      if (!stored) ::_exit(2);
      done.records = *stored;
      const std::string text = nc_text(400'000, static_cast<unsigned>(done.revisions) + 1);
      if (!push("loop.nc", text, 90'000)) ::_exit(3);
      ++done.revisions;
      if (::write(pipe, &done, sizeof done) != sizeof done) ::_exit(4);
    }
  }

  /// Kills the child `delay` after its first acknowledgment; returns the last one.
  Acknowledged kill_writer(std::chrono::microseconds delay) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(ends[1]);
    ::close(ends[1]);
    Acknowledged last, next;
    EXPECT_EQ(::read(ends[0], &last, sizeof last), static_cast<ssize_t>(sizeof last));
    std::this_thread::sleep_for(delay);  // the moment of the kill, not a wait for something
    ::kill(child, SIGKILL);
    while (::read(ends[0], &next, sizeof next) == sizeof next) last = next;
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself: " << WEXITSTATUS(status);
    return last;
  }
};

TEST_F(Killed, AtAnyMomentNothingAcknowledgedIsLost) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  store_.reset();
  unsigned random = 12345;
  for (int round = 0; round < 20; ++round) {
    random = random * 1664525 + 1013904223;
    const Acknowledged last = kill_writer(std::chrono::microseconds(random >> 17));
    reopen();
    ASSERT_TRUE(store_->check());
    const auto stored = store_->machines.find("m1")->last_record;
    EXPECT_GE(stored, last.records);
    EXPECT_EQ(stored % 20, 0u) << "a batch is stored whole or not at all";
    EXPECT_EQ(store_->runs.find("r1")->outputs, stored);
    EXPECT_EQ(query("SELECT count(*) FROM record"), static_cast<std::int64_t>(stored));
    const auto revisions = store_->programs.revisions("loop.nc");
    ASSERT_GE(revisions->size(), last.revisions);
    const Revision& newest = revisions->front();
    EXPECT_EQ(sha256(pull(newest.content)), newest.content);
    EXPECT_EQ(pull(newest.content), nc_text(400'000, static_cast<unsigned>(newest.number)));
    store_.reset();
  }
}

using LostFileTest = StoreTest;

/// What is written into a file without a name is gone when it is closed.
TEST_F(LostFileTest, StoresNothingInAFileThatWasMovedOrReplaced) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  ASSERT_TRUE(store_->probe());
  const auto aside = directory_ / "aside.sqlite";
  std::filesystem::rename(options_.file, aside);
  const auto stored = store_->records.store(make_batch(1, 5));
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().code, Errc::Io);
  EXPECT_NE(stored.error().what.find(options_.file.string()), std::string::npos);
  EXPECT_FALSE(store_->probe());
  EXPECT_TRUE(store_->runs.find("r1")) << "what is known can be read";
  std::filesystem::copy_file(aside, options_.file);
  EXPECT_FALSE(store_->records.store(make_batch(1, 5))) << "a copy is another file";
  std::filesystem::rename(aside, options_.file);
  EXPECT_EQ(store_->records.store(make_batch(1, 5)), 5u);
  EXPECT_TRUE(store_->probe());
}

class ThreadsTest : public ContractTest {};

TEST_P(ThreadsTest, ManyUseOneStoreAtOnce) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  const std::string text = nc_text(700'000);
  const Digest content = push("q.nc", text)->content;
  std::vector<std::jthread> threads;
  threads.emplace_back([&] {
    for (std::uint64_t n = 0; n < 50; ++n) {
      EXPECT_EQ(store_->records.store(make_batch(10 * n + 1, 10 * n + 10)), 10 * n + 10);
    }
  });
  threads.emplace_back([&] {
    for (std::uint64_t n = 1; n <= 200; ++n) {
      EXPECT_TRUE(store_->runs.update_counters({"m1", "r1", {n, n, n}, n, 0}));
    }
  });
  for (unsigned upload = 0; upload < 2; ++upload) {
    threads.emplace_back([&, upload] {
      EXPECT_TRUE(push(fmt::format("u{}.nc", upload), nc_text(900'000, 50 + upload), 70'000));
    });
  }
  for (int reader = 0; reader < 6; ++reader) {
    threads.emplace_back([&] {
      for (std::size_t at = 0; at < text.size(); at += 35'000) {
        const auto bytes = store_->programs.read_content(content, at, 35'000);
        EXPECT_TRUE(bytes && text_of(*bytes) == text.substr(at, 35'000));
        EXPECT_TRUE(store_->runs.find("r1"));
      }
    });
  }
  threads.clear();
  EXPECT_EQ(store_->runs.find("r1")->outputs, 500u);
  EXPECT_EQ(store_->runs.find("r1")->counters.executed, 200u);
  EXPECT_EQ(store_->programs.list({})->size(), 4u);
}

ON_BOTH_ENGINES(ThreadsTest);

}  // namespace
}  // namespace dripline::storage
