#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"

namespace dripline::gateway {

inline const std::string kRestartedProgram =
    "O0540\nT1 M06\nG90 G00 X0 Y0 Z50.\nM03 S900\nM08\n#1=1\nN10 WHILE[#1LE6]DO1\nN20 G01 "
    "X[#1*10] F600\nN30 Y10.\nM98 P0561\n#1=#1+1\nEND1\nN40 T2 M06\nN50 G01 Z-5.\nX0\nM00\nN60 "
    "Y0\nM98 P0562\nN70 X90.\nM30\n";
inline const std::string kCalledProgram = "O0561\nG91 Z-1.\nZ1.\nG90 M99\n";
inline const std::string kCalledLater = "O0562\nG91 Z-2.\nZ2.\nG90 M99\n";

/// A run of a called program's control that is cut off and restarted.
class RestartFaults : public testing::Test {
 protected:
  /// Under which the run was executed.
  PresentState unchanged(storage::sqlite::Database& database) const {
    const auto stored = report::CheckpointStore::find(database, run).value();
    PresentState now;
    now.revision = stored.run.revision;
    now.size = stored.run.size;
    now.control = stored.run.control;
    now.conditions = decode_conditions(run, stored.conditions).value();
    now.memory = decode_ending(run, stored.ending)->memory;
    return now;
  }
  RestartFaults() : shop(interpreter::kFanucDialect, {}, "20x") {
    shop.set_checkpoint_interval(std::chrono::milliseconds(200));
    shop.push("P", kRestartedProgram);
    shop.loader = [this](std::string_view name) -> std::optional<std::string> {
      for (const auto& [number, text] : called) {
        if (name.ends_with(number)) return text;
      }
      return std::nullopt;
    };
    shop.restart_gateway();
  }
  /// Up to the stop before N60.
  void run_to_stop() {
    shop.path.clear();
    ASSERT_TRUE(shop.start_program("P").accepted);
    run = shop.last_run();
    ASSERT_TRUE(shop.run_until(
        [&] { return shop.status && shop.status->execution == dds::Execution::ProgramStopped; }));
  }
  void abort() {
    ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
    ASSERT_TRUE(shop.run_on());
    ASSERT_EQ(shop.last_end().outcome, dds::RunOutcome::Aborted);
  }
  void abort_at_stop() {
    run_to_stop();
    before = shop.path;
    abort();
    shop.path.clear();
  }
  nlohmann::json restart(const std::string& at = "executed") {
    shop.path.clear();
    return shop.begin_restart("P", run, at);
  }
  std::string reason() const {
    return shop.start_answer.accepted ? shop.last_end().reason : shop.start_answer.reason;
  }
  /// A restart that begins, and cannot look through the program.
  void restart_without_text() {
    shop.serves_text = false;
    dds::Command start = shop.start_command("P");
    start.argument = "restart=" + run;
    ASSERT_TRUE(shop.send(start).accepted);
    second = start.run;
    ASSERT_TRUE(shop.run_until([&] { return says("waiting for its text"); }));
  }
  bool says(const std::string& text) const {
    return shop.status && shop.status->message.find(text) != std::string::npos;
  }
  bool has_ended(std::size_t runs) const { return shop.count(dds::RecordKind::RunEnded) == runs; }
  /// As after an undisturbed restart.
  void completes() {
    const auto report = restart();
    ASSERT_TRUE(report.is_object()) << reason();
    ASSERT_TRUE(shop.cycle_start());
    ASSERT_TRUE(shop.run_on());
    EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Completed) << shop.last_end().reason;
  }

  std::map<std::string, std::string> called{{"561", kCalledProgram}, {"562", kCalledLater}};
  RestartFixture shop;
  std::string run, second;
  RestartFixture::Path before;
};

}  // namespace dripline::gateway
