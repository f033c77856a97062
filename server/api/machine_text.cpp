#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "gateway/interpreter/position_rules.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/base/utf8.hpp"
#include "protocol/dds/members.hpp"
#include "protocol/dds/message.hpp"
#include "server/api/response.hpp"
#include "server/api/views.hpp"
#include "server/library/control_catalog.hpp"
#include "server/machines/machine_registry.hpp"

namespace dripline::api {
namespace {

constexpr std::string_view kAxes = "XYZABCUVW";

/// Appends JSON to a text: with thousands of statuses a second a tree of objects would cost more
/// than everything else that is done with them. Bytes that are not UTF-8 become U+FFFD.
class Writer {
 public:
  explicit Writer(std::string& text) : text_(text) {}

  void begin(char bracket) {
    text_ += bracket;
    is_first_ = true;
  }
  void end(char bracket) {
    text_ += bracket;
    is_first_ = false;
  }
  /// Of an element of a list; a member is separated by its name.
  void separate() {
    if (!std::exchange(is_first_, false)) text_ += ',';
  }
  /// Of a member of ours: a word without anything that would have to be escaped.
  void name(std::string_view name) {
    separate();
    text_ += '"';
    text_ += name;
    text_ += "\":";
  }
  template <class T>
  void member(std::string_view of, const T& what) {
    name(of);
    value(what);
  }

  void null() { text_ += "null"; }
  /// Written already.
  void json(std::string_view written) { text_ += written; }
  void value(bool is_true) { text_ += is_true ? "true" : "false"; }
  void value(std::string_view text) { text.empty() ? null() : quote(text); }
  void value(const std::string& text) { value(std::string_view(text)); }
  void value(const char* text) { quote(text); }
  void value(UtcTime time) { quote(to_iso8601(time)); }
  template <class T>
  requires(std::is_arithmetic_v<T> && !std::same_as<T, bool>) void value(T number) {
    if (std::is_floating_point_v<T> && !std::isfinite(static_cast<double>(number))) return null();
    char digits[32];  // the shortest text of a double has 24
    const auto end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
    const std::string_view written(digits, static_cast<std::size_t>(end - digits));
    text_ += written;
    // Readers that tell integers from other numbers must find the same kind every time.
    if (std::is_floating_point_v<T> && written.find_first_of(".e") == std::string_view::npos)
      text_ += ".0";
  }

 private:
  void quote(std::string_view text) {
    text_ += '"';
    while (!text.empty()) {
      const auto plain = std::find_if_not(text.begin(), text.end(), is_plain) - text.begin();
      text_ += text.substr(0, static_cast<std::size_t>(plain));
      text.remove_prefix(static_cast<std::size_t>(plain));
      if (!text.empty()) text.remove_prefix(put_character(text));
    }
    text_ += '"';
  }
  static bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }
  /// The first one; returns its length.
  std::size_t put_character(std::string_view text) {
    constexpr unsigned char kBlank = 0x20, kBeyondAscii = 0x80;
    const char c = text.front();
    const auto code = static_cast<unsigned char>(c);
    if (code >= kBeyondAscii) {
      const std::size_t length = utf8_length(text);
      text_ += length == 0 ? "\\ufffd" : text.substr(0, length);
      return std::max<std::size_t>(length, 1);
    }
    if (code < kBlank) {
      fmt::format_to(std::back_inserter(text_), "\\u{:04x}", static_cast<unsigned>(code));
      return 1;
    }
    if (c == '"' || c == '\\') text_ += '\\';
    text_ += c;
    return 1;
  }

  std::string& text_;
  bool is_first_ = true;
};

std::string_view letter(std::size_t axis) {
  return kAxes.substr(axis, 1);
}

/// By axis letter, for the axes whose bit is set; bit 0 is X.
template <std::size_t N>
void write_axes(Writer& out, unsigned axes, const std::array<double, N>& values) {
  out.begin('{');
  for (std::size_t i = 0; i < N; ++i) {
    if ((axes >> i & 1) != 0) out.member(letter(i), values[i]);
  }
  out.end('}');
}

/// Visits the members of a status and of what it contains, and writes them under their names.
class StatusWriter {
 public:
  StatusWriter(Writer& out, const dds::Status& status) : out_(out), status_(status) {}

