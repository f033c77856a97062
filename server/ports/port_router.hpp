#pragma once

#include <string>
#include <vector>

#include "server/ports/gateway_lines.hpp"
#include "server/ports/port_control.hpp"

namespace dripline::ports {

/// The ports of the server and the lines of gateways, as one list. Of a gateway's line everything
/// can be had from here but its setup, which is made at the gateway.
class PortRouter final : public PortControl {
 public:
  PortRouter(PortControl& own, GatewayLines& gateways) : own_(own), gateways_(gateways) {}

  std::vector<PortView> ports() const override;
  Result<PortView> port(const std::string& name) const override;
  Result<PortView> save(const storage::Port& port) override;
  Result<void> remove(const std::string& name) override;
  Result<PortTest> test(const std::string& name) override;
  Result<PortTransfer> send(const std::string& name,
                            const std::vector<ProgramChoice>& programs) override;
  Result<std::string> confirm_reset(const std::string& name) override;
  Result<void> receive(const std::string& name) override;
  Result<void> stop_transfer(const std::string& name, const std::string& reason) override;
  Result<RuleVerdict> test_rules(const std::string& name, const std::string& text) const override;
  Result<std::vector<PortTraffic>> recording(const std::string& name) const override;
  void on_traffic(std::function<void(const PortTraffic&)> listener) override {
    own_.on_traffic(std::move(listener));
  }

 private:
  bool is_gateways(const std::string& name) const;
  PortControl& own_;
  GatewayLines& gateways_;
};

}  // namespace dripline::ports
