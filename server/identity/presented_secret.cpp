#include "server/identity/presented_secret.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <optional>

#include "protocol/base/lines.hpp"

namespace dripline::identity {
namespace {

bool is_secret_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view("-._~+/=").find(c) != std::string_view::npos;
}

/// Empty unless it could be a secret of ours.
std::string checked(std::string_view text) {
  if (text.size() < kMinSecret || text.size() > kMaxSecret) return {};
  if (!std::ranges::all_of(text, is_secret_character)) return {};
  return std::string(text);
}

/// The value of the only cookie with that name. Fields of one name were joined by a comma, which a
/// secret cannot have in it.
std::optional<std::string_view> find_cookie(std::string_view cookies, std::string_view name) {
  std::optional<std::string_view> found;
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find_first_of(";,"), cookies.size());
    const std::string_view pair = trimmed(cookies.substr(0, end));
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    if (!pair.starts_with(name) || pair.size() <= name.size() || pair[name.size()] != '=') continue;
    if (found) return "";
    found = pair.substr(name.size() + 1);
  }
  return found;
}

}  // namespace

PresentedSecret read_presented(std::string_view authorization, std::string_view cookies,
                               std::string_view cookie_name) {
  using enum PresentedSecret::From;
  constexpr std::string_view kScheme = "Bearer ";
  if (authorization.starts_with(kScheme)) {
    return {Bearer, checked(authorization.substr(kScheme.size()))};
  }
  if (!authorization.empty()) return {Bearer, {}};
  if (const auto value = find_cookie(cookies, cookie_name)) return {Cookie, checked(*value)};
  return {};
}

std::string_view cookie_name(bool has_tls) {
  return has_tls ? "__Host-dripline" : "dripline";
}

std::string set_cookie(const std::string& secret, bool has_tls) {
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict{}", cookie_name(has_tls), secret,
                     has_tls ? "; Secure" : "");
}

std::string clear_cookie(bool has_tls) {
  return set_cookie("", has_tls) + "; Max-Age=0";
}

}  // namespace dripline::identity
