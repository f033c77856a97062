#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "clients/lib/client.hpp"
#include "clients/lib/reply.hpp"

namespace dripline::client {

struct PullOptions {
  std::string program;
  std::optional<std::uint64_t> revision;  ///< nullopt: the latest
  RetryPolicy retry;
  std::function<bool(std::uint64_t done, std::uint64_t total)> on_progress;
};

/// Writes the revision to `path`: first to a file beside it, which gets the name only when the
/// SHA-256 is right, so that `path` never holds half a program. Memory: one piece. Failures: those
/// of the calls; Local (the file cannot be written); BadReply with Errc::Corrupt (wrong digest). On
/// any failure `path` is as it was and nothing else is left.
Reply<Revision> pull_program_to_file(Client& client, const PullOptions& options,
                                     const std::string& path);

/// Passes the bytes to `sink` as they arrive. The digest is known only at the end: after
/// Errc::Corrupt the bytes that were passed on must not be used.
Reply<Revision> pull_program(Client& client, const PullOptions& options,
                             const std::function<Result<void>(std::string_view)>& sink);

struct AttachmentPull {
  std::string path;
  RetryPolicy retry;
  std::function<bool(std::uint64_t done, std::uint64_t total)> on_progress;
};

/// Writes an attachment to a file likewise.
Reply<void> pull_attachment_to_file(Client& client, const Attachment& attachment,
                                    const AttachmentPull& options);

}  // namespace dripline::client
