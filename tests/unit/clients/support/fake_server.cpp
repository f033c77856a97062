#include "tests/unit/clients/support/fake_server.hpp"

#include <httplib.h>
#include <map>
#include <mutex>
#include <thread>

#include "tests/unit/clients/support/fake_answers.hpp"
#include "tests/unit/clients/support/fake_event_stream.hpp"
#include "tests/unit/clients/support/fake_library.hpp"

namespace dripline::test_support {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

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
    library.add_routes(server_);
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
  FakeLibrary library{mutex};
  std::vector<json> runs;
  std::map<std::string, json> machines;
  std::function<void(const std::string&, const json&)> command_handler;
  std::map<std::string, std::pair<int, std::string>> answers;
  std::vector<std::string> calls;
  FakeEventStream events;

 private:
  void add_machine_routes() {
    server_.Get("/api/v1/machines", [this](const Request& request, Response& response) {
      const std::lock_guard lock(mutex);
      json all = json::array();
      const auto limit = std::stoul(request.get_param_value("limit"));
      for (auto at = machines.upper_bound(request.get_param_value("after"));
           at != machines.end() && all.size() < limit; ++at)
        all.push_back(at->second);
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
    server_.Get(R"(/api/v1/programs/[^/]+/comparison)", give);
    server_.Get(R"(/api/v1/machines/[\w-]+/setup)", give);
    server_.Delete(R"(/api/v1/machines/[\w-]+)", give);
    server_.Get(ports, give);
    server_.Put(ports, give);
    server_.Post(ports, give);
    server_.Delete(ports, give);
    server_.Post(R"(/api/v1/programs/.*)", give);
    server_.Get(R"(/api/v1/programs/[^/]+/revisions/.*)", give);
    const std::string setups = R"(/api/v1/machines/[\w-]+/setups?)";
    server_.Get(setups, give);
    server_.Put(setups, give);
    server_.Get(R"(/api/v1/runs/[\w-]+/records)", give);
  }

  httplib::Server server_;
  std::thread thread_;
  int port_ = 0;
};

FakeServer::FakeServer() : impl_(std::make_unique<Impl>()) {}
FakeServer::~FakeServer() = default;

std::string FakeServer::url() const {
  return "http://127.0.0.1:" + std::to_string(impl_->port());
}

void FakeServer::fail_piece(PieceFault fault) {
  const std::lock_guard lock(impl_->mutex);
  impl_->library.piece_faults.push_back(std::move(fault));
}

void FakeServer::lose_commit_answer() {
  const std::lock_guard lock(impl_->mutex);
  impl_->library.loses_commit = true;
}

void FakeServer::cut_content(int times) {
  const std::lock_guard lock(impl_->mutex);
  impl_->library.content_cuts = times;
}

void FakeServer::damage_content_at(std::size_t offset) {
  const std::lock_guard lock(impl_->mutex);
  impl_->library.damage = offset;
}

void FakeServer::corrupt_content(const std::string& program) {
  const std::lock_guard lock(impl_->mutex);
  impl_->library.programs.at(program).back().front() ^= 1;
}

void FakeServer::cut_events_once() {
  impl_->events.cut();
}

void FakeServer::add_program(const std::string& name, const std::string& content) {
  const std::lock_guard lock(impl_->mutex);
  impl_->library.add(name, content);
}

std::string FakeServer::content(const std::string& name) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->library.programs.find(name);
  return found == impl_->library.programs.end() ? std::string() : found->second.back();
}

std::uint64_t FakeServer::revisions(const std::string& name) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->library.programs.find(name);
  return found == impl_->library.programs.end() ? 0 : found->second.size();
}

int FakeServer::pieces_received() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->library.pieces;
}

std::size_t FakeServer::longest_piece() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->library.longest_piece;
}

int FakeServer::uploads_open() const {
  const std::lock_guard lock(impl_->mutex);
  return static_cast<int>(impl_->library.uploads.size());
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
