#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

namespace dripline::gateway {

/// A gateway whose machine writes down its path; runs are cut off and restarted.
class RestartFixture : public GatewayFixture {
 public:
  RestartFixture(const interpreter::Dialect& control, interpreter::Setup its_setup,
                 const std::string& speed);

  using Path = std::vector<std::string>;
  /// Since the process began.
  Path path;
  std::string path_file;  ///< where another process leaves it; empty: in `path`

  /// Turns until the run that was started last has ended; stops are resumed, questions answered. At
  /// most so many steps. Returns whether it has ended.
  bool run_on(std::size_t steps = 100'000);
  std::size_t steps() const { return steps_; }
  /// Likewise, up to the moment when the journal has this block: what is done after that in the
  /// same instruction is lost as by a kill, and another process has the disk. False: it was not
  /// reached.
  bool run_until_killed_after(std::uint64_t block);

  /// Starts a restart of that run and waits for its report. Null: refused, or ended before it.
  nlohmann::json begin_restart(const std::string& program, const std::string& run,
                               const std::string& at = "executed");
  dds::CommandResult start_answer;
  dds::RunEndText last_end() const;
  std::string last_run() const { return last_run_; }
  dds::CommandResult start_program(const std::string& program);
  bool cycle_start() { return send(command(dds::CommandAction::Resume)).accepted; }

 private:
  void make_recording();
  void operate();

  const interpreter::Dialect& control_;
  std::uint64_t killed_after_ = 0;  ///< block; 0: none
  std::size_t steps_ = 0;
  std::size_t ended_before_ = 0;  ///< runs, when the last one was started
  std::string last_run_;
};

/// What a path holds up to and including the end of a block, and the rest.
std::size_t length_up_to(const RestartFixture::Path& path, std::uint64_t block);
/// Empty: `path` is the approach of a restart after that block, and then exactly the rest of
/// `whole`. Else what is wrong.
std::string difference(const RestartFixture::Path& whole, const RestartFixture::Path& path,
                       std::uint64_t after);

}  // namespace dripline::gateway
