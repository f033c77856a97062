#pragma once

#include <memory>
#include <string>

#include "gateway/app/command_log.hpp"
#include "gateway/app/machine_gateway.hpp"
#include "gateway/app/options.hpp"
#include "gateway/app/panel/consent.hpp"
#include "gateway/app/panel/kept_emergency_stop.hpp"
#include "gateway/app/serial/kept_transfer.hpp"
#include "gateway/app/serial/line_answers.hpp"
#include "gateway/app/serial/line_calls.hpp"
#include "gateway/app/serial/serial_inbound.hpp"
#include "gateway/app/serial/serial_run.hpp"
#include "gateway/app/serial/serial_transfer.hpp"
#include "gateway/app/serial/task_queue.hpp"
#include "gateway/app/server_link.hpp"
#include "gateway/line/port_line.hpp"

namespace dripline::gateway {

/// The gateway beside a real old control: the machine is at the end of the gateway's own serial
/// line, which this drives as the server drives its ports. Program text comes from the server and
/// is buffered here; what the control sends goes there. Without a server it continues with the text
/// it has. One thread and the line's.
class SerialGateway final : public MachineGateway {
 public:
  struct Parts {
    const GatewayOptions& options;
    dds::GatewayEndpoint& endpoint;
    report::Outbox& outbox;
    report::RunJournal& journal;
    UploadStore& uploads;
    const Clock& clock;
    std::shared_ptr<const line::RuleSet> rules;
    std::filesystem::path recordings;     ///< folder of the flight recorder; empty: in memory only
    std::filesystem::path kept_transfer;  ///< its file (KeptTransfer)
    std::filesystem::path kept_emergency_stop = {};  ///< its file; empty: not kept
    std::uint64_t session = 0;                       ///< of this process, not zero
    std::function<void()> wake;                      ///< `turn` has something to do; any thread
    line::LineOpener open = {};                      ///< empty: serial::LineDriver::start
  };
  /// All references must outlive it.
  explicit SerialGateway(Parts parts);
  ~SerialGateway() override;

  Result<void> recover() override;
  void receive(const Incoming& incoming, SteadyTime now) override;
  SteadyTime turn(SteadyTime now) override;
  bool stop_requested() const override { return stop_requested_; }
  bool is_at_rest() const override { return true; }  // closing the line is all it can do
  Result<void> interrupt_run(const std::string& reason) override;
  bool is_delivered() const override {
    return parts_.outbox.unacknowledged() == 0 && commands_.is_sent();
  }
  dds::Status status() const override;

  static constexpr std::chrono::milliseconds kTick{200};  ///< of the line

 private:
  void on(const dds::Command& command, SteadyTime now);
  void on(const dds::RecordAck& ack, SteadyTime now);
  void on(const dds::BlockData& data, SteadyTime now);
  void on(const ServerSeen& server, SteadyTime now);
  void on(const StopRequested& stop, SteadyTime now);
  void on(const LineChanged&, SteadyTime) {}  // every turn runs the line's tasks
  void on(const PanelRequest& request, SteadyTime now);
  void on(const dds::LineRequest& request, SteadyTime now);
  void on_request(const wire::TransferRequest& request);
  void add_call(line::RuleAction action, const std::string& argument);
  void on_sent(const line::SendEnd& end);

  // serial_commands.cpp
  Reply carry_out(const dds::Command& command, bool is_stop);
  Reply start(const dds::Command& command);
  Reply operate(const dds::Command& command);
  Reply set_emergency_stop(bool is_pressed, bool is_at_panel);
  Reply carry_out(const PanelCommand& command);
  Reply set_remote_enable(bool is_enabled);
  void note_at_panel(const std::string& text);
  bool is_sending_programs() const;
  Result<void> check_transfer() const;
  Result<void> check_stop() const;
  bool end_transfer(const std::string& reason);
  void drop_request(const std::string& reason);

  std::shared_ptr<line::PortLine> make_line(line::LineMemory before);
  line::PortListener listener();
  std::string label() const;

  Parts parts_;
  const wire::LineSettings& settings_;
  ServerLink server_;
  Consent consent_;
  CommandValidity validity_;
  CommandLog commands_;
  SerialRecords records_;
  SerialRun run_;
  LineCalls calls_;
  SerialInbound inbound_;
  SerialTransfer transfer_;
  LineAnswers answers_;
  const KeptTransfer kept_transfer_;
  KeptEmergencyStop emergency_stop_;
  std::shared_ptr<TaskQueue> tasks_;
  std::shared_ptr<line::PortLine> port_;
  SteadyTime next_tick_{};
  bool stop_requested_ = false;
};

}  // namespace dripline::gateway
