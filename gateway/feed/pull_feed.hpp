#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gateway/feed/chunk_cache.hpp"
#include "gateway/feed/line_feed.hpp"

namespace dripline::feed {

struct PullFeedOptions {
  std::size_t cache_bytes = 8 * 1024 * 1024;
  std::size_t min_window = 64 * 1024;  ///< requested ahead of the cursor
  std::size_t max_window = 4 * 1024 * 1024;
  double target_seconds = 10;  ///< of motion, requested ahead
  std::uint32_t request_bytes = 128 * 1024;
  /// Requested and not answered: below what the network holds for a live peer (dds::kBlockWindow
  /// pieces).
  std::size_t max_in_flight = 40 * ChunkCache::kChunkBytes;
  std::chrono::milliseconds retry{300};  ///< silence before a request is repeated; doubles
  std::chrono::milliseconds max_retry{3000};
  int max_failures = 10;  ///< answers "failed" in a row until the program is lost
  std::size_t max_called_programs = 64;
};

/// What is fed: one run of one program revision.
struct FeedRun {
  std::string machine;
  std::uint64_t session = 0;  ///< of this gateway process
  std::string run;
  std::uint64_t size = 0;  ///< bytes of the program
};

/// The program text of one run, pulled from a server that only answers. The gateway owns the
/// cursor: what `fetch` asked for last, and a window ahead of it, is requested in `poll` until it
/// has come; asking is idempotent, so lost, doubled, reordered, late and foreign answers do no
/// harm. Memory: `cache_bytes` and one stitched window. Pure: time comes in, requests go out
/// through a callback. One thread.
class PullFeed final : public ProgramFeed {
 public:
  /// False: not taken, try in the next poll.
  using Ask = std::function<bool(const dds::BlockRequest&)>;

  PullFeed(FeedRun run, PullFeedOptions options, Ask ask);

  interpreter::TextWindow fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                                std::size_t min_bytes) override;
  interpreter::ProgramLookup find(std::string_view name) override;
  std::vector<CalledProgram> called_programs() const override;
  std::size_t called_program_count() const override { return programs_.size() - 1; }
  HeldText held_around(interpreter::ProgramIndex program, std::uint64_t offset,
                       std::size_t reach) const override {
    HeldText held = cache_.around(program, offset, reach);
    held.reaches_end = program < programs_.size() && held.end() == programs_[program].size;
    return held;
  }

  void on_data(const dds::BlockData& data, SteadyTime now) override;
  void poll(SteadyTime now) override;
  std::optional<SteadyTime> next_poll() const override { return next_poll_; }
  void ask_again() override;
  /// Sizes the window to `target_seconds`; nullopt: as fast as possible, the whole window.
  void set_consumption(std::optional<double> bytes_per_second) override;

  /// Why the program is not available any more; empty: it is.
  const std::string& failure() const { return failure_; }
  std::uint64_t sent() const override { return hashed_; }
  /// Equals the revision's once sent() is the program's size.
  Digest content_digest() const override { return hash_.digest(); }
  std::uint64_t content_length() const override { return hashed_; }
  /// Contiguous bytes held after the cursor.
  std::uint64_t bytes_ahead() const;

 private:
  struct Program {
    std::string name;  ///< empty: the run's own
    std::optional<std::uint64_t> size;
    std::string content;  ///< SHA-256, of a called program; empty: not stated
    bool is_missing = false;
    int failures = 0;
    std::uint64_t received_to = 0;  ///< end of the furthest answer since it was last asked
  };
  struct Asked {
    SteadyTime deadline;
    int attempts = 0;
  };
  struct Range {
    std::uint64_t begin = 0, end = 0;
  };

  interpreter::TextWindow stitch(interpreter::ProgramIndex program, std::uint64_t offset,
                                 std::size_t need);
  std::optional<interpreter::ProgramIndex> program_of(const dds::BlockData& data) const;
  bool is_consistent(Program& program, const dds::BlockData& data);
  void on_error(Program& program, const dds::BlockData& data);
  void drop_asked(interpreter::ProgramIndex program, std::uint64_t from, std::uint64_t to);
  void extend_hash();
  Range window_of(const Program& program) const;
  void ask_window(interpreter::ProgramIndex index, SteadyTime now);
  std::size_t in_flight(interpreter::ProgramIndex index, Range window, SteadyTime now);
  bool is_due(ChunkCache::Key key, SteadyTime now);
  bool send(interpreter::ProgramIndex index, Range range, SteadyTime now);
  void note_deadline(SteadyTime deadline);

  FeedRun run_;
  PullFeedOptions options_;
  Ask ask_;
  ChunkCache cache_;
  std::vector<Program> programs_;
  std::map<ChunkCache::Key, Asked> asked_;
  std::string stitched_;
  std::string failure_;

  interpreter::ProgramIndex cursor_program_ = interpreter::kMainProgram;
  std::uint64_t cursor_ = 0;
  std::size_t window_;
  SteadyTime last_data_{};
  std::optional<SteadyTime> next_poll_;

  Sha256 hash_;
  std::uint64_t hashed_ = 0;
};

}  // namespace dripline::feed
