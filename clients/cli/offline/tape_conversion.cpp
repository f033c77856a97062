#include "clients/cli/offline/tape_conversion.hpp"

namespace dripline::cli {

Result<void> CommentFilter::filter(std::string_view text, std::string& left) {
  for (const char c : text) {
    if (c == '(' && !is_inside_) {
      is_inside_ = true;
      ++count_;
    } else if (c == ')') {
      if (!is_inside_) return fail(Errc::Syntax, "line {}: ')' without '('", line_);
      is_inside_ = false;
    } else if (c == '\n' && is_inside_) {
      return fail(Errc::Syntax, "line {}: a comment without ')'", line_);
    } else if (!is_inside_) {
      left += c;
    }
    if (c == '\n') ++line_;
  }
  return {};
}

TapeConversion::TapeConversion(Parts parts, Write write)
    : reader_(parts.from),
      punch_(std::move(parts.to)),
      drops_comments_(parts.drops_comments),
      write_(std::move(write)) {}

Result<void> TapeConversion::begin() {
  if (auto begun = punch_.begin(rows_); !begun) return begun;
  return write_rows();
}

Result<void> TapeConversion::convert(std::span<const std::byte> rows) {
  if (auto read = reader_.read(rows, text_); !read) return read;
  return punch_text();
}

Result<void> TapeConversion::finish() {
  if (auto read = reader_.finish(text_); !read) return read;
  if (auto punched = punch_text(); !punched) return punched;
  punch_.finish(rows_);
  return write_rows();
}

Result<void> TapeConversion::punch_text() {
  kept_.clear();
  if (drops_comments_) {
    if (auto kept = comments_.filter(text_, kept_); !kept) return kept;
  } else {
    kept_.swap(text_);
  }
  text_.clear();
  if (auto punched = punch_.punch(kept_, rows_); !punched) return punched;
  return write_rows();
}

Result<void> TapeConversion::write_rows() {
  auto written = write_({reinterpret_cast<const char*>(rows_.data()), rows_.size()});
  rows_.clear();
  return written;
}

}  // namespace dripline::cli
