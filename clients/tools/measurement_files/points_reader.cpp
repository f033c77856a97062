#include <algorithm>
#include <charconv>
#include <cmath>

#include "clients/tools/measurement_files/points.hpp"

namespace dripline::measurement_files {
namespace {

/// Numbers of a line, separated by commas, semicolons, tabs or spaces; nothing if one of them is
/// none.
bool read_numbers(std::string_view line, std::vector<double>& numbers) {
  numbers.clear();
  constexpr std::string_view kBetween = ",; \t\r";
  while (true) {
    const auto begin = line.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) return true;
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(kBetween));
    double value = 0;
    const char* first = word.data() + (word.front() == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      return false;
    if (numbers.size() == 3) return false;
    numbers.push_back(value);
    line.remove_prefix(word.size());
  }
}

}  // namespace

Result<std::vector<DigitizedPoint>> read_points(std::string_view file) {
  std::vector<DigitizedPoint> points;
  std::vector<double> numbers;
  std::size_t line = 0;
  if (file.starts_with("\xEF\xBB\xBF")) file.remove_prefix(3);
  while (!file.empty()) {
    ++line;
    const auto end = std::min(file.find('\n'), file.size());
    const std::string_view text = file.substr(0, end);
    file.remove_prefix(std::min(file.size(), end + 1));
    const bool is_read = read_numbers(text, numbers);
    if (is_read && numbers.empty()) continue;
    if (!is_read && line == 1) continue;  // the names of the columns
    if (!is_read || numbers.size() < 2)
      return fail(Errc::Syntax, "line {}: two or three numbers are expected", line);
    if (points.size() == kMaxPoints) return fail(Errc::LimitExceeded, "over {} points", kMaxPoints);
    points.push_back({numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 0});
  }
  return points;
}

}  // namespace dripline::measurement_files
