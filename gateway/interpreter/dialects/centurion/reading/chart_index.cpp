#include "gateway/interpreter/dialects/centurion/reading/chart_index.hpp"

#include <algorithm>

namespace dripline::interpreter::centurion {
namespace {

/// The line at `at`, which moves after its end.
std::string_view take_line(std::string_view text, std::size_t& at) {
  const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
  const std::string_view line = text.substr(at, end - at);
  at = end;
  if (at < text.size() && text[at] == '\r') ++at;
  if (at < text.size() && text[at] == '\n' && (at == end || text[at - 1] == '\r')) ++at;
  return line;
}

std::string without_blanks_after(std::string_view text) {
  const std::size_t last = text.find_last_not_of(" \t");
  return std::string(text.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

}  // namespace

std::vector<ChartLine> parse_chart_index(std::string_view text) {
  std::vector<ChartLine> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view line = take_line(text, at);
    const std::string_view name = line.substr(0, kChartFileName);
    const std::size_t first = name.find_first_not_of(' ');
    ChartLine entry;
    if (first != std::string_view::npos) entry.file = without_blanks_after(name.substr(first));
    if (line.size() > kChartFileName) {
      entry.text = without_blanks_after(line.substr(kChartFileName));
    }
    lines.push_back(std::move(entry));
  }
  return lines;
}

std::string_view first_chart_page(std::string_view text) {
  std::size_t at = 0;
  for (std::size_t line = 0; line < kChartLines && at < text.size(); ++line) take_line(text, at);
  return text.substr(0, at);
}

}  // namespace dripline::interpreter::centurion
