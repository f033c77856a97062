#pragma once

#include "storage/programs/attachment_store.hpp"
#include "storage/programs/upload_store.hpp"
#include "storage/sql/query.hpp"

/// Rows of attachment, inside the caller's transaction.
namespace dripline::storage {

/// The row id of a program that can be seen, and has that revision. Errors: NotFound.
Result<std::int64_t> find_owner(sql::Database& database, const std::string& program,
                                std::optional<std::uint64_t> revision);

struct NewAttachment {
  const Upload& upload;
  std::int64_t content = 0;
  Digest digest;
  Actor who;
  UtcTime now;
};
/// Promises: AttachmentStore::commit. The same bytes under the same name are there already.
Result<Attachment> publish_attachment(sql::Database& database, const NewAttachment& added);

}  // namespace dripline::storage
