#include "server/app/standby_page.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "protocol/base/lines.hpp"
#include "protocol/base/markup.hpp"
#include "server/web/page.hpp"

namespace dripline::app {
namespace {

constexpr int kPageStatus = 503;
constexpr unsigned kReloadSeconds = 5;

struct Words {
  std::string_view language, waits, has_library, unknown, database_lost, blocked, lacks_agent,
      other_network, other_settings, other_clock, lacks_disk, reloads;
};
constexpr Words kEnglish{
    "en",
    "This server stands by. It takes over when the server that has the library ends.",
    "The library is at",
    "Which server has the library is not known now.",
    "The database cannot be reached now, so this may have changed.",
    "A UDP port that this server needs for gateways is in use: it cannot take over.",
    "The address of its MTConnect agent is in use or not allowed: it would take over without the "
    "agent.",
    "Its DDS settings are not those of the server that has the library: it cannot take over.",
    "Its settings are not those of the server that has the library: see its log.",
    "Its clock is not that of the database.",
    "Its disk is full or nearly full.",
    "This page loads itself again, and becomes the usual one when this server has the library."};
constexpr Words kGerman{
    "de",
    "Dieser Server wartet in Bereitschaft. Er übernimmt, wenn der Server mit der Bibliothek endet.",
    "Die Bibliothek ist bei",
    "Welcher Server die Bibliothek hat, ist gerade nicht bekannt.",
    "Die Datenbank ist gerade nicht erreichbar, deshalb kann sich das geändert haben.",
    "Ein UDP-Port, den dieser Server für Gateways braucht, ist belegt: er kann nicht übernehmen.",
    "Die Adresse seines MTConnect-Agenten ist belegt oder nicht erlaubt: er würde ohne den Agenten "
    "übernehmen.",
    "Seine DDS-Einstellungen sind andere als die des Servers mit der Bibliothek: er kann nicht "
    "übernehmen.",
    "Seine Einstellungen sind andere als die des Servers mit der Bibliothek: siehe sein Protokoll.",
    "Seine Uhr geht anders als die der Datenbank.",
    "Sein Datenträger ist voll oder fast voll.",
    "Diese Seite lädt sich selbst neu und wird zur gewohnten, sobald dieser Server die Bibliothek "
    "hat."};

/// The weight of one entry of Accept-Language: "de-AT;q=0.7".
double weight(std::string_view entry) {
  const auto at = entry.find(";q=");
  if (at == std::string_view::npos) return 1;
  double value = 0;
  const std::string_view number = trimmed(entry.substr(at + 3));
  std::from_chars(number.data(), number.data() + number.size(), value);
  return value;
}

/// English, unless German is wanted more.
const Words& words_for(std::string_view accept_language) {
  double german = 0, english = 0;
  while (!accept_language.empty()) {
    const auto comma = accept_language.find(',');
    const std::string_view entry = trimmed(accept_language.substr(0, comma));
    if (entry.starts_with("de")) german = std::max(german, weight(entry));
    if (entry.starts_with("en")) english = std::max(english, weight(entry));
    accept_language = comma == std::string_view::npos ? "" : accept_language.substr(comma + 1);
  }
  return german > english ? kGerman : kEnglish;
}

/// It comes from the database: only an address becomes a link.
std::string link_to(const std::string& url) {
  const std::string text = escape_markup(url);
  if (!url.starts_with("http://") && !url.starts_with("https://")) return text;
  return fmt::format("<a href=\"{0}/\">{0}</a>", text);
}

std::string place_of(const ActiveServer& active, const Words& words) {
  const std::string name = escape_markup(active.name);
  if (active.url.empty() && name.empty()) return std::string(words.unknown);
  if (active.url.empty()) return fmt::format("{} {}.", words.has_library, name);
  if (name.empty()) return fmt::format("{} {}", words.has_library, link_to(active.url));
  return fmt::format("{} {} ({})", words.has_library, link_to(active.url), name);
}

}  // namespace

bool wants_page(const api::Request& request) {
  if (request.method != "GET" && request.method != "HEAD") return false;
  const auto& segments = request.target.segments;
  if (!segments.empty() && segments.front() == "api") return false;
  return request.header("accept").find("text/html") != std::string::npos;
}

api::Response standby_page(const ActiveServer& active, const StandbyFaults& faults,
                           const api::Request& request) {
  const Words& words = words_for(request.header("accept-language"));
  api::Response response;
  response.status = kPageStatus;
  response.content_type = "text/html; charset=utf-8";
  response.body = fmt::format(
      "<!doctype html><html lang=\"{}\"><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"refresh\" content=\"{}\"><title>Dripline</title>\n"
      "<h1>Dripline</h1>\n<p>{}</p>\n<p>{}</p>\n",
      words.language, kReloadSeconds, words.waits, place_of(active, words));
  const auto add = [&response](const std::string& fault, std::string_view text) {
    if (!fault.empty()) response.body += fmt::format("<p>{}</p>\n", text);
  };
  add(faults.database, words.database_lost);
  add(faults.ports, words.blocked);
  add(faults.network, words.other_network);
  add(faults.agent, words.lacks_agent);
  add(faults.settings, words.other_settings);
  add(faults.clock, words.other_clock);
  add(faults.disk, words.lacks_disk);
  response.body += fmt::format("<p>{}</p>\n</html>\n", words.reloads);
  response.headers.emplace_back("Cache-Control", "no-store");
  response.headers.emplace_back("Vary", "Accept, Accept-Language");
  web::add_protection(response);
  return response;
}

}  // namespace dripline::app
