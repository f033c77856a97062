#include "storage/impl/offset_repository.hpp"

#include "protocol/base/names.hpp"
#include "storage/impl/audit_repository.hpp"
#include "storage/impl/setup_rows.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

OffsetRules read_rules(const sql::Statement& row) {
  return {.machine = row.text(0),
          .version = row.number(1),
          .text = row.text(2),
          .author = row.text(3),
          .created = row.time(4)};
}

Result<std::optional<OffsetRules>> newest_rules(sql::Database& database,
                                                const std::string& machine) {
  return sql::first_row(database,
                        "SELECT machine, version, text, author, created_us FROM offset_rules "
                        "WHERE machine = ?1 ORDER BY version DESC LIMIT 1",
                        read_rules, machine);
}

const std::string kSelectOffset =
    "SELECT id, machine, rule, target, unit, old_value, new_value, base, state, used, left_out, "
    "mean, first, last, reasons, created_us, decided_us, who, comment, is_automatic, setup "
    "FROM offset_proposal ";

OffsetProposal read_proposal(const sql::Statement& row) {
  OffsetProposal proposal;
  proposal.id = row.number(0);
  proposal.machine = row.text(1);
  proposal.rule = row.text(2);
  proposal.target = row.text(3);
  proposal.unit = row.text(4);
  proposal.old_value = row.real(5);
  proposal.new_value = row.real(6);
  proposal.base = row.number(7);
  // The schema allows only these words; a row with another one is damaged, and is never applied.
  proposal.state = parse_offset_state(row.text(8)).value_or(OffsetState::Rejected);
  proposal.used = row.number(9);
  proposal.left_out = row.number(10);
  proposal.mean = row.real(11);
  proposal.first = row.number(12);
  proposal.last = row.number(13);
  proposal.reasons = row.text(14);
  proposal.created = row.time(15);
  proposal.decided = row.optional_time(16);
  proposal.who = row.text(17);
  proposal.comment = row.text(18);
  proposal.is_automatic = row.integer(19) != 0;
  if (const auto setup = row.optional_integer(20))
    proposal.setup = static_cast<std::uint64_t>(*setup);
  return proposal;
}

Result<OffsetProposal> find_proposal(sql::Database& database, std::uint64_t id) {
  auto found = sql::first_row(database, kSelectOffset + "WHERE id = ?1", read_proposal, id);
  if (!found) return fail(found.error());
  if (*found) return std::move(**found);
  return fail(Errc::NotFound, "there is no offset proposal {}", id);
}

Result<OffsetProposal> find_pending(sql::Database& database, std::uint64_t id) {
  auto proposal = find_proposal(database, id);
  if (!proposal) return proposal;
  if (auto pending = check_pending(*proposal); !pending) return fail(pending.error());
  return proposal;
}

Result<std::optional<OffsetProposal>> pending_of(sql::Database& database,
                                                 const std::string& machine,
                                                 const std::string& target) {
  return sql::first_row(database,
                        kSelectOffset + "WHERE machine = ?1 AND target = ?2 AND state = 'pending'",
                        read_proposal, machine, target);
}

Result<void> supersede(sql::Database& database, std::uint64_t id, UtcTime now,
                       const std::string& reason) {
  return sql::run(database,
                  "UPDATE offset_proposal SET state = 'superseded', decided_us = ?2, comment = "
                  "?3 WHERE id = ?1",
                  id, now, reason);
}

bool is_of_the_same(const OffsetProposal& a, const OffsetProposal& b) {
  return a.first == b.first && a.last == b.last && a.used == b.used && a.mean == b.mean &&
         a.new_value == b.new_value && a.base == b.base;
}

std::string subject_of(const OffsetProposal& proposal) {
  return proposal.machine + " " + proposal.target;
}

std::string change_text(const OffsetProposal& proposal) {
  return fmt::format("proposal {}: {} to {} {}, from {} measurements with mean deviation {:.6g}",
                     proposal.id, proposal.old_value, proposal.new_value, proposal.unit,
                     proposal.used, proposal.mean);
}

}  // namespace

Result<OffsetRules> OffsetRepository::save_rules(const OffsetRules& given, const Actor& who) {
  if (auto named = check_machine_name(given.machine); !named) return fail(named.error());
  return connections_.write([&](sql::Database& database) -> Result<OffsetRules> {
    auto newest = newest_rules(database, given.machine);
    if (!newest) return fail(newest.error());
    if (*newest && (*newest)->text == given.text) return std::move(**newest);
    OffsetRules rules = given;
    rules.version = *newest ? (*newest)->version + 1 : 1;
    const auto kept =
        sql::run(database,
                 "INSERT INTO offset_rules (machine, version, text, author, created_us) VALUES "
                 "(?1, ?2, ?3, ?4, ?5)",
                 rules.machine, rules.version, rules.text, rules.author, rules.created);
    if (!kept) return fail(kept.error());
    const auto noted = add_audit(database, {.time = rules.created,
                                            .who = who,
                                            .action = "offset.rules",
                                            .subject = rules.machine,
                                            .detail = fmt::format("version {}", rules.version)});
    if (!noted) return fail(noted.error());
    return rules;
  });
}

