#include "clients/tools/conversational/sequence.hpp"

#include <algorithm>
#include <set>

#include "clients/tools/conversational/fields.hpp"

namespace dripline::conversational {
namespace {

/// The number of the pattern an event begins.
std::optional<int> begun_pattern(const Event& event) {
  if (const auto* rough = std::get_if<RoughCycle>(&event)) return rough->pattern;
  if (const auto* repeat = std::get_if<PatternRepeat>(&event)) return repeat->pattern;
  return std::nullopt;
}

struct Walk {
  const Events& events;
  std::optional<int> open;
  std::set<int> ended;

  template <class... Args>
  Result<void> wrong(std::size_t number, fmt::format_string<Args...> format, Args&&... args) const {
    return fail(Errc::Syntax, "event {} ({}): {}", number, kind_of(events[number]).type,
                fmt::format(format, std::forward<Args>(args)...));
  }
  Result<void> check_ends(std::size_t number) const {
    const bool is_setup = std::holds_alternative<ProgramSetup>(events[number]);
    const bool is_end = std::holds_alternative<EndOfProgram>(events[number]);
    if (is_setup != (number == 0)) {
      return wrong(number, "event 0 and no other is the program_setup");
    }
    if (is_end != (number + 1 == events.size())) {
      return wrong(number, "the last event and no other is the end_of_program");
    }
    return {};
  }
  Result<void> begin(std::size_t number, int pattern) {
    if (open) return wrong(number, "pattern {} has not ended: end_cycle is missing", *open);
    if (ended.contains(pattern)) return wrong(number, "there is a pattern {} already", pattern);
    open = pattern;
    return {};
  }
  Result<void> end(std::size_t number) {
    if (!open) return wrong(number, "no pattern has begun");
    ended.insert(*open);
    open.reset();
    return {};
  }
  Result<void> check_pattern(std::size_t number) {
    const Event& event = events[number];
    if (const auto pattern = begun_pattern(event)) return begin(number, *pattern);
    if (std::holds_alternative<EndCycle>(event)) return end(number);
    const bool is_end = std::holds_alternative<EndOfProgram>(event);
    const auto* finish = std::get_if<FinishCycle>(&event);
    if (open && (is_end || finish != nullptr)) {
      return wrong(number, "pattern {} has not ended: end_cycle is missing", *open);
    }
    if (finish != nullptr && !(finish->pattern && ended.contains(*finish->pattern))) {
      return wrong(number, "pattern = {}: no such pattern before it", finish->pattern.value_or(0));
    }
    return {};
  }
};

}  // namespace

Result<void> check_sequence(const Events& events) {
  if (events.empty()) return fail(Errc::Syntax, "there is no event");
  Walk walk{events, {}, {}};
  for (std::size_t number = 0; number < events.size(); ++number) {
    if (auto checked = walk.check_ends(number); !checked) return checked;
    if (auto checked = walk.check_pattern(number); !checked) return checked;
  }
  return {};
}

}  // namespace dripline::conversational
