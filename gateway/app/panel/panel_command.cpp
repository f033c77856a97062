#include "gateway/app/panel/panel_command.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "protocol/base/utf8.hpp"

namespace dripline::gateway {
namespace {

using Verb = PanelCommand::Verb;

enum class Takes : std::uint8_t {
  Nothing,
  State,
  StateOrPressed,
  Text,
  Percent,
  NameAndState,
  Count
};

struct VerbRow {
  std::string_view word;
  Verb verb;
  Takes takes;
  std::string_view help;
};

constexpr std::array kVerbRows{
    VerbRow{"status", Verb::Status, Takes::Nothing, "print what the machine does and waits for"},
    VerbRow{"cycle-start", Verb::CycleStart, Takes::Nothing,
            "begin the program that waits, or resume after a hold or a stop"},
    VerbRow{"remote-enable on|off", Verb::RemoteEnable, Takes::State,
            "let the network start the machine, or no longer"},
    VerbRow{"hold", Verb::Hold, Takes::Nothing, "hold the feed"},
    VerbRow{"abort", Verb::Abort, Takes::Nothing, "end the run"},
    VerbRow{"emergency-stop [on|off]", Verb::EmergencyStop, Takes::StateOrPressed,
            "press it (on), or release it"},
    VerbRow{"answer TEXT", Verb::Answer, Takes::Text, "answer the program's question"},
    VerbRow{"switch NAME on|off", Verb::Switch, Takes::NameAndState,
            "set single_block, optional_stop, block_skip, dry_run, machine_lock, test_run or "
            "handwheel"},
    VerbRow{"feed-override PERCENT", Verb::FeedOverride, Takes::Percent, "set the feed override"},
    VerbRow{"rapid-override PERCENT", Verb::RapidOverride, Takes::Percent,
            "set the rapid override"},
    VerbRow{"spindle-override PERCENT", Verb::SpindleOverride, Takes::Percent,
            "set the spindle override"},
    VerbRow{"handwheel CLICKS", Verb::Handwheel, Takes::Count, "turn it, in handwheel mode"},
    VerbRow{"home", Verb::Home, Takes::Nothing, "move the axes to their reference points"},
    VerbRow{"unlock", Verb::Unlock, Takes::Nothing,
            "accept the position of a locked machine without homing"},
    VerbRow{"rewind", Verb::Rewind, Takes::Nothing,
            "wind a tape of several programs back: the next start reads its first one"},
    VerbRow{"discard-memory", Verb::DiscardMemory, Takes::Nothing,
            "discard the retained memory (variables, offsets), e.g. when it is damaged"},
};

std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find(' '));
}

std::string_view after_word(std::string_view text) {
  const std::size_t end = text.find(' ');
  if (end == std::string_view::npos) return {};
  text.remove_prefix(end);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

Result<void> check_text(std::string_view line) {
  if (line.size() > kMaxPanelLine) {
    return fail(Errc::LimitExceeded, "a line of {} bytes, at most {}", line.size(), kMaxPanelLine);
  }
  const bool has_control = std::any_of(line.begin(), line.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (has_control || !is_utf8(line)) return fail(Errc::Syntax, "expected one line of UTF-8 text");
  return {};
}

Result<double> state_of(std::string_view word) {
  if (word == "on") return 1.0;
  if (word == "off") return 0.0;
  return fail(Errc::Syntax, "'{}' is neither on nor off", word);
}

Result<double> number_of(std::string_view text, double highest) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= 0 && value <= highest))
    return fail(Errc::Syntax, "'{}' is not a number from 0 to {}", text, highest);
  return value;
}

Result<PanelCommand> with_value(PanelCommand command, const Result<double>& value, double divisor) {
  if (!value) return fail(value.error());
  command.value = *value / divisor;
  return command;
}

Result<PanelCommand> read_argument(const VerbRow& row, std::string_view rest) {
  PanelCommand command{.verb = row.verb, .text = {}, .value = 0};
  switch (row.takes) {
    case Takes::Nothing:
      if (!rest.empty())
        return fail(Errc::Syntax, "'{}': {} takes no argument", rest, first_word(row.word));
      return command;
    case Takes::StateOrPressed:
      return with_value(std::move(command), rest.empty() ? Result<double>(1.0) : state_of(rest), 1);
    case Takes::State:
      return with_value(std::move(command), state_of(rest), 1);
    case Takes::Percent:
      return with_value(std::move(command), number_of(rest, 1000), 100);
    case Takes::Count:
      return with_value(std::move(command), number_of(rest, 1e6), 1);
    case Takes::Text:
      command.text = rest;
      return command;
    case Takes::NameAndState:
      command.text = first_word(rest);
      return with_value(std::move(command), state_of(after_word(rest)), 1);
  }
  return command;
}

}  // namespace

Result<PanelCommand> parse_panel_command(std::string_view line) {
  if (const auto good = check_text(line); !good) return fail(good.error());
  const std::string_view word = first_word(line);
  for (const VerbRow& row : kVerbRows) {
    if (first_word(row.word) == word) return read_argument(row, after_word(line));
  }
  std::string known;
  for (const VerbRow& row : kVerbRows)
    known += (known.empty() ? "" : ", ") + std::string(first_word(row.word));
  return fail(Errc::Syntax, "'{}' is none of {}", word, known);
}

bool is_stop(const PanelCommand& command) {
  switch (command.verb) {
    case Verb::Status:
    case Verb::Hold:
    case Verb::Abort:
      return true;
    case Verb::EmergencyStop:
      return command.value == 1;
    case Verb::RemoteEnable:
      return command.value == 0;
    case Verb::Switch:
      return command.text == "emergency_stop" && command.value == 1;
    case Verb::FeedOverride:
    case Verb::RapidOverride:
      return command.value == 0;  // it holds the axes
    default:
      return false;
  }
}

std::optional<std::string> refusal_of_late(const PanelRequest& request) {
  if (is_stop(request.command) || !request.why_late) return std::nullopt;
  const std::string why = request.why_late();
  if (why.empty()) return std::nullopt;
  return fmt::format("too late: {}; give it again", why);
}

std::string panel_verbs() {
  std::string text;
  for (const VerbRow& row : kVerbRows) {
    text += fmt::format("  {:<25} {}", row.word, row.help);
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

}  // namespace dripline::gateway
