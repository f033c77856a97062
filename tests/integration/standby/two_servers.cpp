#include "tests/integration/standby/two_servers.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#include "gateway/app/panel/panel_socket.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/network_namespace.hpp"

namespace dripline::integration {

using test_support::ChildProcess;
using test_support::eventually;
using test_support::RestClient;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

TwoServers::TwoServers(Options options)
    : options_(std::move(options)), tag_("two-" + std::to_string(::getpid())) {
  domain_ = take_domain(domain_lock_);
}

std::uint16_t TwoServers::dds_port(int server) const {
  return static_cast<std::uint16_t>(7410 + 250 * domain_ + 100 * server);
}

void TwoServers::start(int server) {
  const auto number = at(server);
  servers_[number].reset();
  std::filesystem::create_directories(state(server));
  std::filesystem::remove(state(server) / "dncd.json");
  std::vector<std::string> command{program_path("dncd"),
                                   "--state",
                                   state(server),
                                   "--http",
                                   "127.0.0.1:" + std::to_string(http_ports_[number]),
                                   "--log",
                                   folder() / (name(server) + ".log"),
                                   "--store",
                                   options_.stores[number],
                                   "--standby",
                                   "yes",
                                   "--dds-domain",
                                   std::to_string(domain_),
                                   "--dds-tag",
                                   tag_,
                                   "--dds-port",
                                   std::to_string(dds_port(server)),
                                   "--discovery-interval-ms",
                                   "100",
                                   "--lease-ms",
                                   "1500"};
  command.insert(command.end(), options_.arguments.begin(), options_.arguments.end());
  const auto& own = options_.second_arguments;
  if (server == 1) command.insert(command.end(), own.begin(), own.end());
  const auto network = network_arguments();
  command.insert(command.end(), network.begin(), network.end());
  const test_support::InNetwork inside(server == 0 ? options_.first_network : "");
  servers_[number].emplace(command, folder() / (name(server) + ".out"));
  ASSERT_TRUE(eventually([&] { return !role(server).empty(); })) << output(server) << log(server);
  const std::string url = rest(server).url();
  http_ports_[number] =
      static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));  // as in a shop
}

std::vector<std::string> TwoServers::network_arguments() const {
  if (options_.interface == "lo") return {};
  return {"--dds-interface", options_.interface, "--dds-open-network", "yes"};
}

void TwoServers::share_keys() {
  std::filesystem::create_directories(state(1));
  std::filesystem::permissions(state(1), std::filesystem::perms::owner_all);
  for (const char* file : {"token", "signing.key", "database.id"})
    std::filesystem::copy_file(state(0) / file, state(1) / file);
}

void TwoServers::start_gateway() {
  gateway_.reset();
  std::vector<std::string> command{program_path("dncgw"),
                                   "--machine",
                                   "lathe-1",
                                   "--control",
                                   "centurion",
                                   "--state",
                                   gateway_state(),
                                   "--speed",
                                   options_.speed,
                                   "--log",
                                   folder() / "gateway.log",
                                   "--server",
                                   fmt::format("{}:{},{}:{}", options_.addresses[0], dds_port(0),
                                               options_.addresses[1], dds_port(1)),

                                   "--dds-domain",
                                   std::to_string(domain_),
                                   "--dds-tag",
                                   tag_,
                                   "--discovery-interval-ms",
                                   "100",
                                   "--lease-ms",
                                   "1500"};
  const auto network = network_arguments();
  command.insert(command.end(), network.begin(), network.end());
  gateway_.emplace(command, folder() / "gateway.out");
}

RestClient TwoServers::rest(int server) const {
  const auto json = nlohmann::json::parse(text_of(state(server) / "dncd.json"), nullptr, false);
  const std::string url = json.is_object() ? json.value("url", "") : "http://127.0.0.1:1";
  std::string token = text_of(state(server) / "token");
  while (!token.empty() && token.back() == '\n') token.pop_back();
  return RestClient(url, token, server == 0 ? options_.first_network : "");
}

