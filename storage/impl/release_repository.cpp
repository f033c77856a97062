#include "storage/impl/release_repository.hpp"

#include <algorithm>

#include "storage/impl/content.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/impl/revision_rows.hpp"
#include "storage/sqlite/query.hpp"

namespace dripline::storage {
namespace {

/// A row with another word is damaged, and so is its signature.
Decision read_decision(const sqlite::Statement& row) {
  Decision decision;
  decision.id = row.number(0);
  decision.program = row.text(1);
  decision.revision = row.number(2);
  decision.content = read_digest(row, 3);
  decision.step = parse_revision_step(row.text(4)).value_or(RevisionStep::Reject);
  decision.time = row.time(5);
  decision.who = {row.text(6), row.text(7), row.text(8)};
  decision.comment = row.text(9);
  decision.policy = read_digest(row, 10);
  const auto signature = row.blob(11);
  if (signature.size() == Signature::kSize)
    std::ranges::copy(signature, decision.signature.bytes.begin());
  return decision;
}

Result<Revision> decidable(sqlite::Database& database, const Decision& decision,
                           RevisionState from) {
  auto revision = find_revision(database, decision.program, decision.revision);
  if (!revision) return revision;
  if (revision->is_held) {
    return fail(Errc::Conflict,
                "program {} revision {} came from a machine and waits for acceptance: accept it "
                "first",
                revision->program, revision->number);
  }
  if (revision->content != decision.content) {
    return fail(Errc::Conflict, "program {} revision {} has not the content {}", revision->program,
                revision->number, decision.content.hex());
  }
  if (revision->state == from) return revision;
  return fail(Errc::Conflict, "program {} revision {} is {} by now", revision->program,
              revision->number, to_string(revision->state));
}

Result<void> insert_decision(sqlite::Database& database, const Decision& decision) {
  return sqlite::run(
      database,
      "INSERT INTO revision_step (program, revision, name, sha256, step, time_us, who, credential, "
      "address, comment, policy, signature) VALUES ((SELECT id FROM program WHERE name = ?1), ?2, "
      "?1, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)",
      decision.program, decision.revision, std::span<const std::byte>(decision.content.bytes),
      to_string(decision.step), decision.time, decision.who.name, decision.who.credential,
      decision.who.address, decision.comment, std::span<const std::byte>(decision.policy.bytes),
      std::span<const std::byte>(decision.signature.bytes));
}

Result<void> set_state(sqlite::Database& database, const Decision& decision) {
  return sqlite::run(database,
                     "UPDATE revision SET state = ?3, "
                     "released_us = iif(?3 = 'released', ?4, released_us), "
                     "withdrawn_us = iif(?3 = 'withdrawn', ?4, withdrawn_us) "
                     "WHERE number = ?2 AND program = (SELECT id FROM program WHERE name = ?1)",
                     decision.program, decision.revision, to_string(state_after(decision.step)),
                     decision.time);
}

}  // namespace

Result<Revision> ReleaseRepository::decide(const Decision& decision, RevisionState from) {
  return connections_.write([&](sqlite::Database& database) -> Result<Revision> {
    const auto before = decidable(database, decision, from);
    if (!before) return before;
    if (auto stored = insert_decision(database, decision); !stored) return fail(stored.error());
    if (auto set = set_state(database, decision); !set) return fail(set.error());
    const AuditEntry entry{
        decision.time, decision.who, fmt::format("program.{}", to_string(decision.step)),
        decision.program,
        fmt::format("revision {} sha256 {} {} to {}{}{}", decision.revision, decision.content.hex(),
                    to_string(from), to_string(state_after(decision.step)),
                    decision.comment.empty() ? "" : ": ", decision.comment)};
    if (auto added = add_audit(database, entry); !added) return fail(added.error());
    return find_revision(database, decision.program, decision.revision);
  });
}

Result<std::vector<Decision>> ReleaseRepository::decisions(const std::string& program,
                                                           std::uint64_t revision) {
  return connections_.read([&](sqlite::Database& database) -> Result<std::vector<Decision>> {
    if (auto known = find_revision(database, program, revision); !known) return fail(known.error());
    return sqlite::all_rows(
        database,
        "SELECT revision_step.id, revision_step.name, revision, sha256, step, time_us, who, "
        "credential, address, comment, policy, signature FROM revision_step "
        "JOIN program ON program.id = revision_step.program "
        "WHERE program.name = ?1 AND revision = ?2 ORDER BY revision_step.id",
        read_decision, program, revision);
  });
}

Result<std::set<std::string>> ReleaseRepository::authors(const Digest& content) {
  const auto names = connections_.read([&](sqlite::Database& database) {
    return sqlite::all_rows(
        database, "SELECT DISTINCT author FROM revision WHERE sha256 = ?1",
        [](const sqlite::Statement& row) { return row.text(0); },
        std::span<const std::byte>(content.bytes));
  });
  if (!names) return fail(names.error());
  return std::set<std::string>(names->begin(), names->end());
}

}  // namespace dripline::storage
