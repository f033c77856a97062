#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"

#include <cmath>
#include <optional>

#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// After the comment or output text that begins at `at`.
const char* skip_to(const char* at, char close) {
  while (*at != close && !is_end_of_block(*at)) ++at;
  return *at == close ? at + 1 : at;
}

/// Output text ends with the first bracket that does not close a format.
const char* skip_output_text(const char* at) {
  at = skip_blanks(at);
  if (*at != '[') return at;
  for (++at; *at != ']' && !is_end_of_block(*at);) {
    if (*at++ != '#') continue;
    while (is_digit(*at)) ++at;
    if (*at == '[') at = skip_to(at, ']');
  }
  return *at == ']' ? at + 1 : at;
}

TextPosition place_at(TextPosition base, std::uint64_t offset, std::uint64_t line) {
  base.after_cr = false;
  base.code_seen = true;
  base.offset = offset;
  base.line = line;
  return base;
}

TextPosition program_at(std::uint64_t offset, std::uint64_t line) {
  TextPosition position;
  position.segment_offset = position.offset = offset;
  position.segment_line = position.line = line;
  return position;
}

bool same_place(const TextPosition& a, const TextPosition& b) {
  return a.program == b.program && a.offset == b.offset && a.line == b.line;
}

}  // namespace

BlockHead read_head(const char* begin) {
  const char* at = begin;
  for (;;) {
    at = skip_blanks(at);
    if (*at != '(') break;
    at = skip_to(at, ')');
  }
  if (*at == '%') {
    const char* after = skip_blanks(at + 1);
    if (is_end_of_block(*after)) return {};
  }
  if (is_end_of_block(*at)) return {};
  if (*at == '/') at = skip_blanks(at + 1);
  const char first = kind_of(*at) == CharKind::Letter ? upper(*at) : *at;
  if (first != 'N' && first != 'O') return {BlockHead::Kind::Other, 0};
  at = skip_blanks(at + 1);
  if (!is_digit(*at)) return {BlockHead::Kind::Other, 0};
  const Number number = read_number(at);
  if (number.fault != NumberFault::None || number.value != std::trunc(number.value) ||
      number.value > 99999) {
    return {BlockHead::Kind::Other, 0};
  }
  return {first == 'N' ? BlockHead::Kind::Label : BlockHead::Kind::Program,
          static_cast<std::uint32_t>(number.value)};
}

bool count_loops(const char* begin, int& depth) {
  for (const char* at = begin; !is_end_of_block(*at);) {
    const bool is_letter = kind_of(*at) == CharKind::Letter;
    if (*at == '(') {
      at = skip_to(at, ')');
    } else if (is_letter && upper(*at) == 'W') {
      if (take_word(at, "WHILE")) {
        ++depth;
      } else if (take_word(at, "WEND")) {
        if (--depth == 0) return true;
      } else {
        ++at;
      }
    } else if (is_letter && (take_word(at, "PRINT") || take_word(at, "DPRNT"))) {
      at = skip_output_text(at);
    } else {
      ++at;
    }
  }
  return false;
}

namespace {

constexpr std::uint32_t kComputed = ~0u;

/// The label of the first GOTO in the block, kComputed where it is an expression.
std::optional<std::uint32_t> goto_target(const char* begin) {
  for (const char* at = begin; !is_end_of_block(*at);) {
    const bool is_letter = kind_of(*at) == CharKind::Letter;
    if (*at == '(') {
      at = skip_to(at, ')');
    } else if (is_letter && upper(*at) == 'G' && take_word(at, "GOTO")) {
      at = skip_blanks(at);
      if (!is_digit(*at)) return kComputed;
      const Number number = read_number(at);
      const char* after = skip_blanks(at);
      const bool is_alone = is_end_of_block(*after) || *after == '(';
      if (number.fault != NumberFault::None || !is_alone) return kComputed;
      return static_cast<std::uint32_t>(number.value);
    } else if (is_letter && (take_word(at, "PRINT") || take_word(at, "DPRNT"))) {
      at = skip_output_text(at);
    } else {
      ++at;
    }
  }
  return std::nullopt;
}

}  // namespace

TextSearch::LabelIndex& TextSearch::index_of(const TextPosition& from) {
  LabelIndex* oldest = &indexes_[0];
  for (LabelIndex& index : indexes_) {
    if (index.is_used && index.next.program == from.program &&
        index.next.segment_offset == from.segment_offset) {
      index.last_use = ++uses_;
      return index;
    }
    if (index.last_use < oldest->last_use) oldest = &index;
  }
  *oldest = LabelIndex{};
  oldest->is_used = true;
  oldest->last_use = ++uses_;
  oldest->next.program = from.program;
  oldest->next.segment_offset = oldest->next.offset = from.segment_offset;
  oldest->next.segment_line = oldest->next.line = from.segment_line;
  return *oldest;
}

