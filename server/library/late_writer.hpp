#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "protocol/base/result.hpp"

namespace dripline::library {

/// Writes that follow what has been done already, as a stop is, which waits for no store. One after
/// the other in their order, each again while the store is away. Any thread.
class LateWriter {
 public:
  using Write = std::function<Result<void>()>;
  /// What becomes of a write that the server ends before.
  enum class AtEnd : std::uint8_t { Lost, Kept };
  struct Options {
    std::chrono::milliseconds retry{500};     ///< after a failure
    std::chrono::milliseconds patience{300};  ///< of a caller, who usually finds it written
    std::size_t max_waiting = 10'000;
  };
  LateWriter() : LateWriter(Options{}) {}
  explicit LateWriter(Options options);
  ~LateWriter() { end(); }
  LateWriter(const LateWriter&) = delete;
  LateWriter& operator=(const LateWriter&) = delete;

  /// Returns when it is written, or after `patience`. `what`: for the log, if it is lost. Kept: the
  /// caller has it, and writes it in the server's next life.
  void write(std::string what, Write write, AtEnd at_end = AtEnd::Lost);
  /// Tries what waits once more, until the store refuses one because it is away. What is lost then
  /// is logged. Later writes are made in the caller's thread.
  void end();

 private:
  struct Waiting {
    std::uint64_t number = 0;
    std::string what;
    Write write;
    AtEnd at_end = AtEnd::Lost;
  };
  void run(const std::stop_token& stop);
  /// The store is away: what waits is tried no more.
  void give_up();
  /// Nothing: it is written, or never will be. Errors: the store is away, and may take it later.
  static Result<void> try_one(const Waiting& waiting);
  static void log_loss(const Waiting& waiting, const Error& error);

  const Options options_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;  ///< the first one is being written
  std::uint64_t last_ = 0, written_ = 0;
  bool is_ended_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace dripline::library
