#include "clients/lib/server_location.hpp"

#include "clients/lib/saved_logins.hpp"
#include "protocol/base/lines.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace dripline::client {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxSmallFile = 64 * 1024;

/// What a running server writes to STATE/dncd.json.
struct LocalServer {
  std::string url;
  std::optional<std::string> token_file, ca_file;
};

Result<std::string> read_small_file(const std::string& path, std::string_view purpose) {
  std::error_code ec;
  const auto size = fs::file_size(path, ec);
  if (ec) return fail(Errc::Io, "{} {} cannot be read: {}", purpose, path, ec.message());
  if (size > kMaxSmallFile) {
    return fail(Errc::LimitExceeded, "{} {} has {} bytes, expected at most {}", purpose, path, size,
                kMaxSmallFile);
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(Errc::Io, "{} {} cannot be read: permission denied?", purpose, path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

Result<std::string> read_token(const std::string& path) {
  auto text = read_small_file(path, "token file");
  if (!text) return text;
  constexpr std::string_view kBlanks = " \t\r\n";
  std::string token(trimmed(*text, kBlanks));
  if (token.empty()) return fail(Errc::Syntax, "token file {} is empty", path);
  if (token.find_first_of(kBlanks) != std::string::npos) {
    return fail(Errc::Syntax, "token file {} holds more than one word, expected the token alone",
                path);
  }
  return token;
}

Result<std::string> checked_url(std::string url, std::string_view origin) {
  while (!url.empty() && url.back() == '/') url.pop_back();
  const bool is_http = url.starts_with("http://") && url.size() > 7;
  const bool is_https = url.starts_with("https://") && url.size() > 8;
  if (!is_http && !is_https) {
    return fail(Errc::Syntax,
                "{} '{}' is not a server address, expected http://HOST:PORT or "
                "https://HOST:PORT",
                origin, url);
  }
  if (url.find_first_of("/ ?#", is_http ? 7 : 8) != std::string::npos) {
    return fail(Errc::Syntax,
                "{} '{}' has a path, expected http://HOST:PORT or https://HOST:PORT alone", origin,
                url);
  }
  return url;
}

std::optional<std::string> text_member(const nlohmann::json& object, const char* key,
                                       const fs::path& relative_to) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  const fs::path path(found->get<std::string>());
  return path.is_absolute() ? path.string() : (relative_to / path).string();
}

/// nullopt: there is no dncd.json, so no server runs here.
Result<std::optional<LocalServer>> read_local_server(const std::string& state) {
  const std::string path = (fs::path(state) / "dncd.json").string();
  std::error_code ec;
  if (!fs::exists(path, ec)) return std::optional<LocalServer>();
  auto text = read_small_file(path, "the local server's file");
  if (!text) return fail(text.error());
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("url") || !json["url"].is_string()) {
    return fail(Errc::Syntax, "{} is not a server's file, expected JSON with \"url\"", path);
  }
  LocalServer local;
  auto url = checked_url(json["url"].get<std::string>(), path);
  if (!url) return fail(url.error());
  local.url = *url;
  local.token_file = text_member(json, "token_file", state);
  const fs::path beside = fs::path(state) / "token";
  if (!local.token_file && fs::exists(beside, ec)) local.token_file = beside.string();
  local.ca_file = text_member(json, "ca_file", state);
  return std::optional<LocalServer>(std::move(local));
}

/// The addresses the user named; empty: none.
Result<std::vector<std::string>> named_urls(const LocationOptions& options,
                                            const Environment& environment) {
  std::vector<std::string> urls;
  std::optional<std::string> text = options.server;
  const char* const origin = text ? "--server" : "DRIPLINE_SERVER";
  if (!text) text = environment("DRIPLINE_SERVER");
  if (!text) return urls;
  for (std::size_t begin = 0; begin <= text->size();) {
    const std::size_t end = std::min(text->find(',', begin), text->size());
    auto url = checked_url(text->substr(begin, end - begin), origin);
    if (!url) return fail(url.error());
    urls.push_back(*std::move(url));
    begin = end + 1;
  }
  if (urls.size() > kMaxServers)
    return fail(Errc::LimitExceeded, "{} names {} servers, expected at most {}", origin,
                urls.size(), kMaxServers);
  return urls;
}

Result<std::string> find_token(const LocationOptions& options, const Environment& environment,
                               const std::string& url,
                               const std::optional<std::string>& local_token_file) {
  if (options.token_file) return read_token(*options.token_file);
  if (auto token = environment("DRIPLINE_TOKEN")) return *token;
  // Who names the state folder wants the server's own token.
  const auto file = options.state_dir ? std::nullopt : login_file(environment);
  if (file) {
    auto saved = SavedLogins(*file).find(url);
    if (!saved) return fail(saved.error());
    if (*saved) return **saved;
  }
  if (local_token_file) return read_token(*local_token_file);
  return std::string();
}

Result<void> take_certificate(const LocationOptions& options, ServerAddress& address) {
  if (!options.certificate && !options.key) return {};
  if (!options.certificate || !options.key)
    return fail(Errc::Syntax, "--cert and --key belong together: give both or none");
  if (!address.url.starts_with("https://"))
    return fail(Errc::Syntax, "--cert is for https; the server is {}", address.url);
  for (const auto& file : {*options.certificate, *options.key}) {
    if (auto text = read_small_file(file, "certificate or key"); !text) return fail(text.error());
  }
  address.certificate = *options.certificate;
  address.key = *options.key;
  return {};
}

/// What is given for all servers, and the server on this computer.
struct Known {
  const LocationOptions& options;
  const Environment& environment;
  std::optional<LocalServer> local;
  bool state_is_named = false;
};

Result<ServerAddress> address_of(const std::string& url, const Known& known) {
  const auto& [options, environment, local, state_is_named] = known;
  const bool is_local = local && (url == local->url || state_is_named);
  ServerAddress address{.url = url, .token = {}, .ca_file = options.ca_file};
  if (auto shown = take_certificate(options, address); !shown) return fail(shown.error());
  if (address.certificate.empty() || options.token_file) {
    auto token = find_token(options, environment, url, is_local ? local->token_file : std::nullopt);
    if (!token) return fail(token.error());
    address.token = *std::move(token);
  }
  if (!address.ca_file && is_local) address.ca_file = local->ca_file;
  return address;
}

}  // namespace

Result<std::vector<ServerAddress>> locate_servers(const LocationOptions& options,
                                                  const Environment& environment, bool is_root) {
  auto urls = named_urls(options, environment);
  if (!urls) return fail(urls.error());
  auto state = options.state_dir ? Result<std::string>(*options.state_dir)
                                 : default_state_folder(environment, is_root);
  if (!state && urls->empty()) return fail(state.error());
  Known known{options, environment, {}, options.state_dir || environment("DRIPLINE_STATE")};
  if (state) {
    auto read = read_local_server(*state);
    // A server named explicitly must be usable even where the local one's file is not.
    if (!read && urls->empty()) return fail(read.error());
    if (read) known.local = *std::move(read);
  }
  if (urls->empty() && !known.local) {
    return fail(Errc::NotFound,
                "no server is named, and none runs here ({}/dncd.json does not "
                "exist); expected --server URL or DRIPLINE_SERVER",
                *state);
  }
  if (urls->empty()) urls->push_back(known.local->url);
  std::vector<ServerAddress> servers;
  for (const auto& url : *urls) {
    auto address = address_of(url, known);
    if (!address) return fail(address.error());
    servers.push_back(*std::move(address));
  }
  return servers;
}

}  // namespace dripline::client
