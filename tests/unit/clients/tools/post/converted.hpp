#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "clients/tools/post/conversion.hpp"

namespace dripline::post {

/// A program to be converted, with what its control knows.
struct Original {
  std::string_view control;
  std::string text;
  interpreter::Setup setup = {};
  interpreter::MemorySource::Loader loader = {};
};

/// What became of a conversion.
struct Converted {
  std::string text;  ///< as far as it was written
  std::optional<NotConverted> refusal;
  std::optional<WrittenProgram> written;
  std::optional<comparison::MotionResult> result;
  bool is_proved = false;

  /// Why it was not converted: the refusal with its line, a difference, a condition. Empty: it was.
  std::string reason() const;
};

/// Writes and proves, as `dnc convert` does.
Converted convert(const Original& original, std::string_view target,
                  const ConversionOptions& options = {});

/// A setup from its text. Throws where it is none.
interpreter::Setup setup_from(std::string_view toml);

}  // namespace dripline::post
