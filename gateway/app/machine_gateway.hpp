#pragma once

#include <string>
#include <string_view>

#include "gateway/app/inbox.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

/// One machine's gateway, as its process runs it. Everything happens in `turn`, on one thread;
/// messages come in as values, time as an argument.
class MachineGateway {
 public:
  virtual ~MachineGateway() = default;
  /// Before the first turn: ends the run that a former process was executing. Errors: those of the
  /// outbox; Unsupported (an option that does not fit the machine).
  virtual Result<void> recover() = 0;
  virtual void receive(const Incoming& incoming, SteadyTime now) = 0;
  /// Does what is due; returns when to be called again, if nothing comes in before.
  virtual SteadyTime turn(SteadyTime now) = 0;
  /// Nothing begins any more, and what moves is being stopped; stops still take effect.
  virtual bool stop_requested() const = 0;
  /// After a stop was requested: the machine rests, and what it has executed is known.
  virtual bool is_at_rest() const = 0;
  /// Ends the run, if any, as interrupted. Errors: those of the outbox; then the next start does
  /// it.
  virtual Result<void> interrupt_run(const std::string& reason) = 0;
  /// Nothing is left to send.
  virtual bool is_delivered() const = 0;
  /// As the server gets it.
  virtual dds::Status status() const = 0;
};

inline constexpr std::string_view kIsStopping = "the gateway is stopping";
inline constexpr std::string_view kHasStopped =
    "the gateway is stopping: what it moved was stopped already, and gets nothing more";

}  // namespace dripline::gateway
