#include "gateway/machine/grbl/reply.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace dripline::machine::grbl {
namespace {

constexpr std::array<std::pair<std::string_view, BoardState>, 10> kStates{{
    {"Idle", BoardState::Idle},
    {"Run", BoardState::Run},
    {"Hold", BoardState::Hold},
    {"Jog", BoardState::Jog},
    {"Alarm", BoardState::Alarm},
    {"Door", BoardState::Door},
    {"Check", BoardState::Check},
    {"Home", BoardState::Home},
    {"Sleep", BoardState::Sleep},
    {"Tool", BoardState::Tool},
}};

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

/// Decimal, finite, and of a size that a machine can have.
std::optional<double> real_of(std::string_view text) {
  constexpr double kMax = 1e9;
  const auto value = number_of<double>(text);
  if (!value || !(std::fabs(*value) <= kMax)) return std::nullopt;
  return value;
}

/// Cuts `text` before the first `mark`; the rest stays after it.
std::string_view cut(std::string_view& text, char mark) {
  const std::size_t at = text.find(mark);
  const std::string_view head = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return head;
}

std::optional<AxisValues> axes_of(std::string_view text) {
  AxisValues values;
  while (!text.empty()) {
    const auto value = real_of(cut(text, ','));
    if (!value) return std::nullopt;
    // Axes beyond those we know (U, V) are there, but no program moves them.
    if (values.count < kMaxAxes) values.value[values.count++] = *value;
  }
  if (values.count == 0) return std::nullopt;
  return values;
}

template <std::size_t kCount>
std::optional<std::array<int, kCount>> integers_of(std::string_view text) {
  std::array<int, kCount> values{};
  for (int& value : values) {
    const auto parsed = number_of<int>(cut(text, ','));
    if (!parsed || *parsed < 0) return std::nullopt;
    value = *parsed;
  }
  return values;
}

bool read_state(std::string_view text, StatusReport& report) {
  const std::string_view name = cut(text, ':');
  const auto* found =
      std::ranges::find(kStates, name, &std::pair<std::string_view, BoardState>::first);
  if (found == kStates.end()) return false;
  report.state = found->second;
  if (text.empty()) return true;
  report.substate = number_of<int>(text);
  return report.substate.has_value();
}

bool read_speeds(std::string_view text, StatusReport& report) {
  report.feed = real_of(cut(text, ','));
  if (!report.feed) return false;
  if (text.empty()) return true;
  report.spindle = real_of(cut(text, ','));  // grblHAL adds the actual speed: not used
  return report.spindle.has_value();
}

bool read_member(std::string_view name, std::string_view text, StatusReport& report) {
  if (name == "MPos") return (report.machine_position = axes_of(text)).has_value();
  if (name == "WPos") return (report.work_position = axes_of(text)).has_value();
  if (name == "WCO") return (report.work_offset = axes_of(text)).has_value();
  if (name == "Ln") return (report.line = number_of<std::uint32_t>(text)).has_value();
  if (name == "F" || name == "FS") return read_speeds(text, report);
  if (name == "Pn") {
    report.pins = text;
    return true;
  }
  if (name == "Bf") {
    const auto values = integers_of<2>(text);
    if (values) report.buffers = {(*values)[0], (*values)[1]};
    return values.has_value();
  }
  if (name == "Ov") {
    const auto values = integers_of<3>(text);
    if (values) report.overrides = {(*values)[0], (*values)[1], (*values)[2]};
    return values.has_value();
  }
  return true;  // accessories and what later firmware adds
}

Reply parse_status(std::string_view text) {
  StatusReport report;
  if (!read_state(cut(text, '|'), report)) return GarbageReply{};
  while (!text.empty()) {
    std::string_view member = cut(text, '|');
    const std::string_view name = cut(member, ':');
    if (!read_member(name, member, report)) return GarbageReply{};
  }
  return report;
}

Reply parse_build(std::string_view text) {
  BuildReply build;
  build.letters = cut(text, ',');
  const auto sizes = integers_of<2>(text);
  if (!sizes) return GarbageReply{};
  build.blocks = (*sizes)[0];
  build.bytes = (*sizes)[1];
  return build;
}

Reply parse_axes(std::string_view text) {
  const auto count = number_of<std::size_t>(cut(text, ':'));
  if (!count || *count != text.size()) return GarbageReply{};
  return AxesReply{std::string(text)};
}

Reply parse_probe(std::string_view text) {
  const auto at = axes_of(cut(text, ':'));
  if (!at || (text != "0" && text != "1")) return GarbageReply{};
  return ProbeReply{*at, text == "1"};
}

Reply parse_modes(std::string_view text) {
  ModesReply modes;
  while (!text.empty()) {
    const std::string_view word = cut(text, ' ');
    if (!word.empty()) modes.words.emplace_back(word);
  }
  return modes;
}

bool is_offset(std::string_view name) {
  return name == "G92" || name == "TLO" || name == "G28" || name == "G30" ||
         (name.size() >= 3 && name.starts_with("G5"));
}

Reply parse_bracket(std::string_view text) {
  const std::string_view name = cut(text, ':');
  if (name == "OPT") return parse_build(text);
  if (name == "AXS") return parse_axes(text);
  if (name == "PRB") return parse_probe(text);
  if (name == "GC") return parse_modes(text);
  if (name == "MSG") return NoticeReply{std::string(text)};
  if (is_offset(name)) {
    const auto value = axes_of(text);
    if (!value) return GarbageReply{};
    return OffsetReply{std::string(name), *value};
  }
  return UnusedReply{};
}

Reply parse_setting(std::string_view text) {
  const std::string_view name = cut(text, '=');
  const auto number = number_of<int>(name);
  if (!number || *number < 0) return UnusedReply{};  // $N0= holds a startup line
  const auto value = real_of(text);
  if (!value) return UnusedReply{};  // grblHAL has settings that are texts
  return SettingReply{*number, *value};
}

template <class Kind>
Reply parse_code(std::string_view text) {
  const auto code = number_of<int>(text);
  if (!code || *code < 0) return GarbageReply{};
  return Kind{*code};
}

/// "Grbl 1.1f ['$' for help]", "GrblHAL 1.1f [...]"
Reply parse_greeting(std::string_view text) {
  const std::string_view name = cut(text, ' ');
  return Greeting{std::string(cut(text, ' ')), name != "Grbl"};
}

}  // namespace

