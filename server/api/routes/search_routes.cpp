#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

json hit_json(Services& services, const library::SearchResult::Hit& found) {
  const storage::Revision& revision = found.hit.revision;
  json view = revision_json(revision, services.programs.title(revision));
  view.update(fields_json(found.hit.fields));
  view["line"] = found.line ? json(found.line->line) : json(nullptr);
  view["text"] = found.line ? json(found.line->text) : json(nullptr);
  view["partly_indexed"] = found.is_partly_indexed;
  return view;
}

Response search(Services& services, const Request& request) {
  QueryReader query(request);
  library::SearchRequest wanted;
  wanted.words = query.text("words").value_or("");
  wanted.filter = {.part = query.text("part"),
                   .operation = query.text("operation"),
                   .material = query.text("material"),
                   .machine_group = query.text("machine_group"),
                   .control = query.text("control"),
                   .author = query.text("author"),
                   .machine = query.text("machine")};
  const auto state = query.text("state");
  const std::string replaced = query.text("replaced").value_or("false");
  wanted.before = query.number("before", kMaxNumber).value_or(0);
  wanted.limit = query.number("limit", library::ProgramSearch::kMaxLimit).value_or(wanted.limit);
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (replaced != "true" && replaced != "false") {
    return error_response(
        {Errc::Syntax, fmt::format("query parameter 'replaced' is '{}': true or false", replaced)});
  }
  wanted.filter.with_replaced = replaced == "true";
  if (state) {
    const auto known = storage::parse_revision_state(*state);
    if (!known) return error_response(known.error());
    wanted.filter.state = *known;
  }
  const auto result = services.search.search(wanted);
  if (!result) return error_response(result.error());
  json hits = json::array();
  for (const auto& hit : result->hits) hits.push_back(hit_json(services, hit));
  return json_response(200, {{"hits", std::move(hits)},
                             {"next", number_or_null(result->next)},
                             {"to_be_indexed", result->to_be_indexed}});
}

}  // namespace

void add_search_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/search", with(services, search));
}

}  // namespace dripline::api
