#include "storage/impl/report_template_repository.hpp"

#include "protocol/base/names.hpp"
#include "storage/impl/audit_repository.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

const std::string kSelectTemplate =
    "SELECT name, version, text, author, created_us FROM report_template ";

ReportTemplateVersion read_version(const sql::Statement& row) {
  return {.name = row.text(0),
          .version = row.number(1),
          .text = row.text(2),
          .author = row.text(3),
          .created = row.time(4)};
}

/// Of a template that is not removed.
Result<std::optional<ReportTemplateVersion>> find_version(sql::Database& database,
                                                          const std::string& name,
                                                          std::optional<std::uint64_t> version) {
  static const std::string kNewest =
      kSelectTemplate + "WHERE name = ?1 AND is_removed = 0 ORDER BY version DESC LIMIT 1";
  static const std::string kOne = kSelectTemplate + "WHERE name = ?1 AND version = ?2";
  return version ? sql::first_row(database, kOne, read_version, name, *version)
                 : sql::first_row(database, kNewest, read_version, name);
}

std::string version_text(std::optional<std::uint64_t> version) {
  return version ? fmt::format(" version {}", *version) : std::string();
}

Error no_such(const std::string& name, std::optional<std::uint64_t> version) {
  return {Errc::NotFound,
          fmt::format("report template {}{} is not there", name, version_text(version))};
}

std::string assignment_text(const TemplateAssignment& assignment) {
  return fmt::format("{} {}{}", to_string(assignment.scope), assignment.subject,
                     version_text(assignment.version));
}

/// As long as nothing is assigned nothing is derived, and no cursor moves: records that are there
/// when the first assignment is made are no concern of it.
Result<void> pass_over(sql::Database& database) {
  const auto count = database.integer("SELECT count(*) FROM report_template_assignment");
  if (!count) return fail(count.error());
  if (*count > 0) return {};
  return database.execute(
      "INSERT INTO measurement_cursor SELECT machine, epoch, last FROM record_epoch WHERE true "
      "ON CONFLICT (machine, epoch) DO UPDATE SET number = excluded.number");
}

}  // namespace

Result<ReportTemplateVersion> ReportTemplateRepository::push(const ReportTemplateVersion& version,
                                                             const Actor& who) {
  if (auto named = check_machine_name(version.name); !named) return fail(named.error());
  return connections_.write([&](sql::Database& database) -> Result<ReportTemplateVersion> {
    const auto newest = find_version(database, version.name, std::nullopt);
    if (!newest) return fail(newest.error());
    if (*newest && (*newest)->text == version.text) return **newest;
    const auto last = sql::first_row(
        database, "SELECT coalesce(max(version), 0) FROM report_template WHERE name = ?1",
        [](const sql::Statement& row) { return row.number(0); }, version.name);
    if (!last) return fail(last.error());
    ReportTemplateVersion made = version;
    made.version = last->value_or(0) + 1;
    auto done = sql::run(database,
                         "INSERT INTO report_template (name, version, text, author, created_us) "
                         "VALUES (?1, ?2, ?3, ?4, ?5)",
                         made.name, made.version, made.text, made.author, made.created);
    if (!done) return fail(done.error());
    done = add_audit(database, {.time = made.created,
                                .who = who,
                                .action = "report_template.push",
                                .subject = made.name,
                                .detail = fmt::format("version {}", made.version)});
    if (!done) return fail(done.error());
    return made;
  });
}

Result<std::vector<ReportTemplateVersion>> ReportTemplateRepository::list() {
  static const std::string kSql =
      kSelectTemplate +
      "AS one WHERE is_removed = 0 AND version = (SELECT max(version) FROM report_template WHERE "
      "name = one.name) ORDER BY name";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_version); });
}

Result<std::vector<ReportTemplateVersion>> ReportTemplateRepository::versions(
    const std::string& name) {
  static const std::string kSql =
      kSelectTemplate + "WHERE name = ?1 ORDER BY version DESC LIMIT 1000";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_version, name); });
}

Result<ReportTemplateVersion> ReportTemplateRepository::find(const std::string& name,
                                                             std::optional<std::uint64_t> version) {
  auto found = connections_.read(
      [&](sql::Database& database) { return find_version(database, name, version); });
  if (!found) return fail(found.error());
  if (!*found) return fail(no_such(name, version));
  return std::move(**found);
}

Result<void> ReportTemplateRepository::remove(const std::string& name, const Actor& who,
                                              UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto done = sql::run(
        database, "UPDATE report_template SET is_removed = 1 WHERE name = ?1 AND is_removed = 0",
        name);
    if (!done) return done;
    if (database.changes() == 0) return fail(no_such(name, {}));
    done = sql::run(database, "DELETE FROM report_template_assignment WHERE template = ?1", name);
    if (!done) return done;
    return add_audit(database, {.time = time,
                                .who = who,
                                .action = "report_template.remove",
                                .subject = name,
                                .detail = ""});
  });
}

Result<void> ReportTemplateRepository::assign(const TemplateAssignment& assignment,
                                              const Actor& who) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto newest = find_version(database, assignment.name, std::nullopt);
    if (!newest) return fail(newest.error());
    if (!*newest) return fail(no_such(assignment.name, {}));
    const auto pinned = find_version(database, assignment.name, assignment.version);
    if (!pinned) return fail(pinned.error());
    if (!*pinned) return fail(no_such(assignment.name, assignment.version));
    if (auto passed = pass_over(database); !passed) return passed;
    auto done = sql::run(
        database,
        "INSERT INTO report_template_assignment (scope, subject, template, version, author, "
        "created_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6) ON CONFLICT (scope, subject, template) DO "
        "UPDATE SET version = excluded.version, author = excluded.author, "
        "created_us = excluded.created_us",
        to_string(assignment.scope), assignment.subject, assignment.name, assignment.version,
        assignment.author, assignment.created);
    if (!done) return done;
    return add_audit(database, {.time = assignment.created,
                                .who = who,
                                .action = "report_template.assign",
                                .subject = assignment.name,
                                .detail = assignment_text(assignment)});
  });
}

Result<void> ReportTemplateRepository::unassign(const TemplateAssignment& assignment,
                                                const Actor& who) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto done = sql::run(database,
                         "DELETE FROM report_template_assignment WHERE scope = ?1 AND subject = "
                         "?2 AND template = ?3",
                         to_string(assignment.scope), assignment.subject, assignment.name);
    if (!done) return done;
    if (database.changes() == 0) {
      return fail(Errc::NotFound, "report template {} is not assigned to {}", assignment.name,
                  assignment_text(assignment));
    }
    return add_audit(database, {.time = assignment.created,
                                .who = who,
                                .action = "report_template.unassign",
                                .subject = assignment.name,
                                .detail = assignment_text(assignment)});
  });
}

Result<std::vector<TemplateAssignment>> ReportTemplateRepository::assignments() {
  static const std::string kSql =
      "SELECT scope, subject, template, version, author, created_us FROM "
      "report_template_assignment ORDER BY scope, subject, template";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, [](const sql::Statement& row) {
      TemplateAssignment assignment;
      // The schema allows only these words.
      assignment.scope = parse_template_scope(row.text(0)).value_or(TemplateScope::Program);
      assignment.subject = row.text(1);
      assignment.name = row.text(2);
      if (!row.is_null(3)) assignment.version = row.number(3);
      assignment.author = row.text(4);
      assignment.created = row.time(5);
      return assignment;
    });
  });
}

}  // namespace dripline::storage
