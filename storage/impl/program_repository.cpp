#include "storage/impl/program_repository.hpp"

#include <algorithm>

#include "storage/impl/content.hpp"

namespace dripline::storage {
namespace {

const std::string kSelectRevision =
    "SELECT program.name, revision.number, content.sha256, content.size, revision.control, "
    "revision.comment, revision.author, revision.created_us "
    "FROM revision JOIN program ON program.id = revision.program "
    "JOIN content ON content.id = revision.content ";
const std::string kVisible = "revision.number > program.removed_through ";

Revision read_revision(const sqlite::Statement& row) {
  return {row.text(0), row.number(1), read_digest(row, 2), row.number(3),
          row.text(4), row.text(5),   row.text(6),         row.time(7)};
}

struct ProgramRow {
  std::int64_t id = 0;
  std::uint64_t removed_through = 0;
  std::uint64_t latest = 0;  ///< 0: no revision yet
  std::int64_t latest_content = 0;
};

/// Makes the program when it is new.
Result<ProgramRow> program_row(sqlite::Database& database, const std::string& name) {
  const auto made = sqlite::run(
      database, "INSERT INTO program (name) VALUES (?1) ON CONFLICT (name) DO NOTHING", name);
  if (!made) return fail(made.error());
  const auto row = sqlite::first_row(
      database,
      "SELECT id, removed_through, coalesce(number, 0), coalesce(content, 0) FROM program "
      "LEFT JOIN revision ON revision.program = program.id WHERE name = ?1 "
      "ORDER BY number DESC LIMIT 1",
      [](const sqlite::Statement& s) {
        return ProgramRow{s.integer(0), s.number(1), s.number(2), s.integer(3)};
      },
      name);
  if (!row) return fail(row.error());
  return row->value();
}

/// Errors: NotFound. `number` absent: the latest.
Result<Revision> find_revision(sqlite::Database& database, const std::string& program,
                               std::optional<std::uint64_t> number) {
  static const std::string kLatest = kSelectRevision + "WHERE program.name = ?1 AND " + kVisible +
                                     "ORDER BY revision.number DESC LIMIT 1";
  static const std::string kNumbered =
      kSelectRevision + "WHERE program.name = ?1 AND revision.number = ?2 AND " + kVisible;
  auto found = number ? sqlite::first_row(database, kNumbered, read_revision, program, *number)
                      : sqlite::first_row(database, kLatest, read_revision, program);
  if (!found) return fail(found.error());
  if (*found) return std::move(**found);
  if (number) {
    return fail(Errc::NotFound, "program {} has no revision {} in the library", program, *number);
  }
  return fail(Errc::NotFound, "program {} is not in the library", program);
}

Result<void> check_unused(sqlite::Database& database, const std::string& program) {
  const auto run = sqlite::first_row(
      database,
      "SELECT run.id, machine.name FROM run JOIN machine ON machine.id = run.machine "
      "JOIN program ON program.id = run.program "
      "WHERE program.name = ?1 AND run.state IN ('ordered', 'active') LIMIT 1",
      [](const sqlite::Statement& row) {
        return fmt::format("run {} on {}", row.text(0), row.text(1));
      },
      program);
  if (!run) return fail(run.error());
  if (!*run) return {};
  return fail(Errc::Busy, "program {} is used by the unfinished {}", program, **run);
}

}  // namespace

Result<Revision> publish_revision(sqlite::Database& database, const Upload& upload,
                                  std::int64_t content, UtcTime now) {
  const auto program = program_row(database, upload.program);
  if (!program) return fail(program.error());
  const bool is_visible = program->latest > program->removed_through;
  if (is_visible && program->latest_content == content) {
    return find_revision(database, upload.program, std::nullopt);
  }
  const auto inserted = sqlite::run(
      database,
      "INSERT INTO revision (program, number, content, control, comment, author, created_us) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
      program->id, program->latest + 1, content, upload.control, upload.comment, upload.author,
      now);
  if (!inserted) return fail(inserted.error());
  return find_revision(database, upload.program, program->latest + 1);
}

Result<std::vector<ProgramSummary>> ProgramRepository::programs(Page page) {
  static const std::string kSql =
      "SELECT program.name, revision.number, content.sha256, content.size, revision.control, "
      "revision.comment, revision.author, revision.created_us, visible.revisions "
      "FROM (SELECT program, max(number) AS latest, count(*) AS revisions FROM revision "
      "      JOIN program ON program.id = revision.program WHERE " +
      kVisible +
      "      GROUP BY program) AS visible "
      "JOIN revision ON revision.program = visible.program AND revision.number = visible.latest "
      "JOIN program ON program.id = visible.program "
      "JOIN content ON content.id = revision.content "
      "ORDER BY program.name LIMIT ?1 OFFSET ?2";
  return connections_.read([&](sqlite::Database& database) {
    return Result<std::vector<ProgramSummary>>(sqlite::all_rows(
        database, kSql,
        [](const sqlite::Statement& row) {
          return ProgramSummary{read_revision(row), row.number(8), false};
        },
        page.limit, page.offset));
  });
}

Result<std::vector<Revision>> ProgramRepository::revisions(const std::string& program) {
  static const std::string kSql =
      kSelectRevision + "WHERE program.name = ?1 AND " + kVisible + "ORDER BY revision.number DESC";
  auto found = connections_.read([&](sqlite::Database& database) {
    return sqlite::all_rows(database, kSql, read_revision, program);
  });
  if (found && found->empty()) {
    return fail(Errc::NotFound, "program {} is not in the library", program);
  }
  return found;
}

Result<Revision> ProgramRepository::revision(const std::string& program,
                                             std::optional<std::uint64_t> number) {
  return connections_.read(
      [&](sqlite::Database& database) { return find_revision(database, program, number); });
}

Result<void> ProgramRepository::remove(const std::string& program) {
  return connections_.write([&](sqlite::Database& database) -> Result<void> {
    const auto latest = find_revision(database, program, std::nullopt);
    if (!latest) return fail(latest.error());
    if (auto unused = check_unused(database, program); !unused) return unused;
    return sqlite::run(database, "UPDATE program SET removed_through = ?2 WHERE name = ?1", program,
                       latest->number);
  });
}

Result<std::shared_ptr<const CachedChunk>> ProgramRepository::chunk(const Digest& content,
                                                                    std::uint64_t position) {
  using Loaded = Result<std::shared_ptr<const CachedChunk>>;
  if (auto cached = cache_.find({content, position})) return cached;
  auto loaded = connections_.read([&](sqlite::Database& database) -> Loaded {
    const auto row = find_content(database, content);
    if (!row) return fail(row.error());
    if (!*row) return fail(Errc::NotFound, "content {} is not in the library", content.hex());
    auto chunk = std::make_shared<CachedChunk>();
    chunk->content_size = (*row)->size;
    if (position * kChunkBytes >= chunk->content_size) return chunk;  // behind the end
    auto bytes =
        load_chunk(database, (*row)->id, position, fmt::format("content {}", content.hex()));
    if (!bytes) return fail(bytes.error());
    const auto due = std::min(kChunkBytes, chunk->content_size - position * kChunkBytes);
    if (bytes->size() != due) {
      return fail(Errc::Corrupt, "content {}: chunk {} has {} bytes instead of {}", content.hex(),
                  position, bytes->size(), due);
    }
    chunk->bytes = std::move(*bytes);
    return chunk;
  });
  if (loaded && !(*loaded)->bytes.empty()) cache_.insert({content, position}, *loaded);
  return loaded;
}

Result<std::vector<std::byte>> ProgramRepository::read_content(const Digest& content,
                                                               std::uint64_t offset,
                                                               std::uint64_t length) {
  std::vector<std::byte> bytes;
  for (;;) {
    const std::uint64_t at = offset + bytes.size();
    const auto piece = chunk(content, at / kChunkBytes);
    if (!piece) return fail(piece.error());
    const CachedChunk& found = **piece;
    if (at >= found.content_size) return bytes;
    length = std::min(length, found.content_size - offset);
    bytes.reserve(length);
    const auto part = std::span(found.bytes).subspan(at % kChunkBytes);
    const auto taken = part.first(std::min(part.size(), length - bytes.size()));
    bytes.insert(bytes.end(), taken.begin(), taken.end());
    if (bytes.size() == length) return bytes;
  }
}

}  // namespace dripline::storage
