#include "tests/support/vanished_words.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <vector>

#include "tests/support/event_log.hpp"

namespace dripline::interpreter {
namespace {

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_axis(char c) {
  constexpr std::string_view kAxes = "XYZABCUVWxyzabcuvw";
  return kAxes.find(c) != std::string_view::npos;
}

/// Where a number of an axis word has its first digit that counts, in the text.
struct AxisWord {
  std::size_t begin = 0, digit = 0, end = 0;
};

/// Axis words of one block with a number written out, outside comments.
/// `long_names`: those of two letters as well, XB or YE.
std::vector<AxisWord> axis_words(std::string_view text, std::size_t begin, std::size_t end,
                                 bool long_names = false) {
  constexpr std::string_view kSecond = "BECDObecdo";
  std::vector<AxisWord> words;
  bool in_comment = false;
  for (std::size_t at = begin; at < end; ++at) {
    const char c = text[at];
    if (c == '(') in_comment = true;
    if (c == ')') in_comment = false;
    if (c == ';' && !long_names) break;
    const bool follows_letter = at > begin && is_letter(text[at - 1]);
    if (in_comment || follows_letter || !is_axis(c)) continue;
    std::size_t number = at + 1;
    if (long_names && number < end && kSecond.find(text[number]) != kSecond.npos) ++number;
    if (number < end && (text[number] == '+' || text[number] == '-')) ++number;
    std::size_t after = number;
    bool has_digit = false;
    for (; after < end && (is_digit(text[after]) || text[after] == '.'); ++after)
      has_digit |= is_digit(text[after]);
    if (!has_digit || after - number > 9) continue;
    const std::size_t digit = text.find_first_of("0123456789", number);
    words.push_back({at, digit, after});
  }
  return words;
}

Answer answer_to(const Question& question, const Setup& setup) {
  if (const auto* probe = std::get_if<ProbeQuestion>(&question)) {
    return ProbeResult{true, probe->probe.to};
  }
  if (std::holds_alternative<PromptQuestion>(question))
    return PromptAnswer{setup.answers.empty() ? std::string("1") : setup.answers.front()};
  if (std::holds_alternative<InputQuestion>(question)) return true;
  if (std::holds_alternative<SignalQuestion>(question)) return SignalValue{1.0, ""};
  return LocalTime{1993, 12, 17, 12, 51, 52};
}

bool is_message(const std::string& line) {
  return line.starts_with("warning ") || line.starts_with("alarm ") || line.starts_with("message ");
}

/// One run, block by block.
class Steps {
 public:
  Steps(const Dialect& dialect, std::string_view text, const Setup& setup,
        const MemorySource::Loader& loader)
      : setup_(setup),
        source_(text, loader),
        interpreter_(std::move(*dialect.make(setup, source_, log_))) {}

  /// One more block; its questions answered. False: the run is over.
  bool next() {
    constexpr int kMaxSteps = 10'000;
    has_asked_ = false;
    first_line_ = log_.lines().size();
    const std::uint64_t before = interpreter_->blocks();
    for (int i = 0; i < kMaxSteps; ++i) {
      switch (interpreter_->step(1)) {
        case StepState::Ran:
          if (interpreter_->blocks() != before) return true;
          break;
        case StepState::NeedsAnswer:
          has_asked_ = true;
          if (!interpreter_->answer(answer_to(interpreter_->question(), setup_))) return false;
          break;
        case StepState::NeedsText:
          break;
        case StepState::Ended:
        case StepState::Alarmed:
          return false;
      }
    }
    return false;
  }

  Interpreter& interpreter() { return *interpreter_; }
  const std::vector<std::string>& all_events() const { return log_.lines(); }
  bool has_asked() const { return has_asked_; }
  /// What the last block has delivered.
  std::vector<std::string> events() const {
    return {log_.lines().begin() + static_cast<std::ptrdiff_t>(first_line_), log_.lines().end()};
  }

 private:
  const Setup& setup_;
  MemorySource source_;
  EventLog log_;
  std::unique_ptr<Interpreter> interpreter_;
  bool has_asked_ = false;
  std::size_t first_line_ = 0;
};

class Search {
 public:
  Search(const Dialect& dialect, std::string_view text, const Setup& setup,
         const MemorySource::Loader& loader)
      : dialect_(dialect), text_(text), setup_(setup), loader_(loader) {}

  std::optional<std::string> find(std::uint64_t max_blocks) {
    Steps steps(dialect_, text_, setup_, loader_);
    Snapshot before = steps.interpreter().snapshot();
    while (steps.interpreter().blocks() < max_blocks && steps.next()) {
      Snapshot after = steps.interpreter().snapshot();
      if (auto found = check_block(steps, before, after)) return found;
      before = std::move(after);
    }
    return std::nullopt;
  }

