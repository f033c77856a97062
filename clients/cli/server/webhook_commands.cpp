#include <fmt/ranges.h>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct WebhookList {};

struct WebhookAddition {
  std::string name, url;
  std::vector<std::string> kinds;
};

struct WebhookChoice {
  std::string name;
};

int list_webhooks(Context& context, client::Client& client, const WebhookList& /*command*/) {
  const auto webhooks = client.webhooks();
  if (const auto status = finished(context, webhooks, "webhooks")) return *status;
  if (webhooks->empty()) {
    context.print("There are no webhooks.\n");
    return kExitOk;
  }
  Table table({"WEBHOOK", "STATE", "EVENTS", right("WAITING"), right("LOST"), "LAST DELIVERY",
               "URL", "FAULT"});
  for (const auto& webhook : *webhooks) {
    const bool is_failing = webhook.failures > 0;
    table.add({printable(webhook.name),
               is_failing ? Cell("failing", Style::Bad) : Cell("ok", Style::Good),
               webhook.kinds.empty() ? "all"
                                     : printable(fmt::format("{}", fmt::join(webhook.kinds, ","))),
               std::to_string(webhook.waiting), std::to_string(webhook.lost),
               time_text(webhook.delivered_at), printable(webhook.url), printable(webhook.fault)});
  }
  context.print(table);
  return kExitOk;
}

int add_webhook(Context& context, client::Client& client, const WebhookAddition& command) {
  const auto webhook = client.add_webhook(command.name, command.url, command.kinds);
  if (const auto status = finished(context, webhook)) return *status;
  context.print(fmt::format(
      "Webhook {} is delivered to {} from now on.\nIts secret, which is shown this once: {}\n",
      webhook->name, webhook->url, webhook->secret));
  return kExitOk;
}

int remove_webhook(Context& context, client::Client& client, const WebhookChoice& command) {
  const auto removed = client.remove_webhook(command.name);
  if (!removed) return complain(removed.error());
  context.print(fmt::format("Removed webhook {}.\n", command.name));
  return kExitOk;
}

int test_webhook(Context& context, client::Client& client, const WebhookChoice& command) {
  const auto test = client.test_webhook(command.name);
  if (!test) return complain(test.error());
  const int outcome = test->delivered ? kExitOk : kExitNo;
  if (context.wants_json) {
    context.print(json_text(*test));
  } else {
    context.print(test->delivered ? "Delivered.\n"
                                  : fmt::format("Not delivered: {}\n", printable(test->fault)));
  }
  return outcome;
}

}  // namespace

void add_webhook_commands(Command app, Context& context) {
  auto group = app.add_subcommand("webhook", "Tell other systems what changes, by HTTP");
  group.require_subcommand(1);

  auto list = group.add_subcommand("list", "List the webhooks and how they are delivered");
  add_json_flag(list, context);
  run_at_server(list, context, std::make_shared<WebhookList>(), list_webhooks);

  auto add = group.add_subcommand("add", "Add a webhook; it gets what happens from now on");
  auto addition = std::make_shared<WebhookAddition>();
  add.add_option("NAME", addition->name, "Its name").required();
  add.add_option("URL", addition->url, "http:// or https://, where events are posted").required();
  add.add_option("--events", addition->kinds,
                 "Only these, with commas: revision, run, alarm, import, job, part")
      .delimiter(',');
  add_json_flag(add, context);
  add.footer(
      "Each event is posted as JSON, in order, until the receiver answers with 2xx: at least "
      "once.\n"
      "Its id, Dripline-Delivery, is the same at every try; Dripline-Signature is HMAC-SHA256 of\n"
      "Dripline-Timestamp, a dot and the body, with the secret that is shown now.\n\n"
      "Example:\n  dnc webhook add erp https://erp.example/dripline --events run,alarm");
  run_at_server(add, context, addition, add_webhook);

  auto remove = group.add_subcommand("remove", "Remove a webhook");
  auto removal = std::make_shared<WebhookChoice>();
  remove.add_option("NAME", removal->name, "The webhook").required();
  run_at_server(remove, context, removal, remove_webhook);

  auto test = group.add_subcommand("test", "Deliver an event of the kind test now");
  auto tested = std::make_shared<WebhookChoice>();
  test.add_option("NAME", tested->name, "The webhook").required();
  add_json_flag(test, context);
  test.footer("Exit status: 0 it was delivered, 1 it was not.");
  run_at_server(test, context, tested, test_webhook);
}

}  // namespace dripline::cli
