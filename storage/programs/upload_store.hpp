#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/programs/program_store.hpp"

namespace dripline::storage {

/// An upload in progress. Survives a restart of the server; abandoned ones are dropped after a day.
struct Upload {
  std::string id;
  std::string program;
  std::string control, comment, author;
  std::uint64_t received = 0;  ///< bytes; the next piece begins here
  UtcTime created;
  bool is_held = false;     ///< a machine sent it: becomes a held revision
  FieldChange change = {};  ///< of the program and the new revision
  /// It becomes an attachment of this name (AttachmentStore::commit); absent: a revision.
  std::optional<std::string> attachment = {};
  std::optional<std::uint64_t> attachment_revision = {};  ///< absent: of the program
  /// The file of a hot folder that it comes from: stored in the transaction of its revision.
  std::optional<std::uint64_t> folder_file = {};
};

/// Programs while they arrive in pieces. Promises of every store: storage/store.hpp.
class UploadStore {
 public:
  virtual ~UploadStore() = default;

  /// Errors: Syntax and LimitExceeded (the program's name), Conflict (no such machine group),
  /// NotFound (what an attachment is for).
  virtual Result<Upload> begin(const Upload& upload) = 0;
  /// Errors: NotFound.
  virtual Result<Upload> find(const std::string& id) = 0;
  /// Appends at `offset`. A piece that is stored already, or a part of which is, may be sent again:
  /// what failed may be stored up to some place. Errors: NotFound, Conflict (a gap, or other bytes
  /// than before), LimitExceeded (a piece of more than 16 MiB; an attachment of more than
  /// kMaxAttachmentBytes).
  virtual Result<Upload> append(const std::string& id, std::uint64_t offset,
                                std::span<const std::byte> bytes) = 0;
  /// Bytes received so far, from `offset`, at most `length`; empty after the end. Errors: NotFound.
  virtual Result<std::vector<std::byte>> read(const std::string& id, std::uint64_t offset,
                                              std::uint64_t length) = 0;
  /// For an upload begun without a control, when it was detected from the text. Errors: NotFound.
  virtual Result<void> set_control(const std::string& id, const std::string& control) = 0;
  /// Makes the upload a new revision of its program, or returns the latest one when it has the very
  /// same content; for a held upload also the newest held one with that content. Its `change` is in
  /// force in both cases. Errors: NotFound, Corrupt (the content's SHA-256 is not `expected`),
  /// Syntax (empty), Conflict (it is an upload of an attachment, or its machine group was removed),
  /// NotFound (also its folder's file, which is not Taken any more).
  virtual Result<Revision> commit(const std::string& id, const std::optional<Digest>& expected) = 0;
  virtual Result<void> abandon(const std::string& id) = 0;
  /// `passed` more time has elapsed (by a steady clock; the time of day may jump). Drops uploads
  /// that got no piece for longer than `life` of such time; returns their number.
  virtual Result<std::uint64_t> drop_idle(std::chrono::seconds passed,
                                          std::chrono::seconds life) = 0;
};

}  // namespace dripline::storage
