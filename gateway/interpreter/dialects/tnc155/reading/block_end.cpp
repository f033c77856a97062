#include "gateway/interpreter/dialects/tnc155/reading/block_end.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool has_g_code(std::string_view line) {
  for (std::size_t at = line.find('G'); at != std::string_view::npos; at = line.find('G', at + 1)) {
    std::size_t after = at + 1;
    while (after < line.size() && is_blank_or_control(line[after])) ++after;
    if (after < line.size() && is_decimal(line[after])) return true;
  }
  return false;
}

/// The first line without blanks in front.
std::string_view first_line(std::string_view head) {
  const char* limit = head.data() + head.size();
  const char* begin = skip_blanks(head.data(), limit);
  const char* end = begin;
  while (end != limit && *end != '\n' && *end != '\r') ++end;
  return {begin, end};
}

}  // namespace

Form detect_form(std::string_view head) {
  std::string_view line = first_line(head);
  if (line.empty()) return Form::Unknown;
  if (line.front() == '%' || line.front() == 'N') return Form::Iso;
  std::size_t at = 0;
  while (at < line.size() && (is_decimal(line[at]) || is_blank_or_control(line[at]))) ++at;
  const bool has_number = at > 0;
  line.remove_prefix(at);
  if (line.empty()) return Form::Unknown;
  if (has_number || line.front() == '*') return Form::Plain;
  if (has_g_code(line)) return Form::Iso;
  for (const std::string_view word : {"BEGIN", "END", "TOOL", "TCH", "STOP", "RND", "FN", "DEF",
                                      "BLK", "LBL", "LP", "CALL", "CYCL", "CC", "CP", "CT"}) {
    if (line.starts_with(word)) return Form::Plain;
  }
  if (line.substr(0, line.find_last_not_of(' ') + 1).ends_with('*')) return Form::Iso;
  std::size_t next = 1;
  while (next < line.size() && is_blank_or_control(line[next])) ++next;
  const char second = next < line.size() ? line[next] : '\0';
  const char first = line.front();
  if (first == 'L') {  // L15.8 calls a label, a length has a comma or a sign
    while (next < line.size() && is_decimal(line[next])) ++next;
    const bool is_label = is_decimal(second) && (next == line.size() || line[next] != ',');
    return is_label ? Form::Iso : Form::Plain;
  }
  if (first == 'I')
    return is_decimal(second) || second == '+' || second == '-' ? Form::Iso : Form::Plain;
  if (std::string_view("XYZABCUVW").find(first) != std::string_view::npos) return Form::Plain;
  const bool is_iso = std::string_view("DTSMFHRJK").find(first) != std::string_view::npos;
  return is_iso ? Form::Iso : Form::Unknown;
}

}  // namespace dripline::interpreter::tnc155
