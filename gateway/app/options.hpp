#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/machine/motion_backend.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/pki/certificate.hpp"
#include "protocol/process/settings_table.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::gateway {

/// Machine time for real time; no factor: as fast as possible.
struct Speed {
  std::optional<double> factor = 1;
};
/// "1x", "100x", "0.5x" or "max". Errors: Syntax, LimitExceeded (not above 0, or above 10^6).
Result<Speed> parse_speed(std::string_view text);

/// Only simulated time passes faster or slower. Errors: Unsupported.
Result<void> check_speed(const machine::MotionCapabilities& machine, const Speed& speed);

/// The gateway's line: at one end of it in the place of a control (`--line`), or at the other,
/// beside a control (`--motion line:ADDRESS`).
struct LineOptions {
  std::string address;
  std::string template_name;    ///< empty: the first for this control, or "plain"
  std::string changes;          ///< key=value, one a line
  wire::LineSettings settings;  ///< the result of the two above; made by `complete`
  std::size_t buffer_bytes = 64 * 1024;
  std::string request;          ///< a program's name, or "next"; empty: the host begins
  std::filesystem::path rules;  ///< what the operator can request at the control; empty: nothing
  /// Beside a control: program text kept ahead of the line.
  std::chrono::seconds ahead{600};
};

struct GatewayOptions {
  std::string machine;
  std::string control;
  std::filesystem::path state;
  dds::NetworkOptions network;
  /// The folder of `dnc pki`; `complete` makes network.security and the next member of it.
  std::optional<std::filesystem::path> dds_security;
  std::optional<pki::Certificate> certificate;
  std::string motion = "simulated";  ///< see motion_choice.hpp
  Speed speed;
  std::optional<std::filesystem::path> setup, log, execution_probe;
  std::string log_level = "info";
  std::uint32_t log_mb = 10;
  std::uint32_t log_files = 5;
  std::string description;
  std::optional<LineOptions> line;
  /// The machine is a control at the end of `line`.
  bool drives_control() const;
  bool has_server = true;  ///< without one, programs come from the line alone
  /// Whether the network alone may start the machine. `complete` makes the default: yes for a
  /// simulated machine, no for one with a line.
  std::optional<bool> unattended;
  bool is_unattended = true;
  std::chrono::seconds cycle_start_wait{1800};  ///< then a run without cycle start ends
  /// The largest step of a jog from the network, mm or degrees (0: none is allowed), and its
  /// highest feed per minute.
  double jog_step = 1, jog_feed = 300;
  /// Between two checkpoints of a run, for restarts; no option of its own.
  std::chrono::milliseconds checkpoint_interval{5000};
};

using OptionRow = process::SettingRow<GatewayOptions>;
std::span<const OptionRow> option_rows();

/// Sets every key of a TOML text. Errors: Syntax (not TOML, an unknown key, a value that does not
/// fit), naming the key.
Result<void> apply_config(std::string_view toml, GatewayOptions& options);

/// Makes the defaults that depend on other options, and checks what is required. Errors: Syntax,
/// NotFound (no home folder to put the state in, no such line template or setting), LimitExceeded,
/// Denied (DDS would be open to strangers), and those of dds::open_security_folder.
Result<void> complete(GatewayOptions& options);
/// Whether the control that the setup describes speaks the line's protocol: a TNC 151/155 E or V
/// has no transfer blockwise. Errors: Unsupported; Syntax (the setup's).
Result<void> check_line(const GatewayOptions& options, const interpreter::Setup& setup);

/// The settings of the gateway's line where it is the control: the setup supplies what the line's
/// own options leave open, such as a TNC's `heading_letter`. Errors: Syntax, naming the option.
Result<wire::LineSettings> line_settings_of(const LineOptions& line,
                                            const interpreter::Options& control);

}  // namespace dripline::gateway
