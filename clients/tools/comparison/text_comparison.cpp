#include "clients/tools/comparison/text_comparison.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <unordered_map>
#include <utility>

#include "clients/tools/comparison/line_stream.hpp"
#include "clients/tools/comparison/sequence_diff.hpp"

namespace dripline::comparison {
namespace text_parts {  // members of TextComparison::Parts

constexpr std::size_t kFirstLines = 1024;  // times 8, twice, is the last one
constexpr std::size_t kLastLines = 65'536;
constexpr std::size_t kLineGrowth = 8;
constexpr std::size_t kMaxWindowBytes = 16 << 20;
/// So many lines in a row are the same where a window ends in agreement.
constexpr std::size_t kAgreedLines = 4;
/// Lines of a hunk whose words are compared; in longer ones anything may have changed.
constexpr std::size_t kMaxWordLines = 4096;

using interpreter::kMainProgram;
using interpreter::ProgramSource;

std::uint64_t common_end(const TextSide& a, const TextSide& b) {
  constexpr std::uint64_t kPiece = ProgramSource::kMaxWindow;
  const std::uint64_t most = std::min(a.size, b.size);
  std::uint64_t same = 0, whole = 0;  // whole: with whole lines alone
  while (same < most) {
    const auto size = static_cast<std::size_t>(std::min(kPiece, most - same));
    const auto window_of = [&](const TextSide& side) {
      auto window = side.source.fetch(kMainProgram, side.size - same - size, size);
      return window.text.substr(0, size);
    };
    const std::string_view first = window_of(a), second = window_of(b);
    if (first.size() != size || second.size() != size) return whole;
    const auto found = std::mismatch(first.rbegin(), first.rend(), second.rbegin()).first;
    const auto equal = static_cast<std::size_t>(found - first.rbegin());
    // A line begins after an LF that both have.
    const std::size_t end = first.find('\n', size - equal);
    if (end != std::string_view::npos) whole = same + size - end - 1;
    same += equal;
    if (equal < size) break;
  }
  return same == a.size && same == b.size ? same : whole;
}

/// A line that waits to be compared.
struct Kept {
  std::uint64_t number = 0, offset = 0, size = 0;
  bool has_end = false;
  std::string text;  ///< as it is compared
};

/// One program's lines in order, as far as they were asked for.
class Lines {
 public:
  Lines(const TextSide& side, bool normalized)
      : side_(side),
        rules_(lexical_rules(side.control)),
        normalized_(normalized),
        stream_(side.source) {}

  LineStream& stream() { return stream_; }
  const TextSide& side() const { return side_; }
  const LexicalRules& rules() const { return rules_; }
  const std::deque<Kept>& kept() const { return kept_; }
  bool is_over() const { return is_over_; }

  void fill(std::size_t count) {
    TextLine line;
    while (kept_.size() < count && bytes_ < kMaxWindowBytes && !is_over_) {
      is_over_ = !stream_.next(line);
      if (is_over_) break;
      Kept kept{
          line.number, line.offset, line.text.size() + (line.has_end ? 1 : 0), line.has_end, {}};
      if (normalized_) {
        append_normal(line.text, rules_, {}, kept.text);
        if (kept.text.empty()) continue;
      } else {
        kept.text = line.text;
        if (line.has_end) kept.text += '\n';
      }
      bytes_ += kept.text.size();
      kept_.push_back(std::move(kept));
    }
  }
  void drop(std::size_t count) {
    for (; count > 0; --count) {
      bytes_ -= kept_.front().text.size();
      kept_.pop_front();
    }
  }

  /// Where the line `i` begins, or the end of what was read.
  std::pair<std::uint64_t, std::uint64_t> begin_of(std::size_t i) const {
    if (i < kept_.size()) return {kept_[i].number, kept_[i].offset};
    if (i > 0 && !kept_.empty())
      return {kept_.back().number + 1, kept_.back().offset + kept_.back().size};
    return {stream_.number(), stream_.offset()};
  }
  LineRange range(std::size_t begin, std::size_t count) const {
    const auto [line, offset] = begin_of(begin);
    if (count == 0) return {line, 0, offset, 0};
    const Kept& last = kept_[begin + count - 1];
    return {line, last.number - line + 1, offset, last.offset + last.size - offset};
  }

