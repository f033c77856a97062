#include "server/api/views.hpp"
#include "server/app/impl/server_parts.hpp"

namespace dripline::app {

std::unique_ptr<mqtt::Publisher> ServerParts::make_publisher(const Settings& settings,
                                                             const Loaded& loaded) {
  if (!settings.mqtt.is_on()) return nullptr;
  const auto& client = settings.mqtt.client_id;
  constexpr std::size_t kIdentity = 12;
  broker = mqtt::make_mosquitto_link(
      settings.mqtt, client.empty() ? "dncd-" + loaded.identity.substr(0, kIdentity) : client);
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

}  // namespace dripline::app
