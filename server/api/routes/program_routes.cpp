#include <algorithm>

#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/api/content_body.hpp"
#include "server/api/interpretation.hpp"
#include "server/api/request.hpp"
#include "server/api/views.hpp"

namespace dripline::api {

namespace {

Response answer_upload(int status, const Result<storage::Upload>& upload) {
  if (!upload) return error_response(upload.error());
  return json_response(status, upload_json(*upload, Api::kMaxPiece));
}

Response begin_upload(Services& services, const Request& request) {
  const auto body = decode_upload(request.body);
  if (!body) return error_response(body.error());
  return answer_upload(201, services.programs.begin(*body, request.who));
}

Response show_upload(Services& services, const Request& request) {
  return answer_upload(200, own_upload(services, request));
}

Response append_upload(Services& services, const Request& request) {
  QueryReader query(request);
  const auto offset = query.number("offset", kMaxNumber);
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!offset) return error_response({Errc::Syntax, "query parameter 'offset' is missing"});
  if (request.body.empty()) return error_response({Errc::Syntax, "the piece is empty"});
  if (request.body.size() > Api::kMaxPiece) {
    return error_response({Errc::LimitExceeded, fmt::format("piece of {} bytes: at most {}",
                                                            request.body.size(), Api::kMaxPiece)});
  }
  if (const auto own = own_upload(services, request); !own) return error_response(own.error());
  return answer_upload(200, services.programs.append(request.parameter("id"), *offset,
                                                     std::as_bytes(std::span(request.body))));
}

Response commit_upload(Services& services, const Request& request) {
  const auto body = decode_commit(request.body);
  if (!body) return error_response(body.error());
  if (const auto own = own_upload(services, request); !own) return error_response(own.error());
  const auto protection =
      body->force ? library::Protection::Override : library::Protection::Respect;
  const auto committed =
      services.programs.commit(request.parameter("id"), body->sha256, request.who, protection);
  if (!committed) return error_response(committed.error());
  auto view = revision_json(committed->revision, services.programs.title(committed->revision));
  if (!committed->is_unchanged) return json_response(201, view);
  view["unchanged"] = true;
  return json_response(200, view);
}

Response abandon_upload(Services& services, const Request& request) {
  if (const auto own = own_upload(services, request); !own) return error_response(own.error());
  return empty_response(services.programs.abandon(request.parameter("id")));
}

}  // namespace

Result<storage::Upload> own_upload(Services& services, const Request& request) {
  return services.programs.upload(request.parameter("id"), request.who);
}

Result<std::uint64_t> revision_number(const Request& request) {
  const std::string& text = request.parameter("number");
  const auto number = parse_unsigned(text);
  if (!number) return fail(Errc::Syntax, "revision '{}' is not a whole number", text);
  return number;
}

void add_upload_routes(Router& router, Services& services) {
  router.add("POST", "/api/v1/uploads", with(services, begin_upload));
  router.add("GET", "/api/v1/uploads/{id}", with(services, show_upload));
  router.add("PUT", "/api/v1/uploads/{id}/content", with(services, append_upload));
  router.add("POST", "/api/v1/uploads/{id}/commit", with(services, commit_upload));
  router.add("DELETE", "/api/v1/uploads/{id}", with(services, abandon_upload));
}

