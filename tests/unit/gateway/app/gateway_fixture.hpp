#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/app/gateway.hpp"
#include "gateway/app/motion_choice.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::gateway {

class TestClock final : public Clock {
 public:
  UtcTime now() const override { return UtcTime(std::chrono::hours(400'000)) + elapsed() + step; }
  SteadyTime steady_now() const override { return steady; }
  SteadyTime steady{std::chrono::hours(1)};
  std::chrono::microseconds step{0};  ///< of the time of day

 private:
  std::chrono::microseconds elapsed() const {
    return std::chrono::duration_cast<std::chrono::microseconds>(steady.time_since_epoch());
  }
};

/// Of a setup file's text, which is good.
interpreter::Setup setup_from(const std::string& toml);

/// A gateway with everything around it in a test's hands: its clock, its server and its disk.
/// The server answers requests and acknowledges records between two passes, while `is_up`.
class GatewayFixture : public dds::GatewayEndpoint {
 public:
  /// Of the toy control.
  explicit GatewayFixture(const std::string& speed = "max");
  GatewayFixture(const interpreter::Dialect& control, interpreter::Setup its_setup,
                 const std::string& speed);
  ~GatewayFixture() override;

  /// A new process on the same disk, as after a kill (what was not committed is gone).
  void restart_gateway();
  /// As after a kill, without a new one: so another process can have the disk.
  void close_gateway();
  void set_checkpoint_interval(std::chrono::milliseconds interval);
  void connect(bool is_up);
  /// People may be at the machine: from the next gateway on, it asks for their consent.
  void make_attended();
  /// Jogs of that size and feed are allowed; from the next gateway on.
  void allow_jogs(double step, double feed);
  /// At the machine's panel; the answer.
  std::string panel(const std::string& line);
  /// Turns of `step` until `done` is true, or a (simulated) minute has passed.
  bool run_until(const std::function<bool()>& done,
                 std::chrono::milliseconds step = std::chrono::milliseconds(10));

  void push(const std::string& program, const std::string& text) { programs[program] = text; }
  dds::Command command(dds::CommandAction action);
  std::chrono::microseconds steady_time() const;
  dds::Command start_command(const std::string& program);
  /// Sends it and returns its result.
  dds::CommandResult send(const dds::Command& command);
  dds::CommandResult start(const std::string& program) { return send(start_command(program)); }
  /// Runs until the run has ended, and returns its end.
  dds::RunEndText ended();
  std::vector<std::string> lines() const;
  std::size_t count(dds::RecordKind kind) const;

  Result<void> write(const dds::Announce& message) override;
  Result<void> write(const dds::Status& message) override;
  Result<void> write(const dds::Record& message) override;
  Result<void> write(const dds::CommandResult& message) override;
  Result<void> write(const dds::BlockRequest& message) override;
  Result<void> write(const dds::LineData&) override { return {}; }
  bool is_connected() const override { return is_up; }
  dds::Rejected rejected() const override { return {}; }

  TestClock clock;
  bool is_up = true, serves_text = true, acknowledges = true;
  std::map<std::string, std::string> programs;
  /// For called programs that are not among these; empty: there are no others.
  interpreter::MemorySource::Loader loader;
  std::vector<dds::Record> records;  ///< stored once each, in order
  std::vector<dds::Announce> announced;
  std::optional<dds::Status> status;
  std::map<std::string, dds::CommandResult> results;
  std::uint64_t outbox_bytes = 4ULL << 30;
  interpreter::Setup setup;
  std::string setup_digest = std::string(64, 'b');  ///< as if a file had its text
  machine::MotionFactory motion;  ///< empty: the simulated machine; from the next gateway on
  /// While a gateway recovers; from the next gateway on.
  std::function<std::vector<PanelRequest>()> take_panel;
  std::unique_ptr<Gateway> gateway;
  std::function<void()> each_turn;  ///< of `run_until`: what a device does meanwhile
  std::filesystem::path folder() const { return folder_.path(); }
  ExecutionProbe::Counts execution_probe() const;

 private:
  struct Process;
  void serve();
  std::optional<std::string> text_of(const dds::BlockRequest& request) const;

  test_support::TemporaryFolder folder_;
  const interpreter::Dialect& control_;
  GatewayOptions options_;
  std::unique_ptr<Process> process_;
  std::vector<dds::BlockRequest> requests_;
  std::string program_;
  int commands_ = 0, runs_ = 0, sessions_ = 0;
};

/// A program of so many lines of output, each after so many moves.
std::string with_reports(int lines, int moves);

}  // namespace dripline::gateway
