#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "protocol/archive/archive_entry.hpp"
#include "protocol/archive/archive_reader.hpp"
#include "protocol/archive/verified_archive.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::archive {
namespace {

class Archive : public testing::Test {
 protected:
  WrittenFile write(const std::vector<std::string>& rows) {
    auto writer = ArchiveWriter::begin(file_, {"records", "lathe-1", "db", "test"});
    EXPECT_TRUE(writer) << writer.error().what;
    for (const auto& row : rows) EXPECT_TRUE(writer->add(row));
    const auto written = writer->end();
    EXPECT_TRUE(written) << written.error().what;
    return *written;
  }
  /// All rows, or the error.
  static std::string read(Result<ArchiveReader> reader) {
    if (!reader) return std::string(to_string(reader.error().code));
    std::string all;
    for (;;) {
      const auto row = reader->next();
      if (!row) return std::string(to_string(row.error().code));
      if (!*row) return all;
      all += **row + ";";
    }
  }
  std::string bytes() const {
    std::ostringstream text;
    text << std::ifstream(file_, std::ios::binary).rdbuf();
    return text.str();
  }
  static std::string read_bytes(const std::string& bytes, std::size_t piece) {
    std::size_t at = 0;
    return read(ArchiveReader::begin(
        [&bytes, at, piece]() mutable -> Result<std::span<const std::byte>> {
          const auto some = std::string_view(bytes).substr(at, piece);
          at += some.size();
          return std::as_bytes(std::span(some));
        },
        "bytes"));
  }

  test_support::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.jsonl.zst";
};

TEST_F(Archive, IsReadBack) {
  const auto written = write({R"({"n":1})", R"({"n":2})"});
  EXPECT_EQ(written.rows, 2u);
  EXPECT_EQ(written.bytes, std::filesystem::file_size(file_));
  auto reader = ArchiveReader::open(file_);
  ASSERT_TRUE(reader) << reader.error().what;
  EXPECT_EQ(reader->head().kind, "records");
  EXPECT_EQ(reader->head().machine, "lathe-1");
  while (*reader->next()) {
  }
  EXPECT_EQ(reader->sha256(), written.sha256);
  EXPECT_EQ(read(ArchiveReader::open(file_)), R"({"n":1};{"n":2};)");
}

TEST_F(Archive, MayBeEmptyAndLong) {
  write({});
  EXPECT_EQ(read(ArchiveReader::open(file_)), "");
  std::vector<std::string> rows;
  std::string expected;
  for (int i = 0; i < 50'000; ++i) {
    rows.push_back(fmt::format(R"({{"number":{},"text":"X{}"}})", i, i * 7919));
    expected += rows.back() + ";";
  }
  write(rows);
  EXPECT_EQ(read(ArchiveReader::open(file_)), expected);
  EXPECT_EQ(read_bytes(bytes(), 1), expected) << "however its bytes come";
}

TEST_F(Archive, IsNotThereBeforeItsEnd) {
  {
    auto writer = ArchiveWriter::begin(file_, {"records", "lathe-1", "db", "test"});
    ASSERT_TRUE(writer->add("{}"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  EXPECT_EQ(ArchiveReader::open(file_).error().code, Errc::Io);
}

TEST_F(Archive, CutOffAtAnyByteIsFound) {
  write({R"({"n":1})", R"({"n":2})"});
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(read_bytes(whole.substr(0, size), 64), "corrupt") << size;
}

TEST_F(Archive, ChangedRowsAreFound) {
  auto writer = ArchiveWriter::begin(file_, {"records", "lathe-1", "db", "test"});
  ASSERT_TRUE(writer->add(R"({"end":0,"sha256":""})"));
  ASSERT_TRUE(writer->end());
  EXPECT_EQ(read(ArchiveReader::open(file_)), "corrupt");
  EXPECT_EQ(read_bytes(bytes() + bytes(), 64), "corrupt");
}

TEST_F(Archive, RefusesOtherFiles) {
  std::ofstream(file_) << "no archive";
  EXPECT_EQ(read(ArchiveReader::open(file_)), "corrupt");
  auto writer = ArchiveWriter::begin(file_, {"records", "lathe-1", "db", "test"});
  EXPECT_EQ(writer->add("a\nb").error().code, Errc::LimitExceeded);
  EXPECT_EQ(writer->add(std::string(kMaxLine, 'x')).error().code, Errc::LimitExceeded);
}

TEST_F(Archive, IsVerifiedBeforeItsRowsArePassedOn) {
  const auto written = write({R"({"n":1})", R"({"n":2})"});
  const auto verified = VerifiedArchive::open(file_);
  ASSERT_TRUE(verified) << verified.error().what;
  EXPECT_EQ(verified->head().kind, "records");
  EXPECT_EQ(verified->sha256(), written.sha256);
  EXPECT_EQ(verified->rows(), 2u);
  std::string all;
  const auto take = [&all](const std::string& row) -> Result<void> {
    all += row;
    return {};
  };
  ASSERT_TRUE(verified->each(take));
  ASSERT_TRUE(verified->each(take)) << "as often as it is asked for";
  EXPECT_EQ(all, R"({"n":1}{"n":2}{"n":1}{"n":2})");
  const auto stopped =
      verified->each([](const std::string&) -> Result<void> { return fail(Errc::Io, "full"); });
  EXPECT_EQ(stopped.error().what, "full");

  // Another file under its name does not matter; a change of this one does.
  const std::string whole = bytes();
  std::filesystem::rename(file_, folder_.path() / "kept");
  write({R"({"n":3})"});
  all.clear();
  ASSERT_TRUE(verified->each(take));
  EXPECT_EQ(all, R"({"n":1}{"n":2})");
  std::ofstream(folder_.path() / "kept", std::ios::binary) << bytes();
  EXPECT_EQ(verified->each(take).error().code, Errc::Corrupt);
  std::ofstream(file_, std::ios::binary) << whole.substr(0, whole.size() - 1);
  EXPECT_EQ(VerifiedArchive::open(file_).error().code, Errc::Corrupt);
}

TEST_F(Archive, HasItsDigestInTheAuditTrail) {
  const auto written = write({R"({"n":1})"});
  EXPECT_EQ(*digest_of(file_), written.sha256);
  EXPECT_EQ(digest_in("1 records, sha256 " + written.sha256.hex()), written.sha256);
  EXPECT_FALSE(digest_in("1 records, sha256 12"));
  EXPECT_FALSE(digest_in(""));
  EXPECT_EQ(digest_of(folder_.path() / "absent").error().code, Errc::Io);
}

}  // namespace
}  // namespace dripline::archive
