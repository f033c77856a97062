#include "gateway/interpreter/centurion/program_extraction.hpp"

#include <algorithm>
#include <string>

#include "gateway/interpreter/centurion/characters.hpp"
#include "gateway/interpreter/centurion/text_search.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::size_t kLongestHead = 256;  ///< an O word stands within this much of its line

/// The number of the line's O word, or 0.
std::uint32_t program_number(std::string_view line) {
  std::string head(line.substr(0, kLongestHead));
  head += '\n';  // what read_head stops at
  const BlockHead found = read_head(head.c_str());
  return found.kind == BlockHead::Kind::Program ? found.number : 0;
}

bool is_blank_line(std::string_view line) {
  return std::all_of(line.begin(), line.end(),
                     [](char c) { return is_blank(c) || c == '%' || is_end_of_block(c); });
}

}  // namespace

std::vector<ExtractedProgram> extract_programs(std::string_view text) {
  std::vector<ExtractedProgram> programs;
  std::size_t begin = 0;
  std::size_t last = 0;  ///< behind the last line of the program in hand that is not blank
  std::uint32_t number = 0;
  const auto finish = [&] {
    if (last > begin) programs.push_back({number, text.substr(begin, last - begin)});
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::size_t next = std::min(text.find_first_not_of("\r\n", end), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (const std::uint32_t found = program_number(line); found != 0) {
      finish();
      begin = at;
      number = found;
    }
    if (!is_blank_line(line)) last = next;
    at = next;
  }
  finish();
  return programs;
}

}  // namespace dripline::interpreter::centurion
