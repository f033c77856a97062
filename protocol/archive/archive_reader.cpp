#include "protocol/archive/archive_reader.hpp"

#include <zstd.h>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "protocol/base/invariant.hpp"

namespace dripline::archive {
namespace {

constexpr int kMaxWindowLog = 23;  // 8 MiB
constexpr std::uint64_t kVersion = 1;

std::string text_of(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || !found->is_string() ? "" : found->get<std::string>();
}

}  // namespace

struct ArchiveReader::Stream {
  struct FreeDecompressor {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };

  Bytes bytes;
  std::string name;
  Head head;
  std::unique_ptr<ZSTD_DStream, FreeDecompressor> zstd;
  std::span<const std::byte> in;
  std::vector<char> out;
  std::string text;  ///< decompressed, from `at` on not taken yet
  std::size_t at = 0;
  bool is_in_frame = true, is_at_end = false, is_over = false;
  std::uint64_t rows = 0;
  Sha256 of_lines, of_file;

  void digest_line(std::string_view line) {
    of_lines.update(line);
    of_lines.update("\n");
  }
};

ArchiveReader::ArchiveReader(std::unique_ptr<Stream> stream) : stream_(std::move(stream)) {}
ArchiveReader::ArchiveReader(ArchiveReader&&) noexcept = default;
ArchiveReader::~ArchiveReader() = default;

const Head& ArchiveReader::head() const {
  return stream_->head;
}
Digest ArchiveReader::sha256() const {
  return stream_->of_file.digest();
}

Result<ArchiveReader> ArchiveReader::open(const std::string& name) {
  auto file = std::make_shared<std::ifstream>(name, std::ios::binary);
  if (!*file) return fail(Errc::Io, "archive {} cannot be opened", name);
  auto buffer = std::make_shared<std::array<char, 64 * 1024>>();
  return begin(
      [file, buffer, name]() -> Result<std::span<const std::byte>> {
        file->read(buffer->data(), std::ssize(*buffer));
        if (file->bad()) return fail(Errc::Io, "archive {} cannot be read", name);
        return std::as_bytes(std::span(*buffer).first(static_cast<std::size_t>(file->gcount())));
      },
      name);
}

Result<ArchiveReader> ArchiveReader::begin(Bytes bytes, std::string name) {
  auto stream = std::make_unique<Stream>();
  stream->bytes = std::move(bytes);
  stream->name = std::move(name);
  stream->zstd.reset(ZSTD_createDStream());
  invariant(stream->zstd != nullptr, "memory for a zstd stream");
  ZSTD_DCtx_setParameter(stream->zstd.get(), ZSTD_d_windowLogMax, kMaxWindowLog);
  stream->out.resize(ZSTD_DStreamOutSize());
  ArchiveReader reader(std::move(stream));
  const auto first = reader.line();
  if (!first) return fail(first.error());
  const auto head = nlohmann::json::parse(first->value_or(""), nullptr, false);
  if (!head.is_object() || !head.contains("dripline_archive"))
    return fail(Errc::Syntax, "{} is no archive of Dripline", reader.stream_->name);
  if (head["dripline_archive"] != kVersion) {
    return fail(Errc::Unsupported, "archive {} is of version {}, this program reads {}",
                reader.stream_->name, head["dripline_archive"].dump(), kVersion);
  }
  reader.stream_->digest_line(**first);
  reader.stream_->head = {.kind = text_of(head, "kind"),
                          .machine = text_of(head, "machine"),
                          .database = text_of(head, "database"),
                          .made_by = text_of(head, "made_by")};
  return reader;
}

/// More decompressed text, or the end of the bytes.
Result<void> ArchiveReader::fill() {
  Stream& s = *stream_;
  s.text.erase(0, std::exchange(s.at, 0));
  for (;;) {
    if (s.in.empty()) {
      const auto more = s.bytes();
      if (!more) return fail(more.error());
      s.in = *more;
      s.of_file.update(s.in);
      if (s.in.empty()) {
        s.is_at_end = true;
        if (s.is_in_frame) return fail(Errc::Corrupt, "archive {} is cut off", s.name);
        return {};
      }
    }
    ZSTD_inBuffer in{s.in.data(), s.in.size(), 0};
    ZSTD_outBuffer out{s.out.data(), s.out.size(), 0};
    const std::size_t left = ZSTD_decompressStream(s.zstd.get(), &out, &in);
    if (ZSTD_isError(left))
      return fail(Errc::Corrupt, "archive {}: {}", s.name, ZSTD_getErrorName(left));
    s.is_in_frame = left != 0;
    s.in = s.in.subspan(in.pos);
    if (out.pos == 0) continue;
    s.text.append(s.out.data(), out.pos);
    return {};
  }
}

/// nullopt: the bytes have ended.
Result<std::optional<std::string>> ArchiveReader::line() {
  Stream& s = *stream_;
  std::size_t searched = s.at;
  for (;;) {
    const auto end = s.text.find('\n', searched);
    if (end != std::string::npos) {
      std::string line = s.text.substr(s.at, end - s.at);
      s.at = end + 1;
      return line;
    }
    if (s.text.size() - s.at >= kMaxLine)
      return fail(Errc::LimitExceeded, "archive {}: a line of more than {} bytes", s.name,
                  kMaxLine);
    if (s.is_at_end) {
      if (s.at == s.text.size()) return std::optional<std::string>();
      return fail(Errc::Corrupt, "archive {} is cut off", s.name);
    }
    const std::size_t had = s.text.size() - s.at;
    if (auto filled = fill(); !filled) return fail(filled.error());
    searched = had;  // fill moved the text to its beginning
  }
}

Result<void> ArchiveReader::each(const RowVisitor& visit) {
  for (;;) {
    const auto row = next();
    if (!row) return fail(row.error());
    if (!*row) return {};
    if (auto done = visit(**row); !done) return done;
  }
}

Result<std::optional<std::string>> ArchiveReader::next() {
  Stream& s = *stream_;
  if (s.is_over) return std::optional<std::string>();
  auto text = line();
  if (!text) return text;
  if (!*text) return fail(Errc::Corrupt, "archive {} has no end", s.name);
  if (!(*text)->starts_with(R"({"end":)")) {
    ++s.rows;
    s.digest_line(**text);
    return text;
  }
  const auto end = nlohmann::json::parse(**text, nullptr, false);
  if (!end.is_object() || end.value("end", nlohmann::json()) != s.rows ||
      text_of(end, "sha256") != s.of_lines.digest().hex()) {
    return fail(Errc::Corrupt, "archive {} was changed: its rows do not fit its end", s.name);
  }
  const auto rest = line();
  if (!rest) return fail(rest.error());
  if (*rest) return fail(Errc::Corrupt, "archive {} continues after its end", s.name);
  s.is_over = true;
  return std::optional<std::string>();
}

}  // namespace dripline::archive
