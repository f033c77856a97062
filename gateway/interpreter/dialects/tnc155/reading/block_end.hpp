#pragma once

#include <cstdint>
#include <cstring>

/// Finds where a block of text ends. Both functors return a place in [at, limit) that ends the
/// block which begins at or after `at`, or `limit` when more text is needed.
namespace dripline::interpreter::tnc155 {

inline bool is_blank_or_control(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}
inline bool is_decimal(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}

inline const char* skip_blanks(const char* at, const char* limit) {
  while (at != limit && is_blank_or_control(*at)) ++at;
  return at;
}

/// The LF that ends the line, or its CR where no LF follows; null: not found yet.
inline const char* find_line_end(const char* at, const char* limit) {
  const auto size = static_cast<std::size_t>(limit - at);
  const auto* lf = static_cast<const char*>(std::memchr(at, '\n', size));
  // The CR of a CR LF does not end the line by itself.
  const char* after = lf ? (lf != at && lf[-1] == '\r' ? lf - 1 : lf) : limit;
  const auto* cr =
      static_cast<const char*>(std::memchr(at, '\r', static_cast<std::size_t>(after - at)));
  if (!cr) return lf;
  return cr + 1 == limit ? nullptr : cr;
}

/// Plain language: the end of a line after which a block begins: a line with a number, or, if the
/// block has none itself, one that is not indented. The block END PGM is complete at once.
struct PlainEnd {
  bool*
      is_one_line;  ///< set to true when the block is seen to be one line with no blanks before it

  const char* operator()(const char* at, const char* limit) const {
    *is_one_line = false;
    const char* begin = skip_blanks(at, limit);
    if (begin == limit) return limit;
    for (const char* line = begin;;) {
      const char* end = find_line_end(line, limit);
      if (!end) return limit;
      const char* next = end + 1;
      if (next != limit && is_decimal(*next)) {
        *is_one_line = line == at;
        return end;
      }
      if (is_frame(begin, end, "END", 3)) return end;
      next = skip_blanks(next, limit);
      if (next == limit) return limit;
      if (is_decimal(*next)) return end;
      const bool is_indented = next[-1] == ' ' || next[-1] == '\t';
      if (!is_decimal(*begin) && !is_indented) return end;
      if (*next == 'B' && static_cast<std::size_t>(limit - next) < 5) return limit;
      if (is_frame(next, limit, "BEGIN", 5)) return end;
      line = next;
    }
  }

 private:
  static bool is_frame(const char* at, const char* limit, const char* word, std::size_t length) {
    while (at != limit && (is_decimal(*at) || *at == ' ')) ++at;
    return static_cast<std::size_t>(limit - at) >= length && std::memcmp(at, word, length) == 0;
  }
};

/// ISO: its `*`, or the end of a line that the next one does not continue. A block with a % is
/// complete at once.
struct IsoEnd {
  bool has_continuation;
  bool* is_one_line;  ///< as above; blanks before it are ignored

  const char* operator()(const char* at, const char* limit) const {
    *is_one_line = false;
    const char* begin = skip(at, limit);
    if (begin == limit) return limit;
    for (const char* line = begin;;) {
      const char* end = find_line_end(line, limit);
      const auto* star = static_cast<const char*>(
          std::memchr(line, '*', static_cast<std::size_t>((end ? end : limit) - line)));
      if (star) {
        *is_one_line = line == begin;
        return star;
      }
      if (!end) return limit;
      const char* next = end + 1;
      if (next != limit && (*next == 'N' || *next == '%')) {
        *is_one_line = line == begin;
        return end;
      }
      if (std::memchr(begin, '%', static_cast<std::size_t>(end - begin))) return end;
      next = skip_blanks(next, limit);
      if (next == limit) return limit;
      if (*next == 'N' || *next == '%') return end;
      const bool is_indented = next[-1] == ' ' || next[-1] == '\t';
      if (*next != '*' && (!has_continuation || (*begin != 'N' && !is_indented))) return end;
      line = next;
    }
  }

  /// Blanks, and block ends without a block.
  static const char* skip(const char* at, const char* limit) {
    while (at != limit && (is_blank_or_control(*at) || *at == '*')) ++at;
    return at;
  }
};

}  // namespace dripline::interpreter::tnc155
