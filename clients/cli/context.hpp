#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "clients/cli/command_line.hpp"
#include "clients/cli/exit_status.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/reply.hpp"
#include "clients/lib/server_location.hpp"

namespace dripline::cli {

/// The state every command shares: the options before the verb, and the status it leaves.
class Context {
 public:
  client::LocationOptions location;
  bool wants_json = false;
  int status = kExitOk;

  /// A client of the server (or the servers of one library) that the options, the environment or
  /// the state folder name; when none can be found it complains, sets `status` and gives nothing.
  std::optional<client::Client> connect();

  bool has_color() const;
  /// Text for people, or JSON. Nothing in it steers a terminal, not even one after a pipe; only
  /// JSON goes into a pipe or file as it is.
  void print(std::string_view text) const;
  /// What belongs to others, as a template: a pipe or file gets it byte by byte.
  void print_content(std::string_view bytes) const;
  void print(const Table& table) const { print(table.render(has_color())); }
  void print(const Details& details) const { print(details.render(has_color())); }
};

/// The callback of a command that talks to the server: calls `action` with a client and leaves its
/// status in the context.
template <class Options>
void run_at_server(Command command, Context& context, std::shared_ptr<Options> options,
                   int (*action)(Context&, client::Client&, const Options&)) {
  command.callback([&context, options, action] {
    if (auto client = context.connect()) context.status = action(context, *client, *options);
  });
}
inline void run_at_server(Command command, Context& context,
                          int (*action)(Context&, client::Client&)) {
  command.callback([&context, action] {
    if (auto client = context.connect()) context.status = action(context, *client);
  });
}

/// Adds `--json` to a command.
void add_json_flag(Command command, Context& context);

/// How long transfers continue while the server does not answer; Ctrl-C ends the waiting.
client::RetryPolicy retry_policy();

/// All pages of a listing: `fetch(Page)` is asked until a page is not full or `limit` is reached
/// (0: no limit).
template <class Fetch>
auto fetch_all(std::uint64_t limit, Fetch fetch) -> decltype(fetch(client::Page{})) {
  constexpr std::uint64_t kPageSize = 100;
  auto all = fetch(client::Page{limit == 0 ? kPageSize : std::min(limit, kPageSize), 0});
  while (all && (limit == 0 || all->size() < limit)) {
    if (all->empty() || all->size() % kPageSize != 0) break;
    const std::uint64_t left = limit == 0 ? kPageSize : std::min(kPageSize, limit - all->size());
    auto page = fetch(client::Page{left, all->size()});
    if (!page) return page;
    if (page->empty()) break;
    for (auto& item : *page) all->push_back(std::move(item));
  }
  return all;
}

// One function for each group of verbs: adds it to the application. The verbs run as CLI11
// callbacks and leave their status in the context, which must outlive the application.

void add_program_commands(Command app, Context& context);
void add_import_commands(Command app, Context& context);
void add_offset_commands(Command app, Context& context);
void add_folder_commands(Command app, Context& context);
void add_webhook_commands(Command app, Context& context);
void add_job_commands(Command app, Context& context);
void add_machine_commands(Command app, Context& context);
void add_run_commands(Command app, Context& context);
void add_port_commands(Command app, Context& context);
void add_port_transfer_commands(Command group, Context& context);
/// Verbs of `dnc port` that need no server.
void add_port_doctor_command(Command group, Context& context);
void add_port_replay_command(Command group, Context& context);
void add_port_page_command(Command group, Context& context);
void add_setup_commands(Command app, Context& context);
void add_memory_commands(Command app, Context& context);
void add_report_commands(Command app, Context& context);
/// Verbs of `dnc report`.
void add_measurement_commands(Command report, Context& context);
void add_template_commands(Command report, Context& context);
void add_report_chart_command(Command report, Context& context);
void add_statistics_commands(Command report, Context& context);
void add_server_commands(Command app, Context& context);
void add_audit_commands(Command app, Context& context);
void add_login_commands(Command app, Context& context);
void add_user_commands(Command app, Context& context);
void add_token_commands(Command app, Context& context);
void add_group_commands(Command app, Context& context);
void add_check_command(Command app, Context& context);
void add_trace_command(Command app, Context& context);
void add_diff_command(Command app, Context& context);
void add_edit_command(Command app, Context& context);
void add_approximate_command(Command app, Context& context);
void add_forecast_command(Command app, Context& context);
void add_graphics_command(Command app, Context& context);
void add_touch_command(Command app, Context& context);
void add_convert_command(Command app, Context& context);
void add_chart_command(Command app, Context& context);
void add_extract_command(Command app, Context& context);
void add_conversational_commands(Command app, Context& context);
void add_pki_commands(Command app, Context& context);

/// From here on Ctrl-C (and SIGTERM) set a flag instead of ending the process at once; a second
/// Ctrl-C does end it.
void catch_interrupts();
bool is_interrupted();
/// False when interrupted before the time was over.
bool wait_unless_interrupted(std::chrono::milliseconds time);

}  // namespace dripline::cli
