#include "server/app/impl/cut_off_rule.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dripline::app {
namespace {

/// A row that is not there any more is that of a server that ended or took another note.
template <class Map>
void drop_missing(Map& known, const std::vector<storage::WaitingServer>& waiting) {
  std::erase_if(known, [&](const auto& entry) {
    return std::ranges::find(waiting, entry.first, &storage::WaitingServer::described) ==
           waiting.end();
  });
}

}  // namespace

void CutOffRule::note(const std::vector<storage::WaitingServer>& waiting, SteadyTime now) {
  drop_missing(standbys_, waiting);
  for (const auto& server : waiting) {
    const auto [entry, is_new] = standbys_.try_emplace(server.described);
    Standby& known = entry->second;
    if (!is_new && known.seen != server.seen) known.changed = now;
    known.seen = server.seen;
    known.gateways = server.gateways.value_or(0);
  }
}

std::size_t CutOffRule::heard_elsewhere(SteadyTime now, std::chrono::milliseconds within) const {
  std::size_t most = 0;
  for (const auto& [name, standby] : standbys_)
    if (standby.changed && now - *standby.changed <= within)
      most = std::max(most, standby.gateways);
  return most;
}

std::chrono::seconds CutOffRule::pause() const {
  constexpr std::uint64_t kMaxDoublings = 6;
  const auto doublings =
      std::min(kept_.count - std::min<std::uint64_t>(kept_.count, 1), kMaxDoublings);
  return std::min(kFirstPause * (1 << doublings), kMaxPause);
}

CutOffRule::Judgment CutOffRule::judge(const Look& look) {
  const std::size_t elsewhere = heard_elsewhere(look.now, kFresh);
  return look.heard > 0 ? judge_hearing(look, elsewhere) : judge_silence(look, elsewhere);
}

CutOffRule::Judgment CutOffRule::judge_hearing(const Look& look, std::size_t elsewhere) {
  Judgment judgment;
  has_heard_ = true;
  silent_since_.reset();
  if (!heard_since_) heard_since_ = look.now;
  const storage::OwnHandOvers before = kept_;
  kept_.has_helped = true;
  if (kept_.count > 0 && look.now - *heard_since_ >= pause()) kept_.count = 0;
  if (kept_ != before) judgment.step = Step::Keep;
  if (elsewhere <= look.heard) {
    partial_since_.reset();
    return judgment;
  }
  if (!partial_since_) partial_since_ = look.now;
  if (look.now - *partial_since_ < kPartialFor) return judgment;
  judgment.finding = fmt::format(
      "this server hears {} gateways, and one that waits hears {}: some machines may not reach "
      "this "
      "server",
      look.heard, elsewhere);
  judgment.reason = "nothing is handed over while this server hears any gateway";
  return judgment;
}

bool CutOffRule::is_silent_for_long(SteadyTime now) const {
  // A gateway is heard until its lease has run out.
  const auto more = std::max(options_.silence - options_.lease, options_.lease / 2);
  if (has_heard_) return now - *silent_since_ >= more;
  return now - options_.began >= std::max<std::chrono::milliseconds>(more, kFirstSilence);
}

CutOffRule::Judgment CutOffRule::judge_silence(const Look& look, std::size_t elsewhere) {
  heard_since_.reset();
  partial_since_.reset();
  if (!silent_since_) silent_since_ = look.now;
  if (elsewhere == 0 || !is_silent_for_long(look.now)) return {};
  Judgment judgment;
  judgment.reason = reason_to_stay(look);
  if (judgment.reason.empty() && heard_elsewhere(look.now, kAwake) > 0)
    judgment.step = Step::HandOver;
  judgment.finding = fmt::format(
      "this server hears no gateway, and one that waits hears {}: no machine is fed", elsewhere);
  return judgment;
}

std::string CutOffRule::reason_to_stay(const Look& look) const {
  if (options_.silence.count() == 0) return "handover-s is 0: only people hand over";
  if (!has_heard_ && !look.is_machine_known)
    return "no machine of this library has had a gateway yet";
  if (kept_.count == 0) return {};
  if (!kept_.has_helped)
    return "the last hand-over of this kind has helped nothing: a person decides (dnc server "
           "drain)";
  if (look.now - options_.began < pause())
    return fmt::format("the library was handed over like this less than {} s ago", pause().count());
  return {};
}

}  // namespace dripline::app
