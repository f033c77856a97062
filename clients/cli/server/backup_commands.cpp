#include <memory>
#include <thread>

#include "clients/cli/context.hpp"
#include "clients/cli/server/backup_commands.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using client::Backups;

struct BackupCommand {
  std::string id;
  bool is_detached = false;
};

std::string backup_line(const Backups::Backup& backup) {
  return fmt::format("Backup {}: {}, of which {} were new", backup.id, bytes_text(backup.size),
                     bytes_text(backup.added));
}

/// Until the work that was begun is over; Ctrl-C ends the waiting alone.
client::Reply<Backups> wait_for_end(client::Client& client, client::Reply<Backups> begun) {
  constexpr std::chrono::milliseconds kPollInterval{200};
  catch_interrupts();
  const SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  Progress progress(area, clock, "backup");
  const std::string before = begun && begun->last ? begun->last->time : "";
  while (begun && !is_interrupted()) {
    const bool is_over = !begun->work && begun->last && begun->last->time != before;
    if (is_over) break;
    if (begun->work) progress.update(begun->work->done, begun->work->total);
    std::this_thread::sleep_for(kPollInterval);
    begun = client.backups();
  }
  return begun;
}

int print_outcome(Context& context, const client::Reply<Backups>& state,
                  const BackupCommand& command) {
  const bool is_over = state && !command.is_detached && !state->work && state->last;
  if (is_over && !state->last->error.empty()) return complain({Errc::Io, state->last->error});
  if (const auto status = finished(context, state)) return *status;
  if (!is_over) {
    context.print("In progress at the server: dnc server backups\n");
    return kExitOk;
  }
  for (const auto& backup : state->backups) {
    if (backup.id != state->last->backup) continue;
    const bool is_verified = state->last->kind == "verify";
    context.print(backup_line(backup) + (is_verified ? ", every byte of it is good\n" : "\n"));
  }
  return kExitOk;
}

int finish(Context& context, client::Client& client, client::Reply<Backups> begun,
           const BackupCommand& command) {
  if (!command.is_detached) begun = wait_for_end(client, std::move(begun));
  return print_outcome(context, begun, command);
}

int make(Context& context, client::Client& client, const BackupCommand& command) {
  return finish(context, client, client.make_backup(), command);
}

int verify(Context& context, client::Client& client, const BackupCommand& command) {
  std::string id = command.id;
  if (id.empty()) {
    const auto state = client.backups();
    if (!state) return complain(state.error());
    if (state->backups.empty()) return complain({Errc::NotFound, "there is no backup yet"});
    id = state->backups.front().id;
  }
  return finish(context, client, client.verify_backup(id), command);
}

int list_backups(Context& context, client::Client& client) {
  const auto state = client.backups();
  if (const auto status = finished(context, state)) return *status;
  Table table({"BACKUP", "MADE", "SIZE", "NEW", "VERIFIED"});
  for (const auto& backup : state->backups) {
    table.add({printable(backup.id), time_text(backup.made), bytes_text(backup.size),
               bytes_text(backup.added), time_text(backup.verified)});
  }
  context.print(table);
  for (const auto& damaged : state->damaged)
    context.print(fmt::format("Damaged: {}\n", printable(damaged)));
  if (state->overdue) context.print("The newest is older than it should be.\n");
  if (state->work) {
    context.print(fmt::format("Now: {}, {} of {}\n", state->work->phase,
                              bytes_text(state->work->done), bytes_text(state->work->total)));
  }
  return kExitOk;
}

int remove(Context& context, client::Client& client, const BackupCommand& command) {
  const auto removed = client.remove_backup(command.id);
  if (!removed) return complain(removed.error());
  context.print(fmt::format("Removed backup {}.\n", command.id));
  return kExitOk;
}

}  // namespace

void add_backup_commands(Command server, Context& context) {
  auto made = server.add_subcommand("backup", "Make a backup of the server while it works");
  auto make_options = std::make_shared<BackupCommand>();
  made.add_flag("--detach", make_options->is_detached, "Return at once; the server continues");
  add_json_flag(made, context);
  run_at_server(made, context, make_options, make);

  auto listed = server.add_subcommand("backups", "List the backups, newest first");
  add_json_flag(listed, context);
  run_at_server(listed, context, list_backups);

  auto verified = server.add_subcommand("verify", "Read every byte of a backup");
  auto verify_options = std::make_shared<BackupCommand>();
  verified.add_option("BACKUP", verify_options->id, "The backup; the newest by default");
  verified.add_flag("--detach", verify_options->is_detached,
                    "Return at once; the server continues");
  add_json_flag(verified, context);
  run_at_server(verified, context, verify_options, verify);

  auto removed = server.add_subcommand("remove-backup", "Remove a backup");
  auto remove_options = std::make_shared<BackupCommand>();
  removed.add_option("BACKUP", remove_options->id, "The backup").required();
  run_at_server(removed, context, remove_options, remove);
}

}  // namespace dripline::cli
