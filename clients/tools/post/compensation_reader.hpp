#pragma once

#include "clients/tools/post/conversion.hpp"

namespace dripline::post {

/// How the compensation of a source is read and kept; owns the text that it is read from.
struct CompensationSource {
  bool is_of_offsets = false;  ///< its radii are those of D, else those of the tools
  /// The setup and the program with radii that move nothing.
  interpreter::Setup setup;
  std::unique_ptr<ReplacedSource> program;  ///< absent: its text defines no radii
};

/// Programs of this control define radii in their text.
bool defines_radii(const interpreter::Dialect& dialect);

/// The source for a run as it is programmed. Errors: Unsupported, where the source or the target
/// has no cutter compensation that can be kept.
Result<CompensationSource> as_programmed(const SourceProgram& source,
                                         const interpreter::Setup& setup, const Target& target,
                                         const interpreter::Setup& target_setup);

/// Runs the source twice, with its radii and as it is programmed. Errors, with their place: what
/// cannot be kept.
tl::expected<KeptCompensation, NotConverted> read_compensation(const SourceProgram& source,
                                                               const interpreter::Setup& setup,
                                                               const CompensationSource& programmed,
                                                               const Target& target,
                                                               const ConversionOptions& options);

}  // namespace dripline::post