void TwoServers::freeze(int server) {
  is_frozen_[at(server)] = true;
  this->server(server).signal(SIGSTOP);
}

void TwoServers::thaw(int server) {
  this->server(server).signal(SIGCONT);
  is_frozen_[at(server)] = false;
}

std::string TwoServers::role(int server) const {
  if (is_frozen_[at(server)]) return "";
  const auto health = rest(server).get("/api/v1/health").json();
  return health.is_object() ? health.value("role", "") : "";
}

int TwoServers::active() const {
  const bool a = role(0) == "active", b = role(1) == "active";
  return a == b ? -1 : (a ? 0 : 1);
}

bool TwoServers::wait_active(int server, std::chrono::milliseconds limit) const {
  return eventually([&] { return role(server) == "active"; }, limit);
}

bool TwoServers::wait_connected(int server, std::chrono::milliseconds limit) const {
  return eventually(
      [&] {
        const auto shown = rest(server).get("/api/v1/machines/lathe-1").json();
        return shown.is_object() && shown.value("connected", false) && shown["status"].is_object();
      },
      limit);
}

bool TwoServers::wait_for_standby(std::chrono::milliseconds limit) const {
  return eventually(
      [&] {
        const int server = active();
        if (server < 0) return false;
        const auto shown = rest(server).get("/api/v1/server").json();
        return shown.is_object() && shown["sharing"].is_object() &&
               shown["sharing"]["standbys"].size() == 1;
      },
      limit);
}

std::string TwoServers::output(int server) const {
  return text_of(folder() / (name(server) + ".out"));
}

std::string TwoServers::log(int server) const {
  return text_of(folder() / (name(server) + ".log"));
}

std::string TwoServers::gateway_log() const {
  return text_of(folder() / "gateway.log");
}

void TwoServers::push(int server, const std::string& program, const std::string& text,
                      const std::string& control) const {
  constexpr std::size_t kPiece = 4 << 20;
  const RestClient client = rest(server);
  const auto upload =
      client.post("/api/v1/uploads", {{"program", program}, {"control", control}}).json();
  const std::string path = "/api/v1/uploads/" + upload.value("id", "none");
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    const auto reply =
        client.put_bytes(path + "/content?offset=" + std::to_string(at), text.substr(at, kPiece));
    ASSERT_EQ(reply.status, 200) << reply.body;
  }
  const auto reply = client.post(path + "/commit", nlohmann::json::object());
  ASSERT_TRUE(reply.status == 200 || reply.status == 201) << reply.body;
}

struct TextLevel::Sampler {
  std::filesystem::path state;
  mutable std::mutex mutex;
  Range range;
  std::jthread thread;

  void sample() {
    const auto answer = gateway::ask_panel(state, "status");
    if (!answer) return;
    constexpr std::string_view kKey = " text_bytes=";
    const auto found = answer->find(kKey);
    const std::lock_guard lock(mutex);
    ++range.samples;
    if (found == std::string::npos) {
      range.has_ended = true;
      return;
    }
    std::uint64_t level = 0;
    const char* const end = answer->data() + answer->size();
    std::from_chars(answer->data() + found + kKey.size(), end, level);
    range.least = std::min(range.least, level);
    range.most = std::max(range.most, level);
  }
};

TextLevel::TextLevel(std::filesystem::path gateway_state) : sampler_(new Sampler) {
  sampler_->state = std::move(gateway_state);
  sampler_->thread = std::jthread([raw = sampler_.get()](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      raw->sample();
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
    }
  });
}
TextLevel::~TextLevel() = default;

TextLevel::Range TextLevel::now() const {
  const std::lock_guard lock(sampler_->mutex);
  return sampler_->range;
}

void TextLevel::reset() {
  const std::lock_guard lock(sampler_->mutex);
  sampler_->range = {};
}

}  // namespace dripline::integration
