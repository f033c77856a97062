#include "clients/lib/client.hpp"

#include <algorithm>
#include <charconv>

#include "clients/lib/api_json.hpp"
#include "clients/lib/impl/request.hpp"
#include "clients/lib/request_age.hpp"
#include "clients/lib/shared_http.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::get_part;
using impl::path_of;
using impl::with_method;
using impl::with_number;
using impl::with_page;
using impl::with_query;

namespace {

using Json = nlohmann::json;

/// The inverse of to_string.
Errc code_of(std::string_view name) {
  using enum Errc;
  for (const Errc code : {Syntax, Conflict, Unsupported, LimitExceeded, NotFound, Busy, Timeout,
                          Corrupt, Io, Denied}) {
    if (to_string(code) == name) return code;
  }
  return Io;
}

/// The error that the server reports.
Failure refusal(const HttpResponse& response, const std::string& url) {
  std::string code, message;
  if (auto json = parse_json(response.body); json && json->is_object()) {
    if (const auto error = json->find("error"); error != json->end() && error->is_object()) {
      code = error->value("code", "");
      message = error->value("message", "");
    }
  }
  if (response.status == 403 && !message.empty()) {
    return {Failure::Kind::Denied, Errc::Denied, message};
  }
  if (response.status == 401 || response.status == 403 || code == "denied") {
    return {Failure::Kind::Denied, Errc::Denied,
            fmt::format("server {} does not accept the token{}{}; expected the right one from "
                        "--token-file FILE, DRIPLINE_TOKEN or dnc login",
                        url, message.empty() ? "" : ": ", message)};
  }
  if (message.empty()) {
    return {Failure::Kind::BadReply, Errc::Io,
            fmt::format("{} answered with status {} and no reason; is it a Dripline server?", url,
                        response.status)};
  }
  return {Failure::Kind::Refused, code_of(code), message};
}

std::uint64_t header_number(const HttpResponse& response, const std::string& name) {
  const auto found = response.headers.find(name);
  std::uint64_t value = 0;
  if (found == response.headers.end()) return value;
  const std::string& text = found->second;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string header_text(const HttpResponse& response, const std::string& name) {
  const auto found = response.headers.find(name);
  return found == response.headers.end() ? std::string() : found->second;
}

std::string command_body(const CommandRequest& command) {
  Json body{{"action", command.action}};
  if (command.text) body["text"] = *command.text;
  if (command.name) body["name"] = *command.name;
  if (command.value) body["value"] = *command.value;
  return dumped(body);
}

}  // namespace

Client::Client(ServerAddress address, const HttpOptions& options)
    : Client(std::vector<ServerAddress>{std::move(address)}, options) {}

Client::Client(std::vector<ServerAddress> servers, const HttpOptions& options)
    : servers_(std::move(servers)), http_(open_http(servers_, options)) {}

Client::Client(ServerAddress address, std::unique_ptr<Http> http)
    : servers_{std::move(address)}, http_(std::move(http)) {}

const ServerAddress& Client::address() const {
  const ServerAddress* const answering = http_->answering();
  return answering != nullptr ? *answering : servers_.front();
}

Reply<HttpResponse> Client::exchange(const HttpRequest& request) {
  auto response = http_->send(request);
  if (!response) return response;
  if (response->status < 200 || response->status >= 300) {
    return failed(refusal(*response, address().url));
  }
  return response;
}

Reply<void> Client::perform(HttpRequest request, std::string_view body) {
  if (!body.empty()) request.body = body;
  auto response = exchange(request);
  if (!response) return failed(response.error());
  return {};
}

Reply<std::string> Client::fetch_text(HttpRequest request, std::string_view body) {
  if (!body.empty()) request.body = body;
  auto response = exchange(request);
  if (!response) return failed(response.error());
  return std::move(response->body);
}

template <class T>
Reply<T> Client::fetch(HttpRequest request, std::string_view body) {
  if (!body.empty()) request.body = body;
  auto response = exchange(request);
  if (!response) return failed(response.error());
  auto json = parse_json(response->body);
  auto value = json ? from_json<T>(*json) : Result<T>(tl::make_unexpected(json.error()));
  if (!value) {
    return failed(Failure::Kind::BadReply, Errc::Syntax,
                  "the answer of {} to {} {} is not as expected: {}", address().url, request.method,
                  request.path, value.error().what);
  }
  return std::move(*value);
}

template <class T>
Reply<std::vector<T>> Client::fetch_list(const std::string& path, const char* member) {
  auto response = exchange(get(path));
  if (!response) return failed(response.error());
  auto json = parse_json(response->body);
  const auto bad = [&](std::string_view why) {
    return failed(Failure::Kind::BadReply, Errc::Syntax,
                  "the answer of {} to {} is not as expected: {}", address().url, path, why);
  };
  if (!json || !json->is_object() || !json->contains(member) || !(*json)[member].is_array()) {
    return bad(fmt::format("no list \"{}\"", member));
  }
  std::vector<T> list;
  for (const auto& item : (*json)[member]) {
    auto value = from_json<T>(item);
    if (!value) return bad(value.error().what);
    list.push_back(std::move(*value));
  }
  return list;
}

template Reply<Revision> Client::fetch(HttpRequest, std::string_view);
template Reply<RevisionStates> Client::fetch(HttpRequest, std::string_view);
template Reply<Closure> Client::fetch(HttpRequest, std::string_view);
template Reply<ProgramHistory> Client::fetch(HttpRequest, std::string_view);
template Reply<Upload> Client::fetch(HttpRequest, std::string_view);
template Reply<Attachment> Client::fetch(HttpRequest, std::string_view);
template Reply<SearchResult> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<Program>> Client::fetch_list(const std::string&, const char*);
template Reply<std::vector<Attachment>> Client::fetch_list(const std::string&, const char*);
template Reply<Session> Client::fetch(HttpRequest, std::string_view);
template Reply<User> Client::fetch(HttpRequest, std::string_view);
template Reply<Token> Client::fetch(HttpRequest, std::string_view);
template Reply<MachineGroup> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<Import>> Client::fetch_list(const std::string&, const char*);
template Reply<std::vector<User>> Client::fetch_list(const std::string&, const char*);
template Reply<std::vector<Token>> Client::fetch_list(const std::string&, const char*);
template Reply<std::vector<Folder>> Client::fetch_list(const std::string&, const char*);
template Reply<std::vector<FolderFile>> Client::fetch_list(const std::string&, const char*);
template Reply<AuditState> Client::fetch(HttpRequest, std::string_view);
template Reply<Backups> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<MachineGroup>> Client::fetch_list(const std::string&, const char*);
template Reply<Machine> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<Machine>> Client::fetch_list(const std::string&, const char*);
template Reply<std::vector<Memory>> Client::fetch_list(const std::string&, const char*);
template Reply<PositionSet> Client::fetch(HttpRequest, std::string_view);
template Reply<JogDone> Client::fetch(HttpRequest, std::string_view);
template Reply<PlaybackBlock> Client::fetch(HttpRequest, std::string_view);
template Reply<ControlValues> Client::fetch(HttpRequest, std::string_view);
template Reply<Run> Client::fetch(HttpRequest, std::string_view);
template Reply<BegunRun> Client::fetch(HttpRequest, std::string_view);
template Reply<ShownRun> Client::fetch(HttpRequest, std::string_view);
template Reply<Webhook> Client::fetch(HttpRequest, std::string_view);
template Reply<WebhookTest> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<Webhook>> Client::fetch_list(const std::string&, const char*);
template Reply<Job> Client::fetch(HttpRequest, std::string_view);
template Reply<JobList> Client::fetch(HttpRequest, std::string_view);
template Reply<Setup> Client::fetch(HttpRequest, std::string_view);
template Reply<LoadedSetup> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<Setup>> Client::fetch_list(const std::string&, const char*);
template Reply<Port> Client::fetch(HttpRequest, std::string_view);
template Reply<PortTest> Client::fetch(HttpRequest, std::string_view);
template Reply<Transfer> Client::fetch(HttpRequest, std::string_view);
template Reply<RuleVerdict> Client::fetch(HttpRequest, std::string_view);
template Reply<PortTemplates> Client::fetch(HttpRequest, std::string_view);
template Reply<std::vector<Port>> Client::fetch_list(const std::string&, const char*);

Reply<void> Client::health() {
  return perform(get(path_of("health")));
}

Reply<ServerInfo> Client::server() {
  return fetch<ServerInfo>(get(path_of("server")));
}

Reply<ServerInfo::Sharing> Client::drain() {
  return fetch<ServerInfo::Sharing>(with_method("POST", path_of("server") + "/drain"));
}

Reply<Backups> Client::backups() {
  return fetch<Backups>(get(path_of("backups")));
}

Reply<Backups> Client::make_backup() {
  return fetch<Backups>(with_method("POST", path_of("backups")));
}

Reply<Backups> Client::verify_backup(std::string_view id) {
  return fetch<Backups>(with_method("POST", path_of("backups", id) + "/verify"));
}

Reply<void> Client::remove_backup(std::string_view id) {
  return perform(with_method("DELETE", path_of("backups", id)));
}

Reply<std::vector<Program>> Client::programs(Page page) {
  return fetch_list<Program>(with_page(path_of("programs"), page), "programs");
}

Reply<ProgramHistory> Client::program(std::string_view name) {
  return fetch<ProgramHistory>(get(path_of("programs", name)));
}

Reply<void> Client::remove_program(std::string_view name, bool overrides_protection) {
  std::string path = path_of("programs", name);
  if (overrides_protection) path = with_query(std::move(path), "force", "true");
  return perform(with_method("DELETE", path));
}

Reply<Revision> Client::copy_program(std::string_view from, const std::string& to,
                                     std::optional<std::uint64_t> revision) {
  Json json{{"to", to}};
  if (revision) json["revision"] = *revision;
  return fetch<Revision>(with_method("POST", path_of("programs", from) + "/copy"), dumped(json));
}

Reply<ProgramHistory> Client::rename_program(std::string_view from, const std::string& to) {
  return fetch<ProgramHistory>(with_method("POST", path_of("programs", from) + "/rename"),
                               dumped({{"to", to}}));
}

Reply<Revision> Client::accept_revision(std::string_view name, std::uint64_t revision) {
  return fetch<Revision>(with_method(
      "POST", fmt::format("{}/revisions/{}/accept", path_of("programs", name), revision)));
}

Reply<Content> Client::content(const ContentRange& range) {
  const HttpRequest request = get_part(with_query(path_of("programs", range.program) + "/content",
                                                  "revision", std::to_string(range.revision)),
                                       range.offset, range.length);
  auto response = exchange(request);
  if (!response) return failed(response.error());
  if (response->body.size() > range.length) {
    return failed(Failure::Kind::BadReply, Errc::LimitExceeded,
                  "the answer of {} to {} is longer than {} bytes", address().url, request.path,
                  range.length);
  }
  if (response->status != 206 && range.offset != 0) {
    return failed(Failure::Kind::BadReply, Errc::Unsupported,
                  "{} does not serve parts of a program (status {}, expected 206)", address().url,
                  response->status);
  }
  Content content;
  content.sha256 = header_text(*response, "dripline-sha256");
  content.revision = header_number(*response, "dripline-revision");
  content.size = header_number(*response, "dripline-size");
  content.bytes = std::move(response->body);
  return content;
}

Reply<Upload> Client::open_upload(const UploadRequest& request) {
  Json json{{"program", request.program}};
  if (!request.control.empty()) json["control"] = request.control;
  if (!request.comment.empty()) json["comment"] = request.comment;
  impl::add_fields(json, request.fields);
  return fetch<Upload>(with_method("POST", path_of("uploads")), dumped(json));
}

Reply<Upload> Client::upload(std::string_view id) {
  return fetch<Upload>(get(path_of("uploads", id)));
}

Reply<Upload> Client::put_piece(std::string_view id, const Piece& piece) {
  HttpRequest http = with_method("PUT", with_query(path_of("uploads", id) + "/content", "offset",
                                                   std::to_string(piece.offset)));
  http.content_type = "application/octet-stream";
  http.body = piece.bytes;
  http.on_sent = piece.on_sent;
  return fetch<Upload>(http);
}

Reply<Revision> Client::commit_upload(std::string_view id, const CommitRequest& request) {
  Json json = Json::object();
  if (!request.sha256.empty()) json["sha256"] = request.sha256;
  if (request.overrides_protection) json["force"] = true;
  return fetch<Revision>(with_method("POST", path_of("uploads", id) + "/commit"), dumped(json));
}

Reply<void> Client::drop_upload(std::string_view id) {
  return perform(with_method("DELETE", path_of("uploads", id)));
}

Reply<BegunRun> Client::start_run(const RunRequest& request) {
  Json json{{"machine", request.machine}, {"program", request.program}};
  if (request.revision) json["revision"] = *request.revision;
  if (!request.from.empty()) json["from"] = request.from;
  if (!request.head.empty()) json["head"] = request.head;
  if (!request.memory.empty()) json["memory"] = request.memory;
  if (request.pass) json["pass"] = *request.pass;
  if (request.is_test) json["test"] = true;
  return fetch<BegunRun>(with_method("POST", path_of("runs")), dumped(json));
}

Reply<Run> Client::restart_run(std::string_view run, std::string_view at) {
  return fetch<Run>(with_method("POST", path_of("runs", run) + "/restart"),
                    dumped(Json{{"at", at}}));
}

Reply<std::vector<Run>> Client::runs(const RunQuery& query) {
  std::string path = with_page(path_of("runs"), query.page);
  path = with_query(std::move(path), "machine", query.machine);
  path = with_query(std::move(path), "program", query.program);
  path = with_query(std::move(path), "state", query.state);
  return fetch_list<Run>(path, "runs");
}

Reply<Run> Client::run(std::string_view id) {
  return fetch<Run>(get(path_of("runs", id)));
}

Reply<ShownRun> Client::shown_run(std::string_view id) {
  return fetch<ShownRun>(get(path_of("runs", id)));
}

Reply<void> Client::command(std::string_view run, const CommandRequest& request) {
  return send_command(path_of("runs", run), request);
}

Reply<void> Client::send_command(const std::string& path, const CommandRequest& request) {
  HttpRequest post = with_method("POST", path + "/commands");
  if (request.asked)
    add_age(post.headers,
            std::chrono::ceil<RequestAge>(std::chrono::steady_clock::now() - *request.asked));
  return perform(std::move(post), command_body(request));
}

Reply<std::vector<Record>> Client::records(std::string_view run, std::string_view kind, Page page) {
  const std::string path = with_page(path_of("runs", run) + "/records", page);
  return fetch_list<Record>(with_query(path, "kind", kind), "records");
}

Reply<std::vector<Report>> Client::reports(const ReportQuery& query) {
  std::string path = with_page(path_of("reports"), query.page);
  path = with_query(std::move(path), "machine", query.machine);
  path = with_query(std::move(path), "program", query.program);
  return fetch_list<Report>(path, "reports");
}

Reply<void> Client::export_report(std::string_view run, std::string_view format,
                                  const std::function<bool(std::string_view)>& sink) {
  HttpRequest request = get(with_query(path_of("reports", run), "format", format));
  request.on_body = sink;
  return perform(request);
}

Reply<std::vector<MachineReport>> Client::machine_reports() {
  return fetch_list<MachineReport>(path_of("machine-reports"), "reports");
}

Reply<void> Client::export_machine_report(std::string_view machine, std::string_view format,
                                          const std::function<bool(std::string_view)>& sink) {
  HttpRequest request = get(with_query(path_of("machines", machine) + "/report", "format", format));
  request.on_body = sink;
  return perform(request);
}

}  // namespace dripline::client
