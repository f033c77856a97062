#pragma once

#include <optional>
#include <string>
#include <utility>

#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

/// What the operator requests at the control, for the server to decide: the latest, until it is
/// answered or too old to be meant. So nothing begins when the server comes back an hour later. One
/// thread.
class LineCalls {
 public:
  static constexpr std::chrono::seconds kLife{60};
  /// `reply`: the program that messages to the control come in; empty: none do.
  explicit LineCalls(std::string reply) : reply_(std::move(reply)) {}

  void add(dds::LineCallAction action, const std::string& argument, SteadyTime now);
  /// The call with this number was answered, or is void.
  void end(std::uint64_t number);
  /// The present one is void: a run begins, or the control has withdrawn it.
  void clear() { call_.reset(); }
  void poll(SteadyTime now);
  const std::optional<dds::LineCall>& call() const { return call_; }

 private:
  const std::string reply_;
  std::optional<dds::LineCall> call_;
  SteadyTime until_{};
  std::uint64_t last_number_ = 0;
};

}  // namespace dripline::gateway
