#include "storage/impl/programs/field_rows.hpp"

#include <array>

#include "storage/impl/audit_repository.hpp"

namespace dripline::storage {

const std::string kFieldColumns =
    "program.part, program.operation, program.material, program.machine_group ";

ProgramFields read_fields(const sql::Statement& row, int first_column) {
  return {row.text(first_column), row.text(first_column + 1), row.text(first_column + 2),
          row.text(first_column + 3)};
}

Result<void> check_group(sql::Database& database, const FieldChange& change) {
  if (!change.machine_group || change.machine_group->empty()) return {};
  const auto known = sql::first_row(
      database, "SELECT 1 FROM machine_group WHERE name = ?1",
      [](const sql::Statement& row) { return row.integer(0); }, *change.machine_group);
  if (!known) return fail(known.error());
  if (*known) return {};
  return fail(Errc::Conflict, "there is no machine group '{}'", *change.machine_group);
}

namespace {

struct Before {
  std::int64_t program = 0;
  ProgramFields fields;
  std::string cam_file;
};

Result<Before> find_before(sql::Database& database, const Revision& revision) {
  static const std::string kSql = "SELECT program.id, revision.cam_file, " + kFieldColumns +
                                  "FROM program JOIN revision ON revision.program = program.id "
                                  "WHERE program.name = ?1 AND revision.number = ?2";
  auto found = sql::first_row(
      database, kSql,
      [](const sql::Statement& row) {
        return Before{row.integer(0), read_fields(row, 2), row.text(1)};
      },
      revision.program, revision.number);
  if (!found) return fail(found.error());
  if (*found) return std::move(**found);
  return fail(Errc::NotFound, "program {} has no revision {} in the library", revision.program,
              revision.number);
}

}  // namespace

Result<void> describe(sql::Database& database, const Revision& revision, const FieldChange& change,
                      const Actor& who, UtcTime now) {
  if (change.is_empty()) return {};
  if (auto known = check_group(database, change); !known) return known;
  auto before = find_before(database, revision);
  if (!before) return fail(before.error());
  std::string changes;
  const auto set = [&](std::string_view name, std::string& field,
                       const std::optional<std::string>& value) {
    if (!value || *value == field) return;
    changes += fmt::format("{}{} '{}' to '{}'", changes.empty() ? "" : ", ", name, field, *value);
    field = *value;
  };
  ProgramFields& fields = before->fields;
  const ProgramFields fields_before = fields;
  set("part", fields.part, change.part);
  set("operation", fields.operation, change.operation);
  set("material", fields.material, change.material);
  set("machine group", fields.machine_group, change.machine_group);
  if (fields != fields_before) {
    const auto updated = sql::run(database,
                                  "UPDATE program SET part = ?2, operation = ?3, material = ?4, "
                                  "machine_group = ?5 WHERE id = ?1",
                                  before->program, fields.part, fields.operation, fields.material,
                                  fields.machine_group);
    if (!updated) return updated;
  }
  const std::string cam_file_before = before->cam_file;
  set(fmt::format("CAM file of revision {}", revision.number), before->cam_file, change.cam_file);
  if (before->cam_file != cam_file_before) {
    const auto updated =
        sql::run(database, "UPDATE revision SET cam_file = ?3 WHERE program = ?1 AND number = ?2",
                 before->program, revision.number, before->cam_file);
    if (!updated) return updated;
  }
  if (changes.empty()) return {};
  return add_audit(database, {now, who, "program.describe", revision.program, changes});
}

}  // namespace dripline::storage
