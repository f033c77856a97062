#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"

namespace dripline::storage {

/// A file beside a program: a setup sheet, a drawing ... Its bytes are kept as those of programs
/// are, once however often they are attached, and are read with ProgramStore::read_content.
struct Attachment {
  std::string program;                    ///< name
  std::optional<std::uint64_t> revision;  ///< absent: it belongs to the program
  std::string name;                       ///< a file name without a folder
  Digest content;                         ///< SHA-256 of the bytes
  std::uint64_t size = 0;
  std::string comment, author;
  UtcTime created;
};

struct AttachmentName {
  std::string program;
  std::optional<std::uint64_t> revision;
  std::string name;
};

/// Promises of every store: storage/store.hpp.
class AttachmentStore {
 public:
  virtual ~AttachmentStore() = default;

  /// Those of the program and, with `revision`, of that revision too; without one those of all its
  /// revisions. In the order of revision and name. Errors: NotFound.
  virtual Result<std::vector<Attachment>> list(const std::string& program,
                                               std::optional<std::uint64_t> revision) = 0;
  /// Errors: NotFound.
  virtual Result<Attachment> find(const AttachmentName& name) = 0;
  /// Makes a finished upload that was begun as an attachment one; the audit entry (program.attach)
  /// is part of the transaction. Errors: those of UploadStore::commit, Conflict (the name is taken
  /// with other bytes; it is no upload of an attachment), LimitExceeded (kMaxAttachments).
  virtual Result<Attachment> commit(const std::string& upload,
                                    const std::optional<Digest>& expected, const Actor& who) = 0;
  /// Its bytes go with the last that has them; the audit entry (program.detach) is part of the
  /// transaction. Errors: NotFound.
  virtual Result<void> remove(const AttachmentName& name, const Actor& who) = 0;

  static constexpr std::uint64_t kMaxAttachments = 200;             ///< of a program
  static constexpr std::uint64_t kMaxAttachmentBytes = 256u << 20;  ///< of each
};

}  // namespace dripline::storage
