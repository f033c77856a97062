#include "gateway/interpreter/dialects/fanuc/reading/text_search.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Up to eight digits; larger numbers are no label that anyone looks for.
bool read_number_of(const char*& at, std::uint32_t& number) {
  constexpr std::uint32_t kMax = 99'999'999;
  at = skip_blanks(at);
  if (!is_digit(*at)) return false;
  number = 0;
  for (; is_digit(*at); at = skip_blanks(at + 1)) {
    number = number > kMax ? number : number * 10 + static_cast<std::uint32_t>(*at - '0');
  }
  return true;
}

const char* skip_comments(const char* at, const char* end) {
  for (;;) {
    at = skip_blanks(at);
    if (*at != '(') return at;
    while (*at != ')' && at != end) ++at;
    if (*at == ')') ++at;
  }
}

/// WHILE [..] DO m, DO m, END m. Numbers from variables count as none.
int read_loop_word(const char* at, const char* end) {
  std::uint32_t number = 0;
  if (take_word(at, "END"))
    return read_number_of(at, number) && number <= 3 ? -static_cast<int>(number) : 0;
  if (take_word(at, "WHILE")) {
    int depth = 0;
    for (at = skip_comments(at, end); at != end; ++at) {
      if (*at == '[') ++depth;
      if (*at == ']' && --depth == 0) break;
    }
    if (at == end) return 0;
    at = skip_comments(at + 1, end);
  }
  if (!take_word(at, "DO")) return 0;
  return read_number_of(at, number) && number <= 3 ? static_cast<int>(number) : 0;
}

bool read_name(const char* at, std::string_view& name) {
  name = take_program_name(at);
  return !name.empty() && name.size() <= kMaxProgramName;
}

bool same_place(const TextPosition& a, const TextPosition& b) {
  return a.program == b.program && a.offset == b.offset;
}

}  // namespace

BlockHead read_head(const char* begin, const char* end) {
  BlockHead head;
  const char* at = skip_comments(begin, end);
  if (at == end || *at == ';') return head;
  if (*at == '%') {
    head.kind = BlockHead::Kind::Percent;
    return head;
  }
  head.kind = BlockHead::Kind::Other;
  if (*at == '/') {
    at = skip_blanks(at + 1);
    if (is_digit(*at)) ++at;
    at = skip_comments(at, end);
  }
  const char first = is_letter(*at) ? upper(*at) : *at;
  if (first == 'O' || first == ':' || first == '<') {
    const char* name = first == 'O' ? skip_blanks(at + 1) : at;
    if (read_name(name, head.name) || (first != '<' && read_number_of(++at, head.number)))
      head.kind = BlockHead::Kind::Program;
    return head;
  }
  if (first == 'N' && read_number_of(++at, head.number)) {
    head.kind = BlockHead::Kind::Sequence;
    at = skip_comments(at, end);
    if (*at == '/') {
      at = skip_blanks(at + 1);
      if (is_digit(*at)) ++at;
      at = skip_comments(at, end);
    }
  }
  head.is_bare = head.kind == BlockHead::Kind::Sequence && (at == end || *at == ';');
  const char next = is_letter(*at) ? upper(*at) : '\0';
  if (next == 'W' || next == 'D' || next == 'E') head.loop = read_loop_word(at, end);
  return head;
}

TextSearch::Outcome TextSearch::next_block(TextPosition& at, BlockHead& head, TextPosition& block) {
  const Outcome loaded = load(at);
  if (loaded != Outcome::Found) return loaded;
  block = at;
  head = read_head(run_.text.begin(), run_.text.end());
  if (head.kind == BlockHead::Kind::Percent && !at.head_seen) {
    run_.text.advance(at, run_.text.end());
    at.head_seen = true;
    head = BlockHead{};
    return Outcome::Found;
  }
  const bool is_next_program = head.kind == BlockHead::Kind::Program && at.code_seen;
  if (head.kind == BlockHead::Kind::Percent || is_next_program) return Outcome::Missing;
  if (head.kind != BlockHead::Kind::Empty) at.head_seen = at.code_seen = true;
  run_.text.advance(at, find_block_end(run_, run_.text.begin()));
  return Outcome::Found;
}

