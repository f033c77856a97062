#include "storage/cache/disk_cache.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <fstream>
#include <functional>
#include <thread>

#include "storage/programs/chunk_codec.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::cache {
namespace {

namespace fs = std::filesystem;
using storage::ContentCache;
using storage::ContentList;
using storage::EncodedChunk;
using storage::kChunkBytes;

EncodedChunk chunk_of(unsigned seed, std::size_t size = 20'000) {
  const std::string text = storage::nc_text(size, seed);
  return storage::encode_chunks({}, storage::bytes_of(text)).front();
}

class DiskCacheTest : public testing::Test {
 protected:
  DiskCacheTest() { open(); }

  void open(std::uint64_t capacity = 10 << 20) {
    cache_.reset();
    options_.capacity = capacity;
    options_.reserve = reserve_;
    options_.folder = directory_ / "cache";
    options_.pause = std::chrono::milliseconds(0);
    options_.on_fault = [this](const std::string& fault) { faults_.push_back(fault); };
    auto opened = DiskCache::open(options_);
    ASSERT_TRUE(opened) << opened.error().what;
    cache_ = *std::move(opened);
  }
  void keep(const EncodedChunk& chunk) {
    cache_->keep_chunk(chunk.digest, chunk.data, ContentCache::Reason::Asked);
  }
  std::optional<std::vector<std::byte>> find(const EncodedChunk& chunk) {
    return cache_->find_chunk({content_, chunk.digest}, chunk.size);
  }
  bool has(const EncodedChunk& chunk) {
    const auto found = find(chunk);
    EXPECT_TRUE(!found || sha256(*found) == chunk.digest) << "never wrong bytes";
    return found.has_value();
  }
  fs::path file_of(const char* kind, const Digest& digest) const {
    const std::string name = digest.hex();
    return options_.folder / kind / name.substr(0, 2) / name;
  }
  fs::path file_of(const EncodedChunk& chunk) const { return file_of("chunks", chunk.digest); }
  std::uint64_t bytes_on_disk() const {
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(options_.folder)) {
      if (entry.is_regular_file())
        bytes +=
            (entry.file_size() + DiskCache::kBlock - 1) / DiskCache::kBlock * DiskCache::kBlock;
    }
    return bytes;
  }
  static void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
  }
  static void flip(const fs::path& path, std::uint64_t at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const int byte = file.get();
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(byte ^ 0x08));
  }

  storage::TemporaryDirectory directory_;
  DiskCacheOptions options_;
  std::uint64_t reserve_ = 0;
  std::vector<std::string> faults_;
  std::unique_ptr<DiskCache> cache_;
  const Digest content_ = sha256("a content");
};

TEST_F(DiskCacheTest, GivesBackWhatItWasGiven) {
  const auto chunk = chunk_of(1, kChunkBytes);
  EXPECT_FALSE(has(chunk));
  keep(chunk);
  EXPECT_EQ(storage::text_of(*find(chunk)), storage::nc_text(kChunkBytes, 1));
  const ContentList list{kChunkBytes, {chunk.digest}};
  EXPECT_EQ(cache_->find_list(content_), nullptr);
  cache_->keep_list(content_, list);
  ASSERT_NE(cache_->find_list(content_), nullptr);
  EXPECT_EQ(*cache_->find_list(content_), list);
}

TEST_F(DiskCacheTest, HasItStillAfterARestart) {
  const auto chunk = chunk_of(1);
  keep(chunk);
  cache_->keep_list(content_, {chunk.size, {chunk.digest}});
  const auto before = cache_->state();
  open();
  EXPECT_TRUE(has(chunk));
  EXPECT_NE(cache_->find_list(content_), nullptr);
  EXPECT_EQ(cache_->state().bytes, before.bytes);
  EXPECT_EQ(cache_->state().files, 2u);
}

TEST_F(DiskCacheTest, CountsWhatItGaveAndWhatCameFromTheDatabase) {
  const auto asked = chunk_of(1), ahead = chunk_of(2);
  keep(asked);
  cache_->keep_chunk(ahead.digest, ahead.data, ContentCache::Reason::Ahead);
  EXPECT_TRUE(has(asked));
  EXPECT_TRUE(has(ahead));
  EXPECT_TRUE(has(ahead));
  const auto state = cache_->state();
  EXPECT_EQ(state.hits, 3u);
  EXPECT_EQ(state.misses, 1u);
  EXPECT_EQ(state.ahead, 1u);
  EXPECT_EQ(state.bytes, bytes_on_disk());
}

