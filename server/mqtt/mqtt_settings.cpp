#include "server/mqtt/mqtt_settings.hpp"

#include <arpa/inet.h>
#include <sys/stat.h>
#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <utility>

#include "server/mqtt/sparkplug_payload.hpp"
#include "server/mqtt/topics.hpp"

namespace dripline::mqtt {
namespace {

constexpr std::size_t kMaxText = 256;
constexpr std::size_t kMaxPath = 1024;
constexpr std::size_t kMaxClientId = 64;
constexpr std::int64_t kMaxIntervalMs = 60'000;
constexpr std::uint16_t kPlainPort = 1883;
constexpr std::uint16_t kTlsPort = 8883;

unsigned source_line(const toml::node& node) {
  return node.source().begin.line;
}

Result<std::string> text_of(std::string_view key, const toml::node& node, std::size_t longest) {
  const auto* text = node.as_string();
  if (text == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a string", source_line(node), key);
  if (text->get().size() > longest) {
    return fail(Errc::LimitExceeded, "line {}: {} of {} characters: at most {}", source_line(node),
                key, text->get().size(), longest);
  }
  return text->get();
}

template <std::string MqttSettings::*kMember, std::size_t kLongest>
Result<void> take_text(MqttSettings& settings, std::string_view key, const toml::node& node) {
  auto text = text_of(key, node, kLongest);
  if (!text) return fail(text.error());
  settings.*kMember = *std::move(text);
  return {};
}

template <bool MqttSettings::*kMember>
Result<void> take_flag(MqttSettings& settings, std::string_view key, const toml::node& node) {
  const auto* flag = node.as_boolean();
  if (flag == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be true or false", source_line(node), key);
  settings.*kMember = flag->get();
  return {};
}

Result<std::int64_t> number_of(std::string_view key, const toml::node& node, std::int64_t least,
                               std::int64_t highest) {
  const auto* number = node.as_integer();
  if (number == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a whole number", source_line(node), key);
  if (number->get() < least || number->get() > highest) {
    return fail(Errc::LimitExceeded, "line {}: {} is {}: {} to {}", source_line(node), key,
                number->get(), least, highest);
  }
  return number->get();
}

/// Of `localhost` too, which every resolver answers with this computer.
bool is_loopback_host(const std::string& host) {
  in_addr v4{};
  in6_addr v6{};
  constexpr std::uint32_t kLoopbackNet = 127;
  if (::inet_pton(AF_INET, host.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24 == kLoopbackNet;
  if (::inet_pton(AF_INET6, host.c_str(), &v6) == 1) return IN6_IS_ADDR_LOOPBACK(&v6) != 0;
  return host == "localhost";
}

bool is_host(std::string_view host) {
  return !host.empty() && std::ranges::all_of(host, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(".-_:").find(c) != std::string_view::npos;
  });
}

/// mqtt://HOST[:PORT] and mqtts://...; an IPv6 address is in brackets.
Result<void> read_address(MqttSettings& settings) {
  std::string_view rest = settings.broker;
  settings.has_tls = rest.starts_with("mqtts://");
  const bool has_scheme = settings.has_tls || rest.starts_with("mqtt://");
  static constexpr char kForm[] = "'{}' must be mqtt://HOST:PORT or mqtts://HOST:PORT";
  if (!has_scheme) return fail(Errc::Syntax, kForm, settings.broker);
  rest.remove_prefix(rest.find("://") + 3);
  settings.port = settings.has_tls ? kTlsPort : kPlainPort;
  std::string_view port;
  if (const auto end = rest.find(']'); rest.starts_with('[') && end != std::string_view::npos) {
    settings.host = rest.substr(1, end - 1);
    port = rest.substr(end + 1);
  } else {
    const auto colon = std::min(rest.find(':'), rest.size());
    settings.host = rest.substr(0, colon);
    port = rest.substr(colon);
  }
  if (!port.empty()) {
    const auto* end = port.data() + port.size();
    const auto [read, ec] = std::from_chars(port.data() + 1, end, settings.port);
    if (port.front() != ':' || ec != std::errc() || read != end || settings.port == 0)
      return fail(Errc::Syntax, "'{}' has no port from 1 to 65535", settings.broker);
  }
  if (!is_host(settings.host)) return fail(Errc::Syntax, kForm, settings.broker);
  settings.is_loopback = is_loopback_host(settings.host);
  return {};
}

Result<void> take_broker(MqttSettings& settings, std::string_view key, const toml::node& node) {
  if (auto taken = take_text<&MqttSettings::broker, kMaxText>(settings, key, node); !taken)
    return taken;
  if (auto read = read_address(settings); !read)
    return fail(read.error().code, "line {}: {} {}", source_line(node), key, read.error().what);
  return {};
}

Result<void> take_prefix(MqttSettings& settings, std::string_view key, const toml::node& node) {
  if (auto taken = take_text<&MqttSettings::prefix, kMaxPrefix>(settings, key, node); !taken)
    return taken;
  if (auto good = check_prefix(settings.prefix); !good)
    return fail(good.error().code, "line {}: {} {}", source_line(node), key, good.error().what);
  return {};
}

Result<void> take_client_id(MqttSettings& settings, std::string_view key, const toml::node& node) {
  auto taken = take_text<&MqttSettings::client_id, kMaxClientId>(settings, key, node);
  if (!taken) return taken;
  const auto& id = settings.client_id;
  if (std::ranges::all_of(id, [](char c) { return c > ' ' && c < '\x7f'; })) return {};
  return fail(Errc::Syntax, "line {}: {} '{}' must be letters, digits and signs, without blanks",
              source_line(node), key, id);
}

Result<void> take_qos(MqttSettings& settings, std::string_view key, const toml::node& node) {
  const auto number = number_of(key, node, 1, 2);
  if (!number) return fail(number.error());
  settings.qos = static_cast<int>(*number);
  return {};
}

Result<void> take_interval(MqttSettings& settings, std::string_view key, const toml::node& node) {
  constexpr std::int64_t kLeast = 100;
  const auto number = number_of(key, node, kLeast, kMaxIntervalMs);
  if (!number) return fail(number.error());
  settings.status_interval = std::chrono::milliseconds(*number);
  return {};
}

Result<void> take_protocol(MqttSettings& settings, std::string_view key, const toml::node& node) {
  const auto text = text_of(key, node, kMaxText);
  if (!text) return fail(text.error());
  settings.is_version_5 = *text == "5";
  if (*text == "5" || *text == "3.1.1") return {};
  return fail(Errc::Syntax, "line {}: {} '{}' must be \"5\" or \"3.1.1\"", source_line(node), key,
              *text);
}

Result<void> take_kinds(MqttSettings& settings, std::string_view key, const toml::node& node) {
  const auto* array = node.as_array();
  if (array == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a list of strings", source_line(node), key);
  for (const auto& element : *array) {
    const auto kind = text_of(key, element, kMaxText);
    if (!kind) return fail(kind.error());
    if (auto good = check_kind(*kind); !good)
      return fail(good.error().code, "line {}: {}", source_line(element), good.error().what);
    settings.kinds.push_back(*kind);
  }
  settings.has_records = !array->empty();
  return {};
}

template <std::string MqttSettings::*kMember>
Result<void> take_sparkplug_id(MqttSettings& settings, std::string_view key,
                               const toml::node& node) {
  if (auto taken = take_text<kMember, kMaxText>(settings, key, node); !taken) return taken;
  if (auto good = check_sparkplug_id(settings.*kMember); !good)
    return fail(good.error().code, "line {}: {} {}", source_line(node), key, good.error().what);
  return {};
}

struct MqttKey {
  std::string_view key;
  Result<void> (*take)(MqttSettings&, std::string_view key, const toml::node&);
};
constexpr std::array kMqttKeys{
    MqttKey{"broker", take_broker},
    MqttKey{"ca", take_text<&MqttSettings::ca, kMaxPath>},
    MqttKey{"certificate", take_text<&MqttSettings::certificate, kMaxPath>},
    MqttKey{"key", take_text<&MqttSettings::key, kMaxPath>},
    MqttKey{"user", take_text<&MqttSettings::user, kMaxText>},
    MqttKey{"password_file", take_text<&MqttSettings::password_file, kMaxPath>},
    MqttKey{"client_id", take_client_id},
    MqttKey{"prefix", take_prefix},
    MqttKey{"qos", take_qos},
    MqttKey{"kinds", take_kinds},
    MqttKey{"status", take_flag<&MqttSettings::has_status>},
    MqttKey{"retain_status", take_flag<&MqttSettings::is_status_retained>},
    MqttKey{"status_interval_ms", take_interval},
    MqttKey{"protocol", take_protocol},
    MqttKey{"sparkplug_group", take_sparkplug_id<&MqttSettings::sparkplug_group>},
    MqttKey{"sparkplug_node", take_sparkplug_id<&MqttSettings::sparkplug_node>},
    MqttKey{"open_network", take_flag<&MqttSettings::is_open_network_allowed>},
};

/// What belongs together.
Result<void> check_keys(const MqttSettings& settings, unsigned line) {
  if (!settings.is_on()) return fail(Errc::Syntax, "line {}: [mqtt] needs a broker", line);
  if (settings.certificate.empty() != settings.key.empty())
    return fail(Errc::Conflict, "line {}: certificate and key belong together", line);
  if (!settings.has_tls && (!settings.ca.empty() || !settings.key.empty()))
    return fail(Errc::Conflict, "line {}: ca, certificate and key belong to mqtts://", line);
  if (settings.user.empty() && !settings.password_file.empty())
    return fail(Errc::Conflict, "line {}: a password_file needs a user", line);
  if (!settings.has_status && !settings.has_records && !settings.has_sparkplug())
    return fail(Errc::Conflict,
                "line {}: neither status nor kinds nor a sparkplug_group: nothing is published",
                line);
  return {};
}

Result<MqttSettings> read_section(const toml::table& table) {
  MqttSettings settings;
  const toml::node* node = table.get("mqtt");
  if (node == nullptr) return settings;
  const auto* section = node->as_table();
  if (section == nullptr) return fail(Errc::Syntax, "line {}: write [mqtt]", source_line(*node));
  for (const auto& [key, value] : *section) {
    const auto row = std::ranges::find(kMqttKeys, key.str(), &MqttKey::key);
    if (row == kMqttKeys.end()) {
      return fail(Errc::Syntax, "line {}: key '{}' of [mqtt] is not known", source_line(value),
                  key.str());
    }
    if (auto taken = row->take(settings, key.str(), value); !taken) return fail(taken.error());
  }
  if (auto good = check_keys(settings, source_line(*node)); !good) return fail(good.error());
  return settings;
}

Result<void> check_secret(std::string_view key, const std::string& file) {
  if (file.empty()) return {};
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0)
    return fail(Errc::NotFound, "mqtt: {} '{}' is not there", key, file);
  if ((facts.st_mode & (S_IRWXO | S_IWGRP)) == 0) return {};
  return fail(Errc::Denied, "mqtt: {} '{}' can be read by others: chmod 600 it", key, file);
}

Result<void> check_readable(std::string_view key, const std::string& file) {
  if (file.empty() || std::ifstream(file)) return {};
  return fail(Errc::NotFound, "mqtt: {} '{}' cannot be read", key, file);
}

}  // namespace

Result<MqttSettings> read_mqtt(std::string_view toml) {
  try {
    return read_section(toml::parse(toml));
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
}

Result<void> check_exposure(const MqttSettings& settings) {
  if (!settings.is_on()) return {};
  if (!settings.has_tls && !settings.is_loopback && !settings.is_open_network_allowed) {
    return fail(Errc::Denied,
                "mqtt: {} is beyond this computer and has no TLS: anybody on the way reads what "
                "the machines report, and the password; use mqtts://, or allow it with "
                "open_network = true, on a network of your own",
                settings.broker);
  }
  const std::array files{
      std::pair{"ca", settings.ca}, std::pair{"certificate", settings.certificate},
      std::pair{"key", settings.key}, std::pair{"password_file", settings.password_file}};
  for (const auto& [key, file] : files) {
    if (auto good = check_readable(key, file); !good)
      return fail(Errc::Denied, "{}", good.error().what);
  }
  if (auto good = check_secret("key", settings.key); !good) return good;
  if (auto password = read_password(settings); !password)
    return fail(Errc::Denied, "{}", password.error().what);
  return {};
}

Result<std::string> read_password(const MqttSettings& settings) {
  std::string password;
  if (settings.password_file.empty()) return password;
  if (auto good = check_secret("password_file", settings.password_file); !good)
    return fail(good.error());
  std::ifstream file(settings.password_file);
  if (!std::getline(file, password) || password.empty()) {
    return fail(Errc::NotFound, "mqtt: password_file '{}' has no first line",
                settings.password_file);
  }
  return password;
}

}  // namespace dripline::mqtt
