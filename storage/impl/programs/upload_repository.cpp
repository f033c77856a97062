#include "storage/impl/programs/upload_repository.hpp"

#include <algorithm>

#include "protocol/base/names.hpp"
#include "protocol/base/random.hpp"
#include "storage/impl/programs/attachment_rows.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/content_seal.hpp"
#include "storage/impl/programs/field_rows.hpp"
#include "storage/impl/programs/folder_repository.hpp"
#include "storage/impl/programs/revision_rows.hpp"

namespace dripline::storage {

namespace {

constexpr std::uint64_t kMaxPieceBytes = 16 << 20;
/// Stored in one transaction, or a single chunk: on a line of 512 kbit/s that takes some seconds,
/// and records and commands of machines wait for no more than one.
constexpr std::uint64_t kTransactionBytes = 256 << 10;

struct UploadRow {
  Upload upload;
  ContentRow content;
};

UploadRow read_upload_row(const sql::Statement& row) {
  UploadRow found;
  found.upload = {row.text(0), row.text(1),   row.text(2), row.text(3),
                  row.text(4), row.number(6), row.time(7), row.integer(8) != 0};
  found.upload.change = {row.optional_text(9), row.optional_text(10), row.optional_text(11),
                         row.optional_text(12), row.optional_text(13)};
  found.upload.attachment = row.optional_text(14);
  if (const auto revision = row.optional_integer(15))
    found.upload.attachment_revision = static_cast<std::uint64_t>(*revision);
  if (const auto file = row.optional_integer(16))
    found.upload.folder_file = static_cast<std::uint64_t>(*file);
  found.content = {row.integer(5), row.number(6)};
  return found;
}

/// Errors: NotFound.
Result<UploadRow> find_row(sql::Database& database, const std::string& id) {
  auto row = sql::first_row(
      database,
      "SELECT upload.id, program, control, comment, author, content, size, created_us, held, part, "
      "operation, material, machine_group, cam_file, attachment, attachment_revision, folder_file "
      "FROM upload JOIN content ON content.id = upload.content WHERE upload.id = ?1",
      read_upload_row, id);
  if (!row) return fail(row.error());
  if (!*row) return fail(Errc::NotFound, "upload {} is not known", id);
  return std::move(**row);
}

std::string label_of(const std::string& id) {
  return fmt::format("upload {}", id);
}

/// No client guesses the id of another one's upload.
std::string new_upload_id() {
  constexpr std::size_t kBytes = 16;
  return random_hex(kBytes);
}

Result<void> drop_upload(sql::Database& database, const std::string& id, std::int64_t content) {
  if (auto done = sql::run(database, "DELETE FROM upload WHERE id = ?1", id); !done) return done;
  return drop_content(database, content);
}

/// The upload's content gets its digest, or is replaced by the same content stored before. Returns
/// the content that is kept.
Result<std::int64_t> name_content(sql::Database& database, const ContentRow& content,
                                  const Digest& digest) {
  const auto known = find_content(database, digest);
  if (!known) return fail(known.error());
  if (*known) {
    const auto sealed = check_seal(database, **known, digest);
    if (!sealed && sealed.error().code != Errc::Corrupt) return fail(sealed.error());
    const bool is_sound = sealed && *sealed != nullptr;
    // The uploaded bytes have just been compared with the digest: they heal a damaged content.
    const auto done = is_sound ? drop_content(database, content.id)
                               : replace_content(database, (*known)->id, content.id);
    if (!done) return fail(done.error());
    if (is_sound) return (*known)->id;
  } else {
    const auto named = sql::run(database, "UPDATE content SET sha256 = ?2 WHERE id = ?1",
                                content.id, std::span<const std::byte>(digest.bytes));
    if (!named) return fail(named.error());
  }
  const ContentRow kept{*known ? (*known)->id : content.id, content.size};
  if (auto done = seal_content(database, kept, digest); !done) return fail(done.error());
  return kept.id;
}

Result<void> check_unchanged(const UploadRow& row, const UploadProgress& progress) {
  if (row.content.size == progress.received) return {};
  return fail(Errc::Conflict, "upload {} was changed by another client meanwhile", row.upload.id);
}

}  // namespace

Result<Upload> UploadRepository::begin(const Upload& upload) {
  if (auto named = check_program_name(upload.program); !named) return fail(named.error());
  Upload begun = upload;
  begun.received = 0;
  if (begun.id.empty()) begun.id = new_upload_id();
  if (begun.created == UtcTime{}) begun.created = clock_.now();
  return connections_.write([&](sql::Database& database) -> Result<Upload> {
    if (find_row(database, begun.id)) {
      return fail(Errc::Conflict, "upload {} exists already", begun.id);
    }
    if (auto known = check_group(database, begun.change); !known) return fail(known.error());
    if (begun.attachment) {
      const auto owner = find_owner(database, begun.program, begun.attachment_revision);
      if (!owner) return fail(owner.error());
    }
    const auto content = create_content(database);
    if (!content) return fail(content.error());
    const auto inserted = sql::run(
        database,
        "INSERT INTO upload (id, program, control, comment, author, content, created_us, "
        "touched_us, held, part, operation, material, machine_group, cam_file, attachment, "
        "attachment_revision, folder_file) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?7, ?8, ?9, ?10, "
        "?11, ?12, ?13, ?14, ?15, ?16)",
        begun.id, begun.program, begun.control, begun.comment, begun.author, *content,
        begun.created, begun.is_held ? 1 : 0, begun.change.part, begun.change.operation,
        begun.change.material, begun.change.machine_group, begun.change.cam_file, begun.attachment,
        begun.attachment_revision, begun.folder_file);
    if (!inserted) return fail(inserted.error());
    return begun;
  });
}

Result<Upload> UploadRepository::find(const std::string& id) {
  return connections_.read([&](sql::Database& database) -> Result<Upload> {
    auto row = find_row(database, id);
    if (!row) return fail(row.error());
    return std::move(row->upload);
  });
}

Result<std::shared_ptr<UploadProgress>> UploadRepository::progress_of(const std::string& id) {
  using Found = Result<std::shared_ptr<UploadProgress>>;
  if (auto kept = table_.find(id)) return kept;
  auto loaded = connections_.read([&](sql::Database& database) -> Found {
    const auto row = find_row(database, id);
    if (!row) return fail(row.error());
    auto progress = std::make_shared<UploadProgress>();
    progress->content = row->content.id;
    progress->received = row->content.size;
    if (progress->received == 0) progress->hash.emplace();
    const std::uint64_t chunk_begin = progress->received - progress->received % kChunkBytes;
    auto tail = load_range(database, row->content, chunk_begin, kChunkBytes, label_of(id));
    if (!tail) return fail(tail.error());
    progress->tail = std::move(*tail);
    return progress;
  });
  if (!loaded) return loaded;
  return table_.insert(id, std::move(*loaded));
}

/// Programs have no limit.
Result<void> UploadRepository::check_attachment_size(const std::string& id) {
  const auto upload = find(id);
  if (!upload) return fail(upload.error());
  if (!upload->attachment) return {};
  return fail(Errc::LimitExceeded, "attachment '{}' of program {} has more than {} bytes",
              *upload->attachment, upload->program, AttachmentStore::kMaxAttachmentBytes);
}

Result<Upload> UploadRepository::append(const std::string& id, std::uint64_t offset,
                                        std::span<const std::byte> bytes) {
  if (bytes.size() > kMaxPieceBytes) {
    return fail(Errc::LimitExceeded, "upload {}: piece of {} bytes, at most {}", id, bytes.size(),
                kMaxPieceBytes);
  }
  const auto progress = progress_of(id);
  if (!progress) return fail(progress.error());
  const std::lock_guard lock((*progress)->mutex);
  const std::uint64_t received = (*progress)->received;
  if (offset > received) {
    return fail(Errc::Conflict,
                "upload {}: the piece begins at {}, but only {} bytes were received", id, offset,
                received);
  }
  if (offset < received) {
    const std::uint64_t known = std::min<std::uint64_t>(bytes.size(), received - offset);
    auto same = check_resent(id, offset, bytes.first(known));
    if (!same || known == bytes.size()) return same;
    bytes = bytes.subspan(known);
  }
  if (received + bytes.size() > AttachmentStore::kMaxAttachmentBytes) {
    if (auto fits = check_attachment_size(id); !fits) return fail(fits.error());
  }
  auto stored = store_piece(id, **progress, bytes);
  // Whatever failed, the next piece starts from what the database holds.
  if (!stored) table_.erase(id);
  return stored;
}

Result<Upload> UploadRepository::store_piece(const std::string& id, UploadProgress& progress,
                                             std::span<const std::byte> bytes) {
  if (bytes.empty()) return store_part(id, progress, {}, Durability::Normal);
  const auto chunks = encode_chunks(progress.tail, bytes);
  for (std::span<const EncodedChunk> left = chunks;;) {
    std::size_t count = 0;
    std::uint64_t stored = 0, plain = 0;
    while (count < left.size() &&
           (count == 0 || stored + left[count].data.size() <= kTransactionBytes)) {
      stored += left[count].data.size();
      plain += left[count++].size;
    }
    const Part part{bytes.first(plain - progress.tail.size()), left.first(count)};
    bytes = bytes.subspan(part.bytes.size());
    left = left.subspan(count);
    // What is committed last is on the disk with all before it.
    auto done =
        store_part(id, progress, part, left.empty() ? Durability::Full : Durability::Normal);
    if (!done || left.empty()) return done;
  }
}

Result<Upload> UploadRepository::store_part(const std::string& id, UploadProgress& progress,
                                            const Part& part, Durability durability) {
  auto stored = connections_.write(
      [&](sql::Database& database) -> Result<Upload> {
        auto row = find_row(database, id);
        if (!row) return fail(row.error());
        if (auto same = check_unchanged(*row, progress); !same) return fail(same.error());
        if (part.bytes.empty()) return std::move(row->upload);
        const auto put =
            put_chunks(database, progress.content, progress.received / kChunkBytes, part.chunks);
        if (!put) return fail(put.error());
        const auto updated =
            sql::run(database, "UPDATE upload SET touched_us = ?2, idle_seconds = 0 WHERE id = ?1",
                     id, clock_.now());
        if (!updated) return fail(updated.error());
        row->upload.received += part.bytes.size();
        return std::move(row->upload);
      },
      durability);
  if (stored) progress.advance(part.bytes);
  return stored;
}

Result<Upload> UploadRepository::check_resent(const std::string& id, std::uint64_t offset,
                                              std::span<const std::byte> bytes) {
  return connections_.read([&](sql::Database& database) -> Result<Upload> {
    auto row = find_row(database, id);
    if (!row) return fail(row.error());
    const auto known = load_range(database, row->content, offset, bytes.size(), label_of(id));
    if (!known) return fail(known.error());
    if (!std::ranges::equal(*known, bytes)) {
      return fail(Errc::Conflict, "upload {}: other bytes than before were sent at {}", id, offset);
    }
    return std::move(row->upload);
  });
}

Result<std::vector<std::byte>> UploadRepository::read(const std::string& id, std::uint64_t offset,
                                                      std::uint64_t length) {
  return connections_.read([&](sql::Database& database) -> Result<std::vector<std::byte>> {
    const auto row = find_row(database, id);
    if (!row) return fail(row.error());
    return load_range(database, row->content, offset, length, label_of(id));
  });
}

Result<void> UploadRepository::set_control(const std::string& id, const std::string& control) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto set =
        sql::run(database, "UPDATE upload SET control = ?2 WHERE id = ?1", id, control);
    if (!set) return set;
    if (database.changes() == 0) return fail(Errc::NotFound, "upload {} is not known", id);
    return {};
  });
}

