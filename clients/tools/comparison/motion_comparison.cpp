#include "clients/tools/comparison/motion_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "clients/tools/comparison/action_reader.hpp"

namespace dripline::comparison {
namespace {

/// Actions compared between two returns of `step`.
constexpr std::size_t kStride = 4096;
/// Where both do the same again is looked for in so many actions of each, then in more.
constexpr std::size_t kFirstWindow = 256;
constexpr std::size_t kLastWindow = 65'536;
constexpr std::size_t kWindowGrowth = 4;
/// So many actions in a row are the same where the programs are said to agree again.
constexpr std::size_t kAgreed = 3;
/// Replaced actions, each by one, are looked for up to this length before anything else.
constexpr std::size_t kMaxReplaced = 8;
/// Actions of one key that are tried: a program that often comes to one point costs no more.
constexpr std::size_t kMaxTried = 8;
/// An action of a place with several is looked at for a change of order up to this number.
constexpr std::size_t kMaxPermuted = 32;
/// Actions of a gap in which those that both programs have are looked for.
constexpr std::size_t kMaxAligned = 32;

/// Actions that are alike have the same key, but for those at the edge of a step of the grid.
std::uint64_t key_of(const Action& action, double grid) {
  std::uint64_t key = static_cast<std::uint64_t>(action.kind) + 1;
  const auto mix = [&key](std::uint64_t value) {
    key = (key ^ value) * 0x9e3779b97f4a7c15;
    key ^= key >> 29;
  };
  if (!is_move(action.kind)) {
    mix(static_cast<std::uint64_t>(action.code));
    mix(std::hash<std::string>()(action.text));
    return key;
  }
  for (const auto axis : {interpreter::Axis::X, interpreter::Axis::Y, interpreter::Axis::Z}) {
    const double steps = std::clamp(std::round(action.to.raw(axis) / grid), -1e15, 1e15);
    mix(static_cast<std::uint64_t>(std::isnan(steps) ? 0 : static_cast<std::int64_t>(steps)));
  }
  return key;
}

struct Gap {
  std::size_t first = 0, second = 0;
};

}  // namespace

std::string_view word_of(Condition::Kind kind) {
  constexpr std::string_view kWords[]{"alarm", "fault", "probe",    "prompt",
                                      "input", "clock", "variable", "block_skip"};
  return kWords[static_cast<std::size_t>(kind)];
}

struct MotionComparison::Parts {
  Parts(const MotionSide& a, const MotionSide& b, MotionOptions chosen)
      : options(chosen),
        agreement{chosen.tolerance, a.dialect.name != b.dialect.name},
        sides{a, b},
        first(sides[0], agreement.across_controls),
        second(sides[1], agreement.across_controls) {
    result.tolerance = chosen.tolerance;
    result.across_controls = agreement.across_controls;
  }

  bool step();
  bool is_pair(std::size_t i, std::size_t j) const {
    return is_alike(first[i], second[j], agreement);
  }
  bool agree_from(std::size_t i, std::size_t j, std::size_t a, std::size_t b) const;
  void pass_difference();
  std::optional<Gap> find_replaced(std::size_t a, std::size_t b) const;
  std::optional<Gap> find_agreement(std::size_t a, std::size_t b) const;
  void report(const Gap& gap);
  bool is_permuted(const Gap& gap) const;
  void report_pair(std::size_t i, std::size_t j);
  void report_between(const Gap& from, const Gap& to);
  void add(MotionPlace place);
  MotionPlace place_at(std::size_t i, std::size_t j, const Gap& gap);

