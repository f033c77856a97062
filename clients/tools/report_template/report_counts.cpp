// The part of the interpreter that knows the numbers of counted reports.
#include <algorithm>

#include "clients/tools/report_template/impl/kept_line.hpp"
#include "clients/tools/report_template/report_interpreter.hpp"

namespace dripline::report_template {
namespace {

constexpr std::size_t kMaxGaps = 256;  ///< of counts, in a part; more are reported at once

std::string counts_text(std::int64_t from, std::int64_t to) {
  return from == to ? fmt::format("line {} did not come", from)
                    : fmt::format("lines {} to {} did not come", from, to);
}

}  // namespace

bool ReportInterpreter::take_count(std::int64_t count, std::string_view line,
                                   std::vector<ReportEvent>& events) {
  const std::int64_t next = state_.highest ? *state_.highest + 1 : template_->first_count;
  if (count < next) return take_earlier(count, line, events);
  if (count > next) {
    if (state_.missing.size() >= kMaxGaps) {
      const auto [from, to] = state_.missing.front();
      add_fault(FindingKind::Missing, counts_text(from, to), events);
      state_.missing.erase(state_.missing.begin());
    }
    state_.missing.emplace_back(next, count - 1);
  }
  state_.highest = count;
  keep_line(count, line);
  return true;
}

/// Which of two different numbers is right is not known. What the template states is for parts
/// whose lines state nothing.
void ReportInterpreter::take_expected(std::int64_t expected, std::string_view line,
                                      std::vector<ReportEvent>& events) {
  const auto count = static_cast<std::uint64_t>(expected);
  if (state_.has_expected && state_.expected != count) {
    return add_fault(FindingKind::BadValue,
                     fmt::format("expected in '{}' is {}, an earlier line has {}", kept_line(line),
                                 count, *state_.expected),
                     events);
  }
  state_.expected = count;
  state_.has_expected = true;
}

bool ReportInterpreter::take_earlier(std::int64_t count, std::string_view line,
                                     std::vector<ReportEvent>& events) {
  const auto gap = std::ranges::find_if(state_.missing, [&](const auto& missing) {
    return missing.first <= count && count <= missing.second;
  });
  if (gap == state_.missing.end()) {
    find_doubled(count, line, events);
    return false;
  }
  add_finding(FindingKind::Reordered,
              fmt::format("line {} came after line {}", count, *state_.highest), events);
  const auto [from, to] = *gap;
  const auto at = state_.missing.erase(gap);
  std::vector<std::pair<std::int64_t, std::int64_t>> rest;
  if (from < count) rest.emplace_back(from, count - 1);
  if (count < to) rest.emplace_back(count + 1, to);
  state_.missing.insert(at, rest.begin(), rest.end());
  keep_line(count, line);
  return true;
}

/// Nothing is taken from it. Which of two different lines is right is not known.
void ReportInterpreter::find_doubled(std::int64_t count, std::string_view line,
                                     std::vector<ReportEvent>& events) {
  const std::string again = kept_line(line);
  const auto first = state_.kept.find(count);
  if (first == state_.kept.end()) {
    add_fault(FindingKind::Doubled,
              fmt::format("line {} came again as '{}', too late to be compared with the first",
                          count, again),
              events);
  } else if (first->second != again) {
    add_fault(FindingKind::Doubled,
              fmt::format("line {} came again as '{}', first as '{}'", count, again, first->second),
              events);
  } else {
    add_finding(FindingKind::Doubled, fmt::format("line {} came again", count), events);
  }
}

void ReportInterpreter::keep_line(std::int64_t count, std::string_view line) {
  state_.kept[count] = kept_line(line);
  if (state_.kept.size() > ReportState::kMaxKept) state_.kept.erase(state_.kept.begin());
}

/// At the end of a part: what did not come.
void ReportInterpreter::find_missing(std::vector<ReportEvent>& events) {
  if (const LineForm* form = next_of_partial()) {
    add_fault(
        FindingKind::Incomplete,
        fmt::format("'{}' did not come after '{}'", form->text(), state_.partial->texts.back()),
        events);
  }
  for (const auto& [from, to] : state_.missing)
    add_fault(FindingKind::Missing, counts_text(from, to), events);
  if (state_.expected) {
    const auto expected = static_cast<std::int64_t>(*state_.expected);
    const auto last = template_->first_count + expected - 1;
    if (state_.highest && *state_.highest < last) {
      add_fault(FindingKind::Missing, counts_text(*state_.highest + 1, last), events);
    } else if (state_.highest && *state_.highest > last) {
      add_fault(FindingKind::Doubled,
                fmt::format("line {} came, {} were expected", *state_.highest, expected), events);
    } else if (!state_.highest && state_.lines != *state_.expected) {
      add_fault(state_.lines < *state_.expected ? FindingKind::Missing : FindingKind::Doubled,
                fmt::format("{} lines with values came, {} were expected", state_.lines, expected),
                events);
    }
  }
  for (const auto& [name, definition] : template_->characteristics) {
    if (definition.is_required && !state_.seen.contains(name))
      add_fault(FindingKind::Incomplete, fmt::format("{} was not measured", name), events);
  }
}

}  // namespace dripline::report_template
