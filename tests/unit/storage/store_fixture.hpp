#pragma once

#include <stdlib.h>
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

#include "storage/sqlite_store.hpp"

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

/// A clock the test moves.
class ManualClock final : public Clock {
 public:
  UtcTime now() const override { return now_; }
  SteadyTime steady_now() const override { return SteadyTime{now_.time_since_epoch()}; }
  void advance(std::chrono::microseconds step) { now_ += step; }

 private:
  UtcTime now_{std::chrono::microseconds{1'700'000'000'000'000}};
};

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

  StoreTest() {
    options_.file = directory_ / "store.sqlite";
    reopen();
  }

  /// As after a restart of the server.
  void reopen();

  std::string begin(const std::string& program);
  /// Pushes the text in pieces of `piece` bytes.
  Result<Revision> push(const std::string& program, std::string_view text,
                        std::size_t piece = 1 << 20);
  std::string pull(const Digest& content);
  /// A machine m1, a program p.nc and a run of it.
  Run make_run(const std::string& id);
  /// Reads one number straight from the file.
  std::int64_t query(const std::string& sql);
  /// Changes the file after the store's back; the store is closed while that happens.
  void damage(const std::string& sql);

  TemporaryDirectory directory_;
  SqliteStoreOptions options_;
  ManualClock clock_;
  std::unique_ptr<SqliteStore> store_;
};

}  // namespace dripline::storage
