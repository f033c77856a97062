#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// An action of the operator at the machine's own panel. One line of the panel's protocol
/// (README.md, "The panel").
struct PanelCommand {
  enum class Verb : std::uint8_t {
    Status,
    CycleStart,
    RemoteEnable,  ///< value: 1 given, 0 withdrawn
    Hold,
    Abort,
    EmergencyStop,  ///< value: 1 pressed, 0 released
    Answer,         ///< text
    Switch,         ///< text: its name; value: 1 on, 0 off
    FeedOverride,   ///< value: a factor, as the two after it
    RapidOverride,
    SpindleOverride,
    Handwheel,      ///< value: clicks
    Home,           ///< the axes, while no program runs
    Unlock,         ///< without homing
    Rewind,         ///< the tape in the reader, while no program runs
    DiscardMemory,  ///< the next program begins with what the setup gives
  };
  Verb verb = Verb::Status;
  std::string text;
  double value = 0;
  friend bool operator==(const PanelCommand&, const PanelCommand&) = default;
};

inline constexpr std::size_t kMaxPanelLine = 256;  ///< bytes, without its end

/// `line` without its end. Errors: Syntax (an unknown verb, a wrong argument, bytes that are no
/// printable UTF-8), LimitExceeded (too long).
Result<PanelCommand> parse_panel_command(std::string_view line);

/// It only stops, or takes the network's permission back: carried out however late it comes.
bool is_stop(const PanelCommand& command);

/// A command of the panel; `answer` is called once, from the gateway's thread, with one line
/// that begins with "ok" or "refused".
struct PanelRequest {
  PanelCommand command;
  std::function<void(std::string)> answer;
  /// Why its sender no longer waits for it, or may not; empty: it does. Null: always.
  std::function<std::string()> why_late = nullptr;
};

/// Why `request` is not carried out now: it has come too late for what it may do.
std::optional<std::string> refusal_of_late(const PanelRequest& request);

/// The verbs with their arguments, a line each, for help texts.
std::string panel_verbs();

}  // namespace dripline::gateway
