#include "tests/unit/clients/support/fake_server.hpp"

#include <httplib.h>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "protocol/base/digest.hpp"
#include "tests/unit/clients/support/fake_event_stream.hpp"
#include "tests/unit/clients/support/server_json.hpp"

namespace dripline::test_support {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

struct StoredUpload {
  std::string program, bytes;
};

void answer(Response& response, int status, const json& body) {
  response.status = status;
  response.set_content(body.dump(), "application/json");
}

void answer_error(Response& response, int status, const std::string& code) {
  answer(response, status, {{"error", {{"code", code}, {"message", "fake: " + code}}}});
}

/// Begins an answer and cuts the connection.
void cut(Response& response) {
  response.status = 200;
  response.set_content_provider(100, "application/json",
                                [](std::size_t, std::size_t, httplib::DataSink&) { return false; });
}

/// In chunks: of any other body the library would cut the wanted range out.
void refuse_damaged(Response& response) {
  response.status = 500;
  response.set_chunked_content_provider(
      "application/json", [](std::size_t, httplib::DataSink& sink) {
        const std::string text =
            json{{"error", {{"code", "corrupt"}, {"message", "chunk 3 is damaged"}}}}.dump();
        sink.write(text.data(), text.size());
        sink.done();
        return true;
      });
}

}  // namespace

class FakeServer::Impl {
 public:
  Impl() {
    server_.set_pre_routing_handler([](const Request& request, Response& response) {
      if (request.path == "/api/v1/health" ||
          request.get_header_value("Authorization") == std::string("Bearer ") + kToken) {
        return httplib::Server::HandlerResponse::Unhandled;
      }
      answer_error(response, 401, "denied");
      return httplib::Server::HandlerResponse::Handled;
    });
    // Pings of one another wait a tenth of a second on Nagle's algorithm otherwise.
    server_.set_tcp_nodelay(true);
    add_program_routes();
    add_upload_routes();
    add_machine_routes();
    add_run_routes();
    add_output_routes();
    add_set_routes();
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }

  ~Impl() {
    events.stop();
    server_.stop();
    thread_.join();
  }

  int port() const { return port_; }

  mutable std::mutex mutex;
  std::map<std::string, std::vector<std::string>> programs;
  std::map<std::string, std::string> digests;  ///< by program and number, as first stored
  std::map<std::string, StoredUpload> uploads;
  std::deque<PieceFault> piece_faults;
  bool loses_commit = false;
  int content_cuts = 0, pieces = 0;
  std::optional<std::size_t> damage;
  std::size_t longest_piece = 0;
  std::vector<json> runs;
  std::map<std::string, json> machines;
  std::function<void(const std::string&, const json&)> command_handler;
  std::map<std::string, std::pair<int, std::string>> answers;
  std::vector<std::string> calls;
  FakeEventStream events;

  std::uint64_t add(const std::string& name, const std::string& content) {
    auto& revisions = programs[name];
    revisions.push_back(content);
    digests[name + "/" + std::to_string(revisions.size())] = sha256(content).hex();
    return revisions.size();
  }

 private:
  void add_program_routes() {
    server_.Get("/api/v1/health", [](const Request&, Response& response) {
      answer(response, 200, {{"status", "ok"}});
    });
    server_.Get("/api/v1/programs",
                [this](const Request& request, Response& response) { list(request, response); });
    server_.Get(R"(/api/v1/programs/([^/]+))", [this](const Request& request, Response& response) {
      show(request.matches[1], response);
    });
    server_.Get(
        R"(/api/v1/programs/([^/]+)/content)",
        [this](const Request& request, Response& response) { give_content(request, response); });
  }

