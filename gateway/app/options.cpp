#include "gateway/app/options.hpp"

#include <toml++/toml.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>

#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/state_location.hpp"
#include "protocol/wire/tnc_parameters.hpp"

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

LineOptions& line_of(Options& options) {
  if (!options.line) options.line.emplace();
  return *options.line;
}

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
    OptionRow{"server", "host[:port]", "", "127.0.0.1",
              "where the server listens for gateways; none: without a server, on a line alone",
              [](Options& o, std::string_view v) -> Result<void> {
                o.network.server = v;
                o.has_server = v != "none";
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
    OptionRow{
        "dds-open-network", "yes|no", "", "no",
        "yes: DDS beyond this machine although it has no authentication; only on a network of "
        "its own",
        [](Options& o, std::string_view v) -> Result<void> {
          if (v != "yes" && v != "no") return fail(Errc::Syntax, "'{}' is not yes or no", v);
          o.network.is_open_network_allowed = v == "yes";
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
    OptionRow{"log-mb", "number", "", "10",
              "MB of the log file; then it is numbered and a new one begun",
              [](Options& o, std::string_view v) { return set_number(o.log_mb, v, 1, 10'000); }},
    OptionRow{"log-files", "number", "", "5", "numbered log files that are kept",
              [](Options& o, std::string_view v) { return set_number(o.log_files, v, 0, 1000); }},
    OptionRow{"log-level", "level", "", "info", "trace, debug, info, warn or error",
              [](Options& o, std::string_view v) -> Result<void> {
                for (const std::string_view known : {"trace", "debug", "info", "warn", "error"}) {
                  if (v != known) continue;
                  o.log_level = v;
                  return {};
                }
                return fail(Errc::Syntax, "'{}' is none of trace, debug, info, warn, error", v);
              }},
    OptionRow{
        "line", "address", "", "(none)",
        "serial line at whose end this machine's control stands: a device, tcp://host:port or "
        "rfc2217://host:port; programs then come from there",
        [](Options& o, std::string_view v) -> Result<void> {
          line_of(o).address = v;
          return {};
        }},
    OptionRow{"line-template", "name", "", "(the control's)",
              "the line's settings, as listed by dnc port templates",
              [](Options& o, std::string_view v) -> Result<void> {
                line_of(o).template_name = v;
                return {};
              }},
    OptionRow{"line-setting", "key=value", "", "(none)",
              "changes one of the template's settings; more than once for more",
              [](Options& o, std::string_view v) -> Result<void> {
                line_of(o).changes = v;
                return {};
              },
              true},
    OptionRow{"line-buffer", "number", "byte", "65536",
              "the control's memory for a program being fed: when it is full the host is held",
              [](Options& o, std::string_view v) -> Result<void> {
                const auto bytes = number<std::size_t>(v, 256, 16 * 1024 * 1024);
                if (!bytes) return fail(bytes.error());
                line_of(o).buffer_bytes = *bytes;
                return {};
              }},
    OptionRow{
        "line-request", "name", "", "(none)",
        "program the control asks its host for; next: whichever is next, after each run, as on a "
        "HEIDENHAIN line by itself",
        [](Options& o, std::string_view v) -> Result<void> {
          line_of(o).request = v;
          return {};
        }},
    OptionRow{"unattended", "yes|no", "", "yes; with --line no",
              "whether the network alone may start the machine; no: its operator gives the remote "
              "enable, or cycle start, at its panel (dncgw panel --help)",
              [](Options& o, std::string_view v) -> Result<void> {
                if (v != "yes" && v != "no")
                  return fail(Errc::Syntax, "'{}' is neither yes nor no", v);
                o.unattended = v == "yes";
                return {};
              }},
    OptionRow{"cycle-start-wait-s", "number", "s", "1800",
              "a run that waits so long for cycle start at the machine is ended",
              [](Options& o, std::string_view v) -> Result<void> {
                const auto seconds = number<std::uint32_t>(v, 1, 86'400);
                if (!seconds) return fail(seconds.error());
                o.cycle_start_wait = std::chrono::seconds(*seconds);
                return {};
              }},
    OptionRow{"execution_probe", "file", "", "(none)", "for tests: counts what was truly executed",
              [](Options& o, std::string_view v) -> Result<void> {
                o.execution_probe = v;
                return {};
              }},
};

/// ["baud=9600", "parity=even"]: one a line.
Result<std::string> lines_of(const toml::array& list) {
  std::string lines;
  for (const toml::node& entry : list) {
    const auto* text = entry.as_string();
    if (text == nullptr) return fail(Errc::Syntax, "expected a list of texts");
    lines += text->get() + "\n";
  }
  return lines;
}

Result<std::string> text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* list = node.as_array()) return lines_of(*list);
  return fail(Errc::Syntax, "expected a text or a whole number");
}

const OptionRow* find_row(std::string_view key) {
  for (const OptionRow& row : kRows) {
    if (row.key == key) return &row;
  }
  return nullptr;
}

/// Without a name, the first made for this control; there may be none.
Result<const wire::LineTemplate*> template_of(const LineOptions& line, std::string_view control) {
  if (!line.template_name.empty()) return wire::find_template(line.template_name);
  for (const wire::LineTemplate& known : wire::line_templates()) {
    if (known.control == control) return &known;
  }
  return wire::find_template("plain");
}

Result<void> change(wire::LineSettings& settings, std::string_view changes) {
  while (!changes.empty()) {
    const std::size_t end = std::min(changes.find_first_of("\n,"), changes.size());
    const std::string_view entry = changes.substr(0, end);
    changes.remove_prefix(std::min(end + 1, changes.size()));
    if (entry.empty()) continue;
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos)
      return fail(Errc::Syntax, "line-setting '{}' is not key=value", entry);
    const auto done = wire::set_value(settings, entry.substr(0, equals), entry.substr(equals + 1));
    if (!done) return fail(done.error().code, "line-setting: {}", done.error().what);
  }
  return {};
}

Result<void> complete_line(Options& options) {
  LineOptions& line = *options.line;
  if (line.address.empty())
    return fail(Errc::Syntax, "--line ADDRESS is required with the other line options");
  const auto found = template_of(line, options.control);
  if (!found) return fail(found.error());
  line.template_name = (*found)->name;
  line.settings = (*found)->settings;
  if (const auto done = change(line.settings, line.changes); !done) return done;
  if ((*found)->control == "tnc155") {
    const auto has = wire::check_tnc_baud(line.settings.baud);
    if (!has) return fail(has.error().code, "line-setting: {}", has.error().what);
  }
  const bool must_ask = line.settings.flow == wire::Flow::Heidenhain ||
                        line.settings.flow == wire::Flow::HeidenhainBcc;
  if (line.request.empty() && must_ask) line.request = "next";
  return {};
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

Result<void> check_speed(const machine::MotionCapabilities& machine, const Speed& speed) {
  if (machine.simulated_time || speed.factor == 1) return {};
  return fail(Errc::Unsupported, "this machine moves in real time: its speed is 1x");
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
    if (node.is_array() && !row->may_repeat)
      return fail(Errc::Syntax, "{}: expected one value, not a list", key.str());
    if (!text) return fail(Errc::Syntax, "{}: {}", key.str(), text.error().what);
    if (const auto done = row->set(options, *text); !done)
      return fail(done.error().code, "{}: {}", key.str(), done.error().what);
  }
  return {};
}

Result<void> complete(GatewayOptions& options) {
  if (options.machine.empty()) return fail(Errc::Syntax, "--machine NAME is required");
  if (options.control.empty()) return fail(Errc::Syntax, "--control NAME is required");
  if (options.line) {
    if (const auto done = complete_line(options); !done) return done;
  } else if (!options.has_server) {
    return fail(Errc::Syntax,
                "--server none needs --line ADDRESS: programs must come from somewhere");
  }
  options.is_unattended = options.unattended.value_or(!options.line.has_value());
  if (options.has_server) {
    if (auto safe = dds::check_exposure(options.network); !safe) return safe;
  }
  if (!options.state.empty()) return {};
  const auto state = default_state_folder(process_environment, ::geteuid() == 0);
  if (!state) return fail(state.error());
  options.state = std::filesystem::path(*state) / "gateways" / options.machine;
  return {};
}

Result<void> check_line(const GatewayOptions& options, const interpreter::Setup& setup) {
  namespace tnc155 = interpreter::tnc155;
  const bool is_blockwise =
      options.line && options.line->settings.flow == wire::Flow::HeidenhainBcc;
  if (!is_blockwise || options.control != "tnc155") return {};
  const auto version = tnc155::version_of(setup.control);
  if (!version) return fail(version.error());
  if (version->has(tnc155::Feature::BlockwiseTransfer)) return {};
  return fail(Errc::Unsupported,
              "--line {} speaks heidenhain_bcc: {}; flow heidenhain (template tnc155) is its "
              "interface",
              options.line->address, version->lacks(tnc155::Feature::BlockwiseTransfer));
}

}  // namespace dripline::gateway
