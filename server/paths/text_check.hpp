#pragma once

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "server/machines/run_sources.hpp"

namespace dripline::paths {

/// A program that is not in the library.
struct ProgramText {
  std::string_view text;
  std::string name;     ///< as which it is to be stored
  std::string control;  ///< whose dialect reads it
  std::string machine;  ///< whose setup applies; empty: the control's defaults
  std::stop_token stop = {};
};

/// What `dnc check` does, with the machine's setup and the programs of the library that it calls:
/// the program is interpreted up to its end. Returns why a control would not take it, as "line 12:
/// F0031 ..."; nullopt: it would. Waits, at most kMaxTextCheck. Errors: Unsupported (the control is
/// not known, or the setup is not for it), Timeout (it takes longer, or `stop`), those of the
/// store.
Result<std::optional<std::string>> check_text(const machines::RunSources& sources,
                                              const ProgramText& program);

inline constexpr std::chrono::seconds kMaxTextCheck{120};

}  // namespace dripline::paths
