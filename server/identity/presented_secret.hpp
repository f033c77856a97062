#pragma once

#include <string>
#include <string_view>

namespace dripline::identity {

/// What a request carries to show whose it is.
struct PresentedSecret {
  enum class From { Nothing, Bearer, Cookie };
  From from = From::Nothing;
  std::string secret;  ///< empty: what was sent cannot be one
};

/// Of the header fields Authorization and Cookie. A bearer token comes before a cookie: a program
/// that sends one wants that one judged. Two cookies of our name are none, since one of them is
/// another's. Pure; any bytes.
PresentedSecret read_presented(std::string_view authorization, std::string_view cookies,
                               std::string_view cookie_name);

inline constexpr std::size_t kMinSecret = 32;  ///< characters
inline constexpr std::size_t kMaxSecret = 256;

/// The cookie of the web page. Over TLS a browser sends it back to nothing but this host; without
/// TLS, on this computer, no browser would accept that name.
std::string_view cookie_name(bool has_tls);
/// The value of Set-Cookie that gives it to a browser, until the browser is closed.
std::string set_cookie(const std::string& secret, bool has_tls);
std::string clear_cookie(bool has_tls);

}  // namespace dripline::identity
