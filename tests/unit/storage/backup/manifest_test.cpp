#include "storage/backup/manifest.hpp"

#include <gtest/gtest.h>

#include "storage/programs/chunk_codec.hpp"

namespace dripline::backup {
namespace {

Manifest example() {
  return {.made = UtcTime(std::chrono::microseconds(1'700'000'000'000'000)),
          .made_by = "dncd 1.2",
          .database = "0123",
          .added = 17,
          .files = {{.name = "a.sqlite",
                     .size = storage::kChunkBytes + 1,
                     .chunks = {sha256("one"), sha256("two")}},
                    {.name = "empty", .size = 0, .chunks = {}}}};
}

TEST(Manifest, IsReadAsItWasWritten) {
  const auto read = parse_manifest(to_text(example()));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(to_text(*read), to_text(example()));
  EXPECT_EQ(read->made, example().made);
  EXPECT_EQ(read->size(), storage::kChunkBytes + 1);
  EXPECT_EQ(read->files.at(0).chunks, example().files.at(0).chunks);
}

TEST(Manifest, IsRefusedWhereverItIsCutOrChanged) {
  const std::string text = to_text(example());
  for (std::size_t length = 0; length + 1 < text.size(); ++length)
    EXPECT_FALSE(parse_manifest(std::string_view(text).substr(0, length))) << length;
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    std::string changed = text;
    changed[at] = changed[at] == '1' ? '2' : '1';
    EXPECT_FALSE(parse_manifest(changed)) << at;
  }
}

/// With a digest that fits, as an attacker would write it.
TEST(Manifest, NamesOnlyFilesOfItsFolder) {
  for (const char* name : {"", ".", "..", "../x", "/etc/passwd", "a/b"}) {
    Manifest manifest = example();
    manifest.files.at(0).name = name;
    EXPECT_FALSE(parse_manifest(to_text(manifest))) << name;
  }
  Manifest short_of_chunks = example();
  short_of_chunks.files.at(0).chunks.pop_back();
  EXPECT_FALSE(parse_manifest(to_text(short_of_chunks)));
}

TEST(Manifest, OfANewerFormatIsNamedAsThat) {
  const auto read = parse_manifest(R"({"format": 2})");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace dripline::backup