  template <class T, class Field, class... Rules>
  void operator()(const dds::Member<T, Field>& member, const Rules&... rules) {
    if constexpr (!(std::same_as<Rules, dds::Internal> || ...)) {
      put(member.name, member.value, rules...);
    }
  }

 private:
  template <class T>
  void put(std::string_view name, const T& value, const auto&...) {
    constexpr std::string_view kClaim = "is_";
    if (name.starts_with(kClaim)) name.remove_prefix(kClaim.size());
    out_.name(name);
    show(value);
  }
  void put(std::string_view, bool is_inch, dds::InchOrMetric) {
    out_.member("units", is_inch ? "inch" : "mm");
  }
  void put(std::string_view name, std::int64_t number, dds::NoneIfNegative) {
    out_.name(name);
    number < 0 ? out_.null() : out_.value(number);
  }
  void put(std::string_view name, const std::optional<std::uint8_t>& axis, dds::AxisNumber) {
    out_.name(name);
    axis ? out_.value(letter(*axis)) : out_.null();
  }
  void put(std::string_view name, std::uint8_t axes, dds::MainAxisSet) {
    out_.name(name);
    out_.begin('[');
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
      if ((axes >> i & 1) == 0) continue;
      out_.separate();
      out_.value(letter(i));
    }
    out_.end(']');
  }

  template <class T>
  requires std::is_arithmetic_v<T>
  void show(T value) { out_.value(value); }
  void show(const std::string& text) { out_.value(text); }
  void show(UtcTime time) { out_.value(time); }
  void show(dds::Enumeration auto value) {
    const std::string_view word = dds::to_string(value);
    word == "unknown" ? out_.null() : out_.value(word);
  }
  template <std::size_t N>
  void show(const std::array<double, N>& values) {
    write_axes(out_, status_.axes, values);
  }
  template <class T>
  void show(const std::optional<T>& value) {
    value ? show(*value) : out_.null();
  }
  template <class T>
  requires std::is_class_v<T>
  void show(const T& message) {
    out_.begin('{');
    dds::members(*this, message);
    add(message);
    out_.end('}');
  }

  // What an object has besides its members.
  void add(const auto&) {}
  void add(const dds::ProgramFrame& frame) {
    out_.name("pole");
    frame.pole_axes != 0 ? write_axes(out_, frame.pole_axes, frame.pole) : out_.null();
  }
  void add(const dds::Coordinates& coordinates) {
    std::array<double, 9> distance{};
    for (std::size_t i = 0; i < distance.size(); ++i)
      distance[i] = coordinates.target[i] - status_.position[i];
    out_.name("distance_to_go");
    write_axes(out_, status_.axes, distance);
  }

  Writer& out_;
  const dds::Status& status_;
};

/// What the API shows of a gateway's status: the members of protocol/dds/members.hpp under their
/// names, and `distance_to_go`. Axes are objects by letter, absent values null, times ISO 8601 UTC.
void write_status(Writer& out, const dds::Status& status) {
  StatusWriter writer(out, status);
  out.begin('{');
  dds::members(writer, status);
  out.end('}');
}

/// What the control's own screen shows: the units that its settings choose, else those of the
/// program while one is there; on a lathe X as its programs have it, as a diameter; the modes that
/// it has.
void write_display(Writer& out, const machines::MachineView& view) {
  const auto dialect = interpreter::find_dialect(view.machine.control);
  if (!dialect) return out.null();
  const auto* status = view.status ? &*view.status : nullptr;
  const bool has_program = status != nullptr && !status->run.empty() && status->modes;
  bool is_inch = (*dialect)->units == interpreter::Units::Inch;
  if (has_program) is_inch = status->modes->is_inch;
  if (status != nullptr && status->screen) is_inch = status->screen->is_inch;
  const bool is_lathe = (*dialect)->machine == interpreter::MachineKind::Lathe;
  out.begin('{');
  out.member("units", is_inch ? "inch" : "mm");
  out.member("x", is_lathe ? "diameter" : "radius");
  out.name("fields");
  out.begin('[');
  for (const std::string_view field : (*dialect)->status_fields) {
    out.separate();
    out.value(field);
  }
  out.end(']');
  out.end('}');
}

