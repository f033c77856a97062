#include "server/webhooks/delivery.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "protocol/base/digest.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::webhooks {
namespace {

constexpr std::size_t kMaxUrl = 512;

/// The data of an event is JSON, but what a machine sent may hold bytes that are no text.
std::string well_formed(std::string_view data) {
  std::string text;
  while (!data.empty()) {
    const std::size_t length = utf8_length(data);
    text += length > 0 ? data.substr(0, length) : std::string_view("\xef\xbf\xbd");
    data.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text;
}

bool is_host_character(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') ||
         std::string_view(".-_:[]").find(c) != std::string_view::npos;
}

/// "host", "host:1" ... "host:65535"; an address of IPv6 in brackets.
bool has_good_port(std::string_view host) {
  constexpr unsigned kMaxPort = 65'535;
  const auto name_end = host.starts_with('[') ? host.find(']') : host.find(':');
  if (host.starts_with('[') && name_end == host.npos) return false;
  std::string_view port = name_end == host.npos ? "" : host.substr(name_end);
  if (port.starts_with(']')) port.remove_prefix(1);
  if (port.empty()) return true;
  unsigned number = 0;
  const char* const end = port.data() + port.size();
  const auto read = std::from_chars(port.data() + 1, end, number);
  return port.front() == ':' && read.ec == std::errc() && read.ptr == end && number >= 1 &&
         number <= kMaxPort;
}

}  // namespace

Digest hmac_sha256(std::string_view key, std::string_view text) {
  constexpr std::size_t kBlock = 64;
  std::array<std::byte, kBlock> padded{};
  if (key.size() > kBlock) {
    std::ranges::copy(sha256(key).bytes, padded.begin());
  } else {
    std::ranges::transform(key, padded.begin(), [](char c) { return static_cast<std::byte>(c); });
  }
  const auto with_pad = [&](std::byte pad) {
    auto block = padded;
    for (auto& byte : block) byte ^= pad;
    return block;
  };
  Sha256 inner;
  inner.update(with_pad(std::byte{0x36}));
  inner.update(text);
  Sha256 outer;
  outer.update(with_pad(std::byte{0x5c}));
  outer.update(inner.digest().bytes);
  return outer.digest();
}

Delivery make_delivery(const storage::Webhook& webhook, const storage::Event& event,
                       const std::string& server, UtcTime now) {
  Delivery delivery;
  delivery.url = webhook.url;
  delivery.id = fmt::format("{}-{}", server, event.id);
  delivery.kind = event.kind;
  delivery.timestamp = fmt::format(
      "{}", std::chrono::duration_cast<std::chrono::seconds>(now.time_since_epoch()).count());
  delivery.body =
      fmt::format(R"({{"id":"{}","number":{},"time":"{}","kind":"{}","data":{}}})", delivery.id,
                  event.id, to_iso8601(event.time), event.kind, well_formed(event.data));
  delivery.signature =
      "sha256=" + hmac_sha256(webhook.secret, delivery.timestamp + "." + delivery.body).hex();
  return delivery;
}

Result<void> check_url(std::string_view url) {
  if (url.size() > kMaxUrl)
    return fail(Errc::LimitExceeded, "URL of {} bytes: at most {}", url.size(), kMaxUrl);
  std::string_view rest = url;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (url.starts_with(scheme)) rest.remove_prefix(scheme.size());
  }
  const std::string_view host = rest.substr(0, rest.find_first_of("/?"));
  const bool is_plain = std::ranges::all_of(
      url, [](char c) { return c > ' ' && c < '\x7f' && c != '#' && c != '\\' && c != '"'; });
  const bool is_good = rest.size() < url.size() && !host.empty() && is_plain &&
                       std::ranges::all_of(host, is_host_character) && has_good_port(host);
  if (is_good) return {};
  return fail(Errc::Syntax, "URL '{}' must be http:// or https://, a host, and a path", url);
}

}  // namespace dripline::webhooks
