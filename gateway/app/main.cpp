#include <fmt/format.h>
#include <sys/stat.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "gateway/app/gateway.hpp"
#include "gateway/app/gateway_process.hpp"
#include "gateway/app/motion_choice.hpp"
#include "gateway/app/serial/serial_gateway.hpp"
#include "gateway/line/inbound/rule_reader.hpp"
#include "protocol/dds/configuration.hpp"
#include "protocol/process/daemon_log.hpp"
#include "protocol/process/log.hpp"
#include "protocol/process/service_manager.hpp"
#include "protocol/process/settings_reader.hpp"
#include "protocol/process/stop_signals.hpp"

namespace dripline::gateway {
namespace {

constexpr int kExitUsage = 2;

Result<std::string> read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  // Of an empty file nothing is inserted, which the stream takes for a failure.
  const bool is_empty = file.is_open() && file.peek() == std::ifstream::traits_type::eof();
  if (!file.is_open() || file.bad() || (!is_empty && !(text << file.rdbuf())))
    return fail(Errc::NotFound, "cannot read {}", path.string());
  return std::move(text).str();
}

/// The setup file: what the control knows, and what the machine is.
struct SetupFile {
  interpreter::Setup setup;
  interpreter::MachineData machine;
};

Result<SetupFile> read_setup(const GatewayOptions& options, const interpreter::Dialect& dialect) {
  if (!options.setup) return SetupFile{};
  const auto text = read_text(*options.setup);
  if (!text) return fail(text.error());
  auto setup = interpreter::parse_setup(*text, dialect.units);
  if (!setup)
    return fail(setup.error().code, "{}: {}", options.setup->string(), setup.error().what);
  const auto machine = interpreter::parse_machine_data(*text, dialect.units);
  if (!machine) return fail(machine.error());
  return SetupFile{*std::move(setup), *machine};
}

/// A restart under another setup is refused.
std::string digest_of_setup(const GatewayOptions& options) {
  const auto text = options.setup ? read_text(*options.setup) : Result<std::string>(std::string());
  return text && !text->empty() ? sha256(*text).hex() : std::string();
}

/// Null: programs come from the server.
Result<std::unique_ptr<feed::ControlLine>> open_line(const GatewayOptions& options,
                                                     const interpreter::Setup& setup,
                                                     Inbox& inbox) {
  if (!options.line) return std::unique_ptr<feed::ControlLine>();
  const auto settings = line_settings_of(*options.line, setup.control);
  if (!settings) return fail(settings.error());
  process::log_info("control at the end of line {} template={} {} buffer={} machine={}",
                    options.line->address, options.line->template_name,
                    wire::short_form(options.line->settings), options.line->buffer_bytes,
                    options.machine);
  return feed::ControlLine::start({.address = options.line->address,
                                   .settings = *settings,
                                   .buffer_bytes = options.line->buffer_bytes,
                                   .wake = [&inbox] { inbox.post(LineChanged{}); }});
}

Result<std::shared_ptr<const line::RuleSet>> read_rules(const std::filesystem::path& file) {
  if (file.empty()) return std::make_shared<const line::RuleSet>();
  const auto text = read_text(file);
  if (!text) return fail(text.error());
  auto rules = line::read_rules(*text);
  if (!rules) return fail(rules.error().code, "{}: {}", file.string(), rules.error().what);
  return std::make_shared<const line::RuleSet>(*std::move(rules));
}

/// The machine is a control at the end of this computer's line.
Result<void> run_serial(const GatewayOptions& options) {
  if (auto sound = wire::make_discipline(options.line->settings, wire::Role::Host); !sound)
    return fail(sound.error().code, "motion line: {}", sound.error().what);
  auto rules = read_rules(options.line->rules);
  if (!rules) return fail(rules.error());
  const auto process = GatewayProcess::open(options);
  if (!process) return fail(process.error());
  GatewayProcess& around = **process;
  auto uploads = UploadStore::open(around.folder.uploads());
  if (!uploads) return fail(uploads.error());
  process::log_info("a control at the end of line {} template={} {} buffer={} s machine={}",
                    options.line->address, options.line->template_name,
                    wire::short_form(options.line->settings), options.line->ahead.count(),
                    options.machine);
  SerialGateway gateway({.options = options,
                         .endpoint = *around.endpoint,
                         .outbox = around.outbox,
                         .journal = around.journal,
                         .uploads = *uploads,
                         .clock = around.clock,
                         .rules = *std::move(rules),
                         .recordings = around.folder.recordings(),
                         .kept_transfer = around.folder.kept_transfer(),
                         .kept_emergency_stop = around.folder.emergency_stop(),
                         .session = around.session,
                         .wake = [&around] { around.inbox.post(LineChanged{}); }});
  return around.run(gateway);
}

Result<void> run(const GatewayOptions& options) {
  if (auto files = process::require_open_files(process::kGatewayFiles); !files) return files;
  if (options.drives_control()) return run_serial(options);
  const auto dialect = interpreter::find_dialect(options.control);
  if (!dialect) return fail(dialect.error());
  auto file = read_setup(options, **dialect);
  if (!file) return fail(file.error());
  interpreter::Setup* setup = &file->setup;
  if (auto fits = check_line(options, *setup); !fits) return fits;
  auto motion = make_motion(options.motion, **dialect, {file->machine, setup->workpiece});
  if (!motion) return fail(motion.error());
  const auto process = GatewayProcess::open(options);
  if (!process) return fail(process.error());
  GatewayProcess& around = **process;
  auto motion_journal = report::MotionJournal::open(around.folder.motion_journal());
  if (!motion_journal) return fail(motion_journal.error());
  auto execution_probe = options.execution_probe ? ExecutionProbe::open(*options.execution_probe)
                                                 : Result<ExecutionProbe>(ExecutionProbe());
  if (!execution_probe) return fail(execution_probe.error());
  auto line = open_line(options, *setup, around.inbox);
  if (!line) return fail(line.error());
  Gateway gateway({.options = options,
                   .dialect = **dialect,
                   .setup = std::move(*setup),
                   .setup_digest = digest_of_setup(options),
                   .endpoint = *around.endpoint,
                   .outbox = around.outbox,
                   .journal = around.journal,
                   .motion_journal = &*motion_journal,
                   .execution_probe = *execution_probe,
                   .clock = around.clock,
                   .make_motion = *std::move(motion),
                   .session = around.session,
                   .line = line->get(),
                   .line_doubt = around.folder.line_doubt(),
                   .kept_emergency_stop = around.folder.emergency_stop(),
                   .take_panel = [&around] { return around.inbox.take_panel(); }});
  return around.run(gateway);
}

Result<void> configure(const process::SettingsReader& reader, const std::string& file,
                       GatewayOptions& options) {
  if (!file.empty()) {
    if (const auto done = reader.read_file(file); !done) return done;
  }
  if (const auto done = reader.apply_command_line(); !done) return done;
  return complete(options);
}

/// dncgw panel [--machine NAME | --state FOLDER] VERB [ARGUMENT].
int panel_main(int argc, char** argv) {
  CLI::App app("Operate a machine's own panel: by hand, or by a button box wired to this computer.",
               "dncgw panel");
  std::string machine, state;
  std::vector<std::string> words;
  app.add_option("--machine", machine, "The machine whose gateway runs here");
  app.add_option("--state", state, "Its gateway's state folder [STATE/gateways/MACHINE]");
  app.add_option("VERB", words, "Action at the panel, with its argument")->required();
  app.footer("Verbs:\n" + panel_verbs() +
             "\nThe socket `panel` in the state folder takes the same lines; each line gets one "
             "line in answer.\nExit status: 0 done, 1 refused or no gateway there, 2 usage error.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  GatewayOptions options;
  options.machine = machine;
  options.control = "any";
  options.state = state;
  if (machine.empty() && state.empty()) {
    std::fprintf(stderr, "dncgw panel: --machine NAME or --state FOLDER is required\n");
    return kExitUsage;
  }
  if (machine.empty()) options.machine = "any";
  if (const auto done = complete(options); !done) {
    std::fprintf(stderr, "dncgw panel: %s\n", done.error().what.c_str());
    return kExitUsage;
  }
  const std::string line = fmt::format("{}", fmt::join(words, " "));
  if (const auto good = parse_panel_command(line); !good) {
    std::fprintf(stderr, "dncgw panel: %s\n", good.error().what.c_str());
    return kExitUsage;
  }
  const auto answer = ask_panel(options.state, line);
  if (!answer) {
    std::fprintf(stderr, "dncgw panel: %s\n", answer.error().what.c_str());
    return 1;
  }
  const bool is_done = answer->starts_with("ok");
  std::fprintf(is_done ? stdout : stderr, "%s\n", answer->c_str());
  return is_done ? 0 : 1;
}

int run_gateway(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "panel") return panel_main(argc - 1, argv + 1);
  CLI::App app("Run the programs that a Dripline server feeds to one machine.", "dncgw");
  app.set_version_flag("--version", "dncgw " DRIPLINE_VERSION);
  std::string file;
  GatewayOptions options;
  process::SettingsReader reader(option_rows(), options);
  app.add_option("--config", file,
                 "TOML file with the same keys; the command line takes precedence")
      ->type_name("FILE");
  reader.declare(app);
  app.footer(
      "dncgw panel --help: actions at the machine itself.\nExit status: 0 stopped by SIGTERM or "
      "SIGINT, 1 could not continue, 2 usage error.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  if (const auto done = configure(reader, file, options); !done) {
    std::fprintf(stderr, "dncgw: %s\n", done.error().what.c_str());
    return kExitUsage;
  }
  ::umask(S_IRWXG | S_IRWXO);  // only the owner reads reports, programs and the log
  const process::LogOptions log{.file = options.log ? options.log->string() : "",
                                .level = options.log_level,
                                .max_mb = options.log_mb,
                                .kept = options.log_files};
  if (const auto done = process::start_log("dncgw", log); !done) {
    std::fprintf(stderr, "dncgw: %s\n", done.error().what.c_str());
    return 1;
  }
  dds::send_log_to(process::log_foreign);
  if (const auto done = run(options); !done) {
    process::log_error("{} machine={}", done.error().what, options.machine);
    if (options.log) std::fprintf(stderr, "dncgw: %s\n", done.error().what.c_str());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace dripline::gateway

int main(int argc, char** argv) {
  try {
    return dripline::gateway::run_gateway(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "dncgw: %s\n", failure.what());
    return 1;
  }
}
