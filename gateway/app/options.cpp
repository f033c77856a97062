#include "gateway/app/options.hpp"

#include <toml++/toml.h>
#include <unistd.h>
#include <array>
#include <charconv>

#include "protocol/base/names.hpp"
#include "protocol/base/state_location.hpp"

namespace dripline::gateway {
namespace {

template <class Number>
Result<Number> number(std::string_view text, Number low, Number high) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return fail(Errc::Syntax, "'{}' is not a number from {} to {}", text, low, high);
  if (value < low || value > high)
    return fail(Errc::LimitExceeded, "{} is not from {} to {}", text, low, high);
  return value;
}

Result<void> set_number(std::uint32_t& to, std::string_view text, std::uint32_t low,
                        std::uint32_t high) {
  const auto value = number<std::uint32_t>(text, low, high);
  if (!value) return fail(value.error());
  to = *value;
  return {};
}

using Options = GatewayOptions;

constexpr std::array kRows{
    OptionRow{"machine", "name", "", "(required)", "name of the machine, as orders call it",
              [](Options& o, std::string_view v) {
                o.machine = v;
                return check_machine_name(v);
              }},
    OptionRow{"control", "name", "", "(required)", "control family whose programs it runs",
              [](Options& o, std::string_view v) -> Result<void> {
                o.control = v;
                return {};
              }},
    OptionRow{"state", "folder", "", "STATE/gateways/MACHINE",
              "where records and counters are kept; one gateway at a time",
              [](Options& o, std::string_view v) -> Result<void> {
                o.state = v;
                return {};
              }},
    OptionRow{"server", "host[:port]", "", "127.0.0.1", "where the server listens for gateways",
              [](Options& o, std::string_view v) -> Result<void> {
                o.network.server = v;
                return {};
              }},
    OptionRow{
        "dds-domain", "number", "", "0", "DDS domain, 0 to 230, the same as the server's",
        [](Options& o, std::string_view v) { return set_number(o.network.domain, v, 0, 230); }},
    OptionRow{"dds-tag", "text", "", "(none)", "systems with different tags do not see each other",
              [](Options& o, std::string_view v) -> Result<void> {
                o.network.tag = v;
                return {};
              }},
    OptionRow{"dds-interface", "name", "", "lo", "network interface, by name or address",
              [](Options& o, std::string_view v) -> Result<void> {
                o.network.interface = v;
                return {};
              }},
    OptionRow{"discovery-interval-ms", "number", "ms", "250", "between two looks for the server",
              [](Options& o, std::string_view v) {
                return set_number(o.network.discovery_interval_ms, v, 10, 60'000);
              }},
    OptionRow{"lease-ms", "number", "ms", "2000", "a server silent for so long is gone",
              [](Options& o, std::string_view v) {
                return set_number(o.network.lease_ms, v, 100, 600'000);
              }},
    OptionRow{"speed", "factor", "", "1x", "of the simulated machine: 1x, 100x, max",
              [](Options& o, std::string_view v) -> Result<void> {
                const auto speed = parse_speed(v);
                if (!speed) return fail(speed.error());
                o.speed = *speed;
                return {};
              }},
    OptionRow{"setup", "file", "", "(none)",
              "what the control knows: offsets, tools, answers, the part a probe meets (TOML)",
              [](Options& o, std::string_view v) -> Result<void> {
                o.setup = v;
                return {};
              }},
    OptionRow{"description", "text", "", "(none)", "for people, shown with the machine",
              [](Options& o, std::string_view v) -> Result<void> {
                o.description = std::string(v.substr(0, 256));
                return {};
              }},
    OptionRow{"log", "file", "", "(standard error)", "log file",
              [](Options& o, std::string_view v) -> Result<void> {
                o.log = v;
                return {};
              }},
    OptionRow{"log-level", "level", "", "info", "trace, debug, info, warn or error",
              [](Options& o, std::string_view v) -> Result<void> {
                for (const std::string_view known : {"trace", "debug", "info", "warn", "error"}) {
                  if (v != known) continue;
                  o.log_level = v;
                  return {};
                }
                return fail(Errc::Syntax, "'{}' is none of trace, debug, info, warn, error", v);
              }},
    OptionRow{"witness", "file", "", "(none)", "for tests: counts what was truly executed",
              [](Options& o, std::string_view v) -> Result<void> {
                o.witness = v;
                return {};
              }},
};

Result<std::string> text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  return fail(Errc::Syntax, "expected a text or a whole number");
}

const OptionRow* find_row(std::string_view key) {
  for (const OptionRow& row : kRows) {
    if (row.key == key) return &row;
  }
  return nullptr;
}

}  // namespace

std::span<const OptionRow> option_rows() {
  return kRows;
}

Result<Speed> parse_speed(std::string_view text) {
  if (text == "max") return Speed{std::nullopt};
  std::string_view factor = text;
  if (!factor.empty() && factor.back() == 'x') factor.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(factor.data(), factor.data() + factor.size(), value,
                                            std::chars_format::fixed);
  if (error != std::errc() || end != factor.data() + factor.size())
    return fail(Errc::Syntax, "'{}' is no speed: 1x, 100x or max", text);
  if (!(value > 0 && value <= 1e6))
    return fail(Errc::LimitExceeded, "speed {} is not above 0 and at most 1000000x", text);
  return Speed{value};
}

Result<void> apply_config(std::string_view toml, GatewayOptions& options) {
  toml::table table;
  try {
    table = toml::parse(toml);
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "line {}: {}", error.source().begin.line, error.description());
  }
  for (const auto& [key, node] : table) {
    const OptionRow* row = find_row(key.str());
    if (row == nullptr) return fail(Errc::Syntax, "unknown key '{}'", key.str());
    const auto text = text_of(node);
    if (!text) return fail(Errc::Syntax, "{}: {}", key.str(), text.error().what);
    if (const auto done = row->set(options, *text); !done)
      return fail(done.error().code, "{}: {}", key.str(), done.error().what);
  }
  return {};
}

Result<void> complete(GatewayOptions& options) {
  if (options.machine.empty()) return fail(Errc::Syntax, "--machine NAME is required");
  if (options.control.empty()) return fail(Errc::Syntax, "--control NAME is required");
  if (!options.state.empty()) return {};
  const auto state = default_state_folder(process_environment, ::geteuid() == 0);
  if (!state) return fail(state.error());
  options.state = std::filesystem::path(*state) / "gateways" / options.machine;
  return {};
}

}  // namespace dripline::gateway
