// Program text of a database, read through a cache on the server's own disk.
#include "storage/cache/disk_cache.hpp"
#include "storage/programs/chunk_codec.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class NearContentTest : public StoreTest {
 protected:
  NearContentTest() : StoreTest(sql::Engine::Postgresql) {
    if (!IsSkipped()) begin();
  }

  /// As after a start: nothing is in memory.
  void begin(std::uint64_t capacity = 64 << 20) {
    store_.reset();
    auto cache = cache::DiskCache::open(
        {.folder = directory_ / "cache", .capacity = capacity, .reserve = 0});
    ASSERT_TRUE(cache) << cache.error().what;
    cache_ = *std::move(cache);
    auto opened = PostgresqlStore::open(
        {.url = database_->url(), .holder = "srv-1", .content_cache = cache_.get()}, clock_);
    ASSERT_TRUE(opened) << opened.error().what;
    store_ = *std::move(opened);
  }
  Digest pushed(const std::string& text) {
    const auto revision = push("p.nc", text);
    EXPECT_TRUE(revision) << revision.error().what;
    return revision ? revision->content : Digest{};
  }
  std::string near(const Digest& content, std::uint64_t offset, std::uint64_t length) {
    const auto bytes = store_->programs.near_content(content, offset, length);
    return bytes ? text_of(*bytes) : "(not near)";
  }
  void fetch_all(const Digest& content) {
    for (std::uint64_t position = 0;; ++position) {
      const auto fetched = store_->programs.fetch_ahead(content, position);
      ASSERT_TRUE(fetched) << fetched.error().what;
      if (fetched->is_end) return;
      EXPECT_GT(fetched->bytes, 0u);
    }
  }
  /// The database has no text any more, whatever is asked.
  void empty_database() { change("UPDATE chunk SET data = decode('00', 'hex')"); }

  std::unique_ptr<cache::DiskCache> cache_;  // used by the store
  const std::string text_ = nc_text(3 * kChunkBytes + 1000);
};

TEST_F(NearContentTest, WhatWasReadIsReadAgainWithoutTheDatabase) {
  const Digest content = pushed(text_);
  EXPECT_EQ(near(content, 0, 10), "(not near)");
  EXPECT_EQ(pull(content), text_);
  empty_database();
  begin();
  EXPECT_EQ(near(content, 0, text_.size()), text_);
  EXPECT_EQ(pull(content), text_);
  EXPECT_EQ(near(content, text_.size() - 3, 100), text_.substr(text_.size() - 3));
  EXPECT_EQ(near(content, text_.size(), 100), "");
  EXPECT_EQ(cache_->state().misses, 0u);
  EXPECT_EQ(cache_->state().hits, 4u) << "then out of memory";
}

TEST_F(NearContentTest, WhatWasFetchedAheadIsNear) {
  const Digest content = pushed(text_);
  fetch_all(content);
  EXPECT_EQ(cache_->state().ahead, 4u);
  fetch_all(content);
  EXPECT_EQ(cache_->state().ahead, 4u) << "once";
  empty_database();
  EXPECT_EQ(near(content, 0, text_.size()), text_);
}

TEST_F(NearContentTest, APartThatIsNotThereMakesTheRangeNotNear) {
  const Digest content = pushed(text_);
  ASSERT_TRUE(store_->programs.fetch_ahead(content, 0));
  ASSERT_TRUE(store_->programs.fetch_ahead(content, 2));
  EXPECT_EQ(near(content, 0, kChunkBytes), text_.substr(0, kChunkBytes));
  EXPECT_EQ(near(content, 0, kChunkBytes + 1), "(not near)");
  EXPECT_EQ(near(content, 2 * kChunkBytes, 5), text_.substr(2 * kChunkBytes, 5));
}

TEST_F(NearContentTest, ADamagedFileIsReadFromTheDatabaseAndKeptAnew) {
  const Digest content = pushed(text_);
  fetch_all(content);
  const auto chunk = encode_chunks({}, bytes_of(text_)).at(1).digest.hex();
  const auto file = directory_ / "cache" / "chunks" / chunk.substr(0, 2) / chunk;
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_EQ(near(content, kChunkBytes, 5), "(not near)");
  EXPECT_EQ(pull(content), text_);
  EXPECT_EQ(cache_->state().damaged, 1u);
  EXPECT_EQ(cache_->state().misses, 1u);
  begin();
  EXPECT_EQ(near(content, 0, text_.size()), text_);
}

TEST_F(NearContentTest, ADamagedListIsReadFromTheDatabase) {
  const Digest content = pushed(text_);
  fetch_all(content);
  const auto name = content.hex();
  std::filesystem::resize_file(directory_ / "cache" / "lists" / name.substr(0, 2) / name, 100);
  begin();
  EXPECT_EQ(near(content, 0, 5), "(not near)");
  EXPECT_EQ(pull(content), text_);
  EXPECT_EQ(cache_->state().damaged, 1u);
}

/// A start is never made from what the cache says: that there is such a program, whole, is what
/// the database says.
TEST_F(NearContentTest, AListIsVerifiedInTheDatabase) {
  const Digest content = pushed(text_);
  fetch_all(content);
  change("DELETE FROM content_chunk WHERE position = 2");
  EXPECT_EQ(store_->programs.verify_content(content).error().code, Errc::Corrupt);
}

TEST_F(NearContentTest, WhoLostThePlaceServesNothing) {
  const Digest content = pushed(text_);
  EXPECT_EQ(pull(content), text_);
  EXPECT_EQ(near(content, 0, 5), text_.substr(0, 5));
  change("UPDATE store_holder SET holder = 'srv-2', until = now() + interval '1 hour'");
  EXPECT_FALSE(store_->probe()) << "it knows";
  EXPECT_EQ(near(content, 0, 5), "(not near)");
  const auto read = store_->programs.read_content(content, 0, 5);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find("taken over"), std::string::npos) << read.error().what;
  EXPECT_FALSE(store_->programs.fetch_ahead(content, 0));
}

TEST_F(NearContentTest, ACacheThatIsTooSmallHindersNothing) {
  const Digest content = pushed(text_);
  begin(cache::DiskCache::kBlock);
  EXPECT_EQ(pull(content), text_);
  EXPECT_EQ(store_->programs.fetch_ahead(content, 0)->bytes, 0u);
  EXPECT_LE(cache_->state().bytes, cache::DiskCache::kBlock);
}

class WithoutCacheTest : public ContractTest {};

TEST_P(WithoutCacheTest, OnlyWhatIsInMemoryIsNear) {
  const auto revision = push("p.nc", "G00 X1.\n");
  EXPECT_FALSE(store_->programs.near_content(revision->content, 0, 3));
  EXPECT_EQ(pull(revision->content), "G00 X1.\n");
  const auto near = store_->programs.near_content(revision->content, 0, 3);
  ASSERT_TRUE(near);
  EXPECT_EQ(text_of(*near), "G00");
  EXPECT_TRUE(store_->programs.fetch_ahead(revision->content, 0)->is_end) << "there is no cache";
}

ON_BOTH_ENGINES(WithoutCacheTest);

}  // namespace
}  // namespace dripline::storage
