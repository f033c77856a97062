#include "gateway/interpreter/dialects/rs274ngc/reading/comments.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/memory/parameter_access.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// Of an expanded text: 252 characters of a line, each parameter at most 40.
constexpr std::size_t kMaxText = 2048;

/// Moves `at` after `word` and the comma (or other mark) that must follow it, blanks anywhere.
bool take_mark(const char*& at, const char* end, std::string_view word, bool allows_blanks) {
  const char* s = at;
  const auto skip = [&] {
    while (s != end && is_blank(*s)) ++s;
  };
  skip();
  for (const char w : word) {
    if (allows_blanks) skip();
    if (s == end || upper(*s) != w) return false;
    ++s;
  }
  at = s;
  return true;
}

/// How numbers are written after a %d, %f or %.3f.
struct TextFormat {
  int decimals = 6;
};

std::string_view trimmed(const char* begin, const char* end) {
  while (begin != end && is_blank(*begin)) ++begin;
  while (begin != end && is_blank(end[-1])) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

/// `%d`, `%f`, `%.nf` set the format of what follows; anything else stays text.
bool take_format(const char*& at, const char* end, TextFormat& format) {
  const char* s = at + 1;
  if (s == end) return false;
  if (*s == 'd') {
    format.decimals = 0;
  } else if (*s == 'f') {
    format.decimals = 4;
  } else if (*s == '.' && end - s >= 3 && is_digit(s[1]) && s[2] == 'f') {
    format.decimals = s[1] - '0';
    s += 2;
  } else {
    return false;
  }
  at = s + 1;
  return true;
}

std::optional<double> take_parameter(Run& run, const char*& at, const char* end) {
  ++at;  // #
  if (at != end && *at == '<') {
    std::string name;
    for (++at; at != end && *at != '>'; ++at) {
      if (is_blank(*at)) continue;
      const char c = *at;
      name += c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
    }
    if (at != end) ++at;
    return named_for_text(run, name);
  }
  int index = 0;
  const auto read = std::from_chars(at, end, index);
  if (read.ec != std::errc{}) return std::nullopt;
  at = read.ptr;
  return parameter_for_text(run, index);
}

/// Without the sign of a zero.
std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// Parameters replaced by their values.
std::string expanded(Run& run, const char* at, const char* end) {
  std::string text;
  TextFormat format;
  while (at != end && text.size() < kMaxText) {
    if (*at == '#') {
      const std::optional<double> value = take_parameter(run, at, end);
      text += value ? number_text(*value, format.decimals) : "######";
    } else if (*at != '%' || !take_format(at, end, format)) {
      text += *at++;
    }
  }
  return text;
}

enum class Mark : std::uint8_t {
  Debug,
  Print,
  LogOpen,
  LogAppend,
  LogClose,
  Log,
  Abort,
  ProbeOpen,
  ProbeClose,
  Python
};
struct MarkWord {
  std::string_view word;
  Mark mark;
};
/// Longer words before their beginnings.
constexpr std::array kMarks{
    MarkWord{"DEBUG,", Mark::Debug},          MarkWord{"PRINT,", Mark::Print},
    MarkWord{"LOGOPEN,", Mark::LogOpen},      MarkWord{"LOGAPPEND,", Mark::LogAppend},
    MarkWord{"LOGCLOSE", Mark::LogClose},     MarkWord{"LOG,", Mark::Log},
    MarkWord{"ABORT,", Mark::Abort},          MarkWord{"PROBEOPEN", Mark::ProbeOpen},
    MarkWord{"PROBECLOSE", Mark::ProbeClose}, MarkWord{"PY,", Mark::Python},
    MarkWord{"PYRUN,", Mark::Python},         MarkWord{"PYRELOAD", Mark::Python}};

bool execute_mark(Run& run, Mark mark, const char* at, const char* end) {
  EventSink& events = run.events();
  switch (mark) {
    case Mark::Debug:
      events.on_message({run.origin, expanded(run, at, end)});
      return true;
    case Mark::Print:
      events.on_output({run.origin, OutputDevice::Screen, expanded(run, at, end)});
      return true;
    case Mark::Log:
      events.on_output({run.origin, OutputDevice::File, expanded(run, at, end)});
      return true;
    case Mark::LogOpen:
    case Mark::LogAppend:
    case Mark::ProbeOpen:
      events.on_open({run.origin, OutputDevice::File, trimmed(at, end)});
      return true;
    case Mark::LogClose:
    case Mark::ProbeClose:
      events.on_close({run.origin, OutputDevice::File});
      return true;
    case Mark::Python:  // may set parameters, or refuse the program: what it does is not known here
      return run.fail(ErrorCode::NotSupported, 0, "Python in a comment");
    case Mark::Abort:
      break;
  }
  const std::string text = expanded(run, at, end);
  events.on_message({run.origin, text});
  return run.fail(ErrorCode::Abort, 0, text);
}

}  // namespace

bool is_message(const char* begin, const char* end) {
  return take_mark(begin, end, "MSG,", true);
}

bool execute_comment(Run& run) {
  const char* at = run.block.comment_begin;
  const char* end = run.block.comment_end;
  if (take_mark(at, end, "MSG,", !run.is_linuxcnc())) {
    run.events().on_message({run.origin, std::string_view(at, static_cast<std::size_t>(end - at))});
    return true;
  }
  if (!run.is_linuxcnc()) return true;
  for (const MarkWord& each : kMarks) {
    at = run.block.comment_begin;
    if (take_mark(at, end, each.word, false)) return execute_mark(run, each.mark, at, end);
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