/// Where a run can begin, and what can be decided about it. A control at the end of a line gets the
/// rest of the text; one of a gateway looks through the program, as far as it can.
void write_starts(Writer& out, const machines::MachineView& view) {
  static const library::StartSearch kOfALine{.at = {"block", "line", "byte", "tool"}};
  const bool has_line = view.has_serial_line();
  const auto& search = has_line ? kOfALine : library::start_search_of(view.machine.control);
  out.begin('{');
  out.name("at");
  out.begin('[');
  for (const auto place : search.at) {
    out.separate();
    out.value(place);
  }
  out.end(']');
  out.member("head", has_line);
  out.member("memory", search.has_memory);
  out.member("pass", search.has_pass);
  const auto dialect = interpreter::find_dialect(view.machine.control);
  out.member("mdi", has_line || !dialect ? std::size_t{0} : (*dialect)->mdi_blocks);
  out.end('}');
}

/// What its control's screen sets from the position. An older gateway does nothing of it.
void write_positions(Writer& out, const machines::MachineView& view) {
  static constexpr interpreter::PositionRules kNone{};
  const bool is_able = !view.has_serial_line() &&
                       view.commands > static_cast<std::uint32_t>(dds::CommandAction::Playback);
  const auto& rules = is_able ? interpreter::position_rules(view.machine.control) : kNone;
  out.begin('{');
  out.name("offsets");
  out.begin('[');
  for (const auto name : rules.offsets) {
    out.separate();
    out.value(name);
  }
  out.end(']');
  out.name("datum_axes");
  out.json(fmt::format("\"{}\"", rules.datum_axes));
  out.name("tool_axes");
  out.json(fmt::format("\"{}\"", rules.tool_axes));
  const auto dialect = interpreter::find_dialect(view.machine.control);
  out.member("x_diameter", dialect && (*dialect)->machine == interpreter::MachineKind::Lathe);
  out.member("zero_only", rules.is_zero_only);
  out.member("playback", rules.playback != nullptr);
  out.end('}');
}

void write_notices(Writer& out, const machines::MachineView& view) {
  out.begin('[');
  auto notices = machines::notices_of(view);
  if (auto lost = machines::switch_notice(view); !lost.empty()) notices.push_back(std::move(lost));
  for (const auto& notice : notices) {
    out.separate();
    out.value(notice);
  }
  out.end(']');
}

}  // namespace

std::string machine_text(const machines::MachineView& view) {
  constexpr std::size_t kUsual = 2048;
  std::string text;
  text.reserve(kUsual);
  Writer out(text);
  out.begin('{');
  out.member("name", view.machine.name);
  out.member("control", view.machine.control);
  out.member("description", view.machine.description);
  out.member("gateway_version", view.machine.gateway_version);
  out.member("connected", view.is_connected);
  out.member("stale", view.is_stale);
  out.member("unconfirmed_gateway", view.unconfirmed_gateway.value_or(""));
  out.name("clock_ahead_seconds");
  view.clock_ahead ? out.value(std::chrono::duration<double>(*view.clock_ahead).count())
                   : out.null();
  out.name("notices");
  write_notices(out, view);
  out.member("first_seen", view.machine.first_seen);
  out.member("last_seen", view.machine.last_seen);
  out.name("held");
  view.held ? out.json(to_text(hold_json(view.held))) : out.null();
  out.name("queue_hold");
  view.queue_hold ? out.json(to_text(hold_json(view.queue_hold))) : out.null();
  out.name("starts");
  write_starts(out, view);
  out.name("positions");
  write_positions(out, view);
  out.name("display");
  write_display(out, view);
  out.name("status");
  view.status ? write_status(out, *view.status) : out.null();
  out.end('}');
  return text;
}

nlohmann::json machine_json(const machines::MachineView& view) {
  return nlohmann::json::parse(machine_text(view));
}

}  // namespace dripline::api
