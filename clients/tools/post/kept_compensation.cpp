#include "clients/tools/post/kept_compensation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>

namespace dripline::post {
namespace {

/// mm for each number: of the largest one, 400, it is no step of any control.
constexpr double kMark = 1e-8;

/// The radius of a tool's definition: where its digits are.
struct RadiusWord {
  std::size_t begin = 0, size = 0;
  double value = 0;
  char point = '.';
};

/// R and its number after `from` in a line that defines a tool; size 0: there is none.
RadiusWord radius_word(std::string_view line, std::size_t from) {
  for (std::size_t at = line.find('R', from); at != std::string_view::npos;
       at = line.find('R', at + 1)) {
    RadiusWord word{.begin = at + 1};
    std::string digits;
    std::size_t end = at + 1;
    if (end < line.size() && (line[end] == '+' || line[end] == '-')) ++end;
    word.begin = end;
    for (; end < line.size(); ++end) {
      const char c = line[end];
      if (c == ',' || c == '.') word.point = c;
      if (c != ',' && c != '.' && (c < '0' || c > '9')) break;
      digits += c == ',' ? '.' : c;
    }
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), word.value);
    word.size = end - word.begin;
    if (word.size > 0 && read.ec == std::errc{}) return word;
  }
  return {};
}

void append_scaled(std::string& out, std::string_view line, const RadiusWord& word, double factor) {
  std::string number = fmt::format("{:.4f}", word.value * factor);
  number.erase(number.find_last_not_of('0') + 1);
  if (number.ends_with('.')) number.pop_back();
  std::ranges::replace(number, '.', word.point);
  out += line.substr(0, word.begin);
  out += number;
  out += line.substr(word.begin + word.size);
}

}  // namespace

KeptCompensation::State KeptCompensation::at(std::uint64_t block) const {
  const auto next = std::ranges::upper_bound(states, block, {}, &State::block);
  return next == states.begin() ? State{} : *std::prev(next);
}

interpreter::Setup scaled_radii(interpreter::Setup setup, double factor) {
  for (auto& tool : setup.tools) {
    tool.radius = Length::mm(tool.radius.mm() * factor);
    tool.radius_wear = Length::mm(tool.radius_wear.mm() * factor);
  }
  return setup;
}

interpreter::Setup marked_radii(interpreter::Setup setup) {
  for (auto& tool : setup.tools) {
    // One of 0 stays so: its offset may be that of a length, and of no radius beside it.
    const bool has_radius = tool.radius.mm() + tool.radius_wear.mm() != 0;
    tool.radius = Length::mm(has_radius ? tool.number * kMark : 0);
    tool.radius_wear = {};
  }
  return setup;
}

int number_of_mark(double radius) {
  constexpr double kMaxNumber = 1e5, kNoise = 1e-3;
  const double number = radius / kMark;
  const double whole = std::round(number);
  return whole > 0 && whole < kMaxNumber && std::fabs(number - whole) < kNoise
             ? static_cast<int>(whole)
             : 0;
}

std::string scaled_definitions(std::string_view text, double factor) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string_view line = text.substr(at, end - at);
    at = end;
    const std::size_t definition = std::min(line.find("TOOL DEF"), line.find("G99"));
    constexpr std::size_t kName = 8;
    const RadiusWord word =
        definition == std::string_view::npos
            ? RadiusWord{}
            : radius_word(line, definition + (line[definition] == 'T' ? kName : 3));
    if (word.size == 0) {
      out += line;
    } else {
      append_scaled(out, line, word, factor);
    }
  }
  return out;
}

}  // namespace dripline::post
