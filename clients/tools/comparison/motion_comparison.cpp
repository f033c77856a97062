#include "clients/tools/comparison/motion_comparison.hpp"

#include <fmt/format.h>
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
constexpr std::size_t kWindowGrowth = 4;
/// So many actions in a row are the same where the programs are taken to agree again.
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

}  // namespace

std::string_view word_of(Condition::Kind kind) {
  constexpr std::string_view kWords[]{"alarm", "fault",    "probe",      "prompt", "input",
                                      "clock", "variable", "block_skip", "start"};
  return kWords[static_cast<std::size_t>(kind)];
}

namespace motion_parts {  // members of MotionComparison::Parts

struct Gap {
  std::size_t first = 0, second = 0;
};

/// Both programs, interpreted and compared once.
class Pass {
 public:
  Pass(const std::array<MotionSide, 2>& sides, const MotionOptions& options, double shift)
      : options_(options),
        agreement_{options.tolerance,
                   options.across_controls || sides[0].dialect.name != sides[1].dialect.name},
        first_(sides[0], agreement_.across_controls, shift, options.started_axes),
        second_(sides[1], agreement_.across_controls, shift, options.started_axes) {
    result_.tolerance = options.tolerance;
    result_.across_controls = agreement_.across_controls;
  }

  Result<void> begin() {
    for (ActionReader* reader : {&first_, &second_}) {
      if (auto begun = reader->begin(options_); !begun) return fail(begun.error());
    }
    return {};
  }
  /// True: it is over.
  bool step();
  MotionResult result() const;

 private:
  bool is_pair(std::size_t i, std::size_t j) const {
    return is_alike(first_[i], second_[j], agreement_);
  }
  bool agree_from(std::size_t i, std::size_t j, std::size_t a, std::size_t b) const;
  void pass_difference();
  std::optional<Gap> find_replaced(std::size_t a, std::size_t b) const;
  std::optional<Gap> find_agreement(std::size_t a, std::size_t b) const;
  void report(const Gap& gap);
  bool is_permuted(const Gap& gap) const;
  void report_pair(std::size_t i, std::size_t j);
  void report_between(const Gap& from, const Gap& to);
  void compare_kept();
  void add(MotionPlace place);
  MotionPlace place_at(std::size_t i, std::size_t j, const Gap& gap);

