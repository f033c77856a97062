// The calls of Client for what is beside the texts of programs: fields, attachments, search.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::get_part;
using impl::path_of;
using impl::with_method;
using impl::with_query;

namespace {

using Json = nlohmann::json;

std::string with_choice(std::string path, const ProgramChoice& choice) {
  path = with_query(std::move(path), "part", choice.part);
  path = with_query(std::move(path), "operation", choice.operation);
  path = with_query(std::move(path), "material", choice.material);
  path = with_query(std::move(path), "machine_group", choice.machine_group);
  path = with_query(std::move(path), "control", choice.control);
  path = with_query(std::move(path), "author", choice.author);
  return with_query(std::move(path), "state", choice.state);
}

std::string with_revision(std::string path, std::optional<std::uint64_t> revision) {
  return with_query(std::move(path), "revision", revision ? std::to_string(*revision) : "");
}

/// Percent-encoded: a name may have what ends a path.
std::string attachment_path(std::string_view program, std::string_view name) {
  const std::string encoded = path_of("programs", name);
  return path_of("programs", program) + "/attachments" + encoded.substr(path_of("programs").size());
}

}  // namespace

namespace impl {

void add_fields(Json& json, const FieldChange& change) {
  const auto add = [&](const char* name, const std::optional<std::string>& value) {
    if (value) json[name] = *value;
  };
  add("part", change.part);
  add("operation", change.operation);
  add("material", change.material);
  add("machine_group", change.machine_group);
  add("cam_file", change.cam_file);
}

}  // namespace impl

Reply<std::vector<Program>> Client::programs(const ProgramChoice& choice, std::uint64_t limit,
                                             const std::string& after) {
  std::string path = with_query(path_of("programs"), "limit", std::to_string(limit));
  path = with_query(std::move(path), "after", after);
  return fetch_list<Program>(with_choice(std::move(path), choice), "programs");
}

Reply<SearchResult> Client::search(const SearchQuery& query) {
  std::string path = with_query("/api/v1/search", "words", query.words);
  path = with_choice(std::move(path), query.choice);
  path = with_query(std::move(path), "machine", query.machine);
  if (query.with_replaced) path = with_query(std::move(path), "replaced", "true");
  if (query.before != 0) path = with_query(std::move(path), "before", std::to_string(query.before));
  path = with_query(std::move(path), "limit", std::to_string(query.limit));
  return fetch<SearchResult>(get(std::move(path)));
}

Reply<ProgramHistory> Client::describe_program(std::string_view name,
                                               std::optional<std::uint64_t> revision,
                                               const FieldChange& change) {
  Json json = Json::object();
  if (revision) json["revision"] = *revision;
  impl::add_fields(json, change);
  return fetch<ProgramHistory>(with_method("PUT", path_of("programs", name) + "/fields"),
                               dumped(json));
}

Reply<std::vector<Attachment>> Client::attachments(std::string_view program,
                                                   std::optional<std::uint64_t> revision) {
  return fetch_list<Attachment>(
      with_revision(path_of("programs", program) + "/attachments", revision), "attachments");
}

Reply<Upload> Client::open_attachment(const AttachmentRequest& request) {
  Json json{{"name", request.name}};
  if (request.revision) json["revision"] = *request.revision;
  if (!request.comment.empty()) json["comment"] = request.comment;
  return fetch<Upload>(with_method("POST", path_of("programs", request.program) + "/attachments"),
                       dumped(json));
}

Reply<Attachment> Client::commit_attachment(std::string_view upload, const std::string& sha256) {
  return fetch<Attachment>(with_method("POST", path_of("uploads", upload) + "/attach"),
                           dumped({{"sha256", sha256}}));
}

Reply<std::string> Client::attachment_bytes(const AttachmentRange& range) {
  auto response =
      exchange(get_part(with_revision(attachment_path(range.program, range.name), range.revision),
                        range.offset, range.length));
  if (!response) return failed(response.error());
  if (response->body.size() != range.length) {
    return failed(Failure::Kind::BadReply, Errc::Corrupt,
                  "{} gave {} bytes of attachment '{}' at {}, expected {}", address().url,
                  response->body.size(), range.name, range.offset, range.length);
  }
  return std::move(response->body);
}

Reply<void> Client::remove_attachment(const AttachmentRequest& attachment) {
  return perform(with_method(
      "DELETE",
      with_revision(attachment_path(attachment.program, attachment.name), attachment.revision)));
}

}  // namespace dripline::client