Result<OffsetRules> OffsetRepository::rules(const std::string& machine) {
  return connections_.read([&](sql::Database& database) -> Result<OffsetRules> {
    auto newest = newest_rules(database, machine);
    if (!newest) return fail(newest.error());
    if (*newest) return std::move(**newest);
    return fail(Errc::NotFound, "machine {} has no offset rules", machine);
  });
}

Result<KeptProposal> OffsetRepository::propose(const OffsetProposal& given) {
  if (auto named = check_machine_name(given.machine); !named) return fail(named.error());
  return connections_.write([&](sql::Database& database) -> Result<KeptProposal> {
    auto pending = pending_of(database, given.machine, given.target);
    if (!pending) return fail(pending.error());
    if (const auto& known = *pending) {
      if (is_of_the_same(*known, given)) return KeptProposal{std::move(**pending), false};
      if (auto done = supersede(database, known->id, given.created, "by a newer one"); !done)
        return fail(done.error());
    }
    const auto kept = sql::run(
        database,
        "INSERT INTO offset_proposal (machine, rule, target, unit, old_value, new_value, base, "
        "used, "
        "left_out, mean, first, last, reasons, created_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, "
        "?9, ?10, ?11, ?12, ?13, ?14)",
        given.machine, given.rule, given.target, given.unit, given.old_value, given.new_value,
        given.base, given.used, given.left_out, given.mean, given.first, given.last, given.reasons,
        given.created);
    if (!kept) return fail(kept.error());
    auto stored = pending_of(database, given.machine, given.target);
    if (!stored) return fail(stored.error());
    return KeptProposal{std::move(**stored), true};
  });
}

Result<void> OffsetRepository::withdraw(const std::string& machine, const std::string& target,
                                        UtcTime now, const std::string& reason) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto pending = pending_of(database, machine, target);
    if (!pending) return fail(pending.error());
    return *pending ? supersede(database, (*pending)->id, now, reason) : Result<void>{};
  });
}

Result<OffsetProposal> OffsetRepository::find(std::uint64_t id) {
  return connections_.read([&](sql::Database& database) { return find_proposal(database, id); });
}

Result<std::vector<OffsetProposal>> OffsetRepository::list(const OffsetFilter& filter, Page page) {
  std::string sql = kSelectOffset + "WHERE true ";  // few texts, so that each is prepared once
  if (filter.machine) sql += "AND machine = ?1 ";
  if (filter.target) sql += "AND target = ?2 ";
  if (filter.state) sql += "AND state = ?3 ";
  sql +=
      "AND (?1 IS NULL OR true) AND (?2 IS NULL OR true) AND (?3 IS NULL OR true) ORDER BY id DESC "
      "LIMIT ?4 OFFSET ?5";
  std::optional<std::string> state;
  if (filter.state) state = std::string(to_string(*filter.state));
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, sql, read_proposal, filter.machine, filter.target, state,
                         page.limit, page.offset);
  });
}

Result<SetupRevision> OffsetRepository::apply(const OffsetDecision& decision,
                                              const SetupRevision& setup) {
  return connections_.write([&](sql::Database& database) -> Result<SetupRevision> {
    const auto proposal = find_pending(database, decision.id);
    if (!proposal) return fail(proposal.error());
    if (proposal->machine != setup.machine) {
      return fail(Errc::Conflict, "offset proposal {} is of machine {}, the setup of {}",
                  proposal->id, proposal->machine, setup.machine);
    }
    auto saved = save_setup(database, setup, proposal->base, decision.time);
    if (!saved) return saved;
    if (saved->number == proposal->base) {
      return fail(Errc::Conflict, "offset proposal {} changes nothing in setup {} of {}",
                  proposal->id, saved->number, saved->machine);
    }
    const auto decided = sql::run(
        database,
        "UPDATE offset_proposal SET state = 'applied', setup = ?2, decided_us = ?3, who = ?4, "
        "comment = ?5, is_automatic = ?6 WHERE id = ?1",
        decision.id, saved->number, decision.time, decision.who.name, decision.comment,
        decision.is_automatic ? 1 : 0);
    if (!decided) return fail(decided.error());
    const auto noted = add_audit(
        database, {.time = decision.time,
                   .who = decision.who,
                   .action = "offset.apply",
                   .subject = subject_of(*proposal),
                   .detail = fmt::format("{}; setup {}, sha256 {}{}", change_text(*proposal),
                                         saved->number, saved->sha256.hex(),
                                         decision.is_automatic ? "; within the policy" : "")});
    if (!noted) return fail(noted.error());
    return saved;
  });
}

Result<OffsetProposal> OffsetRepository::reject(const OffsetDecision& decision) {
  return connections_.write([&](sql::Database& database) -> Result<OffsetProposal> {
    const auto proposal = find_pending(database, decision.id);
    if (!proposal) return proposal;
    const auto decided = sql::run(database,
                                  "UPDATE offset_proposal SET state = 'rejected', decided_us = ?2, "
                                  "who = ?3, comment = ?4 WHERE id = ?1",
                                  decision.id, decision.time, decision.who.name, decision.comment);
    if (!decided) return fail(decided.error());
    const auto noted = add_audit(database, {.time = decision.time,
                                            .who = decision.who,
                                            .action = "offset.reject",
                                            .subject = subject_of(*proposal),
                                            .detail = change_text(*proposal)});
    if (!noted) return fail(noted.error());
    return find_proposal(database, decision.id);
  });
}

}  // namespace dripline::storage
