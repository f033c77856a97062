#pragma once

#include "storage/impl/connections.hpp"
#include "storage/webhook_store.hpp"

namespace dripline::storage {

class WebhookRepository final : public WebhookStore {
 public:
  explicit WebhookRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<Webhook>> list() override;
  Result<Webhook> find(const std::string& name) override;
  Result<Webhook> receiver(std::uint64_t id) override;
  Result<Webhook> add(const Webhook& webhook, const Actor& who) override;
  Result<void> remove(const std::string& name, const Actor& who, UtcTime time) override;
  Result<std::vector<Event>> events(std::uint64_t after, std::uint64_t limit) override;
  Result<void> set_delivered(std::uint64_t id, std::uint64_t event, UtcTime time) override;
  Result<void> set_failing(std::uint64_t id, const std::string& fault, UtcTime time) override;
  Result<void> trim() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
