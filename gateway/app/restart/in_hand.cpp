#include "gateway/app/restart/in_hand.hpp"

#include <algorithm>

namespace dripline::gateway {

using machine::GivenAction;

namespace {

/// With so many actions done; ends of blocks that do nothing are reached with what is before them.
report::Progress progress_after(const InHand& in_hand, std::size_t done,
                                const report::Progress& executed) {
  report::Progress reached = executed;
  for (std::size_t i = 0; i < in_hand.size(); ++i) {
    const GivenAction& action = in_hand[i].action;
    if (i >= done && action.kind != GivenAction::Kind::BlockEnd) break;
    if (!action.ends_block) continue;
    reached = in_hand[i].place;
    reached.sent = executed.sent;
    reached.accepted = executed.accepted;
  }
  return reached;
}

}  // namespace

InHand motion_of(InHand entries) {
  const auto other = std::ranges::find_if(
      entries, [](const auto& entry) { return entry.action.kind == GivenAction::Kind::Other; });
  entries.erase(other, entries.end());
  const bool has_motion = std::ranges::any_of(
      entries, [](const auto& entry) { return entry.action.kind == GivenAction::Kind::Motion; });
  return has_motion ? entries : InHand();
}

bool resolve(InHand& in_hand, const std::optional<GivenAction::Point>& at,
             report::Progress& executed) {
  if (in_hand.empty()) return true;
  if (!at) return false;
  std::vector<GivenAction> actions;
  actions.reserve(in_hand.size());
  for (const auto& entry : in_hand) actions.push_back(entry.action);
  const auto reached = machine::reached(actions, *at);
  if (!reached) return false;
  const report::Progress least = progress_after(in_hand, reached->least, executed);
  const bool is_certain =
      least.executed == progress_after(in_hand, reached->most, executed).executed;
  executed = least;
  if (is_certain) {
    in_hand.clear();
  } else {
    std::erase_if(
        in_hand, [&](const auto& entry) { return entry.action.origin.block <= executed.executed; });
  }
  return is_certain;
}

std::uint64_t last_block(const InHand& in_hand) {
  return in_hand.empty() ? 0 : in_hand.back().action.origin.block;
}

}  // namespace dripline::gateway
