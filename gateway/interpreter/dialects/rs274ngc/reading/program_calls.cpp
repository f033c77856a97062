#include "gateway/interpreter/dialects/rs274ngc/reading/program_calls.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/codes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

const char* skip_brackets(const char* at) {
  int depth = 0;
  for (; !is_end_of_line(*at); ++at) {
    if (*at == '[') ++depth;
    if (*at == ']' && --depth == 0) return at + 1;
  }
  return at;
}

/// The label of an O-word: its name, in small letters and without blanks, or its number; nothing
/// when a run computes it. `at` moves after it.
std::optional<std::string> read_written_label(const char*& at) {
  at = skip_blanks(at);
  std::string label;
  if (*at == '<') {
    for (++at; !is_end_of_line(*at) && *at != '>'; ++at) {
      if (is_blank(*at)) continue;
      label += *at >= 'A' && *at <= 'Z' ? static_cast<char>(*at + ('a' - 'A')) : *at;
    }
    if (*at == '>') ++at;
    return label;
  }
  if (!is_digit(*at)) {
    if (*at == '[') {
      at = skip_brackets(at);
    } else {
      while (*at == '#' || is_digit(*at) || is_blank(*at)) ++at;
    }
    return std::nullopt;
  }
  for (; is_digit(*at) || is_blank(*at); ++at) {
    if (is_digit(*at)) label += *at;
  }
  label.erase(0, std::min(label.find_first_not_of('0'), label.size() - 1));
  return label;
}

/// G70 to G72 call the contour that Q names; without a name a run computes it.
struct WordsOfCycle {
  bool is_turning = false;
  std::string contour;

  void read(char letter, bool is_written, double value) {
    if (!is_written) return;
    if (letter == 'G')
      is_turning |= is_turning_cycle(static_cast<int>(std::lround(std::fmin(value, 1e3) * 10)));
    if (letter == 'Q') contour = fmt::format("{}", static_cast<std::int64_t>(std::round(value)));
  }
};

bool is_read(char letter) {
  return letter == 'M' || letter == 'P' || letter == 'G' || letter == 'Q';
}

class TextCalls {
 public:
  void read(const char* begin, std::uint64_t line) {
    const char* at = skip_blanks(begin);
    if (*at == '/') at = skip_blanks(at + 1);
    if (upper(*at) == 'N') {
      for (++at; is_digit(*at) || is_blank(*at) || *at == '.';) ++at;
    }
    if (upper(*at) == 'O') return read_oword(at + 1, line);
    read_words(at, line);
  }

  Result<ProgramCalls> take() {
    for (const auto& [label, line] : subs_) calls_.add_contained(label);
    for (Found& found : found_) {
      const auto sub = subs_.find(found.call.name);
      const bool is_in_text = found.is_m98 ? labels_.contains(found.call.name)
                                           : sub != subs_.end() && sub->second < found.call.line;
      if (is_in_text) continue;
      // Without a file of that name the control takes the one after the call.
      found.call.is_contained = !found.is_m98 && sub != subs_.end();
      calls_.add(std::move(found.call));
    }
    return calls_.take();
  }

 private:
  struct Found {
    ProgramCall call;
    bool is_m98 = false;
  };

  void read_oword(const char* at, std::uint64_t line) {
    const auto label = read_written_label(at);
    at = skip_blanks(at);
    if (label && (is_end_of_line(*at) || *at == '(' || *at == ';')) labels_.insert(*label);
    if (label && take_word(at, "SUB")) subs_.try_emplace(*label, line);
    if (take_word(at, "CALL")) add({{.name = label.value_or(""), .earlier = {}, .line = line}});
  }

  void read_words(const char* at, std::uint64_t line) {
    bool is_call = false;
    std::optional<double> program;
    bool is_computed = false;
    WordsOfCycle cycle;
    while (!is_end_of_line(*at) && *at != ';') {
      if (*at == '(') {
        while (*at != ')' && !is_end_of_line(*at)) ++at;
      } else if (*at == '[') {
        at = skip_brackets(at);
        continue;
      } else if (const char letter = upper(*at); is_read(letter)) {
        const char* value = skip_blanks(at + 1);
        NumberText number;
        const char* after = read_number<NumberRules{.skip_blanks = true}>(value, nullptr, number);
        const bool is_written = number.fault == NumberFault::None;
        if (is_written) at = after;
        is_call |= letter == 'M' && is_written && number.value == 98;
        if (letter == 'G' || letter == 'Q') cycle.read(letter, is_written, number.value);
        if (letter == 'P' && is_written) program = number.value;
        if (letter == 'P' && !is_written) is_computed = true;
        if (is_written) continue;
      }
      ++at;
    }
    if (cycle.is_turning) add({{.name = cycle.contour, .earlier = {}, .line = line}});
    if (!is_call || (!program && !is_computed)) return;
    std::string name;
    if (!is_computed) name = fmt::format("{}", static_cast<std::int64_t>(std::round(*program)));
    add({{.name = std::move(name), .earlier = {}, .line = line}, true});
  }

  /// A bound of its own: what is in the text is dropped only at the end.
  void add(Found found) {
    constexpr std::size_t kMaxFound = 4 * CallCollector::kMaxCalls;
    const auto is_same = [&](const Found& other) {
      return other.call.name == found.call.name && other.is_m98 == found.is_m98;
    };
    // The first call of a name is the one that its sub may not have been met before.
    if (std::ranges::any_of(found_, is_same)) return;
    if (found_.size() < kMaxFound) return found_.push_back(std::move(found));
    calls_.add(std::move(found.call));
  }

  CallCollector calls_;
  std::vector<Found> found_;
  std::map<std::string, std::uint64_t> subs_;  ///< the line of each
  std::set<std::string> labels_;               ///< O-words alone: where M98 goes
};

}  // namespace

Result<ProgramCalls> program_calls(const Setup&, ProgramSource& source, ProgramIndex program) {
  TextCalls calls;
  CallLines lines(source, program);
  for (;;) {
    const auto has_line = lines.next();
    if (!has_line) return fail(has_line.error());
    if (!*has_line) return calls.take();
    calls.read(lines.begin(), lines.number());
  }
}

}  // namespace dripline::interpreter::rs274ngc
