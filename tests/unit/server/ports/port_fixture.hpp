#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/ports/port_service.hpp"
#include "tests/support/line/test_line.hpp"
#include "tests/support/patience.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {

/// The ports on a real store and real line drivers; the test plays the controls at the other ends
/// of cables.
class PortServiceTest : public ServerTest {
 protected:
  PortServiceTest() { catalog_.known.insert(catalog_.known.end(), {"fanuc", "prototrak-plus"}); }

  void start_ports(const storage::Store& store, const std::vector<storage::Port>& configured = {}) {
    ports::PortService::Options options;
    options.recordings = folder_.path() / "recordings";
    options.open = [this](serial::LineDriver::Parts parts) {
      parts.reopen_after = std::chrono::milliseconds(20);
      parts.open = [this, address = parts.address] { return line(address).open(); };
      return serial::LineDriver::start(std::move(parts));
    };
    options.on_fault = [this](const std::string& machine, const std::string& fault) {
      const std::lock_guard lock(notified_mutex_);
      faults_.push_back(machine + ": " + fault);
    };
    machines::MachineListener listener{.on_machine = [](const machines::MachineView&) {},
                                       .on_run = [](const storage::Run&) {},
                                       .on_record =
                                           [this](const storage::Record& record) {
                                             const std::lock_guard lock(notified_mutex_);
                                             records_.push_back(record);
                                           }};
    ports_ = std::make_unique<ports::PortService>(
        machines::RunSources{.store = store, .releases = *releases_, .clock = system_clock_},
        *programs_, options, std::move(listener));
    const auto begun = ports_->begin(configured);
    ASSERT_TRUE(begun) << begun.error().what;
  }
  void start_ports() { start_ports(*store_); }

  static storage::Port mill(const std::string& rules = "") {
    storage::Port port;
    port.name = "com1";
    port.machine = "mill";
    port.address = "/dev/line1";
    port.settings = {
        {"baud", "115200"}, {"idle_end_ms", "60"}, {"rest_gap_ms", "60"}, {"eob", "lf"}};
    port.rules = rules;
    return port;
  }
  void add_port(const storage::Port& port) {
    const auto saved = ports_->save(port);
    ASSERT_TRUE(saved) << saved.error().what;
    ASSERT_TRUE(wait([&] { return ports_->port(port.name)->is_open; }));
  }
  /// What comes sooner after the opening of mill()'s line may be the rest of a text.
  void let_pass_idle_end() { line().read_for(std::chrono::milliseconds(70)); }
  test_support::TestLine& line(const std::string& address = "/dev/line1") {
    const std::lock_guard lock(lines_mutex_);
    auto& line = lines_[address];
    if (!line) line = std::make_unique<test_support::TestLine>();
    return *line;
  }
  Result<Run> start(const std::string& program, machines::StartPoint from = {}) {
    return ports_->machines().start(
        {.machine = "mill", .program = program, .revision = {}, .author = "cam", .from = from});
  }
  Result<void> command(const std::string& run, dds::CommandAction action) {
    return ports_->machines().command({.run = run, .action = action, .argument = {}, .value = 0});
  }
  /// Looks again and again, at most for a minute.
  static bool wait(const std::function<bool()>& is_so) {
    const auto end = std::chrono::steady_clock::now() + test_support::kPatience;
    while (!is_so()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  bool wait_state(const std::string& run, storage::RunState state) {
    return wait([&] { return store_->runs.find(run)->state == state; });
  }
  /// A program of numbered blocks, some of them more than the line takes in a second.
  static std::string blocks(int count) {
    std::string text;
    for (int i = 1; i <= count; ++i) text += fmt::format("N{} G1 X{}.5 Y-{}.25\n", i * 10, i, i);
    return text;
  }
  std::vector<ports::PortTraffic> recording() { return ports_->recording("com1").value(); }
  std::vector<storage::Record> records_of(const std::string& run, const std::string& kind) {
    return store_->records.of_run(run, kind, {}).value();
  }

  SystemClock system_clock_;
  std::mutex lines_mutex_, notified_mutex_;
  std::map<std::string, std::unique_ptr<test_support::TestLine>> lines_;
  std::vector<storage::Record> records_;
  std::vector<std::string> faults_;
  std::unique_ptr<ports::PortService> ports_;  // last: it ends before what its threads use
};

}  // namespace dripline::server_test
