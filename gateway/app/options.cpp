#include "gateway/app/options.hpp"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>

#include "gateway/app/motion_choice.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/private_folder.hpp"
#include "protocol/dds/security_folder.hpp"
#include "protocol/process/settings_reader.hpp"
#include "protocol/wire/tnc_parameters.hpp"

namespace dripline::gateway {
namespace {

using Options = GatewayOptions;

LineOptions& line_of(Options& options) {
  if (!options.line) options.line.emplace();
  return *options.line;
}

Result<void> set_machine(Options& options, std::string_view name) {
  options.machine = name;
  return check_machine_name(name);
}

Result<void> set_server(Options& options, std::string_view address) {
  options.network.server = address;
  options.has_server = address != "none";
  return {};
}

Result<void> set_motion(Options& options, std::string_view name) {
  options.motion = name;
  return check_motion(name);
}

Result<void> set_speed(Options& options, std::string_view text) {
  const auto speed = parse_speed(text);
  if (!speed) return fail(speed.error());
  options.speed = *speed;
  return {};
}

Result<void> set_description(Options& options, std::string_view text) {
  options.description = text.substr(0, 256);
  return {};
}

Result<void> set_log_level(Options& options, std::string_view level) {
  constexpr std::array<std::string_view, 5> kLevels{"trace", "debug", "info", "warn", "error"};
  if (std::ranges::find(kLevels, level) == kLevels.end())
    return fail(Errc::Syntax, "'{}' is not one of trace, debug, info, warn, error", level);
  options.log_level = level;
  return {};
}

template <std::string LineOptions::*member>
Result<void> set_line(Options& options, std::string_view text) {
  line_of(options).*member = text;
  return {};
}

Result<void> set_line_buffer(Options& options, std::string_view text) {
  const auto bytes = process::parse_number(text, 256, 16 * 1024 * 1024);
  if (!bytes) return fail(bytes.error());
  line_of(options).buffer_bytes = *bytes;
  return {};
}

Result<void> set_line_rules(Options& options, std::string_view file) {
  line_of(options).rules = file;
  return {};
}

Result<void> set_line_ahead(Options& options, std::string_view text) {
  const auto seconds = process::parse_number(text, 1, 86'400);
  if (!seconds) return fail(seconds.error());
  line_of(options).ahead = std::chrono::seconds(*seconds);
  return {};
}

Result<void> set_cycle_start_wait(Options& options, std::string_view text) {
  const auto seconds = process::parse_number(text, 1, 86'400);
  if (!seconds) return fail(seconds.error());
  options.cycle_start_wait = std::chrono::seconds(*seconds);
  return {};
}

/// Errors: Syntax; LimitExceeded (not `least` to `most`).
Result<double> parse_size(std::string_view text, double least, double most) {
  double value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value, std::chars_format::fixed);
  if (error != std::errc() || end != last) return fail(Errc::Syntax, "'{}' is no number", text);
  if (value >= least && value <= most) return value;
  return fail(Errc::LimitExceeded, "{} is not {} to {}", text, least, most);
}

Result<void> set_jog_step(Options& options, std::string_view text) {
  const auto step = parse_size(text, 0, 100);
  if (!step) return fail(step.error());
  options.jog_step = *step;
  return {};
}

Result<void> set_jog_feed(Options& options, std::string_view text) {
  const auto feed = parse_size(text, 0.1, 10'000);
  if (!feed) return fail(feed.error());
  options.jog_feed = *feed;
  return {};
}

using process::number_value;
using process::text_value;
using process::Written;
using process::yes_no_value;
using Network = dds::NetworkOptions;
constexpr auto kNetwork = &Options::network;

using SetOption = Result<void> (*)(Options&, std::string_view);
constexpr auto set_by(Written form, SetOption set) {
  return process::SettingValue<Options>{form, set};
}

constexpr std::array kOptionRows{
    OptionRow{"machine", "NAME", "", "required", "Name of the machine, as commands use it",
              set_by(Written::Text, set_machine)},
    OptionRow{"control", "NAME", "", "required", "Control family whose programs it runs",
              text_value<&Options::control>()},
    OptionRow{"state", "FOLDER", "", "STATE/gateways/MACHINE",
              "Folder of records and counters; one gateway at a time",
              text_value<&Options::state>()},
    OptionRow{
        "server", "HOST[:PORT],...", "", "127.0.0.1",
        "Address where the server listens for gateways, and with commas between of those that "
        "take over from it; none: run without a server, from a serial line only",
        set_by(Written::Text, set_server)},
    OptionRow{"dds-domain", "NUMBER", "", "", "DDS domain, 0 to 230, the same as the server's",
              number_value<0, 230, kNetwork, &Network::domain>()},
    OptionRow{"dds-tag", "TEXT", "", "none", "Systems with different tags do not see each other",
              text_value<kNetwork, &Network::tag>()},
    OptionRow{"dds-cells", "NUMBER", "", "",
              "Parts of the server's DDS side: 8, 16, 32 or 64; the same as the server's, or fewer",
              number_value<dds::kFewestCells, dds::kMostCells, kNetwork, &Network::cells>()},
    OptionRow{"dds-interface", "NAME", "", "lo", "Network interface, by name or address",
              text_value<kNetwork, &Network::interface>()},
    OptionRow{"dds-security", "FOLDER", "", "none: no authentication",
              "Folder with this machine's certificate, key and permissions (dnc pki gateway "
              "MACHINE); needed for DDS beyond this computer",
              text_value<&Options::dds_security>()},
    OptionRow{"dds-open-network", "yes|no", "", "",
              "yes: allow DDS beyond this computer without dds-security; only on a network of its "
              "own",
              yes_no_value<kNetwork, &Network::is_open_network_allowed>()},
    OptionRow{"discovery-interval-ms", "NUMBER", "ms", "",
              "Interval between two searches for the server",
              number_value<10, 60'000, kNetwork, &Network::discovery_interval_ms>()},
    OptionRow{"lease-ms", "NUMBER", "ms", "",
              "Consider the server disconnected after this much silence",
              number_value<100, 600'000, kNetwork, &Network::lease_ms>()},
    OptionRow{
        "motion", "NAME", "", "simulated",
        "Back end that moves the machine: simulated; linuxcnc:INI, the LinuxCNC that runs this INI "
        "file; grbl:ADDRESS, a board of the Grbl 1.1 class at a device, tcp://host:port or "
        "rfc2217://host:port, with ,BAUD where it is not 115200; line:ADDRESS, a control at the "
        "end of this computer's serial line, which the line options describe",
        set_by(Written::Text, set_motion)},
    OptionRow{"speed", "FACTOR", "", "1x", "Speed of the simulated machine: 1x, 100x, max",
              set_by(Written::TextOrNumber, set_speed)},
    OptionRow{
        "setup", "FILE", "", "none",
        "Setup of the control: offsets, tools, answers, the simulated workpiece for probing (TOML)",
        text_value<&Options::setup>()},
    OptionRow{"description", "TEXT", "", "none", "Description shown with the machine",
              set_by(Written::Text, set_description)},
    OptionRow{"log", "FILE", "", "standard error", "Log file", text_value<&Options::log>()},
    OptionRow{"log-mb", "NUMBER", "MB", "", "Rotate the log file at this size",
              number_value<1, 10'000, &Options::log_mb>()},
    OptionRow{"log-files", "NUMBER", "", "", "Keep this many rotated log files",
              number_value<0, 1000, &Options::log_files>()},
    OptionRow{"log-level", "LEVEL", "", "info",
              "Lowest level that is logged: trace, debug, info, warn or error",
              set_by(Written::Text, set_log_level)},
    OptionRow{"line", "ADDRESS", "", "none",
              "Serial line at whose end this machine's control is: a device, tcp://host:port or "
              "rfc2217://host:port; programs then come from there",
              set_by(Written::Text, set_line<&LineOptions::address>)},
    OptionRow{"line-template", "NAME", "", "the control's",
              "Settings of the line, as listed by dnc port templates",
              set_by(Written::Text, set_line<&LineOptions::template_name>)},
    OptionRow{
        "line-setting", "KEY=VALUE", "", "none",
        "Change one of the template's settings; a word like 4800e71 is baud, parity, data and "
        "stop bits; repeat for more",
        set_by(Written::List, set_line<&LineOptions::changes>)},
    OptionRow{"line-buffer", "NUMBER", "bytes", "65536",
              "Memory of the control for a program being fed: when it is full the host is held",
              set_by(Written::Number, set_line_buffer)},
    OptionRow{"line-request", "NAME", "", "none",
              "Request this program from the host; next: request the next one after each run "
              "(always so on a HEIDENHAIN line)",
              set_by(Written::Text, set_line<&LineOptions::request>)},
    OptionRow{
        "line-ahead-s", "NUMBER", "s", "600",
        "With --motion line: keep program text for this long ahead of the line, so that a cut "
        "of the network is not felt at the control; at most 64 MiB",
        set_by(Written::Number, set_line_ahead)},
    OptionRow{"line-rules", "FILE", "", "none",
              "With --motion line: rules for what the control sends and requests (TOML)",
              set_by(Written::Text, set_line_rules)},
    OptionRow{"unattended", "yes|no", "", "yes; no with --line or a real --motion",
              "Whether the network alone may start the machine; no: its operator gives the remote "
              "enable, or cycle start, at its panel (dncgw panel --help)",
              yes_no_value<&Options::unattended>()},
    OptionRow{"cycle-start-wait-s", "NUMBER", "s", "1800",
              "End a run that has waited this long for cycle start at the machine",
              set_by(Written::Number, set_cycle_start_wait)},
    OptionRow{"jog-step", "NUMBER", "mm or degrees", "1",
              "Largest step of an axis that is jogged from the network (dnc machine jog), 0 to "
              "100; 0: none is allowed",
              set_by(Written::TextOrNumber, set_jog_step)},
    OptionRow{"jog-feed", "NUMBER", "per minute", "300",
              "Highest feed of such a step, and that of one without a feed; mm or degrees, 0.1 to "
              "10000",
              set_by(Written::TextOrNumber, set_jog_feed)},
    OptionRow{"execution-probe", "FILE", "", "none",
              "For tests: count in this file what was executed",
              text_value<&Options::execution_probe>()}};

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
    const bool is_short_form = equals == std::string_view::npos;
    if (is_short_form) {
      if (const auto done = wire::set_value(settings, "line", entry); !done) {
        return fail(Errc::Syntax, "line-setting '{}' is neither key=value nor like 4800e71: {}",
                    entry, done.error().what);
      }
      continue;
    }
    const auto done = wire::set_value(settings, entry.substr(0, equals), entry.substr(equals + 1));
    if (!done) return fail(done.error().code, "line-setting: {}", done.error().what);
  }
  return {};
}

Result<void> complete_line(Options& options) {
  LineOptions& line = *options.line;
  if (options.drives_control()) {
    if (!line.address.empty())
      return fail(Errc::Conflict, "--line and --motion line: are the two ends of a line: one only");
    line.address = line_address_of(options.motion);
  }
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
  if (line.request.empty() && must_ask && !options.drives_control()) line.request = "next";
  return {};
}

Result<void> open_security(Options& options) {
  if (!options.dds_security) return {};
  auto folder = dds::open_security_folder(*options.dds_security,
                                          {.role = dds::Role::Gateway, .machine = options.machine},
                                          SystemClock().now());
  if (!folder) return fail(folder.error());
  options.network.security = std::move(folder->files);
  options.certificate = std::move(folder->certificate);
  return {};
}

}  // namespace

bool GatewayOptions::drives_control() const {
  return !line_address_of(motion).empty();
}

std::span<const OptionRow> option_rows() {
  return kOptionRows;
}

Result<Speed> parse_speed(std::string_view text) {
  if (text == "max") return Speed{std::nullopt};
  std::string_view factor = text;
  if (!factor.empty() && factor.back() == 'x') factor.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(factor.data(), factor.data() + factor.size(), value,
                                            std::chars_format::fixed);
  if (error != std::errc() || end != factor.data() + factor.size())
    return fail(Errc::Syntax, "'{}' is not a speed: 1x, 100x or max", text);
  if (!(value > 0 && value <= 1e6))
    return fail(Errc::LimitExceeded, "speed {} is not above 0 and at most 1000000x", text);
  return Speed{value};
}

Result<void> check_speed(const machine::MotionCapabilities& machine, const Speed& speed) {
  if (machine.simulated_time || speed.factor == 1) return {};
  return fail(Errc::Unsupported, "this machine moves in real time: its speed is 1x");
}

Result<void> apply_config(std::string_view toml, GatewayOptions& options) {
  return process::SettingsReader(option_rows(), options).read_toml(toml);
}

Result<void> complete(GatewayOptions& options) {
  if (options.machine.empty()) return fail(Errc::Syntax, "--machine NAME is required");
  if (options.control.empty()) return fail(Errc::Syntax, "--control NAME is required");
  if (options.drives_control()) {
    if (!options.has_server)
      return fail(Errc::Syntax, "--motion line: needs a server: programs come from there");
    line_of(options);
  }
  if (options.line) {
    if (const auto done = complete_line(options); !done) return done;
  } else if (!options.has_server) {
    return fail(Errc::Syntax,
                "--server none needs --line ADDRESS: programs must come from somewhere");
  }
  const bool can_hurt = options.line.has_value() || is_real_motion(options.motion);
  options.is_unattended = options.unattended.value_or(!can_hurt);
  if (options.has_server) {
    if (auto secure = open_security(options); !secure) return secure;
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

Result<wire::LineSettings> line_settings_of(const LineOptions& line,
                                            const interpreter::Options& control) {
  wire::LineSettings settings = line.settings;
  const bool is_named = line.changes.find("tnc_heading=") != std::string::npos;
  if (settings.flow != wire::Flow::HeidenhainBcc || is_named ||
      control.find("heading_letter") == nullptr) {
    return settings;
  }
  const auto letter = control.choice("heading_letter", {"%", "H"}, 0);
  if (!letter) return fail(letter.error());
  settings.heidenhain.heading = *letter == 0 ? '%' : 'H';
  return settings;
}

}  // namespace dripline::gateway
