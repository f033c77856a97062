#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "clients/tools/comparison/motion_comparison.hpp"
#include "clients/tools/post/adaptation.hpp"
#include "clients/tools/post/post_processor.hpp"
#include "clients/tools/post/target.hpp"

namespace dripline::post {

/// A program with all that its interpretation needs; all of it must outlive the conversion.
struct SourceProgram {
  const interpreter::Dialect& dialect;
  const interpreter::Setup& setup;
  interpreter::ProgramSource& source;  ///< holds all of its text
  std::string_view text;               ///< of the main program, for its comments
};

struct ConversionOptions {
  /// Of the target's machine; what it says of the start is taken from the source.
  interpreter::Setup target_setup = {};
  std::optional<interpreter::Units> units = {};  ///< absent: as the source has them
  std::optional<std::int64_t> name = {};         ///< number of the program
  std::optional<double> tolerance = {};  ///< mm between two paths; absent: a step of the target
  std::optional<double> chord = {};      ///< see AdaptationOptions
  /// Also writes what holds with this setup alone: its start, variables, answers and switches.
  bool is_as_set_up = false;
  /// Writes contours as they are programmed, with the target's compensation.
  bool keeps_compensation = false;
  std::function<bool()> is_to_stop = {};  ///< asked now and then; true ends the work with Timeout
};

/// Why a program is not written, with its place in the source.
struct NotConverted {
  Errc code = Errc::Unsupported;
  std::string what;
  /// Absent: it is about no place.
  std::optional<interpreter::Origin> origin;
};

/// What was written, and what it takes to prove it.
struct WrittenProgram {
  Grid grid;
  AdaptationOptions adaptation;
  interpreter::Setup source_setup, target_setup;
  ProgramHead head;
  WrittenCounts written;
  AdaptationCounts adapted;
  double tolerance = 0;
  std::set<int> tools = {};            ///< called, by their numbers
  KeptCompensation compensation = {};  ///< none where it is resolved
};

/// Writes the motion of a program as a program of `target`, in one pass and bounded memory. Nothing
/// of it may be used before `prove` says that it is the same.
tl::expected<WrittenProgram, NotConverted> write_program(const SourceProgram& source,
                                                         const Target& target,
                                                         const ConversionOptions& options,
                                                         const PostProcessor::Output& output);

/// Interprets what was written as its control does, and compares it action by action with the
/// source. Where compensation is kept, once more with other radii of the tools on both sides; the
/// result is that of the first comparison that is no proof. `is_same` of the result is the proof;
/// what it depends on is in `conditions`, and a condition other than those of `is_as_set_up` is
/// none. Errors: those of MotionComparison; Timeout.
Result<comparison::MotionResult> prove(const SourceProgram& source, const WrittenProgram& written,
                                       interpreter::ProgramSource& text,
                                       const ConversionOptions& options);

/// The condition that keeps a result from being a proof; nullptr: it is one, or it is not the same.
const comparison::Condition* objection(const comparison::MotionResult& result,
                                       const ConversionOptions& options);

}  // namespace dripline::post
