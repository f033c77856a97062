#pragma once

#include "server/feeds/feed_control.hpp"
#include "server/serial/serial_feed.hpp"

namespace dripline::ports {

/// All machines of the server, however they are fed: those with an enabled port over their line,
/// all others by their gateway. A machine has one feeder: while a gateway speaks for one that has a
/// port, the machine is contested and nothing is started.
class MachineFeeds final : public feeds::FeedControl {
 public:
  MachineFeeds(storage::Store& store, feeds::FeedControl& gateways, SerialFeed& lines)
      : store_(store), gateways_(gateways), lines_(lines) {}

  /// In order of their names.
  std::vector<feeds::MachineView> machines() const override;
  Result<feeds::MachineView> machine(const std::string& name) const override;
  Result<storage::Run> start(const feeds::StartRequest& request) override;
  Result<void> order(const feeds::OrderRequest& request) override;

 private:
  storage::Store& store_;
  feeds::FeedControl& gateways_;
  SerialFeed& lines_;
};

}  // namespace dripline::ports
