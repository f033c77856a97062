#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <csignal>

#include "clients/cli/command_line.hpp"
#include "clients/cli/completion.hpp"
#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"

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
    print_error("dnc: '{}' is not known here\nSee {} --help.\n", unknown.front(), typed_verbs(app));
  } else {
    print_error("dnc: {}\nSee {} --help.\n", end.what(), typed_verbs(app));
  }
  return kExitUsage;
}

/// Who adds which first words.
struct Verbs {
  void (*add)(Command dnc, Context& context);
  std::array<std::string_view, 3> names;
};
constexpr Verbs kVerbs[]{
    {add_program_commands, {"program"}},
    {add_import_commands, {"import"}},
    {add_offset_commands, {"offset"}},
    {add_folder_commands, {"folder"}},
    {add_webhook_commands, {"webhook"}},
    {add_job_commands, {"job"}},
    {add_machine_commands, {"machine"}},
    {add_run_commands, {"run"}},
    {add_port_commands, {"port"}},
    {add_setup_commands, {"setup"}},
    {add_memory_commands, {"memory"}},
    {add_report_commands, {"report"}},
    {add_server_commands, {"server"}},
    {add_audit_commands, {"audit"}},
    {add_login_commands, {"login", "logout", "whoami"}},
    {add_user_commands, {"user"}},
    {add_token_commands, {"token"}},
    {add_group_commands, {"group"}},
    {add_check_command, {"check"}},
    {add_trace_command, {"trace"}},
    {add_diff_command, {"diff"}},
    {add_edit_command, {"edit"}},
    {add_forecast_command, {"forecast"}},
    {add_touch_command, {"touch"}},
    {add_graphics_command, {"graphics"}},
    {add_approximate_command, {"approximate"}},
    {add_convert_command, {"convert"}},
    {add_conversational_commands, {"conversational"}},
    {add_chart_command, {"chart"}},
    {add_extract_command, {"extract"}},
    {add_pki_commands, {"pki"}},
    {add_completion_command, {"completion"}},
};

/// With one of the names as the first word only its verbs are added: those of all take longer than
/// a short program's check. The completion looks at them all.
void add_verbs(Command dnc, Context& context, std::string_view first) {
  const auto is_of = [&](const Verbs& verbs) {
    return first != "completion" && std::ranges::find(verbs.names, first) != verbs.names.end();
  };
  if (const auto* one = std::ranges::find_if(kVerbs, is_of);
      !first.empty() && one != std::end(kVerbs))
    return one->add(dnc, context);
  for (const Verbs& verbs : kVerbs) verbs.add(dnc, context);
}

int run(int argc, char** argv) {
  Context context;
  CLI::App app(kAbout, "dnc");
  app.set_version_flag("--version", "dnc " DRIPLINE_VERSION);
  app.require_subcommand(1);
  add_connection_options(app, context);
  const Command dnc(&app);
  add_verbs(dnc, context, argc > 1 ? argv[1] : "");
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
    print_error("dnc: {}\n", failure.what());
    return kExitNo;
  }
}
