#include "storage/impl/webhook_repository.hpp"

#include <fmt/ranges.h>
#include <sstream>

#include "storage/impl/audit_repository.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

const std::string kWebhookColumns =
    "SELECT id, name, url, secret, kinds, author, created_us, delivered, delivered_us, failures, "
    "failing_since_us, fault, lost, ";
const std::string kSelectWebhook =
    kWebhookColumns +
    "(SELECT count(*) FROM event WHERE event.id > webhook.delivered AND (kinds = '' OR "
    "instr(',' || kinds || ',', ',' || event.kind || ',') > 0)) FROM webhook ";

Webhook read_webhook(const sql::Statement& row) {
  Webhook webhook;
  webhook.id = row.number(0);
  webhook.name = row.text(1);
  webhook.url = row.text(2);
  webhook.secret = row.text(3);
  std::istringstream kinds(row.text(4));
  for (std::string kind; std::getline(kinds, kind, ',');) webhook.kinds.push_back(kind);
  webhook.author = row.text(5);
  webhook.created = row.time(6);
  webhook.delivered = row.number(7);
  webhook.delivered_at = row.optional_time(8);
  webhook.failures = row.number(9);
  webhook.failing_since = row.optional_time(10);
  webhook.fault = row.text(11);
  webhook.lost = row.number(12);
  webhook.waiting = row.number(13);
  return webhook;
}

Result<Webhook> find_webhook(sql::Database& database, const std::string& name) {
  static const std::string kSql = kSelectWebhook + "WHERE name = ?1";
  auto webhook = sql::first_row(database, kSql, read_webhook, name);
  if (!webhook) return fail(webhook.error());
  if (!*webhook) return fail(Errc::NotFound, "webhook '{}' is not known", name);
  return std::move(**webhook);
}

/// What every webhook has; all of them when there is none.
Result<void> drop_delivered(sql::Database& database) {
  return sql::run(database,
                  "DELETE FROM event WHERE id <= coalesce((SELECT min(delivered) FROM webhook), "
                  "(SELECT max(id) FROM event))");
}

/// Scheme, host and port. What follows may hold a secret of the receiver's, and who reads the audit
/// trail is not to know it.
std::string origin_of(const std::string& url) {
  const auto scheme = url.find("://");
  const auto host = scheme == std::string::npos ? 0 : scheme + 3;
  return url.substr(0, url.find_first_of("/?", host));
}

}  // namespace

Result<std::vector<Webhook>> WebhookRepository::list() {
  static const std::string kSql = kSelectWebhook + "ORDER BY name LIMIT ?1";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_webhook, kMaxWebhooks);
  });
}

Result<Webhook> WebhookRepository::find(const std::string& name) {
  return connections_.read([&](sql::Database& database) { return find_webhook(database, name); });
}

Result<Webhook> WebhookRepository::receiver(std::uint64_t id) {
  static const std::string kSql = kWebhookColumns + "0 FROM webhook WHERE id = ?1";
  return connections_.read([&](sql::Database& database) -> Result<Webhook> {
    auto webhook = sql::first_row(database, kSql, read_webhook, id);
    if (!webhook) return fail(webhook.error());
    if (!*webhook) return fail(Errc::NotFound, "webhook {} was removed", id);
    return std::move(**webhook);
  });
}

Result<Webhook> WebhookRepository::add(const Webhook& webhook, const Actor& who) {
  return connections_.write([&](sql::Database& database) -> Result<Webhook> {
    const auto known = sql::all_rows(
        database, "SELECT name FROM webhook LIMIT ?1",
        [](const sql::Statement& row) { return row.text(0); }, kMaxWebhooks);
    if (!known) return fail(known.error());
    for (const auto& name : *known) {
      if (name == webhook.name) return fail(Errc::Conflict, "webhook '{}' exists already", name);
    }
    if (known->size() >= kMaxWebhooks)
      return fail(Errc::LimitExceeded, "there are {} webhooks, the limit", kMaxWebhooks);
    const auto inserted = sql::run(
        database,
        "INSERT INTO webhook (name, url, secret, kinds, author, created_us, delivered) VALUES (?1, "
        "?2, ?3, ?4, ?5, ?6, coalesce((SELECT max(id) FROM event), (SELECT max(delivered) FROM "
        "webhook), 0))",
        webhook.name, webhook.url, webhook.secret, fmt::format("{}", fmt::join(webhook.kinds, ",")),
        webhook.author, webhook.created);
    if (!inserted) return fail(inserted.error());
    auto written = add_audit(
        database, {webhook.created, who, "webhook.add", webhook.name, origin_of(webhook.url)});
    if (!written) return fail(written.error());
    return find_webhook(database, webhook.name);
  });
}

Result<void> WebhookRepository::remove(const std::string& name, const Actor& who, UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto webhook = find_webhook(database, name);
    if (!webhook) return fail(webhook.error());
    auto removed = sql::run(database, "DELETE FROM webhook WHERE name = ?1", name);
    if (!removed) return removed;
    if (auto dropped = drop_delivered(database); !dropped) return dropped;
    return add_audit(database, {time, who, "webhook.remove", name, origin_of(webhook->url)});
  });
}

Result<std::vector<Event>> WebhookRepository::events(std::uint64_t after, std::uint64_t limit) {
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database, "SELECT id, time_us, kind, data FROM event WHERE id > ?1 ORDER BY id LIMIT ?2",
        [](const sql::Statement& row) {
          return Event{row.number(0), row.time(1), row.text(2), row.text(3)};
        },
        after, limit);
  });
}

Result<void> WebhookRepository::set_delivered(std::uint64_t id, std::uint64_t event, UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto set = sql::run(database,
                        "UPDATE webhook SET delivered = max(delivered, ?2), delivered_us = ?3, "
                        "failures = 0, failing_since_us = NULL, fault = '' WHERE id = ?1",
                        id, event, time);
    return set ? drop_delivered(database) : set;
  });
}

Result<void> WebhookRepository::set_failing(std::uint64_t id, const std::string& fault,
                                            UtcTime time) {
  return connections_.write([&](sql::Database& database) {
    return sql::run(database,
                    "UPDATE webhook SET failures = failures + 1, fault = ?2, failing_since_us = "
                    "coalesce(failing_since_us, ?3) WHERE id = ?1",
                    id, fault, time);
  });
}

Result<void> WebhookRepository::trim() {
  const auto kept = connections_.read([](sql::Database& database) {
    return database.integer("SELECT coalesce(max(id) - min(id), 0) FROM event");
  });
  if (!kept) return fail(kept.error());
  if (*kept < static_cast<std::int64_t>(kMaxEvents)) return {};  // nearly always: nothing to write
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto last = database.integer("SELECT coalesce(max(id), 0) FROM event");
    if (!last) return fail(last.error());
    const auto first_kept = *last - static_cast<std::int64_t>(kMaxEvents);
    if (first_kept <= 0) return {};
    auto lost = sql::run(database,
                         "UPDATE webhook SET lost = lost + (SELECT count(*) FROM event WHERE id "
                         "> delivered AND id <= ?1), delivered = ?1 WHERE delivered < ?1",
                         first_kept);
    if (!lost) return lost;
    return sql::run(database, "DELETE FROM event WHERE id <= ?1", first_kept);
  });
}

}  // namespace dripline::storage