// -- damage --

struct Damage {
  std::string name;
  std::function<void(const fs::path& file, const fs::path& other)> make;
};

class Damaged : public DiskCacheTest, public testing::WithParamInterface<Damage> {};

std::vector<Damage> damages() {
  const auto flip_at = [](double part) {
    return [part](const fs::path& file, const fs::path&) {
      const auto size = fs::file_size(file);
      std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
      const auto at = std::min<std::uint64_t>(
          size - 1, static_cast<std::uint64_t>(part * static_cast<double>(size)));
      stream.seekg(static_cast<std::streamoff>(at));
      const int byte = stream.get();
      stream.seekp(static_cast<std::streamoff>(at));
      stream.put(static_cast<char>(byte ^ 0x08));
    };
  };
  const auto resized = [](auto size_of) {
    return [size_of](const fs::path& file, const fs::path&) {
      fs::resize_file(file, size_of(fs::file_size(file)));
    };
  };
  return {
      {"FirstByte", flip_at(0)},
      {"Middle", flip_at(0.5)},
      {"LastByte", flip_at(1)},
      {"Truncated", resized([](std::uint64_t size) { return size - 1; })},
      {"Halved", resized([](std::uint64_t size) { return size / 2; })},
      {"Empty", resized([](std::uint64_t) { return std::uint64_t{0}; })},
      {"Longer", resized([](std::uint64_t size) { return size + 1; })},
      {"Enormous", resized([](std::uint64_t) { return std::uint64_t{1} << 40; })},
      {"AnotherOnes",
       [](const fs::path& file, const fs::path& other) {
         fs::copy_file(other, file, fs::copy_options::overwrite_existing);
       }},
      {"Gone", [](const fs::path& file, const fs::path&) { fs::remove(file); }},
      {"ALink",
       [](const fs::path& file, const fs::path& other) {
         fs::remove(file);
         fs::create_symlink(other, file);
       }},
      {"APipe",
       [](const fs::path& file, const fs::path&) {
         fs::remove(file);
         ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
       }},
  };
}

TEST_P(Damaged, ChunkIsAsOneThatIsNotThereAndIsKeptAnew) {
  const auto chunk = chunk_of(1), other = chunk_of(2);
  for (const bool is_restarted : {false, true}) {
    keep(chunk);
    keep(other);
    GetParam().make(file_of(chunk), file_of(other));
    if (is_restarted) open();
    EXPECT_FALSE(has(chunk));
    EXPECT_FALSE(fs::exists(fs::symlink_status(file_of(chunk)))) << "it is removed";
    EXPECT_TRUE(has(other));
    keep(chunk);
    EXPECT_TRUE(has(chunk));
    EXPECT_EQ(cache_->state().bytes, bytes_on_disk());
  }
  EXPECT_EQ(faults_, std::vector<std::string>());
}

TEST_P(Damaged, ListIsAsOneThatIsNotThereAndIsKeptAnew) {
  const Digest other = sha256("another");
  const ContentList list{3, {sha256("c")}}, others{3, {sha256("d")}};
  for (const bool is_restarted : {false, true}) {
    cache_->keep_list(content_, list);
    cache_->keep_list(other, others);
    GetParam().make(file_of("lists", content_), file_of("lists", other));
    if (is_restarted) open();
    EXPECT_EQ(cache_->find_list(content_), nullptr);
    EXPECT_FALSE(fs::exists(fs::symlink_status(file_of("lists", content_))));
    ASSERT_NE(cache_->find_list(other), nullptr);
    EXPECT_EQ(*cache_->find_list(other), others);
    cache_->keep_list(content_, list);
    ASSERT_NE(cache_->find_list(content_), nullptr);
    EXPECT_EQ(*cache_->find_list(content_), list);
  }
}

INSTANTIATE_TEST_SUITE_P(, Damaged, testing::ValuesIn(damages()),
                         [](const auto& i) { return i.param.name; });

