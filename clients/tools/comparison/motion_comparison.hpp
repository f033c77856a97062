#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/tools/comparison/action.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/base/result.hpp"

namespace dripline::comparison {

/// Millimeters or degrees between two starts, on no grid of a program: what depends on the start is
/// another path from there.
inline constexpr double kStartShift = 0.7313;
/// The setup with another start: by `shift` on these axes (bit 0 is X).
interpreter::Setup started_beside(interpreter::Setup setup, double shift, unsigned axes = ~0U);

/// What an event passes before it is compared: a stage in front of `out`, for a run that
/// begins at `start`. `out` outlives it.
using ComparisonStage = std::function<std::unique_ptr<interpreter::EventSink>(
    interpreter::EventSink& out, const interpreter::Position& start)>;

/// A program with all that its interpretation needs; all of it must outlive the comparison.
struct MotionSide {
  const interpreter::Dialect& dialect;
  const interpreter::Setup& setup;
  interpreter::ProgramSource& source;  ///< holds all of its text
  ComparisonStage stage = {};          ///< empty: the events as they come
};

/// One place where two programs do not do the same.
struct MotionPlace {
  Differences differences;
  /// The block of each program; where one has nothing here, the block it does next, or its last.
  Place first, second;
  std::uint64_t first_actions = 0;  ///< how many actions of each program the place takes in
  std::uint64_t second_actions = 0;
  double distance = 0;  ///< of two paths, mm; infinity: the moves are not of one kind
  std::string first_text, second_text;  ///< the first action of each; empty: it has none
};

/// Why a comparison holds only under a condition.
struct Condition {
  enum class Kind : std::uint8_t {
    Alarm,
    Fault,
    Probe,
    Prompt,
    Input,
    Clock,
    Variable,
    BlockSkip,
    Start
  };
  Kind kind = Kind::Alarm;
  bool is_second = false;  ///< which program
  Place place;             ///< the first such block
  std::string text;        ///< an alarm's id and text; the variable
};
std::string_view word_of(Condition::Kind kind);

struct MotionResult {
  /// Both programs do the same, action by action. Rely on it alone only where `conditions` is
  /// empty.
  bool is_same = true;
  std::vector<Condition> conditions;
  std::vector<MotionPlace> places;  ///< the first ones, in order; at most the limit
  std::uint64_t place_count = 0;
  std::array<std::uint64_t, kDifferenceCount> counts{};  ///< places, by difference
  Differences differences;                               ///< of all places
  double max_distance = 0;                               ///< of paths that could be measured, mm
  double tolerance = 0;
  bool across_controls = false;
  std::uint64_t first_blocks = 0, second_blocks = 0;
  std::uint64_t first_actions = 0, second_actions = 0;

  bool is_unconditional() const { return is_same && conditions.empty(); }
};

inline constexpr double kMaxTolerance = 1000;  ///< mm

struct MotionOptions {
  double tolerance = 0.001;                  ///< mm, degrees
  std::size_t max_places = 1000;             ///< kept; all are counted
  std::uint64_t max_blocks = 1'000'000'000;  ///< of each program
  /// Executed that had been executed before, of each program: see OfflineLimits.
  std::uint64_t max_repeated_blocks = 10'000'000;
  /// Actions of each program in which the place is looked for from which both do the same again;
  /// some 400 bytes each.
  std::size_t max_window = 65'536;
  /// Compares as across controls, where both are of one as well.
  bool across_controls = false;
  /// Bit 0 is X: the axes whose other start the second pass begins at.
  unsigned started_axes = ~0U;
};

/// Interprets both programs in step and compares what they do; where it is the same, again from
/// another position of the machine, because a first move may leave an axis where it is. Memory is
/// bounded by the window in which it looks for the place where both do the same again
/// (`max_window`), not by the programs. One thread.
class MotionComparison {
 public:
  /// Errors: those of `Dialect::make`; LimitExceeded (the tolerance).
  static Result<MotionComparison> begin(const MotionSide& first, const MotionSide& second,
                                        MotionOptions options = {});
  MotionComparison(MotionComparison&&) noexcept;
  MotionComparison& operator=(MotionComparison&&) noexcept;
  ~MotionComparison();

  /// Compares up to some thousand actions. True: it is over.
  bool step();
  MotionResult result() const;

 private:
  struct Parts;
  explicit MotionComparison(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// All of it at once.
Result<MotionResult> compare_motion(const MotionSide& first, const MotionSide& second,
                                    MotionOptions options = {});

}  // namespace dripline::comparison
