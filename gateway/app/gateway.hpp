#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "gateway/app/command_log.hpp"
#include "gateway/app/inbox.hpp"
#include "gateway/app/jog/jogger.hpp"
#include "gateway/app/line_operator.hpp"
#include "gateway/app/machine_gateway.hpp"
#include "gateway/app/memory/position_setter.hpp"
#include "gateway/app/panel/panel_controller.hpp"
#include "gateway/app/run/run_loop.hpp"
#include "gateway/app/server_link.hpp"
#include "gateway/app/status_builder.hpp"

namespace dripline::gateway {

/// One machine's gateway: takes commands, runs programs, reports. Everything happens in `turn`, on
/// one thread; messages come in as values, time as an argument. Without a server it continues with
/// the text it has, keeps its records, and delivers them when a server is back.
class Gateway final : public MachineGateway {
 public:
  struct Parts {
    const GatewayOptions& options;
    const interpreter::Dialect& dialect;
    interpreter::Setup setup;
    std::string setup_digest = {};  ///< SHA-256 of its text; empty: none
    dds::GatewayEndpoint& endpoint;
    report::Outbox& outbox;
    report::RunJournal& journal;
    report::MotionJournal* motion_journal = nullptr;  ///< null: a machine that is ahead of nothing
    ExecutionProbe& execution_probe;
    const Clock& clock;
    machine::MotionFactory make_motion;     ///< makes what moves the machine
    std::uint64_t session = 0;              ///< of this process, not zero
    feed::ControlLine* line = nullptr;      ///< programs come from it instead of the server
    std::filesystem::path line_doubt = {};  ///< LineOperator::Parts::doubt
    std::filesystem::path kept_emergency_stop = {};  ///< its file; empty: not kept
    /// What waits from the machine's panel, while recover keeps the inbox waiting.
    std::function<std::vector<PanelRequest>()> take_panel = [] {
      return std::vector<PanelRequest>();
    };
  };
  /// All references must outlive it.
  explicit Gateway(Parts parts);

  /// Before the first turn: see RunLoop::recover. Errors: also Unsupported (a speed that the
  /// machine does not have).
  Result<void> recover() override;

  void receive(const Incoming& incoming, SteadyTime now) override;
  /// Does what is due, for at most about RunLoop::kSlice; returns when to be called again, if
  /// nothing comes in before.
  SteadyTime turn(SteadyTime now) override;
  bool stop_requested() const override { return stop_requested_; }

  bool is_at_rest() const override;
  /// See RunLoop::interrupt.
  Result<void> interrupt_run(const std::string& reason) override { return loop_.interrupt(reason); }
  /// Nothing is left to send.
  bool is_delivered() const override {
    return outbox_.unacknowledged() == 0 && commands_.is_sent();
  }
  /// As the server gets it.
  dds::Status status() const override;

  static constexpr std::chrono::milliseconds kTick{10};  ///< while the machine moves in real time

 private:
  void on(const dds::Command& command, SteadyTime now);
  void on(const dds::RecordAck& ack, SteadyTime now);
  void on(const dds::BlockData& data, SteadyTime now);
  void on(const ServerSeen& server, SteadyTime now);
  void on(const StopRequested& stop, SteadyTime now);
  void on(const LineChanged&, SteadyTime) {}  // every turn looks at the line
  void on(const PanelRequest& request, SteadyTime now);
  void on(const dds::LineRequest&, SteadyTime) {}  // its machine is no control on a line

  // gateway_commands.cpp
  bool stops(const dds::Command& command) const;
  Reply carry_out(const dds::Command& command, bool is_stop);
  std::optional<Reply> refusal_of_start(const dds::Command& command) const;
  Reply start(const dds::Command& command);
  Reply operate(const dds::Command& command);
  Reply set_position(const dds::Command& command);
  Reply stop_at_end();
  std::optional<Reply> refusal_of_jog(const dds::Command& command) const;
  std::optional<Reply> begin_jog(const dds::Command& command);
  void keep_jog(const dds::Command& command, const std::string& hold);
  bool stop_jog(std::string_view why);
  bool stop_homing(std::string_view why);
  bool stop_without_run(std::string_view why);
  void on_jog(const dds::Command& command);
  void answer_jog();
  void give_answer(const std::string& command, const Reply& reply);
  Reply resume();
  std::optional<Reply> refusal_of_fault() const;
  void answer_query(const dds::Command& command);
  void show_setup(const std::string& setup);
  void keep_answer(const std::string& command, const Reply& reply);

  // gateway_panel.cpp
  void serve_stops();
  Reply carry_out(const PanelCommand& command);
  Reply cycle_start();
  Reply rewind_tape();
  Reply discard_memory();
  Reply reference_axes(bool is_homing);

  SteadyTime next_turn(SteadyTime now) const;

  Parts parts_;
  report::Outbox& outbox_;
  ServerLink server_;
  CurrentRun run_;
  ExecutionRecorder recorder_;
  ControlMemory memory_;
  std::unique_ptr<machine::MotionBackend> machine_;
  Consent consent_;
  CommandValidity validity_;
  CommandLog commands_;
  KeptEmergencyStop emergency_stop_;
  PanelController panel_;
  RunLoop loop_;
  PositionSetter positions_;
  Jogger jogger_;
  std::unique_ptr<LineOperator> line_;  ///< null: programs come from the server
  StatusBuilder status_;
  std::optional<std::string> setup_shown_;  ///< the server's, by which the screen shows
  bool stop_requested_ = false;
};

}  // namespace dripline::gateway
