#pragma once

#include <fmt/core.h>
#include <string>
#include <tl/expected.hpp>
#include <utility>

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

}  // namespace dripline::client
