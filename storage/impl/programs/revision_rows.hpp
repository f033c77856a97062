#pragma once

#include <optional>
#include <string>

#include "storage/programs/upload_store.hpp"
#include "storage/sql/query.hpp"

/// Rows of revision, as they are found, made and judged. Everything runs inside the caller's
/// transaction.
namespace dripline::storage {

/// Columns of read_revision, the digest of the content that the row names, then FROM with program
/// and content joined; a WHERE follows.
extern const std::string kRevisionColumns;
inline constexpr int kAfterRevision = 18;  ///< the first column past them
extern const std::string kRevisionTables;
/// A condition: not removed, not rejected.
extern const std::string kRevisionVisible;
Revision read_revision(const sql::Statement& row);
struct BoundRevision {
  Revision revision;
  Digest named;  ///< the content that the row names
};
BoundRevision read_bound(const sql::Statement& row);
/// `named`: the digest of the content that the revision's row names; the revision has the one that
/// it was stored with.
/// Errors: Corrupt.
Result<void> check_content(const Revision& revision, const Digest& named);

/// `number` absent: the latest that is not held. Errors: NotFound, Conflict (nothing but held
/// ones), Corrupt (its row names another content than it was stored with).
Result<Revision> find_revision(sql::Database& database, const std::string& program,
                               std::optional<std::uint64_t> number);

/// Makes `content` a new revision of the upload's program, or returns the latest one when that has
/// this very content and was not withdrawn (the newest held one, if the upload is held).
Result<Revision> publish_revision(sql::Database& database, const Upload& upload,
                                  std::int64_t content, UtcTime now);

struct Judgment {
  std::string program;
  std::uint64_t number = 0;
  Actor who;
  UtcTime time;
  std::string reason = {};
  bool is_at_once = false;  ///< by the policy
  /// Of a rejection: the text became a revision of this program instead; empty: it did not.
  std::string target = {};
  std::uint64_t target_revision = 0;
};
/// Promises of both: storage/programs/program_store.hpp. The import queue follows.
Result<Revision> accept_revision(sql::Database& database, const Judgment& judgment);
Result<void> reject_revision(sql::Database& database, const Judgment& judgment);

}  // namespace dripline::storage
