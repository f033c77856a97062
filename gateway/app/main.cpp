#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "gateway/app/gateway.hpp"
#include "gateway/app/motion_choice.hpp"
#include "gateway/app/no_server.hpp"
#include "gateway/app/panel_socket.hpp"
#include "gateway/app/setup_line.hpp"
#include "gateway/app/state_folder.hpp"
#include "protocol/base/random.hpp"
#include "protocol/dds/dds_log.hpp"
#include "protocol/process/daemon_log.hpp"
#include "protocol/process/open_files.hpp"
#include "protocol/process/stop_signals.hpp"

namespace dripline::gateway {
namespace {

constexpr int kExitUsage = 2;
constexpr std::chrono::seconds kFarewell{2};  ///< for the last records to be acknowledged

/// Turns SIGTERM and SIGINT into a message, SIGHUP into a log file opened anew. All threads have
/// them blocked, so only this one gets them.
class SignalWatch {
 public:
  SignalWatch(Inbox& inbox, const sigset_t& signals)
      : thread_([&inbox, signals] {
          int signal = 0;
          // Without a log file a hang-up is the end, as of any program whose terminal is gone.
          do {
            if (::sigwait(&signals, &signal) != 0) return;
          } while (signal == SIGHUP && process::reopen_log());
          inbox.post(StopRequested{signal});
        }) {}
  ~SignalWatch() {
    ::pthread_kill(thread_.native_handle(), SIGTERM);  // ends the wait; nobody reads it any more
    thread_.join();
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  std::thread thread_;
};

Result<std::string> read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    return fail(Errc::NotFound, "cannot read {}", path.string());
  return std::move(text).str();
}

Result<interpreter::Setup> read_setup(const GatewayOptions& options,
                                      const interpreter::Dialect& dialect) {
  if (!options.setup) return interpreter::Setup{};
  const auto text = read_text(*options.setup);
  if (!text) return fail(text.error());
  auto setup = interpreter::parse_setup(*text, dialect.units);
  if (!setup)
    return fail(setup.error().code, "{}: {}", options.setup->string(), setup.error().what);
  return setup;
}

std::uint64_t new_session() {
  return random_number() | 1;  // never zero
}

/// Runs until a stop is asked for; then gives the records some time to be acknowledged.
Result<void> serve(Gateway& gateway, Inbox& inbox, const Clock& clock, bool has_server) {
  std::optional<SteadyTime> farewell;
  SteadyTime next = clock.steady_now();
  for (;;) {
    for (Incoming& incoming : inbox.take(next))
      gateway.receive(std::move(incoming), clock.steady_now());
    if (gateway.stop_requested() && !farewell) {
      farewell = clock.steady_now() + kFarewell;
      if (const auto done = gateway.interrupt_run("the gateway was stopped"); !done) return done;
    }
    next = gateway.turn(clock.steady_now());
    if (!farewell) continue;
    if (gateway.is_delivered() || !has_server || clock.steady_now() >= *farewell) return {};
    next = std::min(next, clock.steady_now() + std::chrono::milliseconds(20));
  }
}

Result<std::unique_ptr<dds::GatewayEndpoint>> open_endpoint(const GatewayOptions& options,
                                                            dds::GatewayHandlers handlers) {
  if (!options.has_server) return std::unique_ptr<dds::GatewayEndpoint>(new NoServer);
  return dds::GatewayEndpoint::open(options.network, options.machine, std::move(handlers));
}

/// Null: programs come from the server.
Result<std::unique_ptr<feed::ControlLine>> open_line(const GatewayOptions& options,
                                                     const interpreter::Setup& setup,
                                                     Inbox& inbox) {
  if (!options.line) return std::unique_ptr<feed::ControlLine>();
  const auto settings = line_settings_of(*options.line, setup.control);
  if (!settings) return fail(settings.error());
  spdlog::info("control at the end of line {} template={} {} buffer={} machine={}",
               options.line->address, options.line->template_name,
               wire::short_form(options.line->settings), options.line->buffer_bytes,
               options.machine);
  return feed::ControlLine::start({.address = options.line->address,
                                   .settings = *settings,
                                   .buffer_bytes = options.line->buffer_bytes,
                                   .wake = [&inbox] { inbox.post(LineChanged{}); }});
}

/// A folder that has a journal had an outbox too, and in it what the control has kept.
Result<report::Outbox> open_outbox(const StateFolder& folder) {
  std::error_code error;
  const bool is_lost = !std::filesystem::exists(folder.outbox(), error) &&
                       std::filesystem::exists(folder.journal(), error);
  auto outbox = report::Outbox::open(folder.outbox());
  if (!outbox || !is_lost) return outbox;
  spdlog::error("{} is gone, and with it what was not delivered yet", folder.outbox().string());
  outbox->stage_memory_fault("what the control has kept is lost with the file " +
                             folder.outbox().filename().string());
  if (const auto done = outbox->commit(); !done) return fail(done.error());
  return outbox;
}

Result<void> run(const GatewayOptions& options) {
  if (auto files = process::require_open_files(process::kGatewayFiles); !files) return files;
  const auto dialect = interpreter::find_dialect(options.control);
  if (!dialect) return fail(dialect.error());
  auto setup = read_setup(options, **dialect);
  if (!setup) return fail(setup.error());
  if (auto fits = check_line(options, *setup); !fits) return fits;
  auto motion = make_motion(options.motion, **dialect, setup->workpiece);
  if (!motion) return fail(motion.error());
  auto folder = StateFolder::open(options.state);
  if (!folder) return fail(folder.error());
  auto outbox = open_outbox(*folder);
  if (!outbox) return fail(outbox.error());
  auto journal = report::RunJournal::open(folder->journal());
  if (!journal) return fail(journal.error());
  auto execution_probe = options.execution_probe ? ExecutionProbe::open(*options.execution_probe)
                                                 : Result<ExecutionProbe>(ExecutionProbe());
  if (!execution_probe) return fail(execution_probe.error());

  const sigset_t signals = process::block_stop_signals();  // before DDS starts its threads
  const SystemClock clock;
  Inbox inbox;
  auto endpoint = open_endpoint(
      options, {.on_command = [&](dds::Command command) { inbox.post(std::move(command)); },
                .on_ack = [&](dds::RecordAck ack) { inbox.post(std::move(ack)); },
                .on_block = [&](dds::BlockData data) { inbox.post(std::move(data)); },
                .on_server = [&](bool is_connected) { inbox.post(ServerSeen{is_connected}); }});
  if (!endpoint) return fail(endpoint.error());
  auto line = open_line(options, *setup, inbox);
  if (!line) return fail(line.error());
  const auto panel = PanelSocket::open(
      options.state, [&](PanelRequest request) { inbox.post(std::move(request)); });
  if (!panel) return fail(panel.error());
  const SignalWatch watch(inbox, signals);
  Gateway gateway({options, **dialect, std::move(*setup), **endpoint, *outbox, *journal,
                   *execution_probe, clock, *std::move(motion), new_session(), line->get()});
  if (const auto done = gateway.recover(); !done) return done;
  spdlog::info(
      "gateway ready machine={} control={} state={} server={} domain={} records={} unattended={}",
      options.machine, options.control, options.state.string(), options.network.server,
      options.network.domain, outbox->unacknowledged(), options.is_unattended ? "yes" : "no");
  const auto done = serve(gateway, inbox, clock, options.has_server);
  spdlog::info("gateway stopped machine={} records={}", options.machine, outbox->unacknowledged());
  return done;
}

/// Declares the table's rows; what was given on the command line is put into `given`.
void declare(CLI::App& app, std::vector<std::pair<const OptionRow*, std::string>>& given) {
  for (const OptionRow& row : option_rows()) {
    auto* option = app.add_option_function<std::string>(
        "--" + std::string(row.key),
        [&given, &row](const std::string& value) { given.emplace_back(&row, value); },
        fmt::format("{} [{}]", row.text, row.fallback));
    option->type_name(std::string(row.type));
    if (row.may_repeat) option->join('\n');
  }
}

Result<void> configure(const std::string& file,
                       const std::vector<std::pair<const OptionRow*, std::string>>& given,
                       GatewayOptions& options) {
  if (!file.empty()) {
    const auto text = read_text(file);
    if (!text) return fail(text.error());
    if (const auto done = apply_config(*text, options); !done)
      return fail(done.error().code, "{}: {}", file, done.error().what);
  }
  for (const auto& [row, value] : given) {
    if (const auto done = row->set(options, value); !done)
      return fail(done.error().code, "--{}: {}", row->key, done.error().what);
  }
  return complete(options);
}

/// dncgw panel [--machine NAME | --state FOLDER] VERB [ARGUMENT]: what is done at the machine.
int panel_main(int argc, char** argv) {
  CLI::App app(
      "What is done at a machine's own panel: by hand, or by a button box wired to this computer.",
      "dncgw panel");
  std::string machine, state;
  std::vector<std::string> words;
  app.add_option("--machine", machine, "The machine whose gateway runs here");
  app.add_option("--state", state, "Its gateway's state folder [STATE/gateways/MACHINE]");
  app.add_option("VERB", words, "What is done, with its argument")->required();
  app.footer("Verbs:\n" + panel_verbs() +
             "\nThe same lines are understood at the socket `panel` in the state folder, one "
             "answer line each.\nExit status: 0 done, 1 refused or no gateway there, 2 wrong "
             "usage.");
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

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "panel") return panel_main(argc - 1, argv + 1);
  CLI::App app("The gateway of one machine: runs the programs that a Dripline server feeds it.",
               "dncgw");
  app.set_version_flag("--version", "dncgw " DRIPLINE_VERSION);
  std::string file;
  std::vector<std::pair<const OptionRow*, std::string>> given;
  app.add_option("--config", file, "TOML file with the same keys; the command line goes first")
      ->type_name("file");
  declare(app, given);
  app.footer(
      "dncgw panel --help: what is done at the machine itself.\n"
      "Exit status: 0 stopped by SIGTERM or SIGINT, 1 could not go on, 2 wrong usage.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  GatewayOptions options;
  if (const auto done = configure(file, given, options); !done) {
    std::fprintf(stderr, "dncgw: %s\n", done.error().what.c_str());
    return kExitUsage;
  }
  ::umask(S_IRWXG | S_IRWXO);  // reports, programs and the log are the owner's alone
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
    spdlog::critical("{} machine={}", done.error().what, options.machine);
    if (options.log) std::fprintf(stderr, "dncgw: %s\n", done.error().what.c_str());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace dripline::gateway

int main(int argc, char** argv) {
  return dripline::gateway::main(argc, argv);
}
