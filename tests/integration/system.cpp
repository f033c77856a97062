#include "tests/integration/system.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cstring>
#include <fstream>
#include <sstream>

namespace dripline::integration {

using test_support::ChildProcess;
using test_support::eventually;
using test_support::RestClient;

namespace {

constexpr const char* kDiscovery = "50";  // ms; only restarts are quicker than with the default

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool is_port_free(int port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool is_free =
      ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(socket);
  return is_free;
}

constexpr int kDomains = 90;  // above, their ports would meet ephemeral ones

bool has_ended(const nlohmann::json& run) {
  const std::string state = run.value("state", "");
  return state != "ordered" && state != "active" && !state.empty();
}

}  // namespace

/// Domains share a port range of the machine, so tests that run side by side take different ones.
int take_domain(std::optional<FileLock>& lock) {
  constexpr int kFirstPort = 7410, kPortsOfADomain = 250;
  for (int i = 0; i < kDomains; ++i) {
    const int domain = 1 + static_cast<int>((::getpid() + i) % kDomains);
    const auto file = std::filesystem::temp_directory_path() /
                      ("dripline-test-domain-" + std::to_string(domain) + ".lock");
    auto taken = FileLock::acquire(file, "DDS domain " + std::to_string(domain));
    if (!taken || !is_port_free(kFirstPort + kPortsOfADomain * domain)) continue;
    lock = std::move(*taken);
    return domain;
  }
  ADD_FAILURE() << "no DDS domain is free";
  return kDomains;
}

std::string program_path(const std::string& name) {
  return std::string(DRIPLINE_BIN) + "/" + name;
}

System::System(Options options)
    : options_(std::move(options)), tag_("test-" + std::to_string(::getpid())) {
  domain_ = take_domain(domain_lock_);
}

void System::append_network(std::vector<std::string>& command) const {
  for (const std::string& argument :
       {std::string("--dds-domain"), std::to_string(domain_), std::string("--dds-tag"), tag_,
        std::string("--discovery-interval-ms"), std::string(kDiscovery), std::string("--lease-ms"),
        options_.lease_ms}) {
    command.push_back(argument);
  }
}

void System::launch_server() {
  server_.reset();
  std::filesystem::remove(server_state() / "dncd.json");
  std::vector<std::string> command{program_path("dncd"), "--state", server_state(),       "--http",
                                   "127.0.0.1:0",        "--log",   folder() / "dncd.log"};
  append_network(command);
  command.insert(command.end(), options_.server_arguments.begin(), options_.server_arguments.end());
  server_.emplace(command, folder() / "dncd.out");
}

void System::start_server() {
  launch_server();
  const bool listens = eventually([this] {
    return std::filesystem::exists(server_state() / "dncd.json") &&
           rest().get("/api/v1/server").status == 200;
  });
  ASSERT_TRUE(listens) << server_->output();
}

std::vector<std::string> System::gateway_command(const std::string& machine,
                                                 const std::string& state) const {
  std::vector<std::string> command{program_path("dncgw"),
                                   "--machine",
                                   machine,
                                   "--control",
                                   options_.control,
                                   "--state",
                                   folder() / state / machine,
                                   "--speed",
                                   options_.speed,
                                   "--log",
                                   folder() / (state + ".log"),
                                   "--execution-probe",
                                   folder() / (state + ".execution_probe")};
  append_network(command);
  command.insert(command.end(), options_.gateway_arguments.begin(),
                 options_.gateway_arguments.end());
  if (options_.gateway_environment.empty()) return command;
  command.insert(command.begin(), options_.gateway_environment.begin(),
                 options_.gateway_environment.end());
  command.insert(command.begin(), "/usr/bin/env");
  return command;
}

void System::start_gateway(const std::string& machine) {
  gateway_.reset();
  gateway_.emplace(gateway_command(machine, "gateway"), folder() / "gateway.out");
}

ChildProcess System::second_gateway(const std::string& machine) const {
  return ChildProcess(gateway_command(machine, "second"), folder() / "second.out");
}

void System::wait_connected(const std::string& machine) {
  // A machine is there before its first status, which is not acknowledged: it may be the next. One
  // whose gateway was killed is there until its lease ends: something has to be heard from now on.
  std::optional<std::string> seen_before;
  const bool connected = eventually([&] {
    const auto shown = rest().get("/api/v1/machines/" + machine).json();
    if (!shown.value("connected", false) || !shown["status"].is_object()) return false;
    const std::string seen = shown.value("last_seen", "");
    if (!seen_before) seen_before = seen;
    return seen != *seen_before;
  });
  ASSERT_TRUE(connected) << "the server does not see " << machine << "\n" << gateway_->output();
}

std::string System::url() const {
  const auto location =
      nlohmann::json::parse(read_file(server_state() / "dncd.json"), nullptr, false);
  return location.is_object() ? location.value("url", "") : "http://127.0.0.1:1";
}

RestClient System::rest() const {
  std::string token = read_file(server_state() / "token");
  while (!token.empty() && token.back() == '\n') token.pop_back();
  return RestClient(url(), token);
}

nlohmann::json System::push(const std::string& name, const std::string& text) {
  constexpr std::size_t kPiece = 4 << 20;
  const RestClient client = rest();
  const auto upload =
      client.post("/api/v1/uploads", {{"program", name}, {"control", options_.control}}).json();
  const std::string path = "/api/v1/uploads/" + upload.value("id", "none");
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    const auto reply =
        client.put_bytes(path + "/content?offset=" + std::to_string(at), text.substr(at, kPiece));
    EXPECT_EQ(reply.status, 200) << reply.body;
  }
  const auto reply = client.post(path + "/commit", nlohmann::json::object());
  EXPECT_TRUE(reply.status == 200 || reply.status == 201) << reply.body;
  return reply.json();
}

std::string System::start_run(const std::string& program, const std::string& machine) {
  const auto reply = rest().post("/api/v1/runs", {{"machine", machine}, {"program", program}});
  EXPECT_EQ(reply.status, 201) << reply.body;
  return reply.json().value("id", "none");
}

nlohmann::json System::run(const std::string& id) const {
  auto run = rest().get("/api/v1/runs/" + id).json();
  return run.is_object() ? run : nlohmann::json::object();
}

nlohmann::json System::restart_report(const std::string& id) const {
  nlohmann::json report;
  const auto page = rest().get("/api/v1/runs/" + id + "/records?kind=message").json();
  for (const auto& record : page.at("records"))
    if (record.value("device", "") == "restart")
      report = nlohmann::json::parse(record.value("text", ""));
  return report;
}

nlohmann::json System::wait_ended(const std::string& id, std::chrono::milliseconds limit) const {
  nlohmann::json last = nlohmann::json::object();
  const bool ended = eventually([&] { return has_ended(last = run(id)); }, limit);
  EXPECT_TRUE(ended) << "run " << id << " did not end in time: " << last.dump();
  return last;
}

std::vector<std::string> System::report_lines(const std::string& id) const {
  std::istringstream text(rest().get("/api/v1/reports/" + id + "?format=text").body);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

System::ExecutionProbe System::execution_probe() const {
  const std::string bytes = read_file(folder() / "gateway.execution_probe");
  ExecutionProbe execution_probe;
  static_assert(std::is_trivially_copyable_v<ExecutionProbe>);
  if (bytes.size() >= sizeof execution_probe)
    std::memcpy(&execution_probe, bytes.data(), sizeof execution_probe);
  return execution_probe;
}

}  // namespace dripline::integration
