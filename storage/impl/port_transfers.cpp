// The part of PortRepository about programs that pass a line without a run.
#include <algorithm>
#include <iterator>

#include <fmt/ranges.h>

#include "storage/impl/repositories.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

constexpr std::string_view kTransferStates[] = {"active", "completed", "aborted", "interrupted"};

Result<TransferState> parse_state(std::string_view text) {
  for (std::size_t at = 0; at < std::size(kTransferStates); ++at) {
    if (kTransferStates[at] == text) return static_cast<TransferState>(at);
  }
  return fail(Errc::Corrupt, "'{}' is no state of a transfer", text);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

std::string_view to_string(TransferDirection direction) {
  return direction == TransferDirection::Send ? "send" : "receive";
}

std::string_view to_string(TransferState state) {
  return kTransferStates[static_cast<std::size_t>(state)];
}

Result<void> PortRepository::save_transfer(const PortTransfer& transfer) {
  if ((transfer.state == TransferState::Active) == transfer.ended.has_value()) {
    return fail(Errc::Syntax, "transfer {}: it is {}, {} an end", transfer.id,
                to_string(transfer.state), transfer.ended ? "with" : "without");
  }
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto machine = sql::first_row(
        database, "SELECT machine FROM port WHERE name = ?1",
        [](const sql::Statement& row) { return row.text(0); }, transfer.port);
    if (!machine) return fail(machine.error());
    if (!*machine) return fail(Errc::NotFound, "port {} is not known", transfer.port);
    return sql::run(
        database,
        "INSERT INTO port_transfer (port, direction, id, programs, size, passed, at_most, state, "
        "reason, began_us, ended_us, after_run) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, "
        "?11, coalesce((SELECT run.id FROM run JOIN machine ON machine.id = run.machine "
        "WHERE machine.name = ?12 ORDER BY run.number DESC LIMIT 1), '')) "
        "ON CONFLICT (port, direction) DO UPDATE SET id = excluded.id, "
        "programs = excluded.programs, size = excluded.size, passed = excluded.passed, "
        "at_most = excluded.at_most, state = excluded.state, reason = excluded.reason, "
        "began_us = excluded.began_us, ended_us = excluded.ended_us, after_run = "
        "CASE WHEN port_transfer.id = excluded.id THEN port_transfer.after_run "
        "ELSE excluded.after_run END",
        transfer.port, to_string(transfer.direction), transfer.id,
        fmt::format("{}", fmt::join(transfer.programs, "\n")), transfer.size, transfer.passed,
        transfer.at_most, to_string(transfer.state), transfer.reason, transfer.began,
        transfer.ended, **machine);
  });
}

Result<void> PortRepository::note_progress(const PortTransfer& transfer) {
  return connections_.write([&](sql::Database& database) {
    return sql::run(database,
                    "UPDATE port_transfer SET passed = ?4, at_most = ?5 WHERE port = ?1 AND "
                    "direction = ?2 AND id = ?3 AND state = 'active'",
                    transfer.port, to_string(transfer.direction), transfer.id, transfer.passed,
                    transfer.at_most);
  });
}

Result<void> PortRepository::drop_transfer(const PortTransfer& transfer) {
  return connections_.write([&](sql::Database& database) {
    return sql::run(database,
                    "DELETE FROM port_transfer WHERE port = ?1 AND direction = ?2 AND id = ?3",
                    transfer.port, to_string(transfer.direction), transfer.id);
  });
}

Result<std::vector<PortTransfer>> PortRepository::transfers(const std::string& port) {
  return connections_.read([&](sql::Database& database) -> Result<std::vector<PortTransfer>> {
    std::string unknown;
    auto all = sql::all_rows(
        database,
        "SELECT direction, id, programs, size, passed, at_most, state, reason, began_us, ended_us, "
        "after_run FROM port_transfer WHERE port = ?1 ORDER BY direction DESC",
        [&](const sql::Statement& row) {
          PortTransfer transfer;
          transfer.port = port;
          transfer.direction =
              row.text(0) == "send" ? TransferDirection::Send : TransferDirection::Receive;
          transfer.id = row.text(1);
          transfer.programs = lines_of(row.text(2));
          transfer.size = row.number(3);
          transfer.passed = row.number(4);
          transfer.at_most = row.number(5);
          const auto state = parse_state(row.text(6));
          if (state) transfer.state = *state;
          if (!state) unknown = state.error().what;
          transfer.reason = row.text(7);
          transfer.began = row.time(8);
          transfer.ended = row.optional_time(9);
          transfer.after_run = row.optional_text(10);
          return transfer;
        },
        port);
    if (!unknown.empty()) return fail(Errc::Corrupt, "port {}: {}", port, unknown);
    return all;
  });
}

}  // namespace dripline::storage
