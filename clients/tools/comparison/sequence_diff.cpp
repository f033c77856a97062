#include "clients/tools/comparison/sequence_diff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dripline::comparison {
namespace {

using Index = std::ptrdiff_t;

/// Edits from each end before the search for the shortest script is given up.
constexpr Index kMinCost = 256;

/// A part of the two sequences: [x, x_end) and [y, y_end).
struct Box {
  Index x = 0, x_end = 0, y = 0, y_end = 0;
};
struct Point {
  Index x = 0, y = 0;
};

/// How far paths from one corner reach on each diagonal x - y.
class Frontier {
 public:
  Frontier(std::vector<Index>& reach, Index diagonals_before, Index start, Index outside)
      : reach_(reach), zero_(diagonals_before), low_(start), high_(start), outside_(outside) {}

  Index& operator[](Index diagonal) { return reach_[static_cast<std::size_t>(diagonal + zero_)]; }
  bool has(Index diagonal) const { return diagonal >= low_ && diagonal <= high_; }
  Index low() const { return low_; }
  Index high() const { return high_; }
  /// One edit more: a diagonal more on each side, as long as the box has it.
  void widen(Index least, Index most) {
    if (low_ > least) {
      (*this)[--low_ - 1] = outside_;
    } else {
      ++low_;
    }
    if (high_ < most) {
      (*this)[++high_ + 1] = outside_;
    } else {
      --high_;
    }
  }

 private:
  std::vector<Index>& reach_;
  Index zero_, low_, high_, outside_;
};

class Differ {
 public:
  Differ(std::span<const std::uint32_t> first, std::span<const std::uint32_t> second)
      : a_(first),
        b_(second),
        forward_(first.size() + second.size() + 3),
        backward_(forward_.size()),
        max_cost_(std::max(kMinCost, static_cast<Index>(std::sqrt(
                                         static_cast<double>(first.size() + second.size()))))) {}

  std::vector<EditRun> run() {
    // A stack instead of recursion: the depth of a text that a stranger wrote is not bounded.
    std::vector<Box> open{{0, static_cast<Index>(a_.size()), 0, static_cast<Index>(b_.size())}};
    while (!open.empty()) {
      Box box = open.back();
      open.pop_back();
      trim(box);
      if (box.x == box.x_end || box.y == box.y_end) {
        add(box);
        continue;
      }
      const Point middle = find_middle(box);
      open.push_back({middle.x, box.x_end, middle.y, box.y_end});
      open.push_back({box.x, middle.x, box.y, middle.y});
    }
    return std::move(runs_);
  }

 private:
  bool is_same(Index x, Index y) const {
    return a_[static_cast<std::size_t>(x)] == b_[static_cast<std::size_t>(y)];
  }

  void trim(Box& box) const {
    while (box.x < box.x_end && box.y < box.y_end && is_same(box.x, box.y)) ++box.x, ++box.y;
    while (box.x < box.x_end && box.y < box.y_end && is_same(box.x_end - 1, box.y_end - 1))
      --box.x_end, --box.y_end;
  }

  void add(const Box& box) {
    if (box.x == box.x_end && box.y == box.y_end) return;
    const auto x = static_cast<std::size_t>(box.x), y = static_cast<std::size_t>(box.y);
    const auto width = static_cast<std::size_t>(box.x_end - box.x);
    const auto height = static_cast<std::size_t>(box.y_end - box.y);
    if (!runs_.empty() && runs_.back().first + runs_.back().first_count == x &&
        runs_.back().second + runs_.back().second_count == y) {
      runs_.back().first_count += width;
      runs_.back().second_count += height;
    } else {
      runs_.push_back({x, width, y, height});
    }
  }