 private:
  const TextSide& side_;
  const LexicalRules& rules_;
  bool normalized_;
  LineStream stream_;
  std::deque<Kept> kept_;
  std::size_t bytes_ = 0;
  bool is_over_ = false;
};

/// Equal texts get equal numbers.
class Classes {
 public:
  std::vector<std::uint32_t> of(const std::deque<Kept>& lines) {
    std::vector<std::uint32_t> classes;
    classes.reserve(lines.size());
    for (const Kept& line : lines) {
      const auto next = static_cast<std::uint32_t>(numbers_.size());
      classes.push_back(numbers_.try_emplace(line.text, next).first->second);
    }
    return classes;
  }

 private:
  std::unordered_map<std::string_view, std::uint32_t> numbers_;
};

using Texts = std::vector<std::string>;

/// Of the normal forms of the lines of a hunk.
TextChange change_of_lines(const Texts& before, const Texts& after) {
  std::unordered_map<std::string_view, std::uint32_t> numbers;
  const auto classes_of = [&numbers](const Texts& texts) {
    std::vector<std::uint32_t> classes;
    for (const std::string& text : texts) {
      const auto next = static_cast<std::uint32_t>(numbers.size());
      classes.push_back(numbers.try_emplace(text, next).first->second);
    }
    return classes;
  };
  const auto first = classes_of(before), second = classes_of(after);
  TextChange largest = TextChange::None;
  for (const EditRun& run : diff_sequences(first, second)) {
    const std::size_t lines = std::max(run.first_count, run.second_count);
    for (std::size_t i = 0; i < lines; ++i) {
      const std::string_view was = i < run.first_count ? before[run.first + i] : std::string_view();
      const std::string_view is = i < run.second_count ? after[run.second + i] : std::string_view();
      largest = std::max(largest, change_of(was, is));
    }
  }
  return largest;
}

}  // namespace text_parts

using namespace text_parts;

struct TextComparison::Parts {
  Parts(const TextSide& a, const TextSide& b, TextOptions chosen, Take take_hunk)
      : options(chosen),
        take(std::move(take_hunk)),
        sides{a, b},
        first(sides[0], chosen.normalized),
        second(sides[1], chosen.normalized) {}

  Result<bool> step();
  enum class Window : std::uint8_t { Growing, Last, Whole };
  bool compare_window(Window window);
  void report(const EditRun& run);
  void flush();
  TextChange change_in(const EditRun& run);
  Texts normal_lines(const Lines& lines, std::size_t begin, std::size_t count,
                     NormalForm form) const;
  Result<void> check() {
    for (Lines* lines : {&first, &second}) {
      if (!lines->stream().error().empty()) return fail(Errc::Io, "{}", lines->stream().error());
    }
    return {};
  }

