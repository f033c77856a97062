#include "clients/tools/comparison/program_comparison.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "clients/tools/comparison/line_stream.hpp"

namespace dripline::comparison {
namespace {

using interpreter::ProgramSource;
using nlohmann::json;

/// A line of text in the result; the rest of a longer one is left out.
constexpr std::size_t kMaxLineText = 500;
/// Lines of context are looked for so far before a hunk.
constexpr std::uint64_t kMaxContextBytes = 16'384;

std::string shortened(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  return std::string(line.substr(0, kMaxLineText));
}

std::string_view fetch(ProgramSource& source, interpreter::ProgramIndex program,
                       std::uint64_t offset, std::size_t size) {
  return source.fetch(program, offset, size).text.substr(0, size);
}

std::string line_at(ProgramSource& source, const Place& place) {
  const std::string_view text = fetch(source, place.program, place.offset, kMaxLineText);
  return shortened(text.substr(0, text.find('\n')));
}

/// Whole lines of a program's text, as far as the result has room for them.
class LineList {
 public:
  explicit LineList(std::uint64_t room) : room_(room) {}

  bool is_full() const { return room_ == 0; }

  /// From `offset`, which moves past them.
  json take(ProgramSource& source, std::uint64_t& offset, std::uint64_t count) {
    json lines = json::array();
    while (count-- > 0 && room_ > 0) {
      const std::string_view text =
          fetch(source, interpreter::kMainProgram, offset, ProgramSource::kMaxWindow);
      if (text.empty()) break;
      const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
      lines.push_back(shortened(text.substr(0, end)));
      offset += end;
      --room_;
    }
    return lines;
  }

