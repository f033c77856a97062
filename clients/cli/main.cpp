#include <CLI/CLI.hpp>
#include <csignal>

#include "clients/cli/command_line.hpp"
#include "clients/cli/completion.hpp"
#include "clients/cli/context.hpp"

namespace {

using namespace dripline::cli;

constexpr const char* kAbout =
    "dnc: the command line of Dripline, for NC programs, machines, serial ports, runs and reports.";

constexpr const char* kFooter = R"(Which server:
  --server, else DRIPLINE_SERVER, else the local server's file STATE/dncd.json. Of servers that
  share a library all are named, with commas: the one that has it answers. STATE is --state,
  else DRIPLINE_STATE, else /var/lib/dripline (root), $XDG_STATE_HOME/dripline or
  ~/.local/state/dripline. The token is --token-file's, else DRIPLINE_TOKEN, else the one
  that dnc login saved for this server (not with --state), else the local server's. These options
  may come before or after the verb.

Examples:
  dnc program push shaft.nc --name O0200 --control centurion
  dnc run start lathe-1 O0200 --follow
  dnc port add line-3 --machine mill-3 --address /dev/ttyUSB0 --template tnc155
  dnc report export latest --format csv -o profile.csv
  dnc user add anna --role operator --group lathes --password
  dnc --server https://dnc.shop:8443 --ca shop-ca.pem --token-file ~/.dnc-token machine list
  dnc --server https://srv-1:8443,https://srv-2:8443 --ca shop-ca.pem machine list
  dnc check shaft.nc
  dnc trace --control centurion --setup lathe.toml shaft.nc
  dnc diff --motion shaft.nc shaft-new.nc
  dnc convert shaft.ptp -o shaft.nc
  dnc edit 15.h --delete 5..7

Exit status:
  0    success
  1    refused by the program, the run or the server
  2    usage, an unreadable file, an unknown control
  3    the server is not reachable
  4    the server does not accept the token, or its user may not do this
  124  --timeout has passed; a watched run continues
  130  interrupted by Ctrl-C; a watched run continues

See `dnc VERB --help` and `dnc GROUP VERB --help`. NO_COLOR is respected.)";

void add_connection_options(CLI::App& app, Context& context) {
  auto& location = context.location;
  app.add_option("--server", location.server,
                 "Address of the server, http(s)://HOST:PORT; with commas: of several that share a "
                 "library")
      ->type_name("URL[,URL...]");
  app.add_option("--token-file", location.token_file, "File that holds the access token")
      ->type_name("FILE");
  app.add_option("--ca", location.ca_file, "PEM file of the authority to trust for https")
      ->type_name("FILE");
  app.add_option("--state", location.state_dir, "State folder of a server on this computer")
      ->type_name("DIR");
  app.add_option("--cert", location.certificate,
                 "PEM file of your certificate, shown instead of a token (https)")
      ->type_name("FILE");
  app.add_option("--key", location.key, "PEM file of the key of --cert")->type_name("FILE");
}

/// Options of a group or the application may follow the verb.
void let_options_follow(CLI::App& app) {
  for (auto* command : app.get_subcommands([](CLI::App*) { return true; })) {
    command->fallthrough();
    let_options_follow(*command);
  }
}

/// "dnc run resume": where the help is of what was typed, as far as it is known.
std::string typed_verbs(const CLI::App& app) {
  std::string text = app.get_name();
  for (const auto* verb : app.get_subcommands()) text += " " + typed_verbs(*verb);
  return text;
}

/// Help and version are no errors; everything else is a usage error.
int report_parse_end(const CLI::App& app, const CLI::ParseError& end) {
  if (end.get_exit_code() == 0) return app.exit(end);
  const auto unknown = app.remaining(true);
  // CLI11 reports only that a verb is missing when there is one that it does not know.
  if (dynamic_cast<const CLI::RequiredError*>(&end) != nullptr && !unknown.empty()) {
    std::fprintf(stderr, "dnc: '%s' is not known here\nSee %s --help.\n", unknown.front().c_str(),
                 typed_verbs(app).c_str());
  } else {
    std::fprintf(stderr, "dnc: %s\nSee %s --help.\n", end.what(), typed_verbs(app).c_str());
  }
  return kExitUsage;
}

int run(int argc, char** argv) {
  Context context;
  CLI::App app(kAbout, "dnc");
  app.set_version_flag("--version", "dnc " DRIPLINE_VERSION);
  app.require_subcommand(1);
  add_connection_options(app, context);
  const Command dnc(&app);
  add_program_commands(dnc, context);
  add_import_commands(dnc, context);
  add_offset_commands(dnc, context);
  add_folder_commands(dnc, context);
  add_webhook_commands(dnc, context);
  add_job_commands(dnc, context);
  add_machine_commands(dnc, context);
  add_run_commands(dnc, context);
  add_port_commands(dnc, context);
  add_setup_commands(dnc, context);
  add_memory_commands(dnc, context);
  add_report_commands(dnc, context);
  add_server_commands(dnc, context);
  add_audit_commands(dnc, context);
  add_login_commands(dnc, context);
  add_user_commands(dnc, context);
  add_token_commands(dnc, context);
  add_group_commands(dnc, context);
  add_check_command(dnc, context);
  add_trace_command(dnc, context);
  add_diff_command(dnc, context);
  add_edit_command(dnc, context);
  add_forecast_command(dnc, context);
  add_touch_command(dnc, context);
  add_graphics_command(dnc, context);
  add_approximate_command(dnc, context);
  add_convert_command(dnc, context);
  add_conversational_commands(dnc, context);
  add_chart_command(dnc, context);
  add_extract_command(dnc, context);
  add_pki_commands(dnc, context);
  add_completion_command(dnc, context);
  app.footer(kFooter);  // after the verbs, which would inherit it
  let_options_follow(app);
  const std::vector<std::string> words(argv + std::min(argc, 3), argv + argc);
  if (argc > 2 && std::string_view(argv[1]) == "completion" && std::string_view(argv[2]) == "words")
    return print_candidates(app, context, words);  // as typed so far, so not to be parsed
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    return report_parse_end(app, end);
  }
  return context.status;
}

}  // namespace

int main(int argc, char** argv) {
  // A connection that breaks while sending is an error to report, not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "dnc: %s\n", failure.what());
    return kExitNo;
  }
}
