#include "clients/lib/pull.hpp"

#include <algorithm>

#include "clients/lib/output_file.hpp"
#include "protocol/base/digest.hpp"

namespace dripline::client {
namespace {

constexpr std::uint64_t kPullPiece = 8ull * 1024 * 1024;
/// After a failure the client asks for one chunk: the server checks the first chunk of an answer
/// before it sends a byte, so that a damaged one becomes an error with its name instead of an
/// answer that is cut off.
constexpr std::uint64_t kCarefulPiece = 64 * 1024;

Reply<Revision> find_revision(Client& client, const PullOptions& options) {
  auto history = client.program(options.program);
  if (!history) return failed(history.error());
  const std::uint64_t wanted = options.revision.value_or(history->program.revision);
  for (const auto& revision : history->revisions) {
    if (revision.revision == wanted) return revision;
  }
  return failed(Failure::Kind::Refused, Errc::NotFound,
                "program {} has no revision {}, its latest is {}", options.program, wanted,
                history->program.revision);
}

/// After a failure, `range` may be shorter.
Reply<Content> fetch_piece(Client& client, ContentRange& range, BackOff& back_off) {
  while (true) {
    auto content = client.content(range);
    if (content) {
      back_off.reset();
      return content;
    }
    const bool can_help =
        content.error().kind == Failure::Kind::Unreachable || content.error().code == Errc::Busy;
    if (!can_help || !back_off.wait()) return content;
    range.length = std::min(range.length, kCarefulPiece);
  }
}

Reply<void> check_piece(const Content& content, const ContentRange& range,
                        const Revision& revision) {
  if (content.bytes.size() != range.length) {
    return failed(Failure::Kind::BadReply, Errc::Corrupt,
                  "the server gave {} bytes of program {} at {}, expected {}", content.bytes.size(),
                  range.program, range.offset, range.length);
  }
  if (!content.sha256.empty() && content.sha256 != revision.sha256) {
    return failed(Failure::Kind::BadReply, Errc::Corrupt,
                  "the server gave bytes of content {} for program {} revision {}, expected {}",
                  content.sha256, range.program, range.revision, revision.sha256);
  }
  return {};
}

}  // namespace

Reply<Revision> pull_program(Client& client, const PullOptions& options,
                             const std::function<Result<void>(std::string_view)>& sink) {
  auto revision = find_revision(client, options);
  if (!revision) return revision;
  BackOff back_off(options.retry);
  Sha256 digest;
  std::uint64_t done = 0;
  std::uint64_t careful_until = 0;  ///< the end of the piece that failed
  while (done < revision->size) {
    const std::uint64_t piece = done < careful_until ? kCarefulPiece : kPullPiece;
    ContentRange range{options.program, revision->revision, done,
                       std::min(piece, revision->size - done)};
    const std::uint64_t wanted_end = done + range.length;
    auto content = fetch_piece(client, range, back_off);
    if (!content) return failed(content.error());
    if (done + range.length < wanted_end) careful_until = wanted_end;
    if (auto right = check_piece(*content, range, *revision); !right) return failed(right.error());
    digest.update(content->bytes);
    if (auto taken = sink(content->bytes); !taken) return failed_locally(taken.error());
    done += range.length;
    if (options.on_progress && !options.on_progress(done, revision->size)) {
      return failed(Failure::Kind::Local, Errc::Timeout, "the pull was ended from this side");
    }
  }
  if (digest.digest().hex() != revision->sha256) {
    return failed(Failure::Kind::BadReply, Errc::Corrupt,
                  "the bytes of program {} revision {} have SHA-256 {}, expected {}; they are "
                  "refused",
                  options.program, revision->revision, digest.digest().hex(), revision->sha256);
  }
  return revision;
}

Reply<Revision> pull_program_to_file(Client& client, const PullOptions& options,
                                     const std::string& path) {
  auto file = OutputFile::create(path);
  if (!file) return failed_locally(file.error());
  auto revision =
      pull_program(client, options, [&file](std::string_view bytes) { return file->write(bytes); });
  if (!revision) return revision;
  if (auto kept = file->commit(); !kept) return failed_locally(kept.error());
  return revision;
}

}  // namespace dripline::client
