#include "server/mqtt/sparkplug_session.hpp"

#include <algorithm>
#include <utility>

namespace dripline::mqtt {
namespace {

/// What has changed since `known`, which is brought up to date; nullopt: there is a value that a
/// device has to announce at its birth.
std::optional<std::vector<Metric>> changes(std::map<std::string, Metric>& known,
                                           std::vector<Metric> metrics) {
  std::map<std::string, Metric> now;
  for (auto& metric : metrics) now.emplace(metric.name, std::move(metric));
  std::vector<Metric> changed;
  for (const auto& [name, metric] : now) {
    const auto before = known.find(name);
    if (before == known.end() || before->second.type != metric.type) return std::nullopt;
    if (before->second != metric) changed.push_back(metric);
  }
  for (auto& [name, metric] : known) {
    if (now.contains(name) || !metric.value) continue;
    metric.value.reset();
    changed.push_back(metric);
  }
  for (auto& [name, metric] : now) known[name] = std::move(metric);
  return changed;
}

}  // namespace

std::string SparkplugSession::topic(const char* type) const {
  return fmt::format("spBv1.0/{}/{}/{}", group_, type, node_);
}
std::string SparkplugSession::topic(const char* type, const std::string& device) const {
  return topic(type) + "/" + device;
}

Message SparkplugSession::number(std::string topic, std::vector<Metric> metrics, UtcTime now) {
  return {.topic = std::move(topic),
          .payload = encode({.time = now, .seq = next_++, .metrics = std::move(metrics)}),
          .qos = 0,
          .is_retained = false};
}

Metric SparkplugSession::birth_death_number() const {
  return {"bdSeq", Metric::Type::Unsigned, std::uint64_t{connection_}};
}

Message SparkplugSession::begin(UtcTime now) {
  ++connection_;
  born_.clear();
  return death(now);
}

Message SparkplugSession::death(UtcTime now) const {
  return {.topic = topic("NDEATH"),
          .payload = encode({.time = now, .seq = {}, .metrics = {birth_death_number()}}),
          .qos = 1,
          .is_retained = false};
}

Message SparkplugSession::birth(UtcTime now) {
  next_ = 0;
  born_.clear();
  return number(topic("NBIRTH"),
                {birth_death_number(),
                 {kRebirth, Metric::Type::Boolean, false},
                 {"Properties/Software", Metric::Type::Text, "Dripline " + version_}},
                now);
}

std::optional<Message> SparkplugSession::report(const std::string& device, bool is_connected,
                                                std::vector<Metric> metrics, UtcTime now) {
  const auto born = born_.find(device);
  if (!is_connected) {
    if (born == born_.end()) return std::nullopt;
    born_.erase(born);
    return number(topic("DDEATH", device), {}, now);
  }
  if (born != born_.end()) {
    auto changed = changes(born->second, metrics);
    if (changed && changed->empty()) return std::nullopt;
    if (changed) return number(topic("DDATA", device), *std::move(changed), now);
  }
  Values& values = born_[device];
  // What it had once stays announced, as null.
  for (auto& [name, metric] : values) metric.value.reset();
  for (const auto& metric : metrics) values[metric.name] = metric;
  std::vector<Metric> all;
  for (const auto& [name, metric] : values) all.push_back(metric);
  return number(topic("DBIRTH", device), std::move(all), now);
}

}  // namespace dripline::mqtt
