#include <fmt/format.h>
#include <pthread.h>
#include <sys/stat.h>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "gateway/app/gateway.hpp"
#include "gateway/app/motion_choice.hpp"
#include "gateway/app/panel/panel_socket.hpp"
#include "gateway/app/state_folder.hpp"
#include "protocol/base/random.hpp"
#include "protocol/dds/configuration.hpp"
#include "protocol/process/daemon_log.hpp"
#include "protocol/process/log.hpp"
#include "protocol/process/service_manager.hpp"
#include "protocol/process/settings_reader.hpp"
#include "protocol/process/stop_signals.hpp"

namespace dripline::gateway {
namespace {

constexpr int kExitUsage = 2;
constexpr std::chrono::seconds kFarewell{2};  ///< for the last records to be acknowledged

/// The endpoint of a gateway with a line alone: its outbox keeps what a server would get.
class NoServer final : public dds::GatewayEndpoint {
 public:
  Result<void> write(const dds::Announce&) override { return {}; }
  Result<void> write(const dds::Status&) override { return {}; }
  Result<void> write(const dds::Record&) override { return {}; }
  Result<void> write(const dds::CommandResult&) override { return {}; }
  Result<void> write(const dds::BlockRequest&) override { return {}; }
  bool is_connected() const override { return false; }
  dds::Rejected rejected() const override { return {}; }
};

/// Turns SIGTERM and SIGINT into a message, SIGHUP into a reopened log file. All threads block
/// them, so only this one gets them.
class SignalWatch {
 public:
  SignalWatch(Inbox& inbox, const sigset_t& signals)
      : thread_([&inbox, signals] {
          int signal = 0;
          // Without a log file a hang-up ends the process, as it ends any program without a
          // terminal; a service has none.
          do {
            if (::sigwait(&signals, &signal) != 0) return;
          } while (signal == SIGHUP && (process::reopen_log() || process::has_service_manager()));
          inbox.post(StopRequested{signal});
        }) {}
  ~SignalWatch() {
    // Ends the wait; the message is not read.
    // NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread): sigwait takes it
    ::pthread_kill(thread_.native_handle(), SIGTERM);
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

std::uint64_t new_session() {
  return random_number() | 1;  // never zero
}

/// The line that `systemctl status` shows of a gateway.
std::string status_line(const Gateway& gateway) {
  const dds::Status status = gateway.status();
  std::string line = fmt::format("{} {}", status.machine, to_string(status.execution));
  if (!status.program.empty()) line += fmt::format(", program {}", status.program);
  if (!status.message.empty()) line += fmt::format(": {}", status.message);
  return line;
}

/// Reports to the service manager now and then that the loop runs.
class AliveNotice {
 public:
  explicit AliveNotice(const Gateway& gateway) : gateway_(gateway) {
    process::notify_ready(status_line(gateway));
  }
  /// When to be called again.
  SteadyTime turn(SteadyTime now) {
    if (!interval_) return SteadyTime::max();
    if (now >= due_) {
      process::notify_alive(status_line(gateway_));
      due_ = now + *interval_;
    }
    return due_;
  }

 private:
  const Gateway& gateway_;
  const std::optional<std::chrono::microseconds> interval_ = process::alive_interval();
  SteadyTime due_{};
};

/// Warns of the gateway's own certificate for DDS. When it expires DDS ends the connection without
/// a word, so the gateway is told.
class CertificateNotice {
 public:
  CertificateNotice(const GatewayOptions& options, Inbox& inbox, const Clock& clock)
      : certificate_(options.certificate), inbox_(inbox), clock_(clock) {}
  /// When to be called again.
  SteadyTime turn(SteadyTime now) {
    if (!certificate_ || now < due_) return due_;
    const UtcTime end = certificate_->not_after;
    const auto left = end - clock_.now();
    const bool is_over = left <= std::chrono::seconds(0);
    if (is_over) {
      process::log_error(
          "the DDS certificate has expired {}: no server until it is renewed (dnc pki)",
          pki::expiry_text(end, clock_.now()));
      inbox_.post(ServerSeen{false});
    } else if (left < pki::kExpiryWarning) {
      process::log_warning("the DDS certificate expires {}", pki::expiry_text(end, clock_.now()));
    }
    using std::chrono::microseconds;
    const microseconds wait = is_over ? kInterval : std::min<microseconds>(left, kInterval);
    return due_ = now + std::max<microseconds>(wait, std::chrono::milliseconds(10));
  }

 private:
  static constexpr std::chrono::hours kInterval{24};

  const std::optional<pki::Certificate> certificate_;
  Inbox& inbox_;
  const Clock& clock_;
  SteadyTime due_ = certificate_ ? SteadyTime{} : SteadyTime::max();
};

/// Runs until a stop is requested; then gives the records some time to be acknowledged.
Result<void> serve(Gateway& gateway, Inbox& inbox, const Clock& clock,
                   const GatewayOptions& options) {
  std::optional<SteadyTime> farewell;
  AliveNotice notice(gateway);
  CertificateNotice certificate(options, inbox, clock);
  SteadyTime next = clock.steady_now();
  for (;;) {
    for (const Incoming& incoming : inbox.take(next)) gateway.receive(incoming, clock.steady_now());
    if (gateway.stop_requested() && !farewell) {
      farewell = clock.steady_now() + kFarewell;
      process::notify_stopping();
      if (const auto done = gateway.interrupt_run("the gateway was stopped"); !done) return done;
    }
    next = gateway.turn(clock.steady_now());
    next = std::min(next, notice.turn(clock.steady_now()));
    next = std::min(next, certificate.turn(clock.steady_now()));
    if (!farewell) continue;
    if (gateway.is_delivered() || !options.has_server || clock.steady_now() >= *farewell) return {};
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
  process::log_info("control at the end of line {} template={} {} buffer={} machine={}",
                    options.line->address, options.line->template_name,
                    wire::short_form(options.line->settings), options.line->buffer_bytes,
                    options.machine);
  return feed::ControlLine::start({.address = options.line->address,
                                   .settings = *settings,
                                   .buffer_bytes = options.line->buffer_bytes,
                                   .wake = [&inbox] { inbox.post(LineChanged{}); }});
}

/// A folder with a journal had an outbox too, and in it the memory of the control.
Result<report::Outbox> open_outbox(const StateFolder& folder) {
  std::error_code error;
  const bool is_lost = !std::filesystem::exists(folder.outbox(), error) &&
                       std::filesystem::exists(folder.journal(), error);
  auto outbox = report::Outbox::open(folder.outbox());
  if (!outbox || !is_lost) return outbox;
  process::log_error("{} is gone, and with it the records that were not delivered",
                     folder.outbox().string());
  outbox->memory().stage_fault("what the control has kept is lost with the file " +
                               folder.outbox().filename().string());
  if (const auto done = outbox->commit(); !done) return fail(done.error());
  return outbox;
}

Result<void> run(const GatewayOptions& options) {
  if (auto files = process::require_open_files(process::kGatewayFiles); !files) return files;
  const auto dialect = interpreter::find_dialect(options.control);
  if (!dialect) return fail(dialect.error());
  auto file = read_setup(options, **dialect);
  if (!file) return fail(file.error());
  interpreter::Setup* setup = &file->setup;
  if (auto fits = check_line(options, *setup); !fits) return fits;
  auto motion = make_motion(options.motion, **dialect, {file->machine, setup->workpiece});
  if (!motion) return fail(motion.error());
  auto folder = StateFolder::open(options.state);
  if (!folder) return fail(folder.error());
  auto outbox = open_outbox(*folder);
  if (!outbox) return fail(outbox.error());
  auto journal = report::RunJournal::open(folder->journal());
  if (!journal) return fail(journal.error());
  auto motion_journal = report::MotionJournal::open(folder->motion_journal());
  if (!motion_journal) return fail(motion_journal.error());
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
  Gateway gateway({.options = options,
                   .dialect = **dialect,
                   .setup = std::move(*setup),
                   .setup_digest = digest_of_setup(options),
                   .endpoint = **endpoint,
                   .outbox = *outbox,
                   .journal = *journal,
                   .motion_journal = &*motion_journal,
                   .execution_probe = *execution_probe,
                   .clock = clock,
                   .make_motion = *std::move(motion),
                   .session = new_session(),
                   .line = line->get()});
  if (const auto done = gateway.recover(); !done) return done;
  process::log_info(
      "gateway ready machine={} control={} state={} server={} domain={} records={} unattended={}",
      options.machine, options.control, options.state.string(), options.network.server,
      options.network.domain, outbox->unacknowledged(), options.is_unattended ? "yes" : "no");
  const auto done = serve(gateway, inbox, clock, options);
  process::log_info("gateway stopped machine={} records={}", options.machine,
                    outbox->unacknowledged());
  return done;
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
