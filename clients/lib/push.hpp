#pragma once

#include <cstdint>
#include <functional>

#include "clients/lib/byte_source.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/reply.hpp"

namespace dripline::client {

struct PushOptions {
  UploadRequest upload;
  RetryPolicy retry;
  /// `done`: bytes that the server has or is being sent; false ends the push.
  std::function<bool(std::uint64_t done, std::uint64_t total)> on_progress;
};

/// Sends `source` as a new revision, in pieces, and has the server compare the SHA-256 that was
/// computed meanwhile. When the connection breaks it waits, asks what the server has received and
/// continues from there. Memory: one piece. Failures: those of the calls; Local when the source
/// cannot be read; Unreachable when the attempts are used up.
Reply<Revision> push_program(Client& client, ByteSource& source, const PushOptions& options);

struct AttachOptions {
  AttachmentRequest attachment;
  RetryPolicy retry;
  std::function<bool(std::uint64_t done, std::uint64_t total)> on_progress;
};

/// Sends `source` as an attachment, likewise.
Reply<Attachment> push_attachment(Client& client, ByteSource& source, const AttachOptions& options);

}  // namespace dripline::client