bool StatusReport::rests() const {
  switch (state) {
    case BoardState::Run:
    case BoardState::Jog:
    case BoardState::Home:
      return false;
    case BoardState::Hold:
      return substate.value_or(0) == 0;
    case BoardState::Door:  // 2: braking, 3: leaving
      return substate.value_or(0) < 2;
    default:
      return true;
  }
}

/// 3, and grblHAL's 4: the spindle comes up.
bool StatusReport::leaves_door() const {
  return state == BoardState::Door && substate.value_or(0) > 2;
}

std::string_view to_string(BoardState state) {
  return std::ranges::find(kStates, state, &std::pair<std::string_view, BoardState>::second)->first;
}

namespace {

Reply parse_line(std::string_view line) {
  constexpr std::string_view kError = "error:", kAlarm = "ALARM:";
  if (line.empty()) return UnusedReply{};
  if (line == "ok") return OkReply{};
  if (line.starts_with(kError)) return parse_code<ErrorReply>(line.substr(kError.size()));
  if (line.starts_with(kAlarm)) return parse_code<AlarmReply>(line.substr(kAlarm.size()));
  if (line.starts_with("Grbl ") || line.starts_with("GrblHAL ")) return parse_greeting(line);
  if (line.front() == '<' && line.back() == '>')
    return parse_status(line.substr(1, line.size() - 2));
  if (line.front() == '[' && line.back() == ']' && line.size() > 1)
    return parse_bracket(line.substr(1, line.size() - 2));
  if (line.front() == '$') return parse_setting(line.substr(1));
  if (line.front() == '>') return UnusedReply{};  // a startup line and its answer
  return GarbageReply{};
}

}  // namespace

Reply parse_reply(std::string_view line) {
  constexpr std::size_t kShown = 80;
  Reply reply = parse_line(line);
  if (auto* garbage = std::get_if<GarbageReply>(&reply)) garbage->text = line.substr(0, kShown);
  return reply;
}

std::vector<std::string> LineSplitter::feed(std::span<const std::byte> bytes) {
  std::vector<std::string> lines;
  for (const std::byte byte : bytes) {
    const char c = static_cast<char>(byte);
    if (c == '\r') continue;
    if (c != '\n') {
      if (line_.size() < kMaxLine)
        line_ += c;
      else
        is_too_long_ = true;
      continue;
    }
    if (is_too_long_) line_.front() = '\0';  // garbage, whatever it began with
    is_too_long_ = false;
    lines.push_back(std::exchange(line_, {}));
  }
  return lines;
}

}  // namespace dripline::machine::grbl
