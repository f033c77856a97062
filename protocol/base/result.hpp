#pragma once

#include <fmt/core.h>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace dripline {

/// What kind of failure a caller may have to tell apart; the words are for people.
enum class Errc {
  Syntax,         ///< outside text or bytes that do not follow their grammar
  Conflict,       ///< two words or settings that exclude each other
  Unsupported,    ///< understood, but this control, version or build does not do it
  LimitExceeded,  ///< over a stated bound
  NotFound,
  Busy,     ///< someone else holds it; trying later can help
  Timeout,  ///< not answered in time; the outcome may be unknown
  Corrupt,  ///< stored or received bytes fail their own check
  Io,       ///< the operating system or a library refused
  Denied,   ///< credentials missing, wrong or too weak
};

struct Error {
  Errc code{};
  std::string what;  ///< which thing, which value, which limit
};

/// A value or an Error. Ignoring one is a warning (and so an error in our builds).
template <class T>
struct [[nodiscard]] Result : tl::expected<T, Error> {
  using tl::expected<T, Error>::expected;
};

/// `return fail(Errc::NotFound, "program {} is not in the library", name);`
template <class... Args>
tl::unexpected<Error> fail(Errc code, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

inline std::string_view to_string(Errc code) {
  switch (code) {
    case Errc::Syntax:
      return "syntax";
    case Errc::Conflict:
      return "conflict";
    case Errc::Unsupported:
      return "unsupported";
    case Errc::LimitExceeded:
      return "limit_exceeded";
    case Errc::NotFound:
      return "not_found";
    case Errc::Busy:
      return "busy";
    case Errc::Timeout:
      return "timeout";
    case Errc::Corrupt:
      return "corrupt";
    case Errc::Io:
      return "io";
    case Errc::Denied:
      return "denied";
  }
  return "unknown";
}

}  // namespace dripline