  MotionOptions options_;
  Agreement agreement_;
  ActionReader first_, second_;
  MotionResult result_;
};

bool Pass::step() {
  for (std::size_t i = 0; i < kStride; ++i) {
    const std::size_t a = first_.fill(1), b = second_.fill(1);
    if (a == 0 && b == 0) {
      compare_kept();
      first_.add_conditions(false, result_.conditions);
      second_.add_conditions(true, result_.conditions);
      return true;
    }
    if (a == 0 || b == 0 || !is_pair(0, 0)) {
      pass_difference();
      continue;
    }
    report_pair(0, 0);
    first_.drop(1);
    second_.drop(1);
  }
  return false;
}

bool Pass::agree_from(std::size_t i, std::size_t j, std::size_t a, std::size_t b) const {
  for (std::size_t k = 0; k < kAgreed; ++k) {
    if (i + k == a || j + k == b) return i + k == a && j + k == b;
    if (!is_pair(i + k, j + k)) return false;
  }
  return true;
}

/// Each of some actions has another one of its kind in its place.
std::optional<Gap> Pass::find_replaced(std::size_t a, std::size_t b) const {
  const std::size_t most = std::min({a, b, kMaxReplaced});
  for (std::size_t i = 0; i < most && first_[i].kind == second_[i].kind; ++i) {
    if (i + 1 < a && i + 1 < b && is_pair(i + 1, i + 1)) return Gap{i + 1, i + 1};
  }
  return std::nullopt;
}

/// The shortest gap after which both do the same.
std::optional<Gap> Pass::find_agreement(std::size_t a, std::size_t b) const {
  const double grid = std::max(agreement_.tolerance * 4, 1e-6);
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_key;
  by_key.reserve(b);
  for (std::size_t j = 0; j < b; ++j) {
    auto& tried = by_key[key_of(second_[j], grid)];
    if (tried.size() < kMaxTried) tried.push_back(static_cast<std::uint32_t>(j));
  }
  std::optional<Gap> best;
  for (std::size_t i = 0; i < a && (!best || i < best->first + best->second); ++i) {
    const auto found = by_key.find(key_of(first_[i], grid));
    if (found == by_key.end()) continue;
    for (const std::size_t j : found->second) {
      if (best && i + j >= best->first + best->second) break;
      if (agree_from(i, j, a, b)) best = Gap{i, j};
    }
  }
  return best;
}

void Pass::pass_difference() {
  Gap gap;
  for (std::size_t window = kFirstWindow;; window *= kWindowGrowth) {
    const std::size_t a = std::min(first_.fill(window), window);
    const std::size_t b = std::min(second_.fill(window), window);
    if (const auto replaced = find_replaced(a, b)) {
      gap = *replaced;
      break;
    }
    if (const auto agreement_after = find_agreement(a, b)) {
      gap = *agreement_after;
      break;
    }
    gap = {a, b};
    if ((a < window && b < window) || window >= options_.max_window) break;
  }
  report(gap);
  first_.drop(gap.first);
  second_.drop(gap.second);
}

bool Pass::is_permuted(const Gap& gap) const {
  if (gap.first != gap.second || gap.first < 2 || gap.first > kMaxPermuted) return false;
  std::array<bool, kMaxPermuted> used{};
  for (std::size_t i = 0; i < gap.first; ++i) {
    std::size_t j = 0;
    while (j < gap.second && (used[j] || first_[i].kind != second_[j].kind ||
                              !differences(first_[i], second_[j], agreement_).empty()))
      ++j;
    if (j == gap.second) return false;
    used[j] = true;
  }
  return true;
}

MotionPlace Pass::place_at(std::size_t i, std::size_t j, const Gap& gap) {
  MotionPlace place;
  place.first_actions = gap.first;
  place.second_actions = gap.second;
  place.first = first_.fill(i + 1) > i ? first_[i].place : first_.last_place();
  place.second = second_.fill(j + 1) > j ? second_[j].place : second_.last_place();
  if (result_.places.size() >= options_.max_places) return place;
  if (gap.first > 0) place.first_text = describe(first_[i]);
  if (gap.second > 0) place.second_text = describe(second_[j]);
  return place;
}

/// Two actions of one kind.
void Pass::report_pair(std::size_t i, std::size_t j) {
  const Differences found = differences(first_[i], second_[j], agreement_);
  if (found.empty()) return;
  MotionPlace place = place_at(i, j, {1, 1});
  place.differences = found;
  if (found.has(Difference::Path)) place.distance = path_distance(first_[i], second_[j]);
  add(std::move(place));
}

void Pass::report(const Gap& gap) {
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
void Pass::report_between(const Gap& from, const Gap& to) {
  const Gap size{to.first - from.first, to.second - from.second};
  if (size.first == 0 && size.second == 0) return;
  bool is_replaced = size.first == size.second;
  for (std::size_t i = 0; is_replaced && i < size.first; ++i)
    is_replaced = first_[from.first + i].kind == second_[from.second + i].kind;
  if (is_replaced) {
    for (std::size_t i = 0; i < size.first; ++i) report_pair(from.first + i, from.second + i);
    return;
  }
  MotionPlace place = place_at(from.first, from.second, size);
  for (std::size_t i = from.first; i < to.first; ++i)
    place.differences |= difference_of(first_[i].kind);
  for (std::size_t j = from.second; j < to.second; ++j)
    place.differences |= difference_of(second_[j].kind);
  add(std::move(place));
}

/// Variables and offsets that stay: the next program moves by them.
void Pass::compare_kept() {
  if (agreement_.across_controls) return;
  const ActionReader::Kept first = first_.kept(), second = second_.kept();
  const bool has_same_cells =
      std::ranges::equal(first.cells, second.cells, {}, &interpreter::MemoryCell::name,
                         &interpreter::MemoryCell::name);
  if (!has_same_cells) return;
  for (std::size_t i = 0; i < first.values.size(); ++i) {
    const double a = first.values[i], b = second.values[i];
    if (a == b || (std::isnan(a) && std::isnan(b))) continue;
    MotionPlace place = place_at(0, 0, {});
    place.differences = Difference::Function;
    place.first_actions = place.second_actions = 1;
    const auto left = [&](double value) {
      return std::isnan(value) ? fmt::format("leaves {} empty", first.cells[i].name)
                               : fmt::format("leaves {} = {:.6g}", first.cells[i].name, value);
    };
    place.first_text = left(a);
    place.second_text = left(b);
    add(std::move(place));
  }
}

void Pass::add(MotionPlace place) {
  result_.is_same = false;
  ++result_.place_count;
  result_.differences |= place.differences;
  for (std::size_t i = 0; i < kDifferenceCount; ++i) {
    if (place.differences.has(static_cast<Difference>(i))) ++result_.counts[i];
  }
  if (std::isfinite(place.distance))
    result_.max_distance = std::max(result_.max_distance, place.distance);
  if (result_.places.size() < options_.max_places) result_.places.push_back(std::move(place));
}

MotionResult Pass::result() const {
  MotionResult result = result_;
  result.first_blocks = first_.blocks();
  result.second_blocks = second_.blocks();
  result.first_actions = first_.dropped();
  result.second_actions = second_.dropped();
  return result;
}

}  // namespace motion_parts

using motion_parts::Pass;

struct MotionComparison::Parts {
  Result<void> begin_pass(double shift) {
    pass = std::make_unique<Pass>(sides, options, shift);
    return pass->begin();
  }

