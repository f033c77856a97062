#include "gateway/app/run/block_texts.hpp"

#include <algorithm>

#include "gateway/app/run/run_texts.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {
namespace {

/// Of text on each side of the block: more than the longest lines of programs have.
constexpr std::size_t kReach = 4096;
constexpr std::string_view kLineEnds = "\r\n";

/// Without blanks at its ends and without control characters, as a screen has it.
std::string shown(std::string_view line) {
  std::string text;
  for (const char c : line) {
    const auto code = static_cast<unsigned char>(c);
    const bool is_blank = c == '\t' || c == ' ';
    if (is_blank && !text.empty()) text += ' ';
    if (!is_blank && code > ' ' && code != 0x7F) text += c;
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return valid_text(text, dds::kMaxBlockText);
}

/// The text around a place, line by line.
class Lines {
 public:
  Lines(const feed::HeldText& held, std::uint64_t offset)
      : text_(held.text),
        begin_(offset - held.offset),
        end_(begin_),
        begins_program_(held.offset == 0),
        ends_program_(held.reaches_end) {
    while (begin_ > 0 && !is_line_end(text_[begin_ - 1])) --begin_;
    end_ = end_of(begin_);
  }

  std::string present() const { return shown(text_.substr(begin_, end_ - begin_)); }
  /// The line before that is not blank; empty: its begin is not held.
  std::string previous() const {
    std::size_t begin = begin_;
    while (begin > 0) {
      const std::size_t end = begin - 1;
      begin = text_.substr(0, end).find_last_of(kLineEnds) + 1;  // npos + 1 is 0
      if (begin == 0 && !begins_program_) return {};
      std::string line = shown(text_.substr(begin, end - begin));
      if (!line.empty()) return line;
    }
    return {};
  }
  /// Goes on to it; empty: its end is not held.
  std::string next() {
    while (end_ < text_.size()) {
      begin_ = end_ + 1;
      end_ = end_of(begin_);
      if (end_ == text_.size() && !ends_program_) return {};
      std::string line = present();
      if (!line.empty()) return line;
    }
    return {};
  }

 private:
  static bool is_line_end(char c) { return kLineEnds.find(c) != std::string_view::npos; }
  std::size_t end_of(std::size_t begin) const {
    return std::min(text_.find_first_of(kLineEnds, begin), text_.size());
  }

  std::string_view text_;
  std::size_t begin_, end_;             ///< of the present line
  bool begins_program_, ends_program_;  ///< the text does where the program does
};

}  // namespace

BlockTexts block_texts(const feed::ProgramFeed& feed, const interpreter::Origin& at) {
  const feed::HeldText held = feed.held_around(at.program, at.offset, kReach);
  BlockTexts texts;
  if (held.text.empty()) return texts;
  Lines lines(held, at.offset);
  const bool has_begun = at.block > 0;
  if (has_begun) {
    texts.block = lines.present();
    texts.previous = lines.previous();
  } else {
    texts.next = lines.present();
  }
  if (texts.next.empty()) texts.next = lines.next();
  texts.further = lines.next();
  return texts;
}

}  // namespace dripline::gateway
