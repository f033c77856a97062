#include "storage/impl/programs/release_repository.hpp"

#include <algorithm>

#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

/// A row with another word is damaged, and so is its signature.
Decision read_decision(const sql::Statement& row) {
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
  if (const auto pins = row.optional_integer(12)) {
    decision.closure.emplace(static_cast<std::size_t>(
        std::clamp<std::int64_t>(*pins, 0, static_cast<std::int64_t>(Decision::kMaxPins))));
  }
  return decision;
}

Result<Revision> decidable(sql::Database& database, const Decision& decision, RevisionState from) {
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

std::optional<std::int64_t> pin_count(const Decision& decision) {
  if (!decision.closure) return std::nullopt;
  return static_cast<std::int64_t>(decision.closure->size());
}

/// Returns its id.
Result<std::int64_t> insert_decision(sql::Database& database, const Decision& decision) {
  return sql::insert(
      database,
      "INSERT INTO revision_step (program, revision, name, sha256, step, time_us, who, credential, "
      "address, comment, policy, signature, closure) VALUES ((SELECT id FROM program WHERE name = "
      "?1), ?2, ?1, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12) RETURNING id",
      decision.program, decision.revision, std::span<const std::byte>(decision.content.bytes),
      to_string(decision.step), decision.time, decision.who.name, decision.who.credential,
      decision.who.address, decision.comment, std::span<const std::byte>(decision.policy.bytes),
      std::span<const std::byte>(decision.signature.bytes), pin_count(decision));
}

/// What is pinned must be released, and be what was looked at.
Result<void> check_pin(sql::Database& database, const Pin& pin) {
  const auto revision = find_revision(database, pin.program, pin.revision);
  if (!revision) return fail(revision.error());
  if (revision->state == RevisionState::Released && revision->content == pin.content) return {};
  return fail(Errc::Conflict, "program {} revision {} is {} by now", pin.program, pin.revision,
              to_string(revision->state));
}

Result<void> insert_pins(sql::Database& database, std::int64_t step, const Decision& decision) {
  if (!decision.closure) return {};
  if (decision.closure->size() > Decision::kMaxPins) {
    return fail(Errc::LimitExceeded, "program {} revision {} pins {} revisions: at most {}",
                decision.program, decision.revision, decision.closure->size(), Decision::kMaxPins);
  }
  std::int64_t position = 0;
  for (const Pin& pin : *decision.closure) {
    // A program that calls itself is released by this very decision.
    const bool is_itself = pin.program == decision.program && pin.revision == decision.revision;
    if (auto good = is_itself ? Result<void>() : check_pin(database, pin); !good) return good;
    const auto inserted = sql::run(
        database,
        "INSERT INTO revision_pin (step, position, program, revision, name, sha256) VALUES (?1, "
        "?2, (SELECT id FROM program WHERE name = ?3), ?4, ?3, ?5)",
        step, position++, pin.program, pin.revision, std::span<const std::byte>(pin.content.bytes));
    if (!inserted) return inserted;
  }
  return {};
}

/// "; pins O0001@2, O0002@1".
std::string pin_words(const Decision& decision) {
  if (!decision.closure) return {};
  if (decision.closure->empty()) return "; pins that it calls nothing";
  std::string words = "; pins ";
  for (const Pin& pin : *decision.closure) {
    if (&pin != &decision.closure->front()) words += ", ";
    words += fmt::format("{}@{}", pin.program, pin.revision);
  }
  return words;
}

Result<void> set_state(sql::Database& database, const Decision& decision) {
  return sql::run(database,
                  "UPDATE revision SET state = ?3, "
                  "released_us = CASE WHEN ?3 = 'released' THEN ?4 ELSE released_us END, "
                  "released_after = CASE WHEN ?3 = 'released' THEN newest.run "
                  "ELSE released_after END, "
                  "withdrawn_us = CASE WHEN ?3 = 'withdrawn' THEN ?4 ELSE withdrawn_us END, "
                  "withdrawn_after = CASE WHEN ?3 = 'withdrawn' THEN newest.run "
                  "ELSE withdrawn_after END "
                  "FROM (SELECT coalesce(max(run.number), 0) AS run FROM run) AS newest "
                  "WHERE number = ?2 AND program = (SELECT id FROM program WHERE name = ?1)",
                  decision.program, decision.revision, to_string(state_after(decision.step)),
                  decision.time);
}

Result<Revision> take_step(sql::Database& database, const Decision& decision, RevisionState from) {
  const auto before = decidable(database, decision, from);
  if (!before) return before;
  const auto stored = insert_decision(database, decision);
  if (!stored) return fail(stored.error());
  if (auto pinned = insert_pins(database, *stored, decision); !pinned) return fail(pinned.error());
  if (auto set = set_state(database, decision); !set) return fail(set.error());
  const AuditEntry entry{
      decision.time, decision.who, fmt::format("program.{}", to_string(decision.step)),
      decision.program,
      fmt::format("revision {} sha256 {} {} to {}{}{}{}", decision.revision, decision.content.hex(),
                  to_string(from), to_string(state_after(decision.step)), pin_words(decision),
                  decision.comment.empty() ? "" : ": ", decision.comment)};
  if (auto added = add_audit(database, entry); !added) return fail(added.error());
  return find_revision(database, decision.program, decision.revision);
}

Result<void> read_pins(sql::Database& database, Decision& decision) {
  if (!decision.closure) return {};
  auto pins = sql::all_rows(
      database, "SELECT name, revision, sha256 FROM revision_pin WHERE step = ?1 ORDER BY position",
      [](const sql::Statement& row) {
        return Pin{row.text(0), row.number(1), read_digest(row, 2)};
      },
      decision.id);
  if (!pins) return fail(pins.error());
  // With another number of them the signature does not verify.
  decision.closure = *std::move(pins);
  return {};
}

}  // namespace