  std::array<MotionSide, 2> sides;
  MotionOptions options;
  std::unique_ptr<Pass> pass = {};
  std::optional<MotionResult> result = {};  ///< of the first pass
};

MotionComparison::MotionComparison(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
MotionComparison::MotionComparison(MotionComparison&&) noexcept = default;
MotionComparison& MotionComparison::operator=(MotionComparison&&) noexcept = default;
MotionComparison::~MotionComparison() = default;

interpreter::Setup started_beside(interpreter::Setup setup, double shift, unsigned axes) {
  if (shift == 0) return setup;
  for (const auto axis : interpreter::kAllAxes) {
    if ((axes >> static_cast<unsigned>(axis) & 1U) == 0) continue;
    const bool has_moved = setup.start.has(axis);
    setup.start.set_raw(axis, setup.start.raw(axis) + shift);
    if (!has_moved) setup.start.unmark(axis);
  }
  return setup;
}

Result<MotionComparison> MotionComparison::begin(const MotionSide& first, const MotionSide& second,
                                                 MotionOptions options) {
  if (!(options.tolerance >= 0 && options.tolerance <= kMaxTolerance)) {
    return fail(Errc::LimitExceeded, "a tolerance of {} mm is not between 0 and {} mm",
                options.tolerance, kMaxTolerance);
  }
  std::unique_ptr<Parts> parts(new Parts{.sides = {first, second}, .options = options});
  if (auto begun = parts->begin_pass(0); !begun) return fail(begun.error());
  return MotionComparison(std::move(parts));
}

bool MotionComparison::step() {
  if (!parts_->pass->step()) return false;
  const MotionResult passed = parts_->pass->result();
  if (!parts_->result) {
    parts_->result = passed;
    if (!passed.is_same) return true;
    if (parts_->begin_pass(kStartShift + 2 * parts_->options.tolerance)) return false;
  }
  auto& conditions = parts_->result->conditions;
  // Another alarm is where the comparison ended, and not a proof.
  const bool is_proof = passed.is_same && passed.conditions.size() == conditions.size();
  if (!is_proof) {
    const Place place = passed.places.empty() ? Place{1, 0} : passed.places.front().second;
    conditions.push_back({Condition::Kind::Start, true, place, {}});
  }
  return true;
}

MotionResult MotionComparison::result() const {
  return parts_->result.value_or(MotionResult{});
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
