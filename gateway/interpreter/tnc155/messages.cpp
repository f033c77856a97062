#include "gateway/interpreter/tnc155/messages.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dripline::interpreter::tnc155 {
namespace {

using enum MessageSource;

/// What no program of ours raises by its text alone.
constexpr std::array kOthers{
    ControlMessage{"PGM ? UNAVAILABLE", Program, true, ErrorCode::ProgramUnavailable},
    ControlMessage{"LIMIT SWITCH ?", Program, true, ErrorCode::LimitSwitch},
    ControlMessage{"EXCHANGE CASSETTE - ME START", Transfer},
    ControlMessage{"ME: PROGRAM INCOMPLETE", Transfer},
    ControlMessage{"TRANSFERRED DATA INCORRECT ?", Transfer},
    ControlMessage{"EXTERNAL DATA INPUT", Transfer, false},
    ControlMessage{"EXTERNAL DATA OUTPUT", Transfer, false},
    ControlMessage{"TRANSFER BLOCKWISE", Transfer, false},
    ControlMessage{"EMERGENCY STOP", Machine},
    ControlMessage{"EXCHANGE BUFFER BATTERY", Machine},
    ControlMessage{"POWER INTERRUPTED", Machine},
    ControlMessage{"RELAY EXT. DC VOLTAGE MISSING", Machine},
    ControlMessage{"OPERATION PARAMETERS ERASED", Machine},
    ControlMessage{"NC: PROGRAM MEMORY ERASED", Machine},
    ControlMessage{"CAUTION: SOFTWARE LIMITS INACTIVE", Machine, false},
    ControlMessage{"MEMORY TEST", Machine, false},
    ControlMessage{"MACHINE PARAMETER PROGRAMMING", Machine, false},
    ControlMessage{"PASS OVER ?-REFERENCE MARK", Machine, false},
    ControlMessage{"REFERENCE MARK AXIS 4", Machine, false},
    ControlMessage{"BLOCK COMPLETE", Machine, false},
    ControlMessage{"EXCHANGE TOUCH PROBE BATTERY", Probe},
    ControlMessage{"PGM-SECTION CANNOT BE SHOWN", Graphics},
    ControlMessage{"TRANSFER GRAPHICS DETAIL", Graphics, false},
};

/// The errors of programs stand in the table of errors; those with a number or an axis are above.
std::vector<ControlMessage> make_messages() {
  std::vector<ControlMessage> messages;
  for (auto i = static_cast<std::size_t>(ErrorCode::AngleReferenceMissing);
       i <= static_cast<std::size_t>(ErrorCode::WrongSign); ++i) {
    const ErrorRow& row = error_row(static_cast<ErrorCode>(i));
    if (row.code == ErrorCode::ProgramUnavailable) continue;
    const bool is_probe =
        row.code == ErrorCode::ProbeNotReady || row.code == ErrorCode::TouchPointInaccessible;
    messages.push_back({row.text, is_probe ? Probe : Program, true, row.code});
  }
  messages.insert(messages.end(), kOthers.begin(), kOthers.end());
  return messages;
}

/// As the manual's index spells them, and as its text does.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOtherSpellings{{
    {"CIRCUIT END POS. INCORRECT", "CIRCLE END POS. INCORRECT"},
    {"CYCLE INCOMPLETE", "CYCL INCOMPLETE"},
    {"ROUNDING RADIUS TOOL LARGE", "ROUNDING RADIUS TOO LARGE"},
}};

bool is_blank(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}

/// Matches from the front of `text`, blanks of either side meaning nothing; `end` is how far.
bool matches(std::string_view text, std::string_view pattern, std::string_view& argument,
             std::size_t& end) {
  std::size_t at = 0;
  const auto skip = [&] {
    while (at < text.size() && is_blank(text[at])) ++at;
  };
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (is_blank(pattern[i])) continue;
    skip();
    if (pattern[i] != '?') {
      if (at == text.size() || text[at] != pattern[i]) return false;
      ++at;
      continue;
    }
    const std::size_t begin = at;
    const char behind = i + 1 < pattern.size() ? pattern[i + 1] : ' ';
    while (at < text.size() && !is_blank(text[at]) && text[at] != ':' &&
           (behind == ' ' || text[at] != behind)) {
      ++at;
    }
    argument = text.substr(begin, at - begin);
    if (argument.empty()) return false;
  }
  skip();
  end = at;
  return true;
}

}  // namespace

std::span<const ControlMessage> control_messages() {
  static const std::vector<ControlMessage> kMessages = make_messages();
  return kMessages;
}

std::optional<RecognisedMessage> recognise_message(std::string_view text) {
  const auto is_text = [&](std::string_view pattern, std::string_view& argument) {
    std::size_t end = 0;
    argument = {};
    return matches(text, pattern, argument, end) && (end == text.size() || text[end] == ':');
  };
  RecognisedMessage found;
  for (const ControlMessage& message : control_messages()) {
    bool is_known = is_text(message.text, found.argument);
    for (const auto& [other, usual] : kOtherSpellings) {
      is_known = is_known || (usual == message.text && is_text(other, found.argument));
    }
    if (!is_known) continue;
    found.message = &message;
    return found;
  }
  return std::nullopt;
}

}  // namespace dripline::interpreter::tnc155