  /// A point of a shortest path, found from both corners at once; beyond the cost limit the point
  /// that is furthest from its corner.
  Point find_middle(const Box& box) {
    const Index least = box.x - box.y_end, most = box.x_end - box.y;
    const Index zero = static_cast<Index>(b_.size()) + 1;
    Frontier forward(forward_, zero, box.x - box.y, -1);
    Frontier backward(backward_, zero, box.x_end - box.y_end, std::numeric_limits<Index>::max());
    const bool is_odd = ((forward.low() - backward.low()) & 1) != 0;
    forward[forward.low()] = box.x;
    backward[backward.low()] = box.x_end;
    for (Index cost = 1;; ++cost) {
      forward.widen(least, most);
      for (Index d = forward.high(); d >= forward.low(); d -= 2) {
        const Index x = reach_forward(box, forward, d);
        if (is_odd && backward.has(d) && backward[d] <= x) return {x, x - d};
      }
      backward.widen(least, most);
      for (Index d = backward.high(); d >= backward.low(); d -= 2) {
        const Index x = reach_backward(box, backward, d);
        if (!is_odd && forward.has(d) && x <= forward[d]) return {x, x - d};
      }
      if (cost >= max_cost_) return furthest(box, forward, backward);
    }
  }

  Index reach_forward(const Box& box, Frontier& reach, Index d) const {
    Index x = std::max(reach[d - 1] + 1, reach[d + 1]);
    while (x < box.x_end && x - d < box.y_end && is_same(x, x - d)) ++x;
    return reach[d] = x;
  }
  Index reach_backward(const Box& box, Frontier& reach, Index d) const {
    Index x = std::min(reach[d - 1], reach[d + 1] - 1);
    while (x > box.x && x - d > box.y && is_same(x - 1, x - d - 1)) --x;
    return reach[d] = x;
  }

  static Point furthest(const Box& box, Frontier& forward, Frontier& backward) {
    Point best{box.x, box.y};
    Index gained = 0;
    for (Index d = forward.high(); d >= forward.low(); d -= 2) {
      const Index x = std::min({forward[d], box.x_end, box.y_end + d});
      if (x - box.x + (x - d) - box.y <= gained) continue;
      gained = x - box.x + (x - d) - box.y;
      best = {x, x - d};
    }
    for (Index d = backward.high(); d >= backward.low(); d -= 2) {
      const Index x = std::max({backward[d], box.x, box.y + d});
      if (box.x_end - x + box.y_end - (x - d) <= gained) continue;
      gained = box.x_end - x + box.y_end - (x - d);
      best = {x, x - d};
    }
    return best;
  }

  std::span<const std::uint32_t> a_, b_;
  std::vector<Index> forward_, backward_;
  Index max_cost_;
  std::vector<EditRun> runs_;
};

}  // namespace

namespace {

/// The elements of a sequence that the other one has too. The rest is edits in any case, and
/// without it the search for what moved far needs few steps.
struct Shared {
  Shared(std::span<const std::uint32_t> all, const std::vector<bool>& is_in_other)
      : is_edit(all.size(), true) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] >= is_in_other.size() || !is_in_other[all[i]]) continue;
      elements.push_back(all[i]);
      places.push_back(i);
      is_edit[i] = false;
    }
  }
  void mark(std::size_t begin, std::size_t count) {
    for (std::size_t i = begin; i < begin + count; ++i) is_edit[places[i]] = true;
  }

  std::vector<std::uint32_t> elements;
  std::vector<std::size_t> places;
  std::vector<bool> is_edit;  ///< of all elements
};

std::vector<bool> elements_of(std::span<const std::uint32_t> sequence) {
  std::vector<bool> has;
  for (const std::uint32_t element : sequence) {
    if (element >= has.size()) has.resize(element + std::size_t{1});
    has[element] = true;
  }
  return has;
}

}  // namespace

std::vector<EditRun> diff_sequences(std::span<const std::uint32_t> first,
                                    std::span<const std::uint32_t> second) {
  Shared a(first, elements_of(second)), b(second, elements_of(first));
  for (const EditRun& run : Differ(a.elements, b.elements).run()) {
    a.mark(run.first, run.first_count);
    b.mark(run.second, run.second_count);
  }
  std::vector<EditRun> runs;
  for (std::size_t x = 0, y = 0; x < first.size() || y < second.size(); ++x, ++y) {
    EditRun run{x, 0, y, 0};
    while (x < first.size() && a.is_edit[x]) ++x;
    while (y < second.size() && b.is_edit[y]) ++y;
    run.first_count = x - run.first;
    run.second_count = y - run.second;
    if (run.first_count + run.second_count > 0) runs.push_back(run);
  }
  return runs;
}

}  // namespace dripline::comparison