Result<Digest> UploadRepository::digest_of(const std::string& id, const UploadProgress& progress) {
  if (progress.hash) return progress.hash->digest();
  Sha256 hash;
  for (std::uint64_t offset = 0; offset < progress.received; offset += kChunkBytes) {
    const auto chunk = read(id, offset, kChunkBytes);
    if (!chunk) return fail(chunk.error());
    hash.update(*chunk);
  }
  return hash.digest();
}

/// `publish` makes of the upload's content, which has its digest by then, what it becomes.
template <class Publish>
auto UploadRepository::finish(const std::string& id, const std::optional<Digest>& expected,
                              Publish publish)
    -> std::invoke_result_t<Publish, sql::Database&, const Upload&, std::int64_t, const Digest&> {
  using Published =
      std::invoke_result_t<Publish, sql::Database&, const Upload&, std::int64_t, const Digest&>;
  const auto progress = progress_of(id);
  if (!progress) return fail(progress.error());
  const std::lock_guard lock((*progress)->mutex);
  if ((*progress)->received == 0) return fail(Errc::Syntax, "upload {} has no bytes", id);
  const auto digest = digest_of(id, **progress);
  if (!digest) return fail(digest.error());
  if (expected && *expected != *digest) {
    return fail(Errc::Corrupt, "upload {}: SHA-256 of the {} bytes received is {}, expected {}", id,
                (*progress)->received, digest->hex(), expected->hex());
  }
  auto published = connections_.write([&](sql::Database& database) -> Published {
    const auto row = find_row(database, id);
    if (!row) return fail(row.error());
    if (auto same = check_unchanged(*row, **progress); !same) return fail(same.error());
    if (auto done = sql::run(database, "DELETE FROM upload WHERE id = ?1", id); !done) {
      return fail(done.error());
    }
    const auto content = name_content(database, row->content, *digest);
    if (!content) return fail(content.error());
    return publish(database, row->upload, *content, *digest);
  });
  if (published) table_.erase(id);
  return published;
}

