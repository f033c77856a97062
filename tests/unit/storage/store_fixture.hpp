#pragma once

#include <stdlib.h>
#include <filesystem>
#include <memory>
#include <string_view>
#include <tuple>

#include <gtest/gtest.h>

#include "storage/postgresql_store.hpp"
#include "storage/sql/database.hpp"
#include "storage/sqlite_store.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/postgresql/test_database.hpp"

namespace dripline::storage {

/// A folder of its own for one test, gone afterwards.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

using test_support::ManualClock;

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}
inline std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// NC text of exactly `size` bytes; another `seed`, another text.
std::string nc_text(std::size_t size, unsigned seed = 1);

Record make_record(std::uint64_t number, const std::string& run = "r1",
                   const std::string& kind = "output");
RecordBatch make_batch(std::uint64_t first, std::uint64_t last, const std::string& run = "r1");

/// A store in a folder of its own, and the steps most tests begin with.
class StoreTest : public testing::Test {
 protected:
  using Run = storage::Run;  // and not Google Test's function

  /// Skipped where the engine is not installed.
  explicit StoreTest(sql::Engine engine = sql::Engine::Sqlite);

  /// As after a restart of the server.
  void reopen();

  std::string begin(const std::string& program);
  /// Pushes the text in pieces of `piece` bytes.
  Result<Revision> push(const std::string& program, std::string_view text,
                        std::size_t piece = 1 << 20);
  std::string pull(const Digest& content);
  /// A machine m1, a program p.nc and a run of it.
  Run make_run(const std::string& id);
  /// Reads one number straight from the database.
  std::int64_t query(const std::string& sql);
  /// Changes the database after the store's back; the store is closed while that happens. What
  /// SQLite writes otherwise than PostgreSQL (x'00', CAST AS BLOB, zeroblob) is translated.
  void damage(const std::string& sql);
  /// The same while the store is open.
  void change(const std::string& sql);

  const sql::Engine engine_;
  TemporaryDirectory directory_;
  SqliteStoreOptions options_;
  std::unique_ptr<test::TestDatabase> database_;  ///< of PostgreSQL
  ManualClock clock_;
  std::unique_ptr<OpenedStore> store_;
};

/// What every engine promises: each test runs on both.
class ContractTest : public StoreTest, public testing::WithParamInterface<sql::Engine> {
 protected:
  ContractTest() : StoreTest(GetParam()) {}
};

/// The same with a row of a table.
template <class Row>
class ContractTestOf : public StoreTest,
                       public testing::WithParamInterface<std::tuple<sql::Engine, Row>> {
 protected:
  ContractTestOf() : StoreTest(std::get<0>(this->GetParam())) {}
  const Row& given() const { return std::get<1>(this->GetParam()); }
};

inline std::string name_of(sql::Engine engine) {
  return engine == sql::Engine::Sqlite ? "Sqlite" : "Postgresql";
}

// The names: "RunTest.NeverLeavesAFinalState/Postgresql", with a row
// "BadPortTest.Is.../Name_Sqlite".
#define ON_BOTH_ENGINES(Fixture)                                                          \
  INSTANTIATE_TEST_SUITE_P(, Fixture,                                                     \
                           testing::Values(sql::Engine::Sqlite, sql::Engine::Postgresql), \
                           [](const auto& i) { return name_of(i.param); })
#define ON_BOTH_ENGINES_WITH(Fixture, ...)                                            \
  INSTANTIATE_TEST_SUITE_P(                                                           \
      , Fixture,                                                                      \
      testing::Combine(testing::Values(sql::Engine::Sqlite, sql::Engine::Postgresql), \
                       testing::Values(__VA_ARGS__)),                                 \
      [](const auto& i) {                                                             \
        return std::get<1>(i.param).name + ("_" + name_of(std::get<0>(i.param)));     \
      })

}  // namespace dripline::storage
