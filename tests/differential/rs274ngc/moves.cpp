#include "tests/differential/rs274ngc/moves.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <cmath>

namespace dripline::differential {
namespace {

constexpr double kStanding = 1e-6;

/// Along one and the same axis, and in its direction.
bool continues(const std::array<double, 6>& before, const std::array<double, 6>& at,
               const std::array<double, 6>& to) {
  int axes = 0;
  bool is_onward = true;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double first = at[i] - before[i], second = to[i] - at[i];
    if (std::fabs(first) <= kStanding && std::fabs(second) <= kStanding) continue;
    ++axes;
    is_onward &= first * second > 0;
  }
  return axes == 1 && is_onward;
}

bool is_same(const Move& a, const Move& b, double tolerance) {
  if (a.kind != b.kind || !is_near(a.to, b.to, tolerance)) return false;
  if (a.kind != Move::Kind::Arc) return true;
  return a.plane == b.plane && a.circles == b.circles &&
         std::fabs(a.center[0] - b.center[0]) <= tolerance &&
         std::fabs(a.center[1] - b.center[1]) <= tolerance;
}

}  // namespace

bool is_near(const std::array<double, 6>& a, const std::array<double, 6>& b, double within) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::fabs(a[i] - b[i]) > within) return false;
  }
  return true;
}

std::string text_of(const Move& move) {
  constexpr const char* kKinds[] = {"rapid", "feed", "arc"};
  std::string text =
      fmt::format("{} {:.6f}", kKinds[static_cast<int>(move.kind)], fmt::join(move.to, " "));
  if (move.kind == Move::Kind::Arc) {
    text += fmt::format(" about {:.6f} plane {} circles {}", fmt::join(move.center, " "),
                        move.plane, move.circles);
  }
  return text;
}

void drop_standing_moves(Behavior& behavior) {
  std::vector<Move> kept;
  std::array<double, 6> at{};
  for (const Move& move : behavior.moves) {
    if (move.kind == Move::Kind::Arc || !is_near(at, move.to, kStanding)) kept.push_back(move);
    at = move.to;
  }
  behavior.moves = std::move(kept);
}

void join_feeds(Behavior& behavior) {
  std::vector<Move> kept;
  std::array<double, 6> before{}, at{};
  for (const Move& move : behavior.moves) {
    const bool are_feeds =
        !kept.empty() && kept.back().kind == Move::Kind::Feed && move.kind == Move::Kind::Feed;
    if (are_feeds && continues(before, at, move.to)) {
      kept.back() = move;
    } else {
      kept.push_back(move);
      before = at;
    }
    at = move.to;
  }
  behavior.moves = std::move(kept);
}

std::string difference(const Behavior& ours, const Behavior& peer, double tolerance) {
  const std::size_t both = std::min(ours.moves.size(), peer.moves.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (is_same(ours.moves[i], peer.moves[i], tolerance)) continue;
    return fmt::format("move {}: ours {}; peer {}", i + 1, text_of(ours.moves[i]),
                       text_of(peer.moves[i]));
  }
  if (ours.is_accepted != peer.is_accepted) {
    return ours.is_accepted ? "only the peer refuses it: " + peer.complaint
                            : "only we refuse it: " + ours.complaint;
  }
  if (ours.moves.size() == peer.moves.size()) return {};
  const bool is_ours = ours.moves.size() > both;
  return fmt::format("{} moves more, the first: {}", is_ours ? "ours has" : "the peer has",
                     text_of((is_ours ? ours : peer).moves[both]));
}

}  // namespace dripline::differential
