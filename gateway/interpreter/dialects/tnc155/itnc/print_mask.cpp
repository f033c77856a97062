#include "gateway/interpreter/dialects/tnc155/itnc/print_mask.hpp"

#include <fmt/format.h>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_words.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr int kWidest = 80;    ///< of a value
constexpr int kDecimals = 9;   ///< of a value, at most
constexpr double kMost = 1e9;  ///< what a Q parameter holds

struct TimePart {
  std::string_view word;
  int (*of)(const LocalTime&);
};
constexpr std::array kTimeParts{
    TimePart{"DAY", [](const LocalTime& now) { return now.day; }},
    TimePart{"MONTH", [](const LocalTime& now) { return now.month; }},
    TimePart{"YEAR2", [](const LocalTime& now) { return now.year % 100; }},
    TimePart{"YEAR4", [](const LocalTime& now) { return now.year; }},
    TimePart{"HOUR", [](const LocalTime& now) { return now.hour; }},
    TimePart{"MIN", [](const LocalTime& now) { return now.minute; }},
    TimePart{"SEC", [](const LocalTime& now) { return now.second; }},
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// %9.3LF, %5.2F, %2d, %I.
struct Field {
  int width = 0;
  int decimals = -1;
  bool is_whole = false;
};

class Printer {
 public:
  Printer(std::string_view mask, std::span<const double> parameters,
          const std::optional<LocalTime>& now)
      : rest_(mask), parameters_(parameters), now_(now) {}

  Result<PrintedMask> print() {
    while (skip_blanks(), !rest_.empty()) {
      if (rest_.front() == '*') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
        continue;
      }
      if (auto done = rest_.front() == '"' ? print_text() : take_keyword(); !done) {
        return tl::make_unexpected(done.error());
      }
    }
    return std::move(printed_);
  }

 private:
  template <class... Values>
  auto wrong(Errc code, fmt::format_string<Values...> text, Values&&... values) const {
    return fail(code, "line {} of the mask: {}", line_,
                fmt::format(text, std::forward<Values>(values)...));
  }

  void skip_blanks() {
    while (!rest_.empty() && static_cast<unsigned char>(rest_.front()) <= ' ') {
      line_ += rest_.front() == '\n' ? 1 : 0;
      rest_.remove_prefix(1);
    }
  }

  /// Up to what ends a word.
  std::string_view word() {
    skip_blanks();
    std::size_t size = 0;
    while (size < rest_.size() && (rest_[size] == '_' || is_digit(rest_[size]) ||
                                   (rest_[size] >= 'A' && rest_[size] <= 'Z'))) {
      ++size;
    }
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  bool take(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  Result<void> take_keyword() {
    const std::string_view keyword = word();
    if (keyword.empty()) return wrong(Errc::Syntax, "'{}' is not expected", rest_.front());
    if (keyword != "M_CLOSE") return wrong(Errc::Unsupported, "{} is not known here", keyword);
    take(';');
    return {};
  }

  Result<void> print_text() {
    const std::size_t end = rest_.find('"', 1);
    if (end == std::string_view::npos || rest_.substr(0, end).find('\n') != std::string_view::npos)
      return wrong(Errc::Syntax, "the text has no closing \"");
    const std::string_view format = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    std::string line;
    for (std::size_t at = 0; at < format.size();) {
      if (format[at] != '%') {
        line += format[at++];
      } else if (format.substr(at).starts_with("%%")) {
        line += '%';
        at += 2;
      } else if (auto done = print_value(format, at, line); !done) {
        return done;
      }
    }
    if (!take(';')) return wrong(Errc::Syntax, "more values than the text has places for, or no ;");
    printed_.lines.push_back(std::move(line));
    return {};
  }

  Result<void> print_value(std::string_view format, std::size_t& at, std::string& line) {
    const auto field = read_field(format, at);
    if (!field) return tl::make_unexpected(field.error());
    if (!take(',')) return wrong(Errc::Syntax, "the text has more places than values");
    const auto value = read_value();
    if (!value) return tl::make_unexpected(value.error());
    if (field->is_whole) {
      line += fmt::format("{:{}}", static_cast<std::int64_t>(std::llround(*value)), field->width);
    } else {
      line +=
          fmt::format("{:{}.{}f}", *value, field->width, field->decimals < 0 ? 6 : field->decimals);
    }
    return {};
  }

  Result<Field> read_field(std::string_view format, std::size_t& at) const {
    const std::size_t start = at++;
    const auto number = [&](int most) {
      int value = 0;
      while (at < format.size() && is_digit(format[at]) && value <= most)
        value = 10 * value + (format[at++] - '0');
      return value;
    };
    Field field;
    field.width = number(kWidest);
    if (at < format.size() && format[at] == '.') {
      ++at;
      field.decimals = number(kDecimals);
    }
    for (const std::string_view kind : {"LF", "F", "lf", "f", "d", "D", "I", "i"}) {
      if (!format.substr(at).starts_with(kind)) continue;
      at += kind.size();
      field.is_whole = kind.size() == 1 && std::string_view("dDIi").find(kind[0]) != kind.npos;
      const bool fits = field.width <= kWidest && field.decimals <= kDecimals &&
                        !(field.is_whole && field.decimals >= 0);
      if (fits) return field;
      break;
    }
    return wrong(Errc::Unsupported, "{} is no format known here", format.substr(start, 8));
  }

  Result<double> read_value() {
    const std::string_view name = word();
    for (const TimePart& part : kTimeParts) {
      if (part.word != name) continue;
      printed_.needs_time |= !now_;
      return now_ ? part.of(*now_) : 0;
    }
    std::int32_t parameter = -1;
    const char* const end = name.data() + name.size();
    const bool is_q = name.size() > 1 && name.front() == 'Q' && is_digit(name[1]);
    if (is_q) {
      const auto read = std::from_chars(name.data() + 1, end, parameter);
      if (read.ec != std::errc{} || read.ptr != end) parameter = -1;
    }
    const bool is_known = parameter >= 0 &&
                          static_cast<std::size_t>(parameter) < parameters_.size() &&
                          !is_of_control(parameter);
    if (!is_known) return wrong(Errc::Unsupported, "{} is no value known here", name);
    const double value = parameters_[static_cast<std::size_t>(parameter)];
    if (!(std::fabs(value) <= kMost)) return wrong(Errc::Unsupported, "Q{} = {}", parameter, value);
    return value;
  }

  std::string_view rest_;
  std::span<const double> parameters_;
  const std::optional<LocalTime>& now_;
  int line_ = 1;
  PrintedMask printed_;
};

}  // namespace

Result<PrintedMask> print_mask(std::string_view mask, std::span<const double> parameters,
                               const std::optional<LocalTime>& now) {
  return Printer(mask, parameters, now).print();
}

}  // namespace dripline::interpreter::tnc155::itnc
