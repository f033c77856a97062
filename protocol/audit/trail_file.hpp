#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/audit/verifier.hpp"

/// An exported trail, and a checkpoint that is kept elsewhere. Their form: README.md.
namespace dripline::audit {

struct TrailHeader {
  std::string database;
  PublicKey key;  ///< of the server
  friend bool operator==(const TrailHeader&, const TrailHeader&) = default;
};

/// The lines of such a file, with their ends.
std::string header_line(const TrailHeader& header);
std::string entry_line(const Entry& entry, const Digest& digest);
std::string checkpoint_line(const Checkpoint& checkpoint);
std::string end_line(std::uint64_t entries);

struct KeptCheckpoint {
  TrailHeader header;
  Checkpoint checkpoint;
};
/// Errors: Syntax, Corrupt (its key has not signed it).
Result<KeptCheckpoint> parse_kept_checkpoint(std::string_view text);

/// Verifies a file that comes in pieces of any size. Constant memory; one thread at a time. After
/// an error it must not be used again.
class TrailReader {
 public:
  static constexpr std::size_t kMaxLine = 1024 * 1024;

  /// Sees every entry as it comes; only after `finish`, without a fault, it is as it was written.
  std::function<void(const Entry&)> on_entry = {};

  TrailReader() = default;
  explicit TrailReader(KeptCheckpoint kept) : kept_(std::move(kept)) {}

  /// Errors: Syntax, LimitExceeded (a line); they name the line. Corrupt: another server's trail
  /// than the kept checkpoint's.
  Result<void> feed(std::string_view bytes);
  /// Nothing follows. Errors: Corrupt (the file was cut off; what the kept checkpoint has is not
  /// there). A fault of the trail itself is in `verifier`.
  Result<void> finish();

  /// Both after the first line.
  const std::optional<TrailHeader>& header() const { return header_; }
  const std::optional<Verifier>& verifier() const { return verifier_; }

 private:
  Result<void> take(std::string_view line);
  Result<void> take_header(std::string_view line);
  Result<void> take_record(std::string_view line);

  std::optional<KeptCheckpoint> kept_;
  std::optional<Digest> at_kept_;  ///< the trail's digest of the kept checkpoint's entry
  std::optional<TrailHeader> header_;
  std::optional<Verifier> verifier_;
  std::string rest_;  ///< of a line that is not complete
  std::uint64_t line_ = 0;
  bool has_ended_ = false;
};

}  // namespace dripline::audit