 private:
  std::uint64_t room_;
};

/// The lines that end at `offset`, up to so many, not before `least`.
json lines_before(LineList& list, ProgramSource& source, std::uint64_t offset, std::uint64_t count,
                  std::uint64_t least) {
  const std::uint64_t from = std::max(least, offset - std::min(offset, kMaxContextBytes));
  const std::string_view text =
      fetch(source, interpreter::kMainProgram, from, static_cast<std::size_t>(offset - from));
  std::size_t begin = text.size();
  std::uint64_t lines = 0;
  while (lines < count && begin > 0) {
    const std::size_t end = begin >= 2 ? text.rfind('\n', begin - 2) : std::string_view::npos;
    if (end == std::string_view::npos && from > least) break;
    begin = end == std::string_view::npos ? 0 : end + 1;
    ++lines;
  }
  std::uint64_t at = from + begin;
  return list.take(source, at, lines);
}

json hunk_side(LineList& list, ProgramSource& source, const LineRange& range) {
  std::uint64_t at = range.offset;
  json lines = list.take(source, at, range.count);
  return {{"line", range.line}, {"count", range.count}, {"lines", std::move(lines)}};
}

json text_json(const ProgramSide& first, const ProgramSide& second, const TextResult& result,
               const ProgramOptions& options) {
  LineList list(options.max_lines);
  json hunks = json::array();
  std::uint64_t passed = 0;  // bytes of the first program that are in the list
  for (std::size_t i = 0; i < result.hunks.size() && !list.is_full(); ++i) {
    const TextHunk& hunk = result.hunks[i];
    const bool has_next = i + 1 < result.hunks.size();
    json one{{"change", word_of(hunk.change)}};
    one["before"] = lines_before(list, first.source, hunk.first.offset, options.context, passed);
    one["first"] = hunk_side(list, first.source, hunk.first);
    one["second"] = hunk_side(list, second.source, hunk.second);
    const std::uint64_t next = has_next ? result.hunks[i + 1].first.line : UINT64_MAX;
    const std::uint64_t between = next - hunk.first.line - hunk.first.count;
    passed = hunk.first.offset + hunk.first.size;
    one["after"] = list.take(first.source, passed, std::min(options.context, between));
    hunks.push_back(std::move(one));
  }
  const bool is_complete = hunks.size() == result.hunk_count && !list.is_full();
  return {{"same", result.is_same},          {"change", word_of(result.change)},
          {"hunk_count", result.hunk_count}, {"removed", result.first_lines},
          {"added", result.second_lines},    {"complete", is_complete},
          {"hunks", std::move(hunks)}};
}

json place_side(ProgramSource& source, const Place& place, std::uint64_t actions,
                const std::string& action) {
  return {{"line", place.line},
          {"offset", place.offset},
          {"called", place.program != interpreter::kMainProgram},
          {"text", line_at(source, place)},
          {"actions", actions},
          {"action", action}};
}

json place_json(const ProgramSide& first, const ProgramSide& second, const MotionPlace& place) {
  json words = json::array();
  for (std::size_t i = 0; i < kDifferenceCount; ++i) {
    const auto difference = static_cast<Difference>(i);
    if (place.differences.has(difference)) words.push_back(word_of(difference));
  }
  const bool is_measured = place.distance > 0 && std::isfinite(place.distance);
  return {
      {"differences", std::move(words)},
      {"distance", is_measured ? json(place.distance) : json(nullptr)},
      {"first", place_side(first.source, place.first, place.first_actions, place.first_text)},
      {"second", place_side(second.source, place.second, place.second_actions, place.second_text)}};
}

json condition_json(const ProgramSide& first, const ProgramSide& second,
                    const Condition& condition) {
  const ProgramSide& side = condition.is_second ? second : first;
  return {{"kind", word_of(condition.kind)},
          {"program", condition.is_second ? "second" : "first"},
          {"line", condition.place.line},
          {"offset", condition.place.offset},
          {"line_text", line_at(side.source, condition.place)},
          {"text", condition.text}};
}

json motion_json(const ProgramSide& first, const ProgramSide& second, const MotionResult& result) {
  json counts = json::object(), places = json::array(), conditions = json::array();
  for (std::size_t i = 0; i < kDifferenceCount; ++i) {
    if (result.counts[i] > 0)
      counts[std::string(word_of(static_cast<Difference>(i)))] = result.counts[i];
  }
  for (const MotionPlace& place : result.places) places.push_back(place_json(first, second, place));
  for (const Condition& condition : result.conditions)
    conditions.push_back(condition_json(first, second, condition));
  return {{"same", result.is_same},
          {"tolerance", result.tolerance},
          {"across_controls", result.across_controls},
          {"max_distance", result.max_distance},
          {"place_count", result.place_count},
          {"counts", std::move(counts)},
          {"complete", result.place_count == result.places.size()},
          {"places", std::move(places)},
          {"conditions", std::move(conditions)},
          {"blocks", {{"first", result.first_blocks}, {"second", result.second_blocks}}},
          {"actions", {{"first", result.first_actions}, {"second", result.second_actions}}}};
}

bool is_to_stop(const ProgramOptions& options) {
  return options.is_to_stop && options.is_to_stop();
}

tl::unexpected<Error> stopped() {
  return fail(Errc::Timeout, "the comparison took too long and was ended");
}

std::string_view control_of(const ProgramSide& side) {
  return side.dialect != nullptr ? side.dialect->name : std::string_view();
}

Result<TextResult> text_of(const ProgramSide& first, const ProgramSide& second,
                           const ProgramOptions& options) {
  TextComparison comparison({first.source, first.size, control_of(first)},
                            {second.source, second.size, control_of(second)},
                            {.normalized = options.by == ProgramOptions::By::Normalized});
  for (;;) {
    const auto is_over = comparison.step();
    if (!is_over) return fail(is_over.error());
    if (*is_over) return comparison.result();
    if (is_to_stop(options)) return stopped();
  }
}

Result<MotionResult> motion_of(const ProgramSide& first, const ProgramSide& second,
                               const ProgramOptions& options) {
  auto comparison =
      MotionComparison::begin({*first.dialect, first.setup, first.source},
                              {*second.dialect, second.setup, second.source}, options.motion);
  if (!comparison) return fail(comparison.error());
  while (!comparison->step()) {
    if (is_to_stop(options)) return stopped();
  }
  return comparison->result();
}

}  // namespace

std::string_view word_of(EditClass edit) {
  constexpr std::string_view kWords[]{"none",    "comment",  "same_motion", "feed_and_speed",
                                      "offsets", "geometry", "other"};
  return kWords[static_cast<std::size_t>(edit)];
}

std::string_view word_of(TextChange change) {
  constexpr std::string_view kWords[]{"comment", "block_numbers", "feed_and_speed", "offsets",
                                      "other"};
  return kWords[static_cast<std::size_t>(change)];
}

EditClass classify(const TextResult& text, const MotionResult* motion) {
  if (text.is_same && (motion == nullptr || motion->is_same)) return EditClass::None;
  if (motion == nullptr)
    return text.change == TextChange::None ? EditClass::Comment : EditClass::Other;
  if (motion->is_same && text.change == TextChange::None) return EditClass::Comment;
  const Differences found = motion->differences;
  constexpr Differences kFeeds = Differences(Difference::Feed) | Difference::Speed;
  // Whatever else it changes: the spindle of a cut, or what its feed means.
  if (found.has(Difference::Pitch)) return EditClass::Geometry;
  const bool is_other = found.has(Difference::Spindle) || found.has(Difference::FeedMode);
  if (is_other) return found.has(Difference::Path) ? EditClass::Geometry : EditClass::Other;
  if (motion->conditions.empty()) {
    // With other values in the tables of offsets it would be another motion.
    if (motion->is_same && text.change != TextChange::Offsets) return EditClass::SameMotion;
    if (!motion->is_same && found.is_within(kFeeds)) return EditClass::FeedAndSpeed;
    if (text.change == TextChange::Offsets || found.is_within(kFeeds | Difference::Offset))
      return EditClass::Offsets;
  } else {
    // Another run may take other branches: then the text has to be about no more than that. Of an F
    // or S word there it is not known whether it is a pitch, or of a spindle that is to turn.
    if (text.change == TextChange::Offsets) return EditClass::Offsets;
  }
  return found.has(Difference::Path) ? EditClass::Geometry : EditClass::Other;
}

Result<json> compare_programs(const ProgramSide& first, const ProgramSide& second,
                              const ProgramOptions& options) {
  using By = ProgramOptions::By;
  if (options.by != By::Text && (first.dialect == nullptr || second.dialect == nullptr))
    return fail(Errc::Unsupported, "the control of a program is not known");
  const auto text = text_of(first, second, options);
  if (!text) return fail(text.error());
  json result{{"by", options.by == By::Motion       ? "motion"
                     : options.by == By::Normalized ? "normalized"
                                                    : "text"}};
  if (options.by != By::Motion) {
    result["same"] = text->is_same;
    result["class"] = word_of(classify(*text, nullptr));
    result["text"] = text_json(first, second, *text, options);
    return result;
  }
  const auto motion = motion_of(first, second, options);
  if (!motion) return fail(motion.error());
  result["same"] = motion->is_unconditional() || (motion->is_same && text->is_same);
  result["class"] = word_of(classify(*text, &*motion));
  result["text"] = text_json(first, second, *text, options);
  result["motion"] = motion_json(first, second, *motion);
  return result;
}

}  // namespace dripline::comparison
