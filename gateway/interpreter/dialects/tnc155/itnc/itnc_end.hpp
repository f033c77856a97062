#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/block_end.hpp"

namespace dripline::interpreter::tnc155 {

/// A block of a later control: a line, and those after a `~` at its end. A numbered CYCL DEF goes
/// on in lines of Q words without numbers, as the TNC 426 writes it. Lines of a comment or of the
/// structure (`* -`) are no blocks.
struct ItncEnd {
  bool* is_one_line;  ///< as for PlainEnd

  const char* operator()(const char* at, const char* limit) const {
    *is_one_line = false;
    const char* begin = skip(at, limit);
    if (begin == limit) return limit;
    for (const char* line = begin;;) {
      const char* end = find_line_end(line, limit);
      if (!end) return limit;
      const char* last = end;
      while (last != line && is_blank_or_control(last[-1])) --last;
      if (last == line || last[-1] != '~') {
        if (!is_numbered_cycle(begin, end)) {
          *is_one_line = line == at;
          return end;
        }
        const char* next = skip_blanks(end, limit);
        if (next == limit) return limit;
        if (*next != 'Q') return end;
      }
      line = end + 1;
    }
  }

  /// Past blanks, comments and lines of the structure.
  static const char* skip(const char* at, const char* limit) {
    for (;;) {
      const char* begin = skip_blanks(at, limit);
      const char* word = begin;
      while (word != limit && (is_decimal(*word) || *word == ' ')) ++word;
      if (word == limit || (*word != ';' && *word != '*')) return begin;
      at = end_of_comment(word, limit, is_decimal(*begin));
    }
  }

 private:
  /// A numbered comment continues in indented lines without numbers after a `~` at its end.
  static const char* end_of_comment(const char* at, const char* limit, bool is_numbered) {
    for (;;) {
      const char* end = find_line_end(at, limit);
      if (!end) return limit;
      const char* last = end;
      while (last != at && is_blank_or_control(last[-1])) --last;
      if (!is_numbered || last == at || last[-1] != '~') return end;
      const char* next = end + 1;
      if (next == limit) return limit;
      if (*next != ' ' && *next != '\t') return end;
      const char* word = skip_blanks(next, limit);
      if (word == limit) return limit;
      if (is_decimal(*word)) return end;
      at = next;
    }
  }

  static bool is_numbered_cycle(const char* at, const char* end) {
    if (!is_decimal(*at)) return false;
    while (at != end && (is_decimal(*at) || *at == ' ')) ++at;
    constexpr std::size_t kWord = 10;
    return static_cast<std::size_t>(end - at) > kWord && std::memcmp(at, "CYCL DEF 2", kWord) == 0;
  }
};

}  // namespace dripline::interpreter::tnc155
