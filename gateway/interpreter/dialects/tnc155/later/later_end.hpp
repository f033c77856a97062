#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/block_end.hpp"

namespace dripline::interpreter::tnc155 {

/// A block of a later control: a line, and those after a `~` at its end. A numbered CYCL DEF goes
/// on in lines of Q words without numbers, as the TNC 426 writes it. Lines of a comment or of the
/// structure (`* -`) are no blocks.
struct LaterEnd {
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
      while (word != limit && *word != '\n' && *word != '\r') ++word;
      at = word;
    }
  }

 private:
  static bool is_numbered_cycle(const char* at, const char* end) {
    if (!is_decimal(*at)) return false;
    while (at != end && (is_decimal(*at) || *at == ' ')) ++at;
    constexpr std::size_t kWord = 10;
    return static_cast<std::size_t>(end - at) > kWord && std::memcmp(at, "CYCL DEF 2", kWord) == 0;
  }
};

}  // namespace dripline::interpreter::tnc155