  /// Of a control that stores the program before it runs: the whole run must be another.
  std::optional<std::string> find_in_stored_program(std::uint64_t max_blocks) {
    constexpr std::size_t kMaxWords = 16;
    const auto events = run_whole(text_, max_blocks);
    if (events.empty() || events.back().starts_with("alarm ")) return std::nullopt;
    // a title in front is left out, and the text after the end
    const std::size_t first = text_.find_first_not_of(" \t\r\n");
    const bool has_title = first != text_.npos && text_[first] == '%';
    const std::size_t begin = has_title ? text_.find(';') : 0;
    const std::size_t end = std::min(text_.find_first_of("%\x1A", begin), text_.size());
    auto words = axis_words(text_, begin, end, true);
    if (words.size() > kMaxWords) words.resize(kMaxWords);
    for (const AxisWord& word : words) {
      const auto line =
          1 +
          std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(word.begin), '\n');
      const bool never_moves = text_[word.begin] == 'Z' || text_[word.begin] == 'z';
      if (never_moves || warns_of(events, static_cast<std::uint64_t>(line))) continue;
      if (run_whole(changed_text(word, 1), max_blocks) != events ||
          run_whole(changed_text(word, 5), max_blocks) != events)
        continue;
      return fmt::format("line {}: {}", line, text_.substr(word.begin, word.end - word.begin));
    }
    return std::nullopt;
  }

 private:
  std::vector<std::string> run_whole(std::string_view text, std::uint64_t max_blocks) const {
    Steps steps(dialect_, text, setup_, loader_);
    while (steps.interpreter().blocks() < max_blocks && steps.next()) {
    }
    return steps.all_events();
  }

  static bool warns_of(const std::vector<std::string>& events, std::uint64_t line) {
    return std::any_of(events.begin(), events.end(), [&](const std::string& event) {
      return event.starts_with("warning ") && event.find(fmt::format(":{}:", line)) != event.npos;
    });
  }

  std::string changed_text(const AxisWord& word, int change) const {
    std::string changed(text_);
    changed[word.digit] = static_cast<char>('0' + (changed[word.digit] - '0' + change) % 10);
    return changed;
  }

  /// What a block did: anything but its end says enough.
  std::optional<std::string> check_block(Steps& steps, const Snapshot& before,
                                         const Snapshot& after) {
    const Origin origin = steps.interpreter().origin();
    if (origin.program != kMainProgram || steps.has_asked() || origin.offset >= text_.size())
      return std::nullopt;
    const auto events = steps.events();
    if (std::any_of(events.begin(), events.end(), is_message)) return std::nullopt;
    const std::size_t begin = origin.offset;
    const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
    if (is_left_out(text_.substr(begin, end - begin))) return std::nullopt;
    const auto words = axis_words(text_, begin, end);
    const auto does_nothing = [&](const AxisWord& word) {
      return is_vanished(word, before, after, events);
    };
    if (words.empty() || !std::all_of(words.begin(), words.end(), does_nothing))
      return std::nullopt;
    // a block that is not read there does not count: a pass of a cycle that was read before
    std::string unread(text_);
    std::fill(unread.begin() + static_cast<std::ptrdiff_t>(begin),
              unread.begin() + static_cast<std::ptrdiff_t>(end), '?');
    if (does_the_same(unread, before, after, events)) return std::nullopt;
    return fmt::format("line {}: \"{}\"", origin.line, text_.substr(begin, end - begin));
  }

  /// A block that the switch or a condition of its own leaves out.
  static bool is_left_out(std::string_view block) {
    return block.find('/') != std::string_view::npos || block.find("IF") != std::string_view::npos;
  }

  /// Of other numbers some might by chance do the same, or mean the same (G07: 0 or not).
  bool is_vanished(const AxisWord& word, const Snapshot& before, const Snapshot& after,
                   const std::vector<std::string>& events) const {
    const int digit = text_[word.digit] - '0';
    for (const int change : {1, 5, 10 - digit}) {
      if (!does_the_same(changed_text(word, change), before, after, events)) return false;
    }
    return true;
  }

  bool does_the_same(const std::string& changed, const Snapshot& before, const Snapshot& after,
                     const std::vector<std::string>& events) const {
    Steps steps(dialect_, changed, setup_, loader_);
    return steps.interpreter().restore(before) && steps.next() && !steps.has_asked() &&
           steps.events() == events && steps.interpreter().snapshot().digest() == after.digest();
  }

  const Dialect& dialect_;
  std::string_view text_;
  const Setup& setup_;
  const MemorySource::Loader& loader_;
};

}  // namespace

std::optional<std::string> find_vanished_word(const Dialect& dialect, std::string_view text,
                                              const Setup& setup, std::uint64_t max_blocks,
                                              const MemorySource::Loader& loader) {
  Search search(dialect, text, setup, loader);
  const bool is_stored = dialect.name == "prototrak-plus";
  return is_stored ? search.find_in_stored_program(max_blocks) : search.find(max_blocks);
}

}  // namespace dripline::interpreter
