#include "gateway/app/gateway_process.hpp"

#include <pthread.h>
#include <thread>

#include "protocol/base/random.hpp"
#include "protocol/pki/certificate.hpp"
#include "protocol/process/daemon_log.hpp"
#include "protocol/process/log.hpp"
#include "protocol/process/service_manager.hpp"
#include "protocol/process/stop_signals.hpp"

namespace dripline::gateway {
namespace {

constexpr std::chrono::seconds kRestLimit{20};  ///< for what moves to come to rest
constexpr std::chrono::seconds kFarewell{2};    ///< for the last records to be acknowledged

/// The endpoint of a gateway with a line alone: its outbox keeps what a server would get.
class NoServer final : public dds::GatewayEndpoint {
 public:
  Result<void> write(const dds::Announce&) override { return {}; }
  Result<void> write(const dds::Status&) override { return {}; }
  Result<void> write(const dds::Record&) override { return {}; }
  Result<void> write(const dds::CommandResult&) override { return {}; }
  Result<void> write(const dds::BlockRequest&) override { return {}; }
  Result<void> write(const dds::LineData&) override { return {}; }
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

/// The line that `systemctl status` shows of a gateway.
std::string status_line(const MachineGateway& gateway) {
  const dds::Status status = gateway.status();
  std::string line = fmt::format("{} {}", status.machine, to_string(status.execution));
  if (!status.program.empty()) line += fmt::format(", program {}", status.program);
  if (!status.message.empty()) line += fmt::format(": {}", status.message);
  return line;
}

/// Reports to the service manager now and then that the loop runs.
class AliveNotice {
 public:
  explicit AliveNotice(const MachineGateway& gateway) : gateway_(gateway) {
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
  const MachineGateway& gateway_;
  const std::optional<std::chrono::microseconds> interval_ = process::alive_interval();
  SteadyTime due_{};
};

/// Warns of the gateway's own certificate for DDS. When it expires DDS ends the connection without
/// a word, so the gateway is given it.
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

Result<std::unique_ptr<dds::GatewayEndpoint>> open_endpoint(const GatewayOptions& options,
                                                            dds::GatewayHandlers handlers) {
  if (!options.has_server) return std::unique_ptr<dds::GatewayEndpoint>(new NoServer);
  return dds::GatewayEndpoint::open(options.network, options.machine, std::move(handlers));
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

std::uint64_t new_session() {
  return random_number() | 1;  // never zero
}

}  // namespace

GatewayProcess::GatewayProcess(const GatewayOptions& options, StateFolder state,
                               report::Outbox records, report::RunJournal run_journal)
    : options_(options),
      folder(std::move(state)),
      outbox(std::move(records)),
      journal(std::move(run_journal)),
      session(new_session()) {}

Result<std::unique_ptr<GatewayProcess>> GatewayProcess::open(const GatewayOptions& options) {
  auto folder = StateFolder::open(options.state);
  if (!folder) return fail(folder.error());
  auto outbox = open_outbox(*folder);
  if (!outbox) return fail(outbox.error());
  auto journal = report::RunJournal::open(folder->journal());
  if (!journal) return fail(journal.error());
  std::unique_ptr<GatewayProcess> process(
      new GatewayProcess(options, *std::move(folder), *std::move(outbox), *std::move(journal)));
  if (auto done = process->connect(); !done) return fail(done.error());
  return process;
}

Result<void> GatewayProcess::connect() {
  signals_ = process::block_stop_signals();  // before DDS starts its threads
  std::function<void(dds::LineRequest)> on_line_request;
  if (options_.drives_control())
    on_line_request = [this](dds::LineRequest request) { inbox.post(std::move(request)); };
  auto opened = open_endpoint(
      options_,
      {.on_command = [this](dds::Command command) { inbox.post(std::move(command)); },
       .on_ack = [this](dds::RecordAck ack) { inbox.post(std::move(ack)); },
       .on_block = [this](dds::BlockData data) { inbox.post(std::move(data)); },
       .on_server = [this](bool is_connected) { inbox.post(ServerSeen{is_connected}); },
       .on_stale_server =
           [machine = options_.machine](std::uint64_t term, std::uint64_t seen) {
             process::log_error(
                 "a server {} is not listened to, since one of term {} has taken over: "
                 "it was frozen or cut off, or has an old copy of the library. Where "
                 "that library is to be used again, restart this gateway while its "
                 "machine is idle machine={}",
                 term == 0 ? std::string("without a term") : fmt::format("of term {}", term), seen,
                 machine);
           },
       .on_line_request = std::move(on_line_request)});
  if (!opened) return fail(opened.error());
  endpoint = *std::move(opened);
  auto panel = PanelSocket::open(options_.state,
                                 [this](PanelRequest request) { inbox.post(std::move(request)); });
  if (!panel) return fail(panel.error());
  panel_ = *std::move(panel);
  return {};
}

Result<void> GatewayProcess::run(MachineGateway& gateway) {
  const SignalWatch watch(inbox, signals_);
  if (const auto done = gateway.recover(); !done) return done;
  process::log_info(
      "gateway ready machine={} control={} state={} server={} domain={} records={} unattended={}",
      options_.machine, options_.control, options_.state.string(), options_.network.server,
      options_.network.domain, outbox.unacknowledged(), options_.is_unattended ? "yes" : "no");
  const auto done = serve(gateway);
  process::log_info("gateway stopped machine={} records={}", options_.machine,
                    outbox.unacknowledged());
  return done;
}

/// Runs until a stop is requested; then until the machine rests, and gives the records some time to
/// be acknowledged. The panel and the network are heard all the time.
Result<void> GatewayProcess::serve(MachineGateway& gateway) {
  std::optional<SteadyTime> rest_limit, farewell;
  AliveNotice notice(gateway);
  CertificateNotice certificate(options_, inbox, clock);
  SteadyTime next = clock.steady_now();
  for (;;) {
    for (const Incoming& incoming : inbox.take(next)) gateway.receive(incoming, clock.steady_now());
    if (gateway.stop_requested() && !rest_limit) {
      rest_limit = clock.steady_now() + kRestLimit;
      process::notify_stopping();
    }
    const bool is_late = rest_limit && clock.steady_now() >= *rest_limit;
    if (rest_limit && !farewell && (is_late || gateway.is_at_rest())) {
      if (is_late && !gateway.is_at_rest())
        process::log_error("the machine does not come to rest within {} s machine={}",
                           kRestLimit.count(), options_.machine);
      farewell = clock.steady_now() + kFarewell;
      if (const auto done = gateway.interrupt_run("the gateway was stopped"); !done) return done;
    }
    next = gateway.turn(clock.steady_now());
    next = std::min(next, notice.turn(clock.steady_now()));
    next = std::min(next, certificate.turn(clock.steady_now()));
    if (!rest_limit) continue;
    next = std::min(next, clock.steady_now() + std::chrono::milliseconds(20));
    if (!farewell) continue;
    if (gateway.is_delivered() || !options_.has_server || clock.steady_now() >= *farewell)
      return {};
  }
}

}  // namespace dripline::gateway
