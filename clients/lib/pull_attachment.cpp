#include "clients/lib/pull.hpp"

#include <algorithm>

#include "clients/lib/output_file.hpp"
#include "protocol/base/digest.hpp"

namespace dripline::client {
namespace {

constexpr std::uint64_t kAttachmentPiece = 4ull * 1024 * 1024;

Reply<std::string> fetch_piece(Client& client, const AttachmentRange& range, BackOff& back_off) {
  while (true) {
    auto bytes = client.attachment_bytes(range);
    if (bytes) {
      back_off.reset();
      return bytes;
    }
    const bool can_help =
        bytes.error().kind == Failure::Kind::Unreachable || bytes.error().code == Errc::Busy;
    if (!can_help || !back_off.wait()) return bytes;
  }
}

}  // namespace

Reply<void> pull_attachment_to_file(Client& client, const Attachment& attachment,
                                    const AttachmentPull& options) {
  auto file = OutputFile::create(options.path);
  if (!file) return failed_locally(file.error());
  BackOff back_off(options.retry);
  Sha256 digest;
  for (std::uint64_t done = 0; done < attachment.size;) {
    const AttachmentRange range{attachment.program, attachment.revision, attachment.name, done,
                                std::min(kAttachmentPiece, attachment.size - done)};
    auto bytes = fetch_piece(client, range, back_off);
    if (!bytes) return failed(bytes.error());
    digest.update(*bytes);
    if (auto written = file->write(*bytes); !written) return failed_locally(written.error());
    done += range.length;
    if (options.on_progress && !options.on_progress(done, attachment.size))
      return failed(Failure::Kind::Local, Errc::Timeout, "the transfer was ended from this side");
  }
  if (digest.digest().hex() != attachment.sha256) {
    return failed(Failure::Kind::BadReply, Errc::Corrupt,
                  "the bytes of attachment '{}' have SHA-256 {}, expected {}; they are refused",
                  attachment.name, digest.digest().hex(), attachment.sha256);
  }
  if (auto kept = file->commit(); !kept) return failed_locally(kept.error());
  return {};
}

}  // namespace dripline::client