Result<Revision> UploadRepository::commit(const std::string& id,
                                          const std::optional<Digest>& expected) {
  return finish(id, expected,
                [&](sql::Database& database, const Upload& upload, std::int64_t content,
                    const Digest&) -> Result<Revision> {
                  if (upload.attachment) {
                    return fail(Errc::Conflict, "upload {} is of attachment '{}'", id,
                                *upload.attachment);
                  }
                  auto revision = publish_revision(database, upload, content, clock_.now());
                  if (!revision || !upload.folder_file) return revision;
                  auto stored = store_folder_file(database, *upload.folder_file, *revision);
                  if (!stored) return fail(stored.error());
                  return revision;
                });
}

Result<Attachment> UploadRepository::commit_attachment(const std::string& id,
                                                       const std::optional<Digest>& expected,
                                                       const Actor& who) {
  return finish(id, expected,
                [&](sql::Database& database, const Upload& upload, std::int64_t content,
                    const Digest& digest) -> Result<Attachment> {
                  if (!upload.attachment)
                    return fail(Errc::Conflict, "upload {} is of a program's text", id);
                  return publish_attachment(database, {upload, content, digest, who, clock_.now()});
                });
}

Result<void> UploadRepository::abandon(const std::string& id) {
  auto abandoned = connections_.write([&](sql::Database& database) -> Result<void> {
    const auto row = find_row(database, id);
    if (!row) return fail(row.error());
    return drop_upload(database, id, row->content.id);
  });
  if (abandoned) table_.erase(id);
  return abandoned;
}

Result<std::uint64_t> UploadRepository::drop_idle(std::chrono::seconds passed,
                                                  std::chrono::seconds life) {
  auto dropped = connections_.write([&](sql::Database& database) -> Result<std::uint64_t> {
    using Old = std::pair<std::string, std::int64_t>;
    const auto aged =
        sql::run(database, "UPDATE upload SET idle_seconds = idle_seconds + ?1", passed.count());
    if (!aged) return fail(aged.error());
    const auto old = sql::all_rows(
        database, "SELECT id, content FROM upload WHERE idle_seconds > ?1",
        [](const sql::Statement& row) { return Old(row.text(0), row.integer(1)); }, life.count());
    if (!old) return fail(old.error());
    for (const auto& [id, content] : *old) {
      if (auto done = drop_upload(database, id, content); !done) return fail(done.error());
    }
    return static_cast<std::uint64_t>(old->size());
  });
  if (dropped && *dropped > 0) table_.clear();
  return dropped;
}

}  // namespace dripline::storage