TEST_F(DiskCacheTest, NoByteOfAChunkCanBeChangedUnseen) {
  const auto chunk = chunk_of(1, 2000);
  keep(chunk);
  const auto size = fs::file_size(file_of(chunk));
  for (std::uint64_t at = 0; at < size; ++at) {
    flip(file_of(chunk), at);
    has(chunk);  // a bit that zstd does not use changes no text
    keep(chunk);
  }
  EXPECT_TRUE(has(chunk));
  EXPECT_GT(cache_->state().damaged, size / 2);
}

TEST_F(DiskCacheTest, ClearsAwayWhatIsUnfinishedOrForeignAtTheStart) {
  const auto chunk = chunk_of(1);
  keep(chunk);
  const auto& folder = options_.folder;
  const std::string name = chunk.digest.hex();
  const std::vector<fs::path> strange{folder / "unfinished" / "17", folder / "chunks" / "readme",
                                      folder / "chunks" / "3f" / "readme",
                                      folder / "chunks" / "zz" / name,
                                      folder / "lists" / name.substr(0, 2) / (name + "0")};
  for (const auto& path : strange) write(path, "foreign");
  const fs::path strangers_folder = folder / "chunks" / "3f" / "folder";
  fs::create_directories(strangers_folder);
  open();
  for (const auto& path : strange) EXPECT_FALSE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::exists(strangers_folder)) << "what is in it was never ours";
  EXPECT_TRUE(has(chunk));
  EXPECT_EQ(cache_->state().files, 1u);
}

// -- the bound --

