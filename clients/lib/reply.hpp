#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <tl/expected.hpp>

#include "protocol/base/result.hpp"

namespace dripline::client {

/// Why a call failed. People act differently on each kind, and `dnc` has an exit status for each.
struct Failure {
  enum class Kind {
    Unreachable,  ///< no answer: wrong address, server down, connection cut, time over
    Denied,       ///< the server does not accept the token
    Refused,      ///< the server refuses, and its answer has the reason
    BadReply,     ///< the answer is not a Dripline server's
    Local,        ///< a file or setting of the client
  };
  Kind kind = Kind::Refused;
  Errc code = Errc::Io;
  std::string what;
  bool is_not_taken = false;  ///< Unreachable: nothing of the request has reached a server
};

/// A value or a Failure. Ignoring one is an error in our builds.
template <class T>
struct [[nodiscard]] Reply : tl::expected<T, Failure> {
  using tl::expected<T, Failure>::expected;
};

inline tl::unexpected<Failure> failed(Failure failure) {
  return tl::unexpected<Failure>(std::move(failure));
}

template <class... Args>
tl::unexpected<Failure> failed(Failure::Kind kind, Errc code, fmt::format_string<Args...> format,
                               Args&&... args) {
  return failed(Failure{kind, code, fmt::format(format, std::forward<Args>(args)...)});
}

/// A failure of a file or setting of the client.
inline tl::unexpected<Failure> failed_locally(Error error) {
  return failed(Failure{Failure::Kind::Local, error.code, std::move(error.what)});
}

/// How long a transfer retries when the server does not answer. The wait doubles from `first` to
/// `longest`; any progress resets it.
struct RetryPolicy {
  std::chrono::milliseconds first{100};
  std::chrono::milliseconds longest{3000};
  int attempts = 10;  ///< in a row without progress; with the values above about 20 s
  /// Waits; false when the user ends the transfer. Injected so that tests need no time.
  std::function<bool(std::chrono::milliseconds)> wait;
};

/// Counts the failures in a row and computes the wait before the next attempt.
class BackOff {
 public:
  explicit BackOff(const RetryPolicy& policy) : policy_(policy) {}

  void reset() { failures_ = 0; }
  /// Waits before the next attempt; false when there is none.
  bool wait() {
    if (++failures_ > policy_.attempts) return false;
    const auto delay =
        std::min(policy_.longest, policy_.first * (1 << std::min(failures_ - 1, 16)));
    return !policy_.wait || policy_.wait(delay);
  }

 private:
  const RetryPolicy& policy_;
  int failures_ = 0;
};

}  // namespace dripline::client
