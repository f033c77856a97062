#include "server/app/migrate_store.hpp"

#include <fmt/format.h>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "server/app/open_store.hpp"
#include "server/app/state_folder.hpp"
#include "storage/migration/store_migration.hpp"

namespace dripline::app {
namespace {

using migration::Progress;
using migration::Report;
using migration::Request;
using migration::Step;

bool is_url(const std::string& text) {
  return text.find("://") != std::string::npos;
}

Result<Request::Direction> direction_of(const StateFolder& folder, const Settings& settings) {
  if (is_url(settings.migrate_to)) {
    if (!settings.store.empty()) {
      return fail(Errc::Unsupported,
                  "--migrate-to: from one PostgreSQL database into another it is PostgreSQL's own "
                  "(pg_dump, pg_basebackup)");
    }
    return Request::Direction::ToPostgresql;
  }
  std::error_code ec;
  if (!std::filesystem::equivalent(settings.migrate_to, folder.path(), ec)) {
    return fail(Errc::Unsupported,
                "--migrate-to {}: a SQLite file is made in the state folder, {}, which has the key "
                "that the audit trail is signed with",
                settings.migrate_to, folder.path().string());
  }
  if (settings.store.empty()) {
    return fail(Errc::Unsupported,
                "--migrate-to {}: what is kept in this folder is a SQLite file already; name the "
                "PostgreSQL database that it comes from with --store",
                settings.migrate_to);
  }
  return Request::Direction::ToSqlite;
}

/// A line for each tenth of the rows, for people and for logs.
class Shown {
 public:
  bool operator()(const Progress& progress) {
    constexpr std::uint64_t kPercent = 100, kStep = 10;
    const bool has_rows = progress.step == Step::Copy || progress.step == Step::Verify;
    if (!has_rows || progress.total == 0) return true;
    const std::uint64_t percent = progress.done * kPercent / progress.total;
    if (progress.step == step_ && percent < percent_ + kStep) return true;
    step_ = progress.step;
    percent_ = percent;
    fmt::print(stderr, "{}: {} %, {} of {} rows, table {}\n",
               step_ == Step::Copy ? "copying" : "verifying", percent, progress.done,
               progress.total, progress.table);
    return true;
  }

 private:
  Step step_ = Step::Leave;
  std::uint64_t percent_ = 0;
};

std::uint64_t rows_of(const Report& report) {
  std::uint64_t rows = 0;
  for (const auto& table : report.tables) rows += table.digest.rows;
  return rows;
}

void print_json(const Report& report) {
  nlohmann::json tables = nlohmann::json::array();
  for (const auto& table : report.tables) {
    tables.push_back({{"table", table.name},
                      {"rows", table.digest.rows},
                      {"sha256", table.digest.sha256.hex()}});
  }
  const nlohmann::json json{{"from", report.from},
                            {"to", report.to},
                            {"identity", report.identity},
                            {"resumed", report.was_resumed},
                            {"begun_again", report.was_begun_again},
                            {"was_complete", report.was_complete},
                            {"rows", rows_of(report)},
                            {"tables", std::move(tables)}};
  fmt::print("{}\n", json.dump());
}

void print_text(const Report& report, Request::Direction direction) {
  if (report.was_begun_again)
    fmt::print("The source was used since the last attempt: copied from the beginning.\n");
  if (report.was_complete) {
    fmt::print("{} was migrated to {} before.\n", report.from, report.to);
  } else {
    fmt::print("Migrated {} to {}: {} tables with {} rows, read back and compared.\n", report.from,
               report.to, report.tables.size(), rows_of(report));
  }
  if (direction == Request::Direction::ToPostgresql) {
    fmt::print(
        "Start dncd with this database as its --store (or `store` in dncd.toml). The SQLite file "
        "stays as {}.migrated: nothing is stored in it any more.\n",
        StateFolder::kDatabase);
  } else {
    fmt::print(
        "Start dncd without --store. The PostgreSQL database stays: nothing is stored in it any "
        "more.\n");
  }
}

}  // namespace

Result<void> migrate_store(const Settings& settings) {
  std::error_code ec;
  if (!std::filesystem::is_directory(settings.state, ec))
    return fail(Errc::NotFound, "there is nothing to migrate: {} is no state folder",
                settings.state);
  const auto folder = StateFolder::open(settings.state);
  if (!folder) return fail(folder.error());
  const auto direction = direction_of(*folder, settings);
  if (!direction) return fail(direction.error());
  const bool to_postgresql = *direction == Request::Direction::ToPostgresql;
  const std::string& url = to_postgresql ? settings.migrate_to : settings.store;
  if (auto known = check_url(url); !known) return known;
  const auto lock = folder->lock();
  if (!lock) return fail(lock.error());
  const auto holder = holder_name(*folder);
  if (!holder) return fail(holder.error());
  const Request request{.direction = *direction,
                        .file = folder->database(),
                        .postgresql = {.url = url,
                                       .holder = *holder,
                                       .described = "migration by " + description(*folder)},
                        .is_expected =
                            [&](const std::string& identity, const std::string& name) {
                              return folder->expect_identity(identity, name);
                            },
                        .proceed = Shown{}};
  const auto report = migration::migrate(request);
  if (!report) return fail(report.error());
  if (!to_postgresql) {
    if (auto kept = folder->remember_term(report->term); !kept) return kept;
  }
  if (settings.wants_json) {
    print_json(*report);
  } else {
    print_text(*report, *direction);
  }
  return {};
}

}  // namespace dripline::app