  TextOptions options;
  Take take;
  std::array<TextSide, 2> sides;
  Lines first, second;
  TextResult result;
  std::optional<TextHunk> pending;  ///< what follows may touch it
  bool has_begun = false;
};

Result<bool> TextComparison::Parts::step() {
  if (!has_begun) {
    has_begun = true;
    const std::uint64_t same = common_end(sides[0], sides[1]);
    first.stream().set_limit(sides[0].size - same);
    second.stream().set_limit(sides[1].size - same);
  }
  if (first.kept().empty() && second.kept().empty() && !first.is_over() && !second.is_over())
    LineStream::skip_equal(first.stream(), second.stream());
  for (std::size_t lines = kFirstLines;; lines *= kLineGrowth) {
    first.fill(lines);
    second.fill(lines);
    if (auto checked = check(); !checked) return fail(checked.error());
    if (first.is_over() && second.is_over()) {
      compare_window(Window::Whole);
      flush();
      return true;
    }
    if (compare_window(lines < kLastLines ? Window::Growing : Window::Last)) return false;
  }
}

/// Takes what is kept of both up to the last place where they agree, for what follows it may look
/// different with more lines. False: there is no such place, and more lines may show one.
bool TextComparison::Parts::compare_window(Window window) {
  Classes classes;
  const auto a = classes.of(first.kept());
  const auto b = classes.of(second.kept());
  const auto runs = diff_sequences(a, b);
  std::size_t taken = runs.size(), end_first = a.size(), end_second = b.size();
  if (window != Window::Whole) {
    const auto agreed_after = [&](std::size_t i) {
      const std::size_t next = i + 1 < runs.size() ? runs[i + 1].first : a.size();
      return next - runs[i].first - runs[i].first_count;
    };
    while (taken > 0 && agreed_after(taken - 1) < kAgreedLines) --taken;
    const std::size_t before = runs.empty() ? a.size() : runs.front().first;
    if (taken > 0) {
      const EditRun& run = runs[taken - 1];
      end_first = run.first + run.first_count + agreed_after(taken - 1);
      end_second = run.second + run.second_count + agreed_after(taken - 1);
    } else if (before > 0) {
      end_first = end_second = before;
    } else if (window == Window::Growing) {
      return false;
    } else {
      taken = runs.size();
    }
  }
  for (std::size_t i = 0; i < taken; ++i) report(runs[i]);
  first.drop(end_first);
  second.drop(end_second);
  return true;
}

Texts TextComparison::Parts::normal_lines(const Lines& lines, std::size_t begin, std::size_t count,
                                          NormalForm form) const {
  Texts texts;
  std::string normal;
  for (std::size_t i = begin; i < begin + count; ++i) {
    const Kept& kept = lines.kept()[i];
    normal.clear();
    append_normal(kept.text, lines.rules(), form, normal);
    if (!normal.empty()) texts.push_back(normal);
  }
  return texts;
}

TextChange TextComparison::Parts::change_in(const EditRun& run) {
  if (sides[0].control != sides[1].control || run.first_count > kMaxWordLines ||
      run.second_count > kMaxWordLines)
    return TextChange::Other;
  constexpr NormalForm kNumbered{.keeps_block_numbers = true};
  if (normal_lines(first, run.first, run.first_count, kNumbered) ==
      normal_lines(second, run.second, run.second_count, kNumbered))
    return TextChange::None;
  const auto change = change_of_lines(normal_lines(first, run.first, run.first_count, {}),
                                      normal_lines(second, run.second, run.second_count, {}));
  return std::max(change, TextChange::BlockNumbers);
}

void TextComparison::Parts::report(const EditRun& run) {
  TextHunk hunk{first.range(run.first, run.first_count), second.range(run.second, run.second_count),
                change_in(run)};
  if (pending && pending->first.offset + pending->first.size == hunk.first.offset &&
      pending->second.offset + pending->second.size == hunk.second.offset) {
    pending->first.count += hunk.first.count;
    pending->first.size += hunk.first.size;
    pending->second.count += hunk.second.count;
    pending->second.size += hunk.second.size;
    pending->change = std::max(pending->change, hunk.change);
    return;
  }
  flush();
  pending = hunk;
}

void TextComparison::Parts::flush() {
  if (!pending) return;
  result.is_same = false;
  ++result.hunk_count;
  result.first_lines += pending->first.count;
  result.second_lines += pending->second.count;
  result.change = std::max(result.change, pending->change);
  if (take) take(*pending);
  if (result.hunks.size() < options.max_hunks) result.hunks.push_back(*pending);
  pending.reset();
}

TextComparison::TextComparison(const TextSide& first, const TextSide& second, TextOptions options,
                               Take take)
    : parts_(std::make_unique<Parts>(first, second, options, std::move(take))) {}
TextComparison::TextComparison(TextComparison&&) noexcept = default;
TextComparison::~TextComparison() = default;

Result<bool> TextComparison::step() {
  return parts_->step();
}

const TextResult& TextComparison::result() const {
  return parts_->result;
}

Result<TextResult> compare_text(const TextSide& first, const TextSide& second, TextOptions options,
                                TextComparison::Take take) {
  TextComparison comparison(first, second, options, std::move(take));
  for (;;) {
    const auto is_over = comparison.step();
    if (!is_over) return fail(is_over.error());
    if (*is_over) return comparison.result();
  }
}

}  // namespace dripline::comparison
