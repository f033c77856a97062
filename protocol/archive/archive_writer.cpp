#include "protocol/archive/archive_writer.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/durable_file.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::archive {
namespace {

constexpr int kLevel = 3;

tl::unexpected<Error> refused(const char* what, const std::filesystem::path& file) {
  return fail(Errc::Io, "archive {}: {}: {}", file.string(), what, std::strerror(errno));
}

}  // namespace

struct ArchiveWriter::File {
  struct FreeCompressor {
    void operator()(ZSTD_CStream* stream) const { ZSTD_freeCStream(stream); }
  };

  std::filesystem::path name, temporary;
  Descriptor descriptor;
  std::unique_ptr<ZSTD_CStream, FreeCompressor> stream;
  std::vector<std::byte> buffer;
  Sha256 of_lines, of_file;
  WrittenFile written;
  bool is_done = false;

  ~File() {
    if (!is_done) ::unlink(temporary.c_str());
  }
};

ArchiveWriter::ArchiveWriter(std::unique_ptr<File> file) : file_(std::move(file)) {}
ArchiveWriter::ArchiveWriter(ArchiveWriter&&) noexcept = default;
ArchiveWriter::~ArchiveWriter() = default;

Result<ArchiveWriter> ArchiveWriter::begin(const std::filesystem::path& name, const Head& head) {
  auto file = std::make_unique<File>();
  file->name = name;
  file->temporary = name.string() + ".tmp";
  file->descriptor =
      Descriptor(::open(file->temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0640));
  if (!file->descriptor) return refused("open", file->temporary);
  file->stream.reset(ZSTD_createCStream());
  invariant(file->stream != nullptr, "memory for a zstd stream");
  invariant(!ZSTD_isError(ZSTD_initCStream(file->stream.get(), kLevel)), "a level of zstd");
  file->buffer.resize(ZSTD_CStreamOutSize());
  ArchiveWriter writer(std::move(file));
  const nlohmann::ordered_json first{{"dripline_archive", 1},
                                     {"kind", head.kind},
                                     {"machine", head.machine},
                                     {"database", head.database},
                                     {"made_by", head.made_by}};
  if (auto done = writer.line(first.dump()); !done) return fail(done.error());
  return writer;
}

Result<void> ArchiveWriter::add(std::string_view row) {
  if (row.size() >= kMaxLine || row.find('\n') != std::string_view::npos) {
    return fail(Errc::LimitExceeded, "archive {}: a row of {} bytes: one line, less than {}",
                file_->name.string(), row.size(), kMaxLine);
  }
  ++file_->written.rows;
  return line(row);
}

Result<void> ArchiveWriter::line(std::string_view text) {
  file_->of_lines.update(text);
  file_->of_lines.update("\n");
  if (auto done = compress(text, false); !done) return done;
  return compress("\n", false);
}

Result<void> ArchiveWriter::compress(std::string_view text, bool is_last) {
  ZSTD_inBuffer in{text.data(), text.size(), 0};
  for (;;) {
    ZSTD_outBuffer out{file_->buffer.data(), file_->buffer.size(), 0};
    const std::size_t left = ZSTD_compressStream2(file_->stream.get(), &out, &in,
                                                  is_last ? ZSTD_e_end : ZSTD_e_continue);
    invariant(!ZSTD_isError(left), "zstd compresses what it is given");
    const auto made = std::span(file_->buffer).first(out.pos);
    file_->of_file.update(made);
    file_->written.bytes += made.size();
    if (!write_all(file_->descriptor.get(), made)) return refused("write", file_->name);
    if (is_last ? left == 0 : in.pos == in.size) return {};
  }
}

Result<WrittenFile> ArchiveWriter::end() {
  const nlohmann::ordered_json last{{"end", file_->written.rows},
                                    {"sha256", file_->of_lines.digest().hex()}};
  if (auto done = compress(last.dump() + "\n", false); !done) return fail(done.error());
  if (auto done = compress("", true); !done) return fail(done.error());
  if (::fsync(file_->descriptor.get()) != 0) return refused("fsync", file_->temporary);
  if (::rename(file_->temporary.c_str(), file_->name.c_str()) != 0)
    return refused("rename", file_->temporary);
  file_->is_done = true;
  if (!sync_folder(file_->name.parent_path())) return refused("fsync of its folder", file_->name);
  file_->written.sha256 = file_->of_file.digest();
  return file_->written;
}

}  // namespace dripline::archive
