#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::interpreter::centurion {

/// A line of the control's file charts.dat, the index of its help pages: the first 12 characters
/// name the file after it (none where they are blank) and are not displayed, the rest is text.
struct ChartLine {
  std::string file;
  std::string text;
};

inline constexpr std::size_t kChartLines =
    16;  ///< as many are displayed, of the index and of a page
inline constexpr std::size_t kChartFileName = 12;

/// Lines end in CR, LF or both. Pure; any thread.
std::vector<ChartLine> parse_chart_index(std::string_view text);

/// The first 16 lines of a page.
std::string_view first_chart_page(std::string_view text);

}  // namespace dripline::interpreter::centurion