  void list(const Request& request, Response& response) {
    const std::lock_guard lock(mutex);
    const auto limit = std::stoul(request.get_param_value("limit"));
    auto offset = std::stoul(request.get_param_value("offset"));
    json all = json::array();
    for (const auto& [name, revisions] : programs) {
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

  void show(const std::string& name, Response& response) {
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

  void give_content(const Request& request, Response& response) {
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

  void add_upload_routes() {
    server_.Post("/api/v1/uploads", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      const std::string id = "u" + std::to_string(++upload_count_);
      uploads[id] = {json::parse(request.body).at("program"), ""};
      answer_upload(response, 201, id);
    });
    server_.Get(R"(/api/v1/uploads/(\w+))", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      answer_upload(response, 200, request.matches[1]);
    });
    server_.Delete(R"(/api/v1/uploads/(\w+))", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      uploads.erase(request.matches[1]);
      response.status = 204;
    });
    server_.Put(
        R"(/api/v1/uploads/(\w+)/content)",
        [this](const Request& request, Response& response) { take_piece(request, response); });
    server_.Post(R"(/api/v1/uploads/(\w+)/commit)",
                 [this](const Request& request, Response& response) { commit(request, response); });
  }

  void answer_upload(Response& response, int status, const std::string& id) {
    const auto found = uploads.find(id);
    if (found == uploads.end()) return answer_error(response, 404, "not_found");
    answer(response, status,
           {{"id", id},
            {"program", found->second.program},
            {"received", found->second.bytes.size()},
            {"max_piece", 4 * 1024 * 1024}});
  }

  void take_piece(const Request& request, Response& response) {
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
    const PieceFault fault = piece_faults.front();
    piece_faults.pop_front();
    upload.bytes += request.body.substr(0, fault.keep);
    if (fault.drops_upload) uploads.erase(request.matches[1]);
    if (fault.status != 0) return answer_error(response, fault.status, fault.code);
    cut(response);
  }

  void commit(const Request& request, Response& response) {
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

  void add_machine_routes() {
    server_.Get("/api/v1/machines", [this](const Request&, Response& response) {
      const std::lock_guard lock(mutex);
      json all = json::array();
      for (const auto& [name, machine] : machines) all.push_back(machine);
      answer(response, 200, {{"machines", all}});
    });
    server_.Get(R"(/api/v1/machines/([\w-]+))", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      const auto found = machines.find(request.matches[1]);
      if (found == machines.end()) return answer_error(response, 404, "not_found");
      answer(response, 200, found->second);
    });
  }

  void add_run_routes() {
    server_.Get("/api/v1/runs", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      json all = json::array();
      const auto limit = std::stoul(request.get_param_value("limit"));
      for (auto i = std::stoul(request.get_param_value("offset"));
           i < runs.size() && all.size() < limit; ++i) {
        all.push_back(runs[i]);
      }
      answer(response, 200, {{"runs", all}});
    });
    server_.Post("/api/v1/runs", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      if (command_handler) command_handler("", json::parse(request.body));
      if (runs.empty()) return answer_error(response, 404, "not_found");
      answer(response, 201, runs.front());
    });
    server_.Get(R"(/api/v1/runs/([\w-]+))", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      for (const auto& run : runs) {
        if (run["id"] == request.matches[1].str()) return answer(response, 200, run);
      }
      answer_error(response, 404, "not_found");
    });
    server_.Post(R"(/api/v1/(?:runs|machines)/([\w-]+)/commands)",
                 [this](const Request& request, Response& response) {
                   const std::lock_guard lock(mutex);
                   if (command_handler)
                     command_handler(request.matches[1], json::parse(request.body));
                   answer(response, 200, {{"accepted", true}});
                 });
  }

  void add_output_routes() {
    server_.Get(R"(/api/v1/reports/([\w-]+))", [](const Request& request, Response& response) {
      response.set_content("report as " + request.get_param_value("format") + "\n", "text/plain");
    });
    server_.Get(R"(/api/v1/(events|ports/[\w-]+/traffic))",
                [this](const Request&, Response& response) {
                  response.set_chunked_content_provider(
                      "text/event-stream",
                      [this, next = std::size_t{0}](std::size_t, httplib::DataSink& sink) mutable {
                        return events.send(sink, next);
                      });
                });
  }

  /// What a test says is answered.
  void add_set_routes() {
    const auto give = [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      const std::string call = request.method + " " + request.path;
      const bool is_setup = request.path.find("/setup") != std::string::npos;
      calls.push_back((is_setup ? request.method + " " + request.target : call) + " " +
                      request.body);
      const auto found = answers.find(call);
      if (found == answers.end()) return answer_error(response, 404, "not_found");
      response.status = found->second.first;
      response.set_content(found->second.second, "application/json");
    };
    const std::string ports = R"(/api/v1/port.*)";
    server_.Get(R"(/api/v1/machines/[\w-]+/setup)", give);
    server_.Get(ports, give);
    server_.Put(ports, give);
    server_.Post(ports, give);
    server_.Delete(ports, give);
    server_.Post(R"(/api/v1/programs/.*)", give);
    const std::string setups = R"(/api/v1/machines/[\w-]+/setups?)";
    server_.Get(setups, give);
    server_.Put(setups, give);
    server_.Get(R"(/api/v1/runs/[\w-]+/records)", give);
  }

  httplib::Server server_;
  std::thread thread_;
  int upload_count_ = 0;
  int port_ = 0;
};

