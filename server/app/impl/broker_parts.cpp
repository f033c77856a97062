#include "server/api/views.hpp"
#include "server/app/impl/server_parts.hpp"
#include "server/mqtt/guarded_link.hpp"

namespace dripline::app {
namespace {

std::string client_of(const Settings& settings, const std::string& identity) {
  constexpr std::size_t kIdentity = 12;
  const auto& client = settings.mqtt.client_id;
  return client.empty() ? "dncd-" + identity.substr(0, kIdentity) : client;
}

/// Of a Sparkplug node, among 256 numbers: not that of the server that had the library before, nor
/// the ones that it came to by connecting again some times. The term grows with each taking of the
/// place; a file's server counts seconds.
std::uint8_t first_connection_of(const storage::OpenedStore& store, const Clock& clock) {
  constexpr std::uint64_t kApart = 37;  // odd: 256 terms that follow each other have all numbers
  const auto seconds = std::chrono::floor<std::chrono::seconds>(clock.now().time_since_epoch());
  const auto grown = store.term() != 0 ? store.term() : static_cast<std::uint64_t>(seconds.count());
  return static_cast<std::uint8_t>(kApart * grown);
}

}  // namespace

std::unique_ptr<mqtt::BrokerLink> ServerParts::make_link(const Settings& settings,
                                                         const std::string& client) const {
  auto link = mqtt::make_mqtt_link(settings.mqtt, client);
  if (!settings.standby) return link;
  return mqtt::make_guarded_link(std::move(link), [this] { return store->has_place(); });
}

std::unique_ptr<mqtt::Publisher> ServerParts::make_publisher(const Settings& settings,
                                                             const Loaded& loaded) {
  if (!settings.mqtt.is_on()) return nullptr;
  broker = make_link(settings, client_of(settings, loaded.identity));
  return std::make_unique<mqtt::Publisher>(
      mqtt::Publisher::Parts{
          .store = *store,
          .link = *broker,
          .clock = clock,
          .server = loaded.identity,
          .version = DRIPLINE_VERSION,
          .machines = [this] { return machines.machines(); },
          .status_json = api::machine_json,
          .record_json = api::record_json,
          .on_fault = watch_faults("mqtt", "broker", "the broker has not been reached for long")},
      settings.mqtt, mqtt::Publisher::Options{});
}

std::unique_ptr<mqtt::SparkplugNode> ServerParts::make_sparkplug(const Settings& settings,
                                                                 const Loaded& loaded) {
  if (!settings.mqtt.has_sparkplug()) return nullptr;
  sparkplug_broker = make_link(settings, client_of(settings, loaded.identity) + "-sparkplug");
  return std::make_unique<mqtt::SparkplugNode>(
      mqtt::SparkplugNode::Parts{
          .link = *sparkplug_broker,
          .clock = clock,
          .version = DRIPLINE_VERSION,
          .first_connection = first_connection_of(*store, clock),
          .machines = [this] { return machines.machines(); },
          .status_json = api::machine_json,
          .on_fault = watch_faults("mqtt", "broker", "the broker has not been reached for long")},
      settings.mqtt, mqtt::SparkplugNode::Options{});
}

}  // namespace dripline::app
