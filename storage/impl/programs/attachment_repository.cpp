#include "storage/impl/programs/attachment_repository.hpp"

#include <limits>

#include "storage/impl/audit_repository.hpp"
#include "storage/impl/programs/attachment_rows.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/revision_rows.hpp"

namespace dripline::storage {
namespace {

const std::string kAttachmentSelect =
    "SELECT program.name, attachment.revision, attachment.name, attachment.sha256, content.size, "
    "attachment.comment, attachment.author, attachment.created_us, attachment.id, "
    "attachment.content FROM attachment JOIN program ON program.id = attachment.program "
    "JOIN content ON content.id = attachment.content ";

struct AttachmentRow {
  Attachment attachment;
  std::int64_t id = 0, content = 0;
};

AttachmentRow read_row(const sql::Statement& row) {
  AttachmentRow found;
  Attachment& attachment = found.attachment;
  attachment.program = row.text(0);
  if (const auto revision = row.optional_integer(1))
    attachment.revision = static_cast<std::uint64_t>(*revision);
  attachment.name = row.text(2);
  attachment.content = read_digest(row, 3);
  attachment.size = row.number(4);
  attachment.comment = row.text(5);
  attachment.author = row.text(6);
  attachment.created = row.time(7);
  found.id = row.integer(8);
  found.content = row.integer(9);
  return found;
}

/// "O0200", "O0200 revision 3".
std::string words_of(const std::string& program, std::optional<std::uint64_t> revision) {
  return revision ? fmt::format("{} revision {}", program, *revision) : program;
}

Result<std::optional<AttachmentRow>> find_row(sql::Database& database, const AttachmentName& name) {
  static const std::string kSql = kAttachmentSelect +
                                  "WHERE attachment.program = ?1 AND coalesce(attachment.revision, "
                                  "0) = ?2 AND attachment.name = ?3";
  const auto owner = find_owner(database, name.program, name.revision);
  if (!owner) return fail(owner.error());
  return sql::first_row(database, kSql, read_row, *owner, name.revision.value_or(0), name.name);
}

Result<AttachmentRow> known_row(sql::Database& database, const AttachmentName& name) {
  auto row = find_row(database, name);
  if (!row) return fail(row.error());
  if (*row) return std::move(**row);
  return fail(Errc::NotFound, "program {} has no attachment '{}'",
              words_of(name.program, name.revision), name.name);
}

Result<void> write_down(sql::Database& database, const Attachment& attachment,
                        const AuditEntry& of) {
  AuditEntry entry = of;
  entry.subject = attachment.program;
  entry.detail = fmt::format(
      "{}'{}' sha256 {} size {}",
      attachment.revision ? fmt::format("revision {} ", *attachment.revision) : std::string(),
      attachment.name, attachment.content.hex(), attachment.size);
  return add_audit(database, entry);
}

Result<void> check_room(sql::Database& database, std::int64_t program, const std::string& name) {
  const auto count = sql::first_row(
      database, "SELECT count(*) FROM attachment WHERE program = ?1",
      [](const sql::Statement& row) { return row.number(0); }, program);
  if (!count) return fail(count.error());
  if (count->value_or(0) < AttachmentStore::kMaxAttachments) return {};
  return fail(Errc::LimitExceeded, "program {} has {} attachments: at most {}", name, **count,
              AttachmentStore::kMaxAttachments);
}

/// A content that nothing names any more.
Result<void> drop_if_unused(sql::Database& database, const AttachmentRow& removed) {
  const auto used = sql::first_row(
      database,
      "SELECT EXISTS (SELECT 1 FROM attachment WHERE content = ?1) OR "
      "EXISTS (SELECT 1 FROM revision WHERE content = ?1) OR "
      "EXISTS (SELECT 1 FROM revision WHERE sha256 = ?2) OR "
      "EXISTS (SELECT 1 FROM upload WHERE content = ?1)",
      [](const sql::Statement& row) { return row.integer(0) != 0; }, removed.content,
      std::span<const std::byte>(removed.attachment.content.bytes));
  if (!used) return fail(used.error());
  return used->value_or(true) ? Result<void>() : drop_content(database, removed.content);
}

}  // namespace

Result<std::int64_t> find_owner(sql::Database& database, const std::string& program,
                                std::optional<std::uint64_t> revision) {
  if (revision) {
    if (auto known = find_revision(database, program, revision); !known) return fail(known.error());
  }
  const auto owner = sql::first_row(
      database, "SELECT id FROM program WHERE name = ?1 AND latest IS NOT NULL",
      [](const sql::Statement& row) { return row.integer(0); }, program);
  if (!owner) return fail(owner.error());
  if (*owner) return **owner;
  return fail(Errc::NotFound, "program {} is not in the library", program);
}

Result<Attachment> publish_attachment(sql::Database& database, const NewAttachment& added) {
  const Upload& upload = added.upload;
  const AttachmentName name{upload.program, upload.attachment_revision, *upload.attachment};
  const auto known = find_row(database, name);
  if (!known) return fail(known.error());
  if (*known) {
    if ((*known)->attachment.content == added.digest) return std::move((*known)->attachment);
    return fail(Errc::Conflict,
                "program {} has an attachment '{}' with other bytes: detach it, or choose another "
                "name",
                words_of(name.program, name.revision), name.name);
  }
  const auto owner = find_owner(database, name.program, name.revision);
  if (!owner) return fail(owner.error());
  if (auto room = check_room(database, *owner, name.program); !room) return fail(room.error());
  const auto inserted = sql::run(
      database,
      "INSERT INTO attachment (program, revision, name, content, sha256, comment, author, "
      "created_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)",
      *owner, name.revision, name.name, added.content,
      std::span<const std::byte>(added.digest.bytes), upload.comment, upload.author, added.now);
  if (!inserted) return fail(inserted.error());
  auto row = known_row(database, name);
  if (!row) return fail(row.error());
  const AuditEntry entry{added.now, added.who, "program.attach", {}, {}};
  if (auto written = write_down(database, row->attachment, entry); !written)
    return fail(written.error());
  return std::move(row->attachment);
}

Result<std::vector<Attachment>> AttachmentRepository::list(const std::string& program,
                                                           std::optional<std::uint64_t> revision) {
  static const std::string kSql =
      kAttachmentSelect +
      "WHERE attachment.program = ?1 AND (?2 IS NULL OR attachment.revision IS NULL OR "
      "attachment.revision = ?2) AND coalesce(attachment.revision, ?3) > program.removed_through "
      "ORDER BY coalesce(attachment.revision, 0), attachment.name";
  constexpr auto kAlways = std::numeric_limits<std::int64_t>::max();
  return connections_.read([&](sql::Database& database) -> Result<std::vector<Attachment>> {
    const auto owner = find_owner(database, program, revision);
    if (!owner) return fail(owner.error());
    return sql::all_rows(
        database, kSql, [](const sql::Statement& row) { return read_row(row).attachment; }, *owner,
        revision, kAlways);
  });
}

Result<Attachment> AttachmentRepository::find(const AttachmentName& name) {
  return connections_.read([&](sql::Database& database) -> Result<Attachment> {
    auto row = known_row(database, name);
    if (!row) return fail(row.error());
    return std::move(row->attachment);
  });
}

Result<void> AttachmentRepository::remove(const AttachmentName& name, const Actor& who) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto row = known_row(database, name);
    if (!row) return fail(row.error());
    const auto deleted = sql::run(database, "DELETE FROM attachment WHERE id = ?1", row->id);
    if (!deleted) return deleted;
    if (auto dropped = drop_if_unused(database, *row); !dropped) return dropped;
    return write_down(database, row->attachment, {clock_.now(), who, "program.detach", {}, {}});
  });
}

}  // namespace dripline::storage
