#include "gateway/interpreter/dialects/centurion/reading/program_extraction.hpp"

#include <algorithm>
#include <string>

#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::size_t kMaxHead = 256;  ///< an O word is within this many bytes of its line

BlockHead head_of(std::string_view line) {
  std::string head(line.substr(0, kMaxHead));
  head += '\n';  // what read_head stops at
  return read_head(head.c_str());
}

bool is_blank_line(std::string_view line) {
  return std::all_of(line.begin(), line.end(),
                     [](char c) { return is_blank(c) || c == '%' || is_end_of_block(c); });
}

}  // namespace

bool ProgramSplitter::begins_next(std::string_view line) {
  const BlockHead head = head_of(line);
  if (head.kind != BlockHead::Kind::Program || head.number == 0) {
    has_blocks_ = has_blocks_ || head.kind != BlockHead::Kind::Empty;
    return false;
  }
  const bool is_next = number_ != 0 || has_blocks_;
  number_ = head.number;
  has_blocks_ = false;
  return is_next;
}

std::vector<ExtractedProgram> extract_programs(std::string_view text) {
  std::vector<ExtractedProgram> programs;
  ProgramSplitter splitter;
  std::size_t begin = 0;
  std::size_t last = 0;  ///< after the last line of the program in hand that is not blank
  const auto finish = [&](std::uint32_t number) {
    if (last > begin) programs.push_back({number, text.substr(begin, last - begin)});
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::size_t next = std::min(text.find_first_not_of("\r\n", end), text.size());
    const std::string_view line = text.substr(at, end - at);
    const std::uint32_t before = splitter.number();
    if (splitter.begins_next(line)) {
      finish(before);
      begin = at;
    }
    const bool is_empty = last <= begin;
    if (is_blank_line(line)) {
      if (is_empty) begin = last = next;
    } else {
      last = next;
    }
    at = next;
  }
  finish(splitter.number());
  return programs;
}

}  // namespace dripline::interpreter::centurion
