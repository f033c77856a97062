#include "tests/unit/clients/support/fake_library.hpp"

#include "protocol/base/digest.hpp"
#include "tests/unit/clients/support/fake_answers.hpp"
#include "tests/unit/clients/support/server_json.hpp"

namespace dripline::test_support {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

void FakeLibrary::add_routes(httplib::Server& server) {
  add_program_routes(server);
  add_upload_routes(server);
}

std::uint64_t FakeLibrary::add(const std::string& name, const std::string& content) {
  auto& revisions = programs[name];
  revisions.push_back(content);
  digests[name + "/" + std::to_string(revisions.size())] = sha256(content).hex();
  return revisions.size();
}

void FakeLibrary::add_program_routes(httplib::Server& server) {
  server.Get("/api/v1/health", [](const Request&, Response& response) {
    answer(response, 200, {{"status", "ok"}});
  });
  server.Get("/api/v1/programs",
             [this](const Request& request, Response& response) { list(request, response); });
  server.Get(R"(/api/v1/programs/([^/]+))", [this](const Request& request, Response& response) {
    show(request.matches[1], response);
  });
  server.Get(
      R"(/api/v1/programs/([^/]+)/content)",
      [this](const Request& request, Response& response) { give_content(request, response); });
}

void FakeLibrary::list(const Request& request, Response& response) {
  const std::lock_guard lock(mutex);
  const auto limit = std::stoul(request.get_param_value("limit"));
  auto offset = request.has_param("offset") ? std::stoul(request.get_param_value("offset")) : 0;
  const std::string after = request.get_param_value("after");
  json all = json::array();
  for (const auto& [name, revisions] : programs) {
    if (name <= after && !after.empty()) continue;
    if (offset > 0) {
      --offset;
      continue;
    }
    if (all.size() == limit) break;
    json program = revision_json(name, "name", revisions.size(), revisions.back());
    program["revisions"] = revisions.size();
    all.push_back(program);
  }
  answer(response, 200, {{"programs", all}});
}

void FakeLibrary::show(const std::string& name, Response& response) {
  const std::lock_guard lock(mutex);
  const auto found = programs.find(name);
  if (found == programs.end()) return answer_error(response, 404, "not_found");
  const auto& revisions = found->second;
  json program = revision_json(name, "name", revisions.size(), revisions.back());
  program["revisions"] = json::array();
  for (std::size_t i = 1; i <= revisions.size(); ++i) {
    json revision = revision_json(name, "program", i, revisions[i - 1]);
    revision["sha256"] = digests[name + "/" + std::to_string(i)];
    program["revisions"].push_back(revision);
  }
  answer(response, 200, program);
}

void FakeLibrary::give_content(const Request& request, Response& response) {
  const std::lock_guard lock(mutex);
  const std::string name = request.matches[1];
  const auto number = std::stoul(request.get_param_value("revision"));
  const std::string content = programs[name][number - 1];
  response.set_header("Dripline-Sha256", digests[name + "/" + std::to_string(number)]);
  response.set_header("Dripline-Size", std::to_string(content.size()));
  response.set_header("Dripline-Revision", std::to_string(number));
  const auto first = static_cast<std::size_t>(request.ranges.at(0).first);
  const auto last = static_cast<std::size_t>(request.ranges.at(0).second);
  longest_piece = std::max(longest_piece, last - first + 1);
  if (content_cuts > 0) {
    --content_cuts;
    return cut(response);
  }
  if (damage && *damage >= first && *damage <= last) {
    if (*damage - first > 64 * 1024) return cut(response);
    return refuse_damaged(response);
  }
  // The library cuts the range out by itself.
  response.status = 206;
  response.set_content(content, "application/octet-stream");
}

void FakeLibrary::add_upload_routes(httplib::Server& server) {
  server.Post("/api/v1/uploads", [this](const Request& request, Response& response) {
    const std::lock_guard lock(mutex);
    const std::string id = "u" + std::to_string(++upload_count_);
    uploads[id] = {json::parse(request.body).at("program"), ""};
    answer_upload(response, 201, id);
  });
  server.Get(R"(/api/v1/uploads/(\w+))", [this](const Request& request, Response& response) {
    const std::lock_guard lock(mutex);
    answer_upload(response, 200, request.matches[1]);
  });
  server.Delete(R"(/api/v1/uploads/(\w+))", [this](const Request& request, Response& response) {
    const std::lock_guard lock(mutex);
    uploads.erase(request.matches[1]);
    response.status = 204;
  });
  server.Put(R"(/api/v1/uploads/(\w+)/content)",
             [this](const Request& request, Response& response) { take_piece(request, response); });
  server.Post(R"(/api/v1/uploads/(\w+)/commit)",
              [this](const Request& request, Response& response) { commit(request, response); });
}

void FakeLibrary::answer_upload(Response& response, int status, const std::string& id) {
  const auto found = uploads.find(id);
  if (found == uploads.end()) return answer_error(response, 404, "not_found");
  answer(response, status,
         {{"id", id},
          {"program", found->second.program},
          {"received", found->second.bytes.size()},
          {"max_piece", 4 * 1024 * 1024}});
}

void FakeLibrary::take_piece(const Request& request, Response& response) {
  const std::lock_guard lock(mutex);
  auto& upload = uploads[request.matches[1]];
  ++pieces;
  longest_piece = std::max(longest_piece, request.body.size());
  if (std::stoul(request.get_param_value("offset")) != upload.bytes.size()) {
    return answer_error(response, 409, "conflict");
  }
  if (piece_faults.empty()) {
    upload.bytes += request.body;
    return answer_upload(response, 200, request.matches[1]);
  }
  const FakeServer::PieceFault fault = piece_faults.front();
  piece_faults.pop_front();
  upload.bytes += request.body.substr(0, fault.keep);
  if (fault.drops_upload) uploads.erase(request.matches[1]);
  if (fault.status != 0) return answer_error(response, fault.status, fault.code);
  cut(response);
}

void FakeLibrary::commit(const Request& request, Response& response) {
  const std::lock_guard lock(mutex);
  const auto found = uploads.find(request.matches[1]);
  if (found == uploads.end()) return answer_error(response, 404, "not_found");
  const StoredUpload upload = found->second;
  if (json::parse(request.body).at("sha256") != sha256(upload.bytes).hex()) {
    return answer_error(response, 400, "corrupt");
  }
  uploads.erase(found);
  auto& revisions = programs[upload.program];
  if (!revisions.empty() && revisions.back() == upload.bytes) {
    json revision = revision_json(upload.program, "program", revisions.size(), upload.bytes);
    revision["unchanged"] = true;
    return answer(response, 200, revision);
  }
  const auto number = add(upload.program, upload.bytes);
  if (std::exchange(loses_commit, false)) return cut(response);
  answer(response, 201, revision_json(upload.program, "program", number, upload.bytes));
}

}  // namespace dripline::test_support
