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
    const auto value = parse_finite(word.substr(word.front() == '+' ? 1 : 0));
    if (!value || numbers.size() == 3) return false;
    numbers.push_back(*value);
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
    const bool is_read = read_numbers(take_until(file, '\n'), numbers);
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
