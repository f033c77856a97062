#include "server/app/shared_settings.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "protocol/base/digest.hpp"
#include "protocol/base/lines.hpp"

namespace dripline::app {
namespace {

constexpr const char* kNone = "none";
/// Gateways look for their server by these.
constexpr std::array<std::string_view, 3> kNetwork{"dds-domain", "dds-tag", "dds-security"};

std::string yes_if(bool is_so) {
  return is_so ? "yes" : "no";
}

std::string or_none(const std::string& text) {
  return text.empty() ? kNone : text;
}

/// By its content: the same policy is a file of another name on another computer.
std::string policy_of(const std::string& file) {
  if (file.empty()) return kNone;
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  constexpr std::size_t kShown = 12;
  return "sha256 " + sha256(text).hex().substr(0, kShown);
}

std::string folders_of(const std::vector<folders::FolderSettings>& folders) {
  std::vector<std::string> names;
  for (const auto& folder : folders) names.push_back(folder.name);
  std::ranges::sort(names);
  return or_none(fmt::format("{}", fmt::join(names, ", ")));
}

std::map<std::string, std::string> values_of(const std::string& text) {
  std::map<std::string, std::string> values;
  for (const std::string_view line : lines_with_ends(text)) {
    const auto blank = line.find(' ');
    if (blank == std::string_view::npos) continue;
    values.emplace(line.substr(0, blank), trimmed(line.substr(blank + 1), "\n"));
  }
  return values;
}

}  // namespace

std::string shared_settings(const Settings& settings) {
  const auto& mqtt = settings.mqtt;
  const std::string broker =
      mqtt.is_on() ? fmt::format("{}:{}, prefix {}", mqtt.host, mqtt.port, mqtt.prefix) : kNone;
  const std::string sparkplug =
      mqtt.has_sparkplug() ? fmt::format("{}/{}", mqtt.sparkplug_group, mqtt.sparkplug_node)
                           : kNone;
  std::string text;
  const auto add = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("{} {}\n", key, value);
  };
  add("dds-domain", std::to_string(settings.dds_domain));
  add("dds-tag", or_none(settings.dds_tag));
  add("dds-security", yes_if(!settings.dds_security.empty()));
  add("takeover-s", std::to_string(settings.takeover_s));
  add("handover-s", std::to_string(settings.handover_s));
  add("policy", policy_of(settings.policy));
  add("folders", folders_of(settings.folders));
  add("mqtt", broker);
  add("sparkplug", sparkplug);
  add("mtconnect", yes_if(!settings.mtconnect.empty()));
  add("tls", yes_if(!settings.tls_certificate.empty()));
  add("archives", yes_if(!settings.archives.empty()));
  return text;
}

SettingsDifference compare_settings(const std::string& own, const std::string& active) {
  SettingsDifference difference;
  const auto theirs = values_of(active);
  for (const auto& [key, value] : values_of(own)) {
    const auto found = theirs.find(key);
    if (found == theirs.end() || found->second == value) continue;
    const bool is_network = std::ranges::find(kNetwork, key) != kNetwork.end();
    (is_network ? difference.forbids : difference.others)
        .push_back(fmt::format("{} is {}, and {} at the active server", key, value, found->second));
  }
  return difference;
}

}  // namespace dripline::app
