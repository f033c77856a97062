#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "protocol/base/result.hpp"
#include "server/machines/run_sources.hpp"

namespace dripline::paths {

inline constexpr double kMaxTolerance = 1000;  ///< mm

struct PathRequest {
  storage::Revision revision;
  std::string machine = {};  ///< whose setup applies; empty: the control's defaults
  double tolerance = 0;      ///< mm, at most kMaxTolerance; see PathEncoder
};

/// The tool path of one program, a piece at a time: interprets as far as the piece needs, and
/// nothing while no piece is asked for. Ends its interpretation when it is destroyed. One thread at
/// a time, which may wait for storage.
class PathReader {
 public:
  virtual ~PathReader() = default;
  /// Frames (README.md); nullopt after the last one. Never empty. A fault of the program is in the
  /// last frame. Errors: Io, Corrupt (its text).
  virtual Result<std::optional<std::string>> next() = 0;
};

enum class CompareBy : std::uint8_t { Text, Normalized, Motion };

struct ComparisonRequest {
  storage::Revision first, second;
  CompareBy by = CompareBy::Text;
  std::string machine = {};   ///< whose setup applies to motion; empty: the controls' defaults
  double tolerance = 0.001;   ///< mm, at most kMaxTolerance
  std::uint64_t context = 3;  ///< lines around a change of the text
  std::stop_token stop = {};  ///< ends it early, with Timeout
};

struct CheckRequest {
  storage::Revision revision;
  std::string machine = {};  ///< whose setup applies; empty: the control's defaults
  std::chrono::milliseconds limit{20'000};
};

/// Interprets stored programs for their tool paths, to compare them, and to check them. Any thread;
/// what it was made of must outlive the readers.
class ProgramPaths {
 public:
  explicit ProgramPaths(const machines::RunSources& sources) : sources_(sources) {}

  /// Errors: Busy (kMaxReaders are open), Unsupported (no control is known, or the machine's setup
  /// is not for it), and those of the setup.
  Result<std::unique_ptr<PathReader>> open(const PathRequest& request);

  /// The comparison as JSON (clients/tools/comparison/README.md), with `first` and `second`
  /// (program, revision, control) and `machine`. Waits for storage, and at most kMaxComparison. It
  /// takes the place of one reader. Errors: Busy, Unsupported, Io, Corrupt, Timeout, and those of
  /// the setup.
  Result<std::string> compare(const ComparisonRequest& request);

  /// What `dnc check` finds, as JSON (README.md): also of a part, when `limit` is over. Waits for
  /// storage; it takes the place of one reader. Errors: Busy, Unsupported, and those of the setup.
  Result<std::string> check(const CheckRequest& request);

  static constexpr int kMaxReaders = 4;
  static constexpr std::chrono::seconds kMaxComparison{20};

 private:
  const machines::RunSources sources_;
  const std::shared_ptr<std::atomic<int>> readers_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace dripline::paths
