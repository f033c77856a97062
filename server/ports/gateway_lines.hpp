#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/library/programs.hpp"
#include "server/library/releases.hpp"
#include "server/machines/machine_control.hpp"
#include "server/machines/run_sources.hpp"
#include "server/machines/worker_pool.hpp"
#include "server/ports/gateways/gateway_monitor.hpp"
#include "server/ports/port_control.hpp"
#include "server/ports/programs/broken_program.hpp"
#include "server/ports/requests/gateway_at_control.hpp"
#include "server/ports/strand.hpp"

namespace dripline::ports {

class RemoteRequestHandler;

/// The lines of gateways beside a control, as far as the server has a part in them: programs that
/// the control has sent are pulled and stored, its requests are decided, recordings and tests are
/// fetched. Each is shown as a port with the machine's name. Any thread.
class GatewayLines {
 public:
  struct Parts {
    const storage::Store& store;
    library::Releases& releases;
    library::Programs& programs;
    const Clock& clock;
    AskLine ask;
    machines::MachineControl& machines;  ///< of the gateways
    ResetGate& resets;
    unsigned workers = 2;
  };
  explicit GatewayLines(Parts parts);
  ~GatewayLines();
  void end();

  /// On a DDS thread; returns at once.
  void on_status(const dds::Status& status);
  std::vector<PortView> ports() const;
  /// Errors: NotFound (no gateway has such a line).
  Result<PortView> port(const std::string& name) const;
  bool has(const std::string& name) const { return port(name).has_value(); }
  // Promises of these: PortControl.
  Result<PortTest> test(const std::string& name);
  Result<PortTransfer> send(const std::string& name, const std::vector<ProgramChoice>& programs);
  Result<std::string> confirm_reset(const std::string& name);
  Result<void> receive(const std::string& name);
  Result<void> stop_transfer(const std::string& name, const std::string& reason);
  Result<RuleVerdict> test_rules(const std::string& name, const std::string& text) const;
  Result<std::vector<PortTraffic>> recording(const std::string& name) const;
  void on_traffic(std::function<void(const PortTraffic&)> listener,
                  std::function<bool(const std::string& port)> has_listeners);

 private:
  struct Line;
  std::shared_ptr<Line> line_of(const std::string& machine);
  PortView show(const machines::MachineView& machine, const dds::LineStatus& line) const;
  void fetch_upload(const std::shared_ptr<Line>& line, const dds::LineUpload& upload);
  Result<std::string> store_upload(const std::string& machine, const dds::LineUpload& upload);
  void handle_call(const std::shared_ptr<Line>& line, const dds::LineCall& call, SteadyTime asked);
  /// Errors: those of ResetGate::check; NotFound.
  Result<void> check_reset(const std::string& name) const;
  std::string control_of(const std::string& machine) const;

  const Parts parts_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Line>> lines_;
  GatewayMonitor monitor_;
  machines::WorkerPool pool_;  // last: its tasks use the others
};

}  // namespace dripline::ports
