#include "clients/lib/push.hpp"

#include <algorithm>
#include <string>

#include "protocol/base/digest.hpp"

namespace dripline::client {
namespace {

constexpr std::uint64_t kPushPiece = 4ull * 1024 * 1024;

bool can_help_to_retry(const Failure& failure) {
  return failure.kind == Failure::Kind::Unreachable || failure.code == Errc::Busy ||
         failure.code == Errc::Timeout;
}

struct SendOptions {
  RetryPolicy retry;
  std::function<bool(std::uint64_t done, std::uint64_t total)> on_progress;
  std::function<Reply<Upload>()> open;
};

/// What was sent and is to be committed.
struct Sent {
  std::string upload, sha256;
};

/// The bytes of one upload: its id, its offset, the digest so far.
class Sending {
 public:
  Sending(Client& client, ByteSource& source, const SendOptions& options)
      : client_(client), source_(source), options_(options), back_off_(options_.retry) {}

  Reply<Sent> run() {
    if (auto opened = open(); !opened) return failed(opened.error());
    if (auto sent = send_all(); !sent) {
      // A refused upload is useless; one that was cut off stays, so that it can be examined.
      if (sent.error().kind == Failure::Kind::Refused) {
        [[maybe_unused]] const auto dropped = client_.drop_upload(id_);
      }
      return failed(sent.error());
    }
    return Sent{id_, digest_.digest().hex()};
  }

 private:
  Reply<void> open() {
    while (true) {
      auto upload = options_.open();
      if (upload) {
        id_ = upload->id;
        piece_size_ = upload->max_piece == 0 ? kPushPiece : std::min(upload->max_piece, kPushPiece);
        return {};
      }
      if (!can_help_to_retry(upload.error()) || !back_off_.wait()) return failed(upload.error());
    }
  }

  Reply<void> send_all() {
    while (offset_ < source_.size()) {
      auto sent = send_piece();
      if (sent) continue;
      if (auto resumed = resume(sent.error()); !resumed) return resumed;
    }
    return {};
  }

  Reply<void> send_piece() {
    buffer_.resize(std::min(piece_size_, source_.size() - offset_));
    if (auto read = source_.read(offset_, buffer_); !read) return failed_locally(read.error());
    hash(buffer_);
    const Piece piece{offset_, buffer_,
                      [this](std::uint64_t sent) { return report(offset_ + sent); }};
    auto upload = client_.put_piece(id_, piece);
    if (!upload) return failed(upload.error());
    if (auto moved = move_to(upload->received); !moved) return moved;
    back_off_.reset();
    return {};
  }

  /// After a failed piece: waits, asks what the server has received, continues from there.
  Reply<void> resume(const Failure& failure) {
    if (failure.kind == Failure::Kind::Local || is_ended_) return failed(failure);
    const bool may_be_offset = failure.kind == Failure::Kind::Refused;
    if (!can_help_to_retry(failure) && !may_be_offset) return failed(failure);
    while (true) {
      if (!back_off_.wait()) return failed(failure);
      auto upload = client_.upload(id_);
      if (upload) {
        const bool has_moved = upload->received != offset_;
        // Refused at the right offset: it would be refused again.
        if (!has_moved && !can_help_to_retry(failure)) return failed(failure);
        if (upload->received > offset_) back_off_.reset();
        return move_to(upload->received);
      }
      if (can_help_to_retry(upload.error())) continue;
      // A server that refuses the content drops the upload: the first refusal has the reason.
      return failed(may_be_offset ? failure : upload.error());
    }
  }

  Reply<void> move_to(std::uint64_t received) {
    if (received > hashed_) {
      return failed(Failure::Kind::BadReply, Errc::Corrupt,
                    "the server says it has {} bytes of upload {}, only {} were sent", received,
                    id_, hashed_);
    }
    offset_ = received;
    if (report(offset_)) return {};
    return failed(Failure::Kind::Local, Errc::Timeout, "the push was ended from this side");
  }

  /// Hashes only new bytes: a piece that is sent again must not be hashed twice.
  void hash(std::string_view piece) {
    const std::uint64_t end = offset_ + piece.size();
    if (end <= hashed_) return;
    digest_.update(piece.substr(static_cast<std::size_t>(hashed_ - offset_)));
    hashed_ = end;
  }

  bool report(std::uint64_t done) {
    is_ended_ = options_.on_progress && !options_.on_progress(done, source_.size());
    return !is_ended_;
  }

  Client& client_;
  ByteSource& source_;
  const SendOptions& options_;
  BackOff back_off_;
  std::string id_;
  std::uint64_t piece_size_ = kPushPiece;
  std::uint64_t offset_ = 0;  ///< of the next piece
  std::uint64_t hashed_ = 0;  ///< bytes in the digest
  Sha256 digest_;
  std::string buffer_;
  bool is_ended_ = false;
};

Reply<Revision> find_committed(Client& client, const UploadRequest& upload,
                               const std::string& sha256, const Failure& failure) {
  auto history = client.program(upload.program);
  if (!history) return failed(failure);
  for (const auto& revision : history->revisions) {
    if (revision.sha256 == sha256 && revision.revision == history->program.revision) {
      return revision;
    }
  }
  return failed(failure);
}

Reply<Attachment> find_attached(Client& client, const AttachmentRequest& request,
                                const std::string& sha256, const Failure& failure) {
  auto attachments = client.attachments(request.program, request.revision);
  if (!attachments) return failed(failure);
  for (const auto& attachment : *attachments) {
    const bool is_it = attachment.name == request.name && attachment.revision == request.revision &&
                       attachment.sha256 == sha256;
    if (is_it) return attachment;
  }
  return failed(failure);
}

/// A commit whose answer was lost may have succeeded: then the upload is gone, and `find` has what
/// became of it.
template <class Commit, class Find>
auto commit(const RetryPolicy& retry, Commit commit, Find find) -> std::invoke_result_t<Commit> {
  BackOff back_off(retry);
  bool is_repeated = false;
  while (true) {
    auto committed = commit();
    if (committed) return committed;
    if (is_repeated && committed.error().code == Errc::NotFound) return find(committed.error());
    if (!can_help_to_retry(committed.error()) || !back_off.wait()) return committed;
    is_repeated = true;
  }
}

}  // namespace

Reply<Revision> push_program(Client& client, ByteSource& source, const PushOptions& options) {
  const UploadRequest& upload = options.upload;
  const SendOptions send{options.retry, options.on_progress,
                         [&] { return client.open_upload(upload); }};
  const auto sent = Sending(client, source, send).run();
  if (!sent) return failed(sent.error());
  return commit(
      options.retry,
      [&] {
        return client.commit_upload(sent->upload, {sent->sha256, upload.overrides_protection});
      },
      [&](const Failure& failure) {
        return find_committed(client, upload, sent->sha256, failure);
      });
}

Reply<Attachment> push_attachment(Client& client, ByteSource& source,
                                  const AttachOptions& options) {
  const AttachmentRequest& request = options.attachment;
  const SendOptions send{options.retry, options.on_progress,
                         [&] { return client.open_attachment(request); }};
  const auto sent = Sending(client, source, send).run();
  if (!sent) return failed(sent.error());
  return commit(
      options.retry, [&] { return client.commit_attachment(sent->upload, sent->sha256); },
      [&](const Failure& failure) {
        return find_attached(client, request, sent->sha256, failure);
      });
}

}  // namespace dripline::client