TEST_F(DiskCacheTest, DropsWhatWasUsedLongestAgo) {
  open(5 * 8192);
  std::vector<EncodedChunk> chunks;
  for (unsigned i = 0; i < 7; ++i) {
    chunks.push_back(chunk_of(i + 1, 18'000));
    ASSERT_LE(chunks.back().data.size(), 8192u);
    ASSERT_GT(chunks.back().data.size(), 4096u);
  }
  for (int i = 0; i < 5; ++i) keep(chunks[i]);
  EXPECT_TRUE(has(chunks[0]));
  keep(chunks[5]);
  keep(chunks[6]);
  EXPECT_TRUE(has(chunks[0])) << "it was used";
  EXPECT_FALSE(has(chunks[1]));
  EXPECT_FALSE(has(chunks[2]));
  EXPECT_TRUE(has(chunks[3]));
  EXPECT_EQ(bytes_on_disk(), 5u * 8192);
}

TEST_F(DiskCacheTest, KnowsTheOrderOfUseAfterARestart) {
  std::vector<EncodedChunk> chunks;
  using namespace std::chrono_literals;
  for (unsigned i = 0; i < 5; ++i) {
    chunks.push_back(chunk_of(i + 1, 18'000));
    keep(chunks[i]);
    fs::last_write_time(file_of(chunks[i]), fs::file_time_type::clock::now() - 1h + i * 1min);
  }
  EXPECT_GT(cache_->use_chunk(chunks[0].digest), 0u);
  EXPECT_TRUE(has(chunks[1]));
  open(2 * 8192);
  EXPECT_TRUE(has(chunks[0]));
  EXPECT_TRUE(has(chunks[1]));
  for (const unsigned i : {2, 3, 4}) EXPECT_FALSE(has(chunks[i])) << i;
  EXPECT_EQ(bytes_on_disk(), 2u * 8192);
}

TEST_F(DiskCacheTest, AListIsUsedWithItsChunks) {
  open(4 * 8192);
  const auto chunk = chunk_of(1, 18'000);
  cache_->keep_list(content_, {chunk.size, {chunk.digest}});
  keep(chunk);
  for (unsigned i = 2; i < 10; ++i) {
    EXPECT_TRUE(has(chunk));
    keep(chunk_of(i, 18'000));
  }
  EXPECT_NE(cache_->find_list(content_), nullptr);
}

TEST_F(DiskCacheTest, WhatIsBiggerThanAllOfItIsNotKept) {
  open(4096);
  keep(chunk_of(1, kChunkBytes));
  EXPECT_EQ(cache_->state().files, 0u);
  EXPECT_EQ(bytes_on_disk(), 0u);
}

TEST_F(DiskCacheTest, KeepsItsBoundAndItsWordUnderConcurrentUse) {
  constexpr std::uint64_t kCapacity = 20 * 8192;
  open(kCapacity);
  std::vector<EncodedChunk> chunks;
  for (unsigned i = 0; i < 60; ++i) chunks.push_back(chunk_of(i + 1, 18'000));
  std::atomic<bool> is_within = true;
  {
    std::vector<std::jthread> threads;
    for (unsigned t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        unsigned state = t + 1;
        for (int n = 0; n < 1500; ++n) {
          state = state * 1664525 + 1013904223;
          const auto& chunk = chunks[(state >> 16) % chunks.size()];
          if (n % 50 == 0) fs::remove(file_of(chunk));  // someone tidies up
          if (!has(chunk)) keep(chunk);
          is_within = is_within && cache_->state().bytes <= kCapacity;
        }
      });
    }
  }
  EXPECT_TRUE(is_within);
  EXPECT_LE(bytes_on_disk(), kCapacity);
  EXPECT_GT(cache_->state().hits, 0u);
  open(kCapacity);
  EXPECT_EQ(cache_->state().bytes, bytes_on_disk()) << "every file is known";
}

// -- a disk that is full or broken --

TEST_F(DiskCacheTest, ADiskThatIsFullOnlyEndsTheKeepingAndIsNamedOnce) {
  const auto chunk = chunk_of(1);
  keep(chunk);
  reserve_ = ~std::uint64_t{0} >> 1;
  open();
  for (unsigned i = 2; i < 6; ++i) keep(chunk_of(i));
  ASSERT_EQ(faults_.size(), 1u);
  EXPECT_NE(faults_[0].find("MiB left"), std::string::npos) << faults_[0];
  const auto without_room = [](std::string text) {  // which others change meanwhile
    const auto begin = text.find("only ") + 5;
    return text.erase(begin, text.find(" MiB left") - begin);
  };
  EXPECT_EQ(without_room(cache_->state().fault), without_room(faults_[0]));
  EXPECT_TRUE(has(chunk)) << "what is there is used";
  EXPECT_EQ(cache_->state().files, 1u);
}

TEST_F(DiskCacheTest, KeepsAgainWhenItCan) {
  const fs::path unfinished = options_.folder / "unfinished";
  fs::remove(unfinished);
  write(unfinished, "an obstacle");
  keep(chunk_of(1));
  keep(chunk_of(2));
  EXPECT_EQ(faults_.size(), 1u);
  EXPECT_FALSE(has(chunk_of(1)));
  fs::remove(unfinished);
  fs::create_directory(unfinished);
  keep(chunk_of(1));
  EXPECT_TRUE(has(chunk_of(1)));
  EXPECT_EQ(cache_->state().fault, "");
}

TEST_F(DiskCacheTest, KeepsAgainAfterItsFolderWasRemoved) {
  for (const char* removed : {"", "unfinished", "chunks", "lists"}) {
    SCOPED_TRACE(removed);
    const auto before = chunk_of(1), after = chunk_of(2);
    keep(before);
    fs::remove_all(options_.folder / removed);
    keep(after);
    cache_->keep_list(content_, {after.size, {after.digest}});
    EXPECT_TRUE(has(after));
    EXPECT_NE(cache_->find_list(content_), nullptr);
    has(before);  // if it is not there any more, it is one that never was
    keep(before);
    EXPECT_TRUE(has(before));
    EXPECT_TRUE(faults_.empty()) << faults_.front();
    fs::remove_all(options_.folder);
    open();
  }
}

TEST_F(DiskCacheTest, DoesNotTryAgainAtOnce) {
  options_.pause = std::chrono::hours(1);
  cache_.reset();
  auto opened = DiskCache::open(options_);
  ASSERT_TRUE(opened);
  cache_ = *std::move(opened);
  const fs::path unfinished = options_.folder / "unfinished";
  fs::remove(unfinished);
  write(unfinished, "an obstacle");
  keep(chunk_of(1));
  fs::remove(unfinished);
  fs::create_directory(unfinished);
  keep(chunk_of(1));
  EXPECT_FALSE(has(chunk_of(1)));
}

TEST_F(DiskCacheTest, IsNotOpenedWhereAFileIsInItsPlace) {
  DiskCacheOptions options = options_;
  options.folder = directory_ / "file";
  write(options.folder, "a file");
  const auto opened = DiskCache::open(options);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().what.find("file"), std::string::npos) << opened.error().what;
}

}  // namespace
}  // namespace dripline::cache
