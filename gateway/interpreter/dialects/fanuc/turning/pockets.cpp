#include "gateway/interpreter/dialects/fanuc/turning/pockets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dripline::interpreter::fanuc {
namespace {

bool is_close(double a, double b) {
  return std::fabs(a - b) <= kSameLength;
}
bool falls(const ProfilePiece& piece) {
  return piece.to.depth < piece.from.depth - kSameLength;
}
bool rises(const ProfilePiece& piece) {
  return piece.to.depth > piece.from.depth + kSameLength;
}

/// A cut at one level, in the cut of the level before that leads to it.
struct Cut {
  OpenInterval interval;
  std::size_t level = 1;
  std::vector<std::size_t> inner;  ///< cuts of the next level
};

double level_of(const PocketCuts& cuts, std::size_t number) {
  return cuts.begin.depth - static_cast<double>(number) * cuts.depth;
}

/// All cuts, level by level: `count_at_first` of them are those of the first level.
struct CutTree {
  std::vector<Cut> cuts;
  std::size_t count_at_first = 0;
};

std::optional<CutTree> find_cuts(const PocketCuts& cuts, std::size_t max_cuts) {
  CutTree tree;
  std::size_t above = 0;  // where the cuts of the level before begin
  for (std::size_t number = 1; number <= max_cuts; ++number) {
    const auto found = open_at(cuts.profile, level_of(cuts, number), cuts.begin.along);
    if (found.empty()) return tree;
    const std::size_t here = tree.cuts.size();
    if (here + found.size() > max_cuts) return std::nullopt;
    std::size_t outer = above;
    for (const OpenInterval& interval : found) {
      // Both levels are in order along the cut, and what is free here is free at the level before.
      while (outer + 1 < here && tree.cuts[outer].interval.to <= interval.from) ++outer;
      if (number > 1) tree.cuts[outer].inner.push_back(tree.cuts.size());
      tree.cuts.push_back({interval, number, {}});
    }
    if (number == 1) tree.count_at_first = found.size();
    above = here;
  }
  return std::nullopt;
}

/// Writes the cuts; knows where the tool is.
class CutWriter {
 public:
  explicit CutWriter(const PocketCuts& cuts) : cuts_(cuts), tool_(cuts.begin) {}

  void cut(const Cut& each) {
    const double level = level_of(cuts_, each.level);
    const double above = level_of(cuts_, each.level - 1);
    const double clear = std::min(above + cuts_.escape, cuts_.begin.depth);
    if (each.interval.is_open_at_start) {
      travel(clear, cuts_.begin.along);
      add({.kind = PassMove::Kind::Approach, .to = {level, cuts_.begin.along}});
    } else {
      enter(each.interval, level, above, clear);
    }
    feed({level, each.interval.to});
    climb(each.interval.closing_piece, above);
    rapid({std::max(tool_.depth, clear), tool_.along});
  }
  void leave() {
    rapid({cuts_.begin.depth, tool_.along});
    rapid(cuts_.begin);
  }
  std::vector<PassMove> take() { return std::move(moves_); }

 private:
  const ProfilePieces& profile() const { return cuts_.profile; }

  /// Over what has been cut: up first, down last.
  void travel(double clear, double along) {
    if (tool_.depth < clear) rapid({clear, tool_.along});
    rapid({tool_.depth, along});
    rapid({clear, along});
  }

  /// Down along the wall through which the contour comes to the level, from the level above or
  /// from the top of the wall.
  void enter(const OpenInterval& interval, double level, double above, double clear) {
    std::size_t first = interval.opening_piece;
    const auto reaches = [&] { return profile()[first].from.depth >= above - kSameLength; };
    while (!reaches() && first > 0 && !rises(profile()[first - 1])) --first;
    while (!falls(profile()[first]) && first < interval.opening_piece) ++first;
    const ProfilePiece& top = profile()[first];
    const bool is_through = reaches();
    const ProfilePoint begin = is_through ? ProfilePoint{above, along_at(top, above)} : top.from;
    travel(clear, begin.along);
    feed({above, begin.along});
    feed(begin);
    for (std::size_t i = first; i < interval.opening_piece; ++i)
      follow(profile()[i], profile()[i].to);
    follow(profile()[interval.opening_piece], {level, interval.from});
  }

