#include "protocol/archive/verified_archive.hpp"

#include <array>
#include <fstream>

namespace dripline::archive {

struct VerifiedArchive::Source {
  std::ifstream file;
  std::array<char, 64 * 1024> buffer;
};

Result<void> VerifiedArchive::read(const RowVisitor& visit, Digest& digest) const {
  Source& source = *source_;
  source.file.clear();
  source.file.seekg(0);
  auto reader = ArchiveReader::begin(
      [this, &source]() -> Result<std::span<const std::byte>> {
        source.file.read(source.buffer.data(), std::ssize(source.buffer));
        if (source.file.bad()) return fail(Errc::Io, "archive {} cannot be read", name_);
        const auto count = static_cast<std::size_t>(source.file.gcount());
        return std::as_bytes(std::span(source.buffer).first(count));
      },
      name_);
  if (!reader) return fail(reader.error());
  if (auto done = reader->each(visit); !done) return done;
  digest = reader->sha256();
  return {};
}

Result<VerifiedArchive> VerifiedArchive::open(const std::string& file) {
  auto head = ArchiveReader::open(file);
  if (!head) return fail(head.error());
  VerifiedArchive archive;
  archive.name_ = file;
  archive.head_ = head->head();
  archive.source_ = std::make_shared<Source>();
  archive.source_->file.open(file, std::ios::binary);
  if (!archive.source_->file) return fail(Errc::Io, "archive {} cannot be opened", file);
  const auto count = [&archive](const std::string&) -> Result<void> {
    ++archive.rows_;
    return {};
  };
  if (auto read = archive.read(count, archive.sha256_); !read) return fail(read.error());
  return archive;
}

Result<void> VerifiedArchive::each(const RowVisitor& visit) const {
  Digest digest;
  if (auto done = read(visit, digest); !done) return done;
  if (digest == sha256_) return {};
  return fail(Errc::Corrupt, "archive {} was changed while it was read", name_);
}

}  // namespace dripline::archive
