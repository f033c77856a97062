#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "clients/tools/comparison/motion_comparison.hpp"
#include "clients/tools/comparison/text_comparison.hpp"

namespace dripline::comparison {

/// What the change from one program to another is about, as far as both comparisons can tell; what
/// is accepted from a machine without a look at it depends on that.
enum class EditClass : std::uint8_t {
  None,          ///< the same text
  Comment,       ///< comments, blanks, forms of numbers
  SameMotion,    ///< another text, the same actions
  FeedAndSpeed,  ///< feeds and spindle speeds alone
  Offsets,       ///< work offsets, tool offsets, and what `FeedAndSpeed` is
  Geometry,      ///< the path
  Other,         ///< tools, functions, outputs, order ..., or it could not be determined
};
std::string_view word_of(EditClass edit);
std::string_view word_of(TextChange change);

/// Without `motion` a change of more than comments is Other: an F word may be a thread's lead.
EditClass classify(const TextResult& text, const MotionResult* motion);

/// A program as both comparisons take it.
struct ProgramSide {
  interpreter::ProgramSource& source;  ///< holds all of its text
  std::uint64_t size = 0;
  const interpreter::Dialect* dialect = nullptr;  ///< needed for the normal form and for motion
  interpreter::Setup setup = {};
};

struct ProgramOptions {
  enum class By : std::uint8_t { Text, Normalized, Motion };
  By by = By::Text;
  MotionOptions motion = {};
  std::uint64_t context = 3;       ///< lines around a hunk
  std::uint64_t max_lines = 5000;  ///< of text in the result; the rest is counted
  /// Asked now and then; true ends the comparison.
  std::function<bool()> is_to_stop = {};
};

/// The result as README.md describes it ("The result as JSON"). By motion the text is compared too.
/// Errors: Unsupported (no dialect), Io, Timeout (`is_to_stop`), those of MotionComparison::begin.
Result<nlohmann::json> compare_programs(const ProgramSide& first, const ProgramSide& second,
                                        const ProgramOptions& options);

}  // namespace dripline::comparison