FakeServer::FakeServer() : impl_(std::make_unique<Impl>()) {}
FakeServer::~FakeServer() = default;

std::string FakeServer::url() const {
  return "http://127.0.0.1:" + std::to_string(impl_->port());
}

void FakeServer::fail_piece(PieceFault fault) {
  const std::lock_guard lock(impl_->mutex);
  impl_->piece_faults.push_back(std::move(fault));
}

void FakeServer::lose_commit_answer() {
  const std::lock_guard lock(impl_->mutex);
  impl_->loses_commit = true;
}

void FakeServer::cut_content(int times) {
  const std::lock_guard lock(impl_->mutex);
  impl_->content_cuts = times;
}

void FakeServer::damage_content_at(std::size_t offset) {
  const std::lock_guard lock(impl_->mutex);
  impl_->damage = offset;
}

void FakeServer::corrupt_content(const std::string& program) {
  const std::lock_guard lock(impl_->mutex);
  impl_->programs.at(program).back().front() ^= 1;
}

void FakeServer::cut_events_once() {
  impl_->events.cut();
}

void FakeServer::add_program(const std::string& name, const std::string& content) {
  const std::lock_guard lock(impl_->mutex);
  impl_->add(name, content);
}

std::string FakeServer::content(const std::string& name) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->programs.find(name);
  return found == impl_->programs.end() ? std::string() : found->second.back();
}

std::uint64_t FakeServer::revisions(const std::string& name) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->programs.find(name);
  return found == impl_->programs.end() ? 0 : found->second.size();
}

int FakeServer::pieces_received() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->pieces;
}

std::size_t FakeServer::longest_piece() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->longest_piece;
}

int FakeServer::uploads_open() const {
  const std::lock_guard lock(impl_->mutex);
  return static_cast<int>(impl_->uploads.size());
}

void FakeServer::set_run(const json& run) {
  const std::lock_guard lock(impl_->mutex);
  for (auto& known : impl_->runs) {
    if (known["id"] != run["id"]) continue;
    known = run;
    return;
  }
  impl_->runs.insert(impl_->runs.begin(), run);
}

void FakeServer::set_machine(const json& machine) {
  const std::lock_guard lock(impl_->mutex);
  impl_->machines[machine["name"]] = machine;
}

void FakeServer::publish(const std::string& name, const json& data) {
  impl_->events.publish("event: " + name + "\ndata: " + data.dump() + "\n\n");
}

void FakeServer::set_answer(const std::string& call, int status, const std::string& body) {
  const std::lock_guard lock(impl_->mutex);
  impl_->answers[call] = {status, body};
}

std::vector<std::string> FakeServer::calls() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->calls;
}

void FakeServer::on_command(std::function<void(const std::string&, const json&)> handler) {
  const std::lock_guard lock(impl_->mutex);
  impl_->command_handler = std::move(handler);
}

}  // namespace dripline::test_support
