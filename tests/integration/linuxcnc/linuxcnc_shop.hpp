#pragma once

#include <gtest/gtest.h>
#include <chrono>
#include <thread>

#include "gateway/machine/linuxcnc/linuxcnc_machine.hpp"
#include "tests/support/linuxcnc/linuxcnc.hpp"
#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::integration {

using machine::MachineState;
using machine::Seconds;
using machine::linuxcnc::LinuxCncMachine;
using test_support::LinuxCnc;
using namespace std::chrono_literals;

/// The back end and a real LinuxCNC, without a gateway.
class LinuxCncTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = LinuxCnc::missing(); !missing.empty())
      GTEST_SKIP() << "skipped: " << missing;
    linuxcnc.emplace();
    if (!table.empty()) linuxcnc->set_tools(table);
    prepare();
    linuxcnc->start();
    connect();
    turn_on();
  }
  /// LinuxCNC's files, before its start.
  virtual void prepare() {}
  /// A back end, instead of the one before.
  void connect(const machine::linuxcnc::SessionLimits& limits = {}) {
    machine.emplace(LinuxCncMachine::Settings{.sink = recorder,
                                              .clock = std::make_shared<SystemClock>(),
                                              .machine = stated,
                                              .limits = limits});
    machine->connect(linuxcnc->ini());
  }
  /// What the operator does at the panel: resets the emergency stop and homes.
  void turn_on() {
    ASSERT_TRUE(wait([&] { return refusal().find("emergency stop") != std::string::npos; }))
        << refusal();
    press_emergency_stop(true);
    press_emergency_stop(false);
    ASSERT_TRUE(wait([&] { return machine->home().has_value(); })) << refusal();
    ASSERT_TRUE(wait([&] { return refusal().empty(); })) << refusal();
  }
  void press_emergency_stop(bool is_pressed) {
    auto panel = machine->panel();
    panel.emergency_stop = is_pressed;
    machine->set_panel(panel);
    std::this_thread::sleep_for(100ms);
  }
  std::string refusal(const interpreter::Position& at = {}) const {
    const auto checked = machine->check_begin(at);
    return checked ? "" : checked.error().what;
  }
  template <class Predicate>
  bool wait(Predicate holds, std::chrono::milliseconds limit = 30s) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!holds()) {
      if (std::chrono::steady_clock::now() > end) return false;
      if (runs) (void)machine->poll(Seconds{0}, 512);
      std::this_thread::sleep_for(2ms);
    }
    return true;
  }
  /// Where the axes are.
  void begin() {
    const interpreter::Position at = machine->status().position;
    ASSERT_TRUE(wait([&] { return refusal(at).empty(); })) << refusal(at);
    machine->begin(at);
    program.emplace(machine->events());
    recorder.lines.clear();
    recorder.blocks.clear();
    runs = true;
  }
  bool wait_over(std::chrono::milliseconds limit = 60s) {
    return wait([&] { return is_over(); }, limit);
  }
  double x() const { return linuxcnc->position()[0]; }
  double z() const { return linuxcnc->position()[2]; }
  bool rests() {
    return wait([&] { return linuxcnc->rests(); });
  }
  bool is_over() const {
    const MachineState state = machine->state();
    return state == MachineState::Completed || state == MachineState::Alarmed ||
           state == MachineState::Aborted;
  }
  std::string alarm() const {
    for (const std::string& line : recorder.lines)
      if (line.starts_with("alarm ")) return line.substr(6);
    return {};
  }

  std::string table;                ///< LinuxCNC's tools; empty: those of the example
  interpreter::MachineData stated;  ///< by the setup
  bool runs = false;
  machine::test::Recorder recorder;
  std::optional<machine::test::Program> program;
  std::optional<LinuxCnc> linuxcnc;
  std::optional<LinuxCncMachine> machine;
};

}  // namespace dripline::integration
