#include "clients/tools/report_template/impl/kept_line.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace dripline::report_template {
namespace {

constexpr std::size_t kMaxKeptLine = 160;

}  // namespace

std::string kept_line(std::string_view line) {
  std::string text;
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  bool is_whole = true, is_after_blank = false;
  for (const char c : line) {
    const bool is_blank = c == ' ' || c == '\t';
    if (is_blank && is_after_blank) continue;
    is_after_blank = is_blank;
    const char one = is_blank ? ' ' : c;
    hash = (hash ^ static_cast<unsigned char>(one)) * 1099511628211u;
    const bool is_plain = one >= ' ' && one <= '~';
    is_whole = is_whole && is_plain && text.size() < kMaxKeptLine;
    if (text.size() < kMaxKeptLine) text += is_plain ? one : '?';
  }
  return is_whole ? text : fmt::format("{} (#{:016x})", text, hash);
}

}  // namespace dripline::report_template