TextSearch::Outcome TextSearch::follow(const BlockHead& head, std::uint64_t offset,
                                       OpenLoops& open) {
  if (head.loop > 0) {
    for (std::size_t i = 0; i < open.count; ++i) {
      if (open.loop[i].number == head.loop) return Outcome::Crossed;
    }
    open.loop[open.count++] = {static_cast<std::uint8_t>(head.loop), offset};
  } else if (head.loop < 0) {
    if (open.count == 0 || open.loop[open.count - 1].number != -head.loop) return Outcome::Crossed;
    --open.count;
  }
  return Outcome::Found;
}

TextSearch::KnownLabel& TextSearch::known_label(const TextPosition& from, std::uint32_t label) {
  const std::uint64_t mixed = (from.offset * 31 + label) * 0x9E3779B97F4A7C15u + from.program;
  return labels_[(mixed >> 32) % kKnown];
}

TextSearch::Outcome TextSearch::find_label(const TextPosition& from, std::uint32_t label,
                                           OpenLoops& open, TextPosition& found) {
  KnownLabel& known = known_label(from, label);
  if (known.is_used && known.label == label && same_place(known.from, from)) {
    found = known.found;
    open = known.open;
    return Outcome::Found;
  }
  LabelSearch& search = label_search_;
  if (!search.is_running || search.label != label || !same_place(search.from, from)) {
    search = {true, false, label, from, from, open};
  }
  const Outcome outcome = continue_label_search(search);
  if (outcome == Outcome::NotYet || outcome == Outcome::More) return outcome;
  search.is_running = false;
  if (outcome != Outcome::Found) return outcome;
  found = search.next;
  open = search.open;
  known = {true, label, from, found, open};
  return Outcome::Found;
}

/// Leaves the place found in `search.next`.
TextSearch::Outcome TextSearch::continue_label_search(LabelSearch& search) {
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    BlockHead head;
    TextPosition block;
    TextPosition next = search.next;
    const Outcome outcome = next_block(next, head, block);
    if (outcome == Outcome::Missing) {
      if (search.from_head) return Outcome::Missing;
      search.from_head = true;
      search.next = search.from.segment_head();
      search.open = OpenLoops{};
      continue;
    }
    if (outcome != Outcome::Found) return outcome;
    if (head.kind == BlockHead::Kind::Sequence && head.number == search.label) {
      search.next = block;
      return Outcome::Found;
    }
    if (search.from_head && same_place(block, search.from)) return Outcome::Missing;
    if (follow(head, block.offset, search.open) == Outcome::Crossed) return Outcome::Crossed;
    search.next = next;
  }
  return Outcome::More;
}