Result<Revision> ReleaseRepository::decide(const Decision& decision, RevisionState from) {
  return decide_all({{decision, from}});
}

Result<Revision> ReleaseRepository::decide_all(const std::vector<DecisionFrom>& decisions) {
  return connections_.write([&](sql::Database& database) -> Result<Revision> {
    Result<Revision> last = fail(Errc::Syntax, "no decision");
    for (const auto& [decision, from] : decisions) {
      last = take_step(database, decision, from);
      if (!last) return last;
    }
    return last;
  });
}

Result<std::vector<Revision>> ReleaseRepository::pinned(std::uint64_t decision) {
  static const std::string kSql =
      "SELECT " + kRevisionColumns + kRevisionTables +
      "JOIN revision_pin ON revision_pin.program = revision.program "
      "AND revision_pin.revision = revision.number WHERE revision_pin.step = ?1 "
      "ORDER BY revision_pin.position";
  return connections_.read([&](sql::Database& database) -> Result<std::vector<Revision>> {
    auto revisions = sql::all_rows(database, kSql, read_bound, decision);
    if (!revisions) return fail(revisions.error());
    std::vector<Revision> found;
    for (auto& [revision, named] : *revisions) {
      if (auto good = check_content(revision, named); !good) return fail(good.error());
      found.push_back(std::move(revision));
    }
    return found;
  });
}

Result<std::vector<Decision>> ReleaseRepository::decisions(const std::string& program,
                                                           std::uint64_t revision) {
  return connections_.read([&](sql::Database& database) -> Result<std::vector<Decision>> {
    if (auto known = find_revision(database, program, revision); !known) return fail(known.error());
    auto decisions = sql::all_rows(
        database,
        "SELECT revision_step.id, revision_step.name, revision, sha256, step, time_us, who, "
        "credential, address, comment, policy, signature, closure FROM revision_step "
        "JOIN program ON program.id = revision_step.program "
        "WHERE program.name = ?1 AND revision = ?2 ORDER BY revision_step.id",
        read_decision, program, revision);
    if (!decisions) return fail(decisions.error());
    for (Decision& decision : *decisions) {
      if (auto read = read_pins(database, decision); !read) return fail(read.error());
    }
    return decisions;
  });
}

Result<std::set<std::string>> ReleaseRepository::authors(const Digest& content) {
  const auto names = connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database, "SELECT DISTINCT author FROM revision WHERE sha256 = ?1",
        [](const sql::Statement& row) { return row.text(0); },
        std::span<const std::byte>(content.bytes));
  });
  if (!names) return fail(names.error());
  return std::set<std::string>(names->begin(), names->end());
}

}  // namespace dripline::storage