  /// Up along the contour to the level above, or to where it goes down again.
  void climb(std::size_t piece, double above) {
    for (; piece < profile().size() && tool_.depth < above - kSameLength; ++piece) {
      const ProfilePiece& each = profile()[piece];
      if (falls(each)) break;
      const bool is_last = each.to.depth >= above - kSameLength;
      follow(each, is_last ? ProfilePoint{above, along_at(each, above)} : each.to);
    }
    if (tool_.depth < above) feed({above, tool_.along});
  }

  void follow(const ProfilePiece& piece, const ProfilePoint& to) {
    if (!piece.is_arc) return feed(to);
    add({PassMove::Kind::Arc, to, piece.center, piece.is_counterclockwise});
  }
  void feed(const ProfilePoint& to) { add({.kind = PassMove::Kind::Line, .to = to}); }
  void rapid(const ProfilePoint& to) { add({.kind = PassMove::Kind::Rapid, .to = to}); }

  void add(const PassMove& move) {
    if (is_close(move.to.depth, tool_.depth) && is_close(move.to.along, tool_.along)) return;
    moves_.push_back(move);
    tool_ = move.to;
  }

  const PocketCuts& cuts_;
  ProfilePoint tool_;
  std::vector<PassMove> moves_;
};

/// The height of a profile at a place; places come in order.
class Heights {
 public:
  explicit Heights(const ProfilePieces& profile) : profile_(profile) {}
  std::optional<double> at(double along) {
    if (profile_.empty() || along < profile_.front().from.along) return {};
    while (piece_ < profile_.size() && profile_[piece_].to.along < along) ++piece_;
    if (piece_ == profile_.size()) return {};
    return depth_at(profile_[piece_], along);
  }

 private:
  const ProfilePieces& profile_;
  std::size_t piece_ = 0;
};

}  // namespace

std::size_t count_pockets(const PocketCuts& cuts) {
  std::size_t count = 0;
  // A first piece from where the cuts begin leads to the contour; it makes no pocket.
  bool is_falling = !cuts.profile.empty() && falls(cuts.profile.front()) &&
                    is_close(cuts.profile.front().from.depth, cuts.begin.depth);
  for (const ProfilePiece& piece : cuts.profile) {
    if (rises(piece)) is_falling = false;
    if (falls(piece) && !std::exchange(is_falling, true)) ++count;
  }
  return count;
}

bool reaches_into(const ProfilePieces& shifted, const ProfilePieces& part) {
  std::vector<double> places;
  for (const ProfilePieces* profile : {&shifted, &part}) {
    for (const ProfilePiece& piece : *profile) {
      places.push_back(piece.from.along);
      places.push_back(piece.to.along);
    }
  }
  std::sort(places.begin(), places.end());
  Heights above(shifted);
  Heights below(part);
  constexpr int kSamples = 16;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double width = places[i] - places[i - 1];
    if (width <= kSameLength) continue;
    for (int n = 0; n <= kSamples; ++n) {
      // Beside the ends: walls are there.
      const double part_of_width = std::clamp(n / double{kSamples}, 1e-6, 1 - 1e-6);
      const double along = places[i - 1] + part_of_width * width;
      const auto high = above.at(along);
      const auto low = below.at(along);
      if (high && low && *high < *low - kSameLength) return true;
    }
  }
  return false;
}

std::optional<std::vector<PassMove>> cut_pockets(const PocketCuts& cuts, std::size_t max_cuts) {
  const auto tree = find_cuts(cuts, max_cuts);
  if (!tree) return std::nullopt;
  CutWriter writer(cuts);
  // Each pocket to its bottom before the next one.
  std::vector<std::size_t> open;
  for (std::size_t i = tree->count_at_first; i > 0; --i) open.push_back(i - 1);
  while (!open.empty()) {
    const Cut& each = tree->cuts[open.back()];
    open.pop_back();
    writer.cut(each);
    open.insert(open.end(), each.inner.rbegin(), each.inner.rend());
  }
  writer.leave();
  return writer.take();
}

}  // namespace dripline::interpreter::fanuc
