#pragma once

#include <csignal>
#include <memory>

#include "gateway/app/inbox.hpp"
#include "gateway/app/machine_gateway.hpp"
#include "gateway/app/options.hpp"
#include "gateway/app/panel/panel_socket.hpp"
#include "gateway/app/state_folder.hpp"
#include "gateway/report/outbox.hpp"
#include "gateway/report/run_journal.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// What a gateway's process has besides the gateway: its state on disk, the server's end, the
/// panel, signals. Messages come into `inbox`.
class GatewayProcess {
 public:
  /// Errors: those of the folder, the outbox, the journal, the endpoint and the panel.
  static Result<std::unique_ptr<GatewayProcess>> open(const GatewayOptions& options);
  GatewayProcess(const GatewayProcess&) = delete;
  GatewayProcess& operator=(const GatewayProcess&) = delete;

  /// Until a stop is requested; then the machine comes to rest (20 s at most), the run ends, and
  /// the records get 2 s to be acknowledged. A second signal changes nothing. Errors: those of the
  /// gateway's `recover` and `interrupt_run`.
  Result<void> run(MachineGateway& gateway);

 private:
  const GatewayOptions& options_;

 public:
  StateFolder folder;
  report::Outbox outbox;
  report::RunJournal journal;
  const SystemClock clock;
  const std::uint64_t session;  ///< of this process, not zero
  Inbox inbox;
  std::unique_ptr<dds::GatewayEndpoint> endpoint;

 private:
  GatewayProcess(const GatewayOptions& options, StateFolder state, report::Outbox records,
                 report::RunJournal run_journal);
  Result<void> connect();
  Result<void> serve(MachineGateway& gateway);

  sigset_t signals_{};
  std::unique_ptr<PanelSocket> panel_;
};

}  // namespace dripline::gateway
