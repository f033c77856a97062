#include "server/app/open_store.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "storage/postgresql/database.hpp"
#include "tests/support/postgresql/test_database.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::app {
namespace {

class OpenStore : public testing::Test {
 protected:
  Result<KeptStore> open(const Settings& settings) {
    auto folder = StateFolder::open(folder_.path().string());
    EXPECT_TRUE(folder) << folder.error().what;
    return open_store(*folder, settings, clock_);
  }
  void expect_refused(const Settings& settings, const std::string& says) {
    const auto refused = open(settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Errc::Unsupported);
    EXPECT_NE(refused.error().what.find(says), std::string::npos) << refused.error().what;
    EXPECT_EQ(refused.error().what.find("secret"), std::string::npos) << refused.error().what;
  }

  test_support::TemporaryFolder folder_;
  SystemClock clock_;
};

TEST_F(OpenStore, IsAFileInTheFolderByDefault) {
  const auto kept = open({});
  ASSERT_TRUE(kept) << kept.error().what;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / StateFolder::kDatabase));
  EXPECT_EQ(kept->identity, kept->store->identity().value());
  EXPECT_FALSE(kept->folder_lock);
  EXPECT_EQ(kept->cache, nullptr) << "its text is on this disk already";
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "cache"));
}

TEST_F(OpenStore, OtherDatabasesAreRefusedWithoutRepeatingAPassword) {
  Settings settings;
  settings.store = "mysql://anna:secret@db-1/shop";
  expect_refused(settings, "begins with postgresql://");
}

TEST_F(OpenStore, BackupsOfAFileAreNoneOfPostgresql) {
  Settings settings;
  settings.store = "postgresql://anna:secret@db-1/shop";
  settings.backups = "/var/lib/dripline-backups";
  expect_refused(settings, "/var/lib/dripline-backups");
}

TEST_F(OpenStore, PostgresqlIsNotBegunEmpty) {
  Settings settings;
  settings.store = "postgresql://anna:secret@db-1/shop";
  settings.begin_empty = true;
  expect_refused(settings, "database.id");
}

TEST_F(OpenStore, WhatAFileHoldsIsMovedBeforePostgresqlIsUsed) {
  ASSERT_TRUE(open({}));
  Settings settings;
  settings.store = "postgresql://127.0.0.1:1/shop";
  const auto refused = open(settings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict) << "before anything is connected";
  EXPECT_NE(refused.error().what.find("dnc server migrate --to"), std::string::npos)
      << refused.error().what;
}

TEST_F(OpenStore, AFileThatWasMigratedIsNotBegunAnew) {
  ASSERT_TRUE(open({}));
  const auto file = folder_.path() / StateFolder::kDatabase;
  std::filesystem::rename(file, file.string() + ".migrated");
  const auto refused = open({});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("migrated to a PostgreSQL database"), std::string::npos)
      << refused.error().what;
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(OpenStore, AMigrationIntoTheFolderThatWasEndedIsToBeRunAgain) {
  ASSERT_TRUE(open({}));
  const auto file = folder_.path() / StateFolder::kDatabase;
  std::filesystem::rename(file, file.string() + ".migrated");
  std::filesystem::copy_file(file.string() + ".migrated", file.string() + ".migrating");
  const auto refused = open({});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("run the migration again (dnc server migrate"),
            std::string::npos)
      << refused.error().what;
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// Killed between its last transaction and its last rename: the database names the folder.
TEST_F(OpenStore, ADatabaseThatWasLeftForAFileWithoutItsNameSaysSo) {
  const auto made = test::TestDatabase::make();
  if (made == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
  auto database = storage::postgresql::Database::connect({.url = made->url()});
  ASSERT_TRUE(database) << database.error().what;
  ASSERT_TRUE(database->execute(
      "CREATE TABLE store_migrated (target text NOT NULL); INSERT INTO store_migrated VALUES "
      "('/state/dripline.sqlite')"));
  Settings settings;
  settings.store = made->url();
  const auto left = open(settings);
  ASSERT_FALSE(left);
  EXPECT_NE(left.error().what.find("was migrated to /state/dripline.sqlite"), std::string::npos)
      << left.error().what;
  std::ofstream(folder_.path() / (std::string(StateFolder::kDatabase) + ".migrating")) << "rows";
  const auto refused = open(settings);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("it was ended before its last step"), std::string::npos)
      << refused.error().what;
  EXPECT_EQ(refused.error().what.find("DROP TABLE"), std::string::npos) << refused.error().what;
}

TEST_F(OpenStore, OneProcessUsesAFolderWithADatabaseElsewhere) {
  const auto folder = StateFolder::open(folder_.path().string());
  const auto lock = folder->lock();
  ASSERT_TRUE(lock) << lock.error().what;
  Settings settings;
  settings.store = "postgresql://127.0.0.1:1/shop";
  const auto refused = open(settings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  EXPECT_EQ(folder->server_id().value(), folder->server_id().value())
      << "it is the same at the next start";
}

}  // namespace
}  // namespace dripline::app
