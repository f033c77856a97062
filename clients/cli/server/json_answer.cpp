#include "clients/cli/server/json_answer.hpp"

#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {

using nlohmann::ordered_json;

int shown_json(const client::Client& client, const std::string& answer,
               const std::function<int(const ordered_json&)>& show, std::string_view call) {
  try {
    return show(ordered_json::parse(answer));
  } catch (const ordered_json::exception& unexpected) {  // what the library reports with
    complain(Error{Errc::Syntax, fmt::format("the answer of {}{} is not as expected: {}",
                                             client.address().url, call, unexpected.what())});
    return kExitUnreachable;
  }
}

int print_answer(const Context& context, const client::Client& client,
                 const client::Reply<std::string>& answer,
                 const std::function<void(const ordered_json&)>& print) {
  if (!answer) return complain(answer.error());
  return shown_json(client, *answer, [&](const ordered_json& shown) {
    if (context.wants_json) {
      context.print(json_text(shown));
    } else {
      print(shown);
    }
    return kExitOk;
  });
}

int print_listing(const Context& context, const client::Client& client,
                  const client::Reply<std::string>& answer, const Listing& listing) {
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    const auto& rows = shown.at(listing.name);
    if (rows.empty()) {
      context.print(listing.when_empty);
    } else {
      context.print(listing.table(rows));
    }
  });
}

std::string text_at(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || !found->is_string() ? "" : found->get<std::string>();
}

}  // namespace dripline::cli
