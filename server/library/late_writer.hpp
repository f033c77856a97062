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
/// the other in their order, each again while the store is away; so none is lost but by the end of
/// the server. Any thread.
class LateWriter {
 public:
  using Write = std::function<Result<void>()>;
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

  /// Returns when it is written, or after `patience`. `what`: for the log, if it is lost.
  void write(std::string what, Write write);
  /// Tries each of what waits once more. What then is lost is logged. Later writes are made in the
  /// caller's thread.
  void end();

 private:
  struct Waiting {
    std::uint64_t number = 0;
    std::string what;
    Write write;
  };
  void run(const std::stop_token& stop);
  /// False: the store is away, and it is to be tried again.
  static bool try_one(const Waiting& waiting, bool is_last_try);

  const Options options_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;  ///< the first one is being written
  std::uint64_t last_ = 0, written_ = 0;
  bool is_ended_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace dripline::library