  MotionOptions options;
  Agreement agreement;
  std::array<MotionSide, 2> sides;
  ActionReader first, second;
  MotionResult result;
};

bool MotionComparison::Parts::step() {
  for (std::size_t i = 0; i < kStride; ++i) {
    const std::size_t a = first.fill(1), b = second.fill(1);
    if (a == 0 && b == 0) {
      first.add_conditions(false, result.conditions);
      second.add_conditions(true, result.conditions);
      return true;
    }
    if (a == 0 || b == 0 || !is_pair(0, 0)) {
      pass_difference();
      continue;
    }
    report_pair(0, 0);
    first.drop(1);
    second.drop(1);
  }
  return false;
}

bool MotionComparison::Parts::agree_from(std::size_t i, std::size_t j, std::size_t a,
                                         std::size_t b) const {
  for (std::size_t k = 0; k < kAgreed; ++k) {
    if (i + k == a || j + k == b) return i + k == a && j + k == b;
    if (!is_pair(i + k, j + k)) return false;
  }
  return true;
}

/// Each of some actions has another one of its kind in its place.
std::optional<Gap> MotionComparison::Parts::find_replaced(std::size_t a, std::size_t b) const {
  const std::size_t most = std::min({a, b, kMaxReplaced});
  for (std::size_t i = 0; i < most && first[i].kind == second[i].kind; ++i) {
    if (i + 1 < a && i + 1 < b && is_pair(i + 1, i + 1)) return Gap{i + 1, i + 1};
  }
  return std::nullopt;
}

/// The shortest gap after which both do the same.
std::optional<Gap> MotionComparison::Parts::find_agreement(std::size_t a, std::size_t b) const {
  const double grid = std::max(agreement.tolerance * 4, 1e-6);
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_key;
  by_key.reserve(b);
  for (std::size_t j = 0; j < b; ++j) {
    auto& tried = by_key[key_of(second[j], grid)];
    if (tried.size() < kMaxTried) tried.push_back(static_cast<std::uint32_t>(j));
  }
  std::optional<Gap> best;
  for (std::size_t i = 0; i < a && (!best || i < best->first + best->second); ++i) {
    const auto found = by_key.find(key_of(first[i], grid));
    if (found == by_key.end()) continue;
    for (const std::size_t j : found->second) {
      if (best && i + j >= best->first + best->second) break;
      if (agree_from(i, j, a, b)) best = Gap{i, j};
    }
  }
  return best;
}

void MotionComparison::Parts::pass_difference() {
  Gap gap;
  for (std::size_t window = kFirstWindow;; window *= kWindowGrowth) {
    const std::size_t a = std::min(first.fill(window), window);
    const std::size_t b = std::min(second.fill(window), window);
    if (const auto replaced = find_replaced(a, b)) {
      gap = *replaced;
      break;
    }
    if (const auto agreement_after = find_agreement(a, b)) {
      gap = *agreement_after;
      break;
    }
    gap = {a, b};
    if ((a < window && b < window) || window >= kLastWindow) break;
  }
  report(gap);
  first.drop(gap.first);
  second.drop(gap.second);
}

bool MotionComparison::Parts::is_permuted(const Gap& gap) const {
  if (gap.first != gap.second || gap.first < 2 || gap.first > kMaxPermuted) return false;
  std::array<bool, kMaxPermuted> used{};
  for (std::size_t i = 0; i < gap.first; ++i) {
    std::size_t j = 0;
    while (j < gap.second && (used[j] || first[i].kind != second[j].kind ||
                              !differences(first[i], second[j], agreement).empty()))
      ++j;
    if (j == gap.second) return false;
    used[j] = true;
  }
  return true;
}

MotionPlace MotionComparison::Parts::place_at(std::size_t i, std::size_t j, const Gap& gap) {
  MotionPlace place;
  place.first_actions = gap.first;
  place.second_actions = gap.second;
  place.first = first.fill(i + 1) > i ? first[i].place : first.last_place();
  place.second = second.fill(j + 1) > j ? second[j].place : second.last_place();
  if (result.places.size() >= options.max_places) return place;
  if (gap.first > 0) place.first_text = describe(first[i]);
  if (gap.second > 0) place.second_text = describe(second[j]);
  return place;
}

/// Two actions of one kind.
void MotionComparison::Parts::report_pair(std::size_t i, std::size_t j) {
  const Differences found = differences(first[i], second[j], agreement);
  if (found.empty()) return;
  MotionPlace place = place_at(i, j, {1, 1});
  place.differences = found;
  if (found.has(Difference::Path)) place.distance = path_distance(first[i], second[j]);
  add(std::move(place));
}

void MotionComparison::Parts::report(const Gap& gap) {
  if (is_permuted(gap)) {
    MotionPlace place = place_at(0, 0, gap);
    place.differences = Difference::Order;
    return add(std::move(place));
  }
  if (gap.first > kMaxAligned || gap.second > kMaxAligned) return report_between({}, gap);
  // The longest sequence of actions that both have, from the end.
  std::array<std::array<std::uint8_t, kMaxAligned + 1>, kMaxAligned + 1> common{};
  for (std::size_t i = gap.first; i-- > 0;) {
    for (std::size_t j = gap.second; j-- > 0;) {
      common[i][j] = is_pair(i, j) ? static_cast<std::uint8_t>(common[i + 1][j + 1] + 1)
                                   : std::max(common[i + 1][j], common[i][j + 1]);
    }
  }
  Gap from, at;
  while (at.first < gap.first && at.second < gap.second) {
    if (is_pair(at.first, at.second)) {
      report_between(from, at);
      report_pair(at.first, at.second);
      from = {++at.first, ++at.second};
    } else if (common[at.first + 1][at.second] >= common[at.first][at.second + 1]) {
      ++at.first;
    } else {
      ++at.second;
    }
  }
  report_between(from, gap);
}

/// Actions that the other program has not, or has others of the same kinds for.
void MotionComparison::Parts::report_between(const Gap& from, const Gap& to) {
  const Gap size{to.first - from.first, to.second - from.second};
  if (size.first == 0 && size.second == 0) return;
  bool is_replaced = size.first == size.second;
  for (std::size_t i = 0; is_replaced && i < size.first; ++i)
    is_replaced = first[from.first + i].kind == second[from.second + i].kind;
  if (is_replaced) {
    for (std::size_t i = 0; i < size.first; ++i) report_pair(from.first + i, from.second + i);
    return;
  }
  MotionPlace place = place_at(from.first, from.second, size);
  for (std::size_t i = from.first; i < to.first; ++i)
    place.differences |= difference_of(first[i].kind);
  for (std::size_t j = from.second; j < to.second; ++j)
    place.differences |= difference_of(second[j].kind);
  add(std::move(place));
}

void MotionComparison::Parts::add(MotionPlace place) {
  result.is_same = false;
  ++result.place_count;
  result.differences |= place.differences;
  for (std::size_t i = 0; i < kDifferenceCount; ++i) {
    if (place.differences.has(static_cast<Difference>(i))) ++result.counts[i];
  }
  if (std::isfinite(place.distance))
    result.max_distance = std::max(result.max_distance, place.distance);
  if (result.places.size() < options.max_places) result.places.push_back(std::move(place));
}

MotionComparison::MotionComparison(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
MotionComparison::MotionComparison(MotionComparison&&) noexcept = default;
MotionComparison& MotionComparison::operator=(MotionComparison&&) noexcept = default;
MotionComparison::~MotionComparison() = default;

Result<MotionComparison> MotionComparison::begin(const MotionSide& first, const MotionSide& second,
                                                 MotionOptions options) {
  if (!(options.tolerance >= 0 && options.tolerance <= kMaxTolerance)) {
    return fail(Errc::LimitExceeded, "a tolerance of {} mm is not between 0 and {} mm",
                options.tolerance, kMaxTolerance);
  }
  auto parts = std::make_unique<Parts>(first, second, options);
  for (ActionReader* reader : {&parts->first, &parts->second}) {
    if (auto begun = reader->begin(options.max_blocks); !begun) return fail(begun.error());
  }
  return MotionComparison(std::move(parts));
}

bool MotionComparison::step() {
  return parts_->step();
}

MotionResult MotionComparison::result() const {
  MotionResult result = parts_->result;
  result.first_blocks = parts_->first.blocks();
  result.second_blocks = parts_->second.blocks();
  result.first_actions = parts_->first.dropped();
  result.second_actions = parts_->second.dropped();
  return result;
}

Result<MotionResult> compare_motion(const MotionSide& first, const MotionSide& second,
                                    MotionOptions options) {
  auto comparison = MotionComparison::begin(first, second, options);
  if (!comparison) return fail(comparison.error());
  while (!comparison->step()) {
  }
  return comparison->result();
}

}  // namespace dripline::comparison
