#pragma once

#include <memory>
#include <string>

#include "gateway/app/run_session.hpp"

namespace dripline::gateway {

/// The run that the parts of a gateway work on, and how the last one ended.
struct CurrentRun {
  std::string machine;
  std::unique_ptr<RunSession> session;  ///< null: no run
  bool is_ending = false;               ///< its last records are staged, not yet on disk
  bool was_emergency_stopped = false;   ///< it ends when the switch is released
  dds::Execution last_execution = dds::Execution::Ready;
  std::string last_message;

  /// Commands and motion apply to it.
  bool is_active() const { return session && !is_ending; }
  /// For the log: "machine=M run=R program=P".
  std::string label() const {
    if (!session) return fmt::format("machine={}", machine);
    return fmt::format("machine={} run={} program={}", machine, session->run().run,
                       session->run().program);
  }
};

}  // namespace dripline::gateway