namespace {

Response list_programs(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  storage::ProgramFilter filter{.part = query.text("part"),
                                .operation = query.text("operation"),
                                .material = query.text("material"),
                                .machine_group = query.text("machine_group"),
                                .control = query.text("control"),
                                .author = query.text("author"),
                                .state = {},
                                .after = query.text("after").value_or("")};
  const auto state = query.text("state");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (state) {
    const auto known = storage::parse_revision_state(*state);
    if (!known) return error_response(known.error());
    filter.state = *known;
  }
  const auto programs = services.programs.list(filter, page);
  if (!programs) return error_response(programs.error());
  auto list = nlohmann::json::array();
  for (const auto& program : *programs) {
    list.push_back(program_json(program, services.programs.title(program.latest)));
  }
  return json_response(200, {{"programs", std::move(list)}});
}

Response program_view(Services& services, const std::string& name) {
  const auto revisions = services.programs.revisions(name);
  if (!revisions) return error_response(revisions.error());
  const auto is_held = [](const storage::Revision& revision) { return revision.is_held; };
  const auto latest = std::ranges::find_if_not(*revisions, is_held);
  const auto held = static_cast<std::uint64_t>(std::ranges::count_if(*revisions, is_held));
  const auto& shown = latest == revisions->end() ? revisions->front() : *latest;
  auto fields = services.programs.fields(name);
  if (!fields) return error_response(fields.error());
  auto view = program_json(
      {.latest = shown, .revisions = revisions->size(), .held = held, .fields = *std::move(fields)},
      services.programs.title(shown));
  auto list = nlohmann::json::array();
  for (const auto& revision : *revisions) {
    list.push_back(revision_json(revision, services.programs.title(revision)));
  }
  view["revisions"] = std::move(list);
  return json_response(200, view);
}

Response show_program(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return program_view(services, request.parameter("name"));
}

Response describe_program(Services& services, const Request& request) {
  auto body = decode_description(request.body);
  if (!body) return error_response(body.error());
  body->program = request.parameter("name");
  body->who = request.who;
  const auto described = services.programs.describe(*body);
  return described ? program_view(services, body->program) : error_response(described.error());
}

Response copy_program(Services& services, const Request& request) {
  const auto body = decode_copy(request.body);
  if (!body) return error_response(body.error());
  const auto copy = services.programs.copy(
      {.from = request.parameter("name"), .to = body->to, .who = request.who}, body->revision);
  if (!copy) return error_response(copy.error());
  return json_response(201, revision_json(*copy, services.programs.title(*copy)));
}

Response rename_program(Services& services, const Request& request) {
  const auto to = decode_rename(request.body);
  if (!to) return error_response(to.error());
  const auto renamed =
      services.programs.rename({.from = request.parameter("name"), .to = *to, .who = request.who});
  return renamed ? program_view(services, *to) : error_response(renamed.error());
}

Response remove_program(Services& services, const Request& request) {
  QueryReader query(request);
  const std::string force = query.text("force").value_or("false");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (force != "true" && force != "false") {
    return error_response(
        {Errc::Syntax, fmt::format("query parameter 'force' is '{}': true or false", force)});
  }
  const auto protection =
      force == "true" ? library::Protection::Override : library::Protection::Respect;
  return empty_response(
      services.programs.remove(request.parameter("name"), request.who, protection));
}

Response accept_revision(Services& services, const Request& request) {
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto accepted = services.programs.accept(request.parameter("name"), *number, request.who);
  if (!accepted) return error_response(accepted.error());
  if (services.imports != nullptr) services.imports->publish(accepted->program, accepted->number);
  return json_response(200, revision_json(*accepted, services.programs.title(*accepted)));
}

Response send_content(Services& services, const Request& request) {
  QueryReader query(request);
  const auto number = query.number("revision", kMaxNumber);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto revision = services.programs.revision(request.parameter("name"), number);
  if (!revision) return error_response(revision.error());
  Response response = content_response(services, request, {revision->content, revision->size});
  if (response.status >= 400) return response;
  response.headers.emplace_back("Dripline-Sha256", revision->content.hex());
  response.headers.emplace_back("Dripline-Revision", std::to_string(revision->number));
  response.headers.emplace_back("Dripline-Size", std::to_string(revision->size));
  return response;
}

Response send_path(Services& services, const Request& request) {
  QueryReader query(request);
  const auto number = query.number("revision", kMaxNumber);
  const auto machine = query.text("machine");
  const auto tolerance = read_tolerance(query.text("tolerance"), 0);
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!tolerance) return error_response(tolerance.error());
  const auto revision = services.programs.revision(request.parameter("name"), number);
  if (!revision) return error_response(revision.error());
  auto opened = services.paths.open(
      {.revision = *revision, .machine = machine.value_or(""), .tolerance = *tolerance});
  if (!opened) return refused_interpretation(opened.error());
  Response response;
  response.content_type = "application/octet-stream";
  response.headers = {{"Dripline-Revision", std::to_string(revision->number)}};
  response.source = [reader = std::shared_ptr<paths::PathReader>(*std::move(opened))] {
    return reader->next();
  };
  return response;
}

}  // namespace

void add_program_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/programs", with(services, list_programs));
  router.add("GET", "/api/v1/programs/{name}", with(services, show_program));
  router.add("DELETE", "/api/v1/programs/{name}", with(services, remove_program));
  router.add("PUT", "/api/v1/programs/{name}/fields", with(services, describe_program));
  router.add("POST", "/api/v1/programs/{name}/copy", with(services, copy_program));
  router.add("POST", "/api/v1/programs/{name}/rename", with(services, rename_program));
  router.add("POST", "/api/v1/programs/{name}/revisions/{number}/accept",
             with(services, accept_revision));
  router.add("GET", "/api/v1/programs/{name}/content", with(services, send_content));
  router.add("GET", "/api/v1/programs/{name}/path", with(services, send_path));
}

}  // namespace dripline::api