/// The manual forbids a number that is there twice: the control would find one of both.
TextSearch::Outcome TextSearch::check_contour(const TextPosition& from, const Contour& contour,
                                              std::string& why) {
  const auto [first, last, is_left_at_its_end] = contour;
  ContourSearch& search = contour_search_;
  if (!search.is_known || search.contour != contour || !same_place(search.from, from)) {
    search = {.is_known = true, .contour = contour, .from = from, .next = from.segment_head()};
  }
  if (search.is_right) return Outcome::Found;
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    BlockHead head;
    TextPosition block;
    TextPosition next = search.next;
    const Outcome outcome = next_block(next, head, block);
    if (outcome == Outcome::NotYet) return outcome;
    if (outcome != Outcome::Found) {
      search.is_known = false;
      if (outcome != Outcome::Missing) return outcome;
      if (search.begins > 1 || search.ends > 1) {
        why = fmt::format("N{} is there twice", search.begins > 1 ? first : last);
      } else if (search.begins == 1 && search.ends == 0) {
        why = fmt::format("there is no N{}", last);
      } else if (search.begins == 1 && search.end < search.begin) {
        why = fmt::format("N{} is before N{}", last, first);
      } else if (is_left_at_its_end && search.begin > from.offset && search.skipped_line > 0) {
        why = fmt::format(
            "N{} does not follow its cycle: what is between them, from line {} on, would never be "
            "executed",
            first, search.skipped_line);
      } else {
        search.is_known = search.is_right = true;
        return Outcome::Found;  // a missing N`first` is the jump's own alarm
      }
      return outcome;
    }
    const bool is_first = head.kind == BlockHead::Kind::Sequence && head.number == first;
    const bool is_between = block.offset >= from.offset && search.begins == 0 && !is_first;
    if (is_between && head.kind != BlockHead::Kind::Empty && !head.is_bare &&
        search.skipped_line == 0)
      search.skipped_line = block.line;
    if (is_first) {
      search.begin = block.offset;
      ++search.begins;
    }
    if (head.kind == BlockHead::Kind::Sequence && head.number == last) {
      search.end = block.offset;
      ++search.ends;
    }
    search.next = next;
  }
  return Outcome::More;
}

const TextSearch::Place* TextSearch::known_program(const Jump& jump) const {
  if (jump.name.empty()) {
    const auto place = programs_.find(jump.number);
    return place == programs_.end() ? nullptr : &place->second;
  }
  const auto place = named_programs_.find(jump.name);
  return place == named_programs_.end() ? nullptr : &place->second;
}

TextSearch::Outcome TextSearch::find_program(const Jump& jump, TextPosition& found) {
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    if (const Place* place = known_program(jump); place != nullptr) {
      found = TextPosition{};
      found.head_seen = true;
      found.segment_offset = found.offset = place->offset;
      found.segment_line = found.line = place->line;
      return Outcome::Found;
    }
    if (programs_complete_) return Outcome::Missing;
    BlockHead head;
    TextPosition block;
    TextPosition next = programs_next_;
    next.code_seen = false;  // past the programs, not at the next one's beginning
    const Outcome outcome = next_block(next, head, block);
    if (outcome == Outcome::Missing) {
      programs_complete_ = true;
      continue;
    }
    if (outcome != Outcome::Found) return outcome;
    if (head.kind == BlockHead::Kind::Program) {
      const Place place{block.offset, block.line};
      if (head.name.empty())
        programs_.try_emplace(head.number, place);
      else
        named_programs_.try_emplace(std::string(head.name), place);
    }
    programs_next_ = next;
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_end(const TextPosition& head, const TextPosition& after,
                                         std::uint8_t number, LoopFrame& loop) {
  LoopFrame& known = loops_[(head.offset * 31 + head.program) % kKnown];
  if (known.end_offset != 0 && same_place(known.head, head)) {
    loop = known;
    return Outcome::Found;
  }
  EndSearch& search = end_search_;
  if (!search.is_running || !same_place(search.head, head)) {
    search = {true, head, after, {}};
    search.open.loop[search.open.count++] = {number, head.offset};
  }
  for (unsigned blocks = 0; blocks < kBlocksPerCall; ++blocks) {
    BlockHead block_head;
    TextPosition block;
    TextPosition next = search.next;
    Outcome outcome = next_block(next, block_head, block);
    if (outcome == Outcome::NotYet) return outcome;
    if (outcome == Outcome::Found) outcome = follow(block_head, block.offset, search.open);
    if (outcome != Outcome::Found) {
      search.is_running = false;
      return outcome;
    }
    search.next = next;
    if (search.open.count != 0) continue;
    search.is_running = false;
    known = loop = {head, next, block.offset, number};
    return Outcome::Found;
  }
  return Outcome::More;
}

}  // namespace dripline::interpreter::fanuc