TextSearch::Outcome TextSearch::find_label(const TextPosition& from, std::uint32_t label,
                                           TextPosition& found) {
  LabelIndex& index = index_of(from);
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    if (const auto place = index.places.find(label); place != index.places.end()) {
      found = place_at(index.next, place->second.offset, place->second.line);
      return Outcome::Found;
    }
    if (index.is_complete) return Outcome::Missing;
    const Outcome loaded = load(index.next);
    if (loaded == Outcome::Missing) index.is_complete = true;
    if (loaded == Outcome::Missing) continue;
    if (loaded != Outcome::Found) return loaded;
    const BlockHead head = read_head(cursor_.begin());
    if (head.kind == BlockHead::Kind::Program && index.next.code_seen) {
      index.is_complete = true;
      continue;
    }
    if (head.kind == BlockHead::Kind::Label) {
      index.places.try_emplace(head.number, Place{cursor_.offset(), index.next.line});
    }
    if (head.kind != BlockHead::Kind::Empty) index.next.code_seen = true;
    cursor_.advance(index.next);
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_program(std::uint32_t number, TextPosition& found) {
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    if (const auto place = programs_.find(number); place != programs_.end()) {
      found = program_at(place->second.offset, place->second.line);
      return Outcome::Found;
    }
    if (programs_complete_) return Outcome::Missing;
    const Outcome loaded = load(programs_next_);
    if (loaded == Outcome::Missing) programs_complete_ = true;
    if (loaded == Outcome::Missing) continue;
    if (loaded != Outcome::Found) return loaded;
    const BlockHead head = read_head(cursor_.begin());
    if (head.kind == BlockHead::Kind::Program) {
      programs_.try_emplace(head.number, Place{cursor_.offset(), programs_next_.line});
    }
    cursor_.advance(programs_next_);
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_block(const BlockPlace& place, std::uint64_t& offset) {
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    const Outcome loaded = load(place_next_);
    if (loaded != Outcome::Found) return loaded;
    offset = cursor_.offset();
    const bool is_there = (place.is_line ? place_next_.line : offset) >= place.number;
    if (is_there && read_head(cursor_.begin()).kind != BlockHead::Kind::Empty)
      return Outcome::Found;
    cursor_.advance(place_next_);
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_content(const TextPosition& from, std::uint64_t end,
                                             std::uint64_t& line) {
  if (!same_place(content_from_, from)) content_from_ = content_next_ = from;
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    if (content_next_.offset >= end) return Outcome::Missing;
    const Outcome loaded = load(content_next_);
    if (loaded != Outcome::Found) return loaded;
    if (cursor_.offset() >= end) return Outcome::Missing;
    line = content_next_.line;
    if (read_head(cursor_.begin()).kind != BlockHead::Kind::Empty) return Outcome::Found;
    cursor_.advance(content_next_);
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_jump_back(const TextPosition& from, std::uint64_t& line) {
  if (back_blocks_ == 0 || !same_place(back_from_, from)) {
    back_from_ = back_next_ = from;
    back_blocks_ = 1;
    back_label_.reset();
  }
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    if (back_label_) {
      TextPosition label;
      const Outcome found =
          *back_label_ == kComputed ? Outcome::Found : find_label(from, *back_label_, label);
      if (found != Outcome::Found && found != Outcome::Missing) return found;
      back_label_.reset();
      line = back_next_.line - 1;
      if (found == Outcome::Found && label.offset <= from.offset) return Outcome::Found;
    }
    if (back_blocks_ > kBlocksLookedAt) return Outcome::Missing;
    const Outcome loaded = load(back_next_);
    if (loaded != Outcome::Found) return loaded;
    const BlockHead block = read_head(cursor_.begin());
    const bool is_next_program = block.kind == BlockHead::Kind::Program && back_next_.code_seen;
    if (is_next_program && back_blocks_ > 1) return Outcome::Missing;
    back_label_ = goto_target(cursor_.begin());
    if (block.kind != BlockHead::Kind::Empty) back_next_.code_seen = true;
    cursor_.advance(back_next_);
    ++back_blocks_;
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_wend(const TextPosition& head, const TextPosition& after,
                                          LoopFrame& loop) {
  for (const LoopFrame& known : known_loops_) {
    if (known.wend_offset != 0 && same_place(known.head, head)) {
      loop = known;
      return Outcome::Found;
    }
  }
  if (loop_depth_ == 0 || !same_place(loop_head_, head)) {
    loop_head_ = head;
    loop_next_ = after;
    loop_depth_ = 1;
  }
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    const Outcome loaded = load(loop_next_);
    if (loaded == Outcome::Missing) loop_depth_ = 0;
    if (loaded != Outcome::Found) return loaded;
    const BlockHead block = read_head(cursor_.begin());
    if (block.kind == BlockHead::Kind::Program && loop_next_.code_seen) {
      loop_depth_ = 0;
      return Outcome::Missing;
    }
    const bool is_end = count_loops(cursor_.begin(), loop_depth_);
    const std::uint64_t offset = cursor_.offset();
    cursor_.advance(loop_next_);
    if (!is_end) continue;
    loop = {head, loop_next_, offset};
    known_loops_[next_known_loop_++ % kKnownLoops] = loop;
    return Outcome::Found;
  }
  return Outcome::More;
}

}  // namespace dripline::interpreter::centurion
