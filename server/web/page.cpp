#include "server/web/page.hpp"

#include <algorithm>
#include <string>

namespace dripline::web {
namespace {

/// Only files of this server run or are shown, nothing is framed or sent elsewhere, and the page
/// cannot turn a text into markup or code even if it tried (trusted types).
constexpr const char* kContentSecurityPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
    "require-trusted-types-for 'script'";

constexpr std::string_view kHowToAddThePage =
    R"(<!doctype html><html lang="en"><meta charset="utf-8"><title>Dripline</title>
<h1>Dripline</h1>
<p>The server is running. Its web page was not built into it.</p>
<p>To add the page, install node and npm and build again:</p>
<pre>deploy/packages/install web
deploy/build</pre>
<p>Without the page, <code>dnc --help</code> names what the command line can do, and
<code>/api/v1/openapi.json</code> describes the API.</p>
</html>
)";

/// "" for the page itself, nullopt for what belongs to the API.
std::optional<std::string> path_of(const api::Request& head) {
  if (head.method != "GET" && head.method != "HEAD") return std::nullopt;
  const auto& segments = head.target.segments;
  if (segments.size() == 1 && segments[0].empty()) return "";
  if (segments.size() == 2 && segments[0] == "assets") return "assets/" + segments[1];
  return std::nullopt;
}

/// Whether one of the tags in If-None-Match is this one. A weak tag is the same for this purpose.
bool names_tag(std::string_view header, std::string_view etag) {
  return header == "*" || header.find(etag) != std::string_view::npos;
}

/// Every browser takes gzip; a client that does not say so is given an explanation instead.
bool takes_gzip(const api::Request& head) {
  return head.header("accept-encoding").find("gzip") != std::string::npos;
}

api::Response text_response(int status, std::string_view content_type, std::string_view body) {
  api::Response response;
  response.status = status;
  response.content_type = content_type;
  response.body = body;
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}

}  // namespace

void add_protection(api::Response& response) {
  response.headers.emplace_back("Content-Security-Policy", kContentSecurityPolicy);
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("Cross-Origin-Opener-Policy", "same-origin");
  response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
}

api::Response Page::send(const Asset& asset, const api::Request& head) const {
  if (!takes_gzip(head)) {
    return text_response(
        406, "text/plain; charset=utf-8",
        "This page is sent with gzip alone: use a browser, or curl --compressed.\n");
  }
  api::Response response;
  response.content_type = asset.content_type;
  // The name of an asset changes with its content; the page that names the assets does not.
  response.headers.emplace_back(
      "Cache-Control", asset.path.empty() ? "no-cache" : "public, max-age=31536000, immutable");
  response.headers.emplace_back("ETag", asset.etag);
  response.headers.emplace_back("Vary", "Accept-Encoding");
  if (names_tag(head.header("if-none-match"), asset.etag)) {
    response.status = 304;
    return response;
  }
  response.headers.emplace_back("Content-Encoding", "gzip");
  response.body = asset.gzip;
  return response;
}

std::optional<api::Response> Page::answer(const api::Request& head) const {
  const auto path = path_of(head);
  if (!path) return std::nullopt;
  const auto asset = std::ranges::find(assets_, *path, &Asset::path);
  api::Response response;
  if (asset != assets_.end()) {
    response = send(*asset, head);
  } else if (path->empty()) {
    response = text_response(200, "text/html; charset=utf-8", kHowToAddThePage);
  } else {
    // A page of an older version is open in the browser: it reloads (clients/web/src/app).
    response = text_response(404, "text/plain; charset=utf-8",
                             "This server's page has no such file: reload the page.\n");
  }
  add_protection(response);
  return response;
}

}  // namespace dripline::web
