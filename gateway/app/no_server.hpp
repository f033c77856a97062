#pragma once

#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// A gateway that lives on its line alone: what it would tell a server stays in its outbox.
class NoServer final : public dds::GatewayEndpoint {
 public:
  Result<void> write(const dds::Announce&) override { return {}; }
  Result<void> write(const dds::Status&) override { return {}; }
  Result<void> write(const dds::Record&) override { return {}; }
  Result<void> write(const dds::CommandResult&) override { return {}; }
  Result<void> write(const dds::BlockRequest&) override { return {}; }
  bool is_connected() const override { return false; }
  dds::Rejected rejected() const override { return {}; }
};

}  // namespace dripline::gateway
