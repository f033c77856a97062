#include "tests/load/shop.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include "storage/postgresql/database.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/load/gateway.hpp"

namespace dripline::load {
namespace {

using namespace std::chrono_literals;
using test_support::ChildProcess;
using test_support::eventually;
namespace fs = std::filesystem;
namespace sql = storage::sql;

constexpr std::size_t kPerProcess = 100;  ///< gateways; more do not fit select()
constexpr auto kPatience = 300s;
constexpr const char* kProgram = "O0200";
constexpr std::uint64_t kProgramLines = 512 * 1024;  // 16 MiB: half an hour of text

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "load: %s\n", why.c_str());
  std::exit(1);
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

int free_port(int type, int wanted) {
  const int fd = ::socket(AF_INET, type | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(wanted));
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  const bool is_free = ::bind(fd, any, sizeof address) == 0 && ::getsockname(fd, any, &size) == 0;
  ::close(fd);
  return is_free ? ntohs(address.sin_port) : 0;
}

/// As the tests do, which use the same locks: each system has a domain of its own.
int take_domain(std::optional<FileLock>& lock) {
  constexpr int kDomains = 90, kFirstPort = 7410, kPortsOfADomain = 250;
  for (int i = 0; i < kDomains; ++i) {
    const int domain = 1 + static_cast<int>((::getpid() + i) % kDomains);
    const auto file =
        fs::temp_directory_path() / ("dripline-test-domain-" + std::to_string(domain) + ".lock");
    auto taken = FileLock::acquire(file, "DDS domain " + std::to_string(domain));
    if (!taken || free_port(SOCK_DGRAM, kFirstPort + kPortsOfADomain * domain) == 0) continue;
    lock = std::move(*taken);
    return domain;
  }
  give_up("no DDS domain is free");
}

struct Sent {
  std::uint64_t epoch = 0, records = 0;
};

template <typename Engine>
std::unique_ptr<sql::Database> opened(Result<Engine> database) {
  if (!database) give_up(database.error().what);
  return std::make_unique<Engine>(std::move(*database));
}

/// The server's: the one of the URL, or the file in its state folder.
std::unique_ptr<sql::Database> open_database(const std::string& store, const fs::path& state) {
  if (!store.empty()) return opened(storage::postgresql::Database::connect({.url = store}));
  return opened(storage::sqlite::Database::open(state / "dripline.sqlite",
                                                {.access = storage::sqlite::Access::ReadOnly}));
}

/// The numbers of a machine's records have no gap, and each has the text it was sent with.
void compare(sql::Database& database, const std::string& machine, const Sent& sent, Kept& kept) {
  auto query = database.prepare(
      "SELECT count(*), "
      "count(*) FILTER (WHERE kind = 'output' AND text = 'LOAD ' || ?1 || ' ' || number), "
      "count(*) FILTER (WHERE kind = 'run_started'), "
      "count(*) FILTER (WHERE epoch = ?2 AND number <= ?3) FROM record "
      "WHERE machine = (SELECT id FROM machine WHERE name = ?1)");
  if (!query) give_up(query.error().what);
  query->bind(machine, sent.epoch, sent.records);
  if (const auto row = query->step(); !row || !*row) give_up("records cannot be read");
  const std::uint64_t stored = query->number(0);
  const std::uint64_t whole = query->number(1) + query->number(2);
  const std::uint64_t known = query->number(3);
  kept.sent += sent.records;
  kept.stored += stored;
  kept.lost += sent.records - std::min(known, sent.records);
  kept.damaged += std::max(stored - whole, stored - known);
}

}  // namespace

Shop::Shop(ShopOptions options)
    : options_(std::move(options)), tag_("load-" + std::to_string(::getpid())) {
  domain_ = take_domain(domain_lock_);
}

void Shop::start_server() {
  server_.reset();
  const fs::path state = folder_.path() / "server";
  if (url_.empty()) url_ = "http://127.0.0.1:" + std::to_string(free_port(SOCK_STREAM, 0));
  std::vector<std::string> command{options_.server,
                                   "--state",
                                   state,
                                   "--http",
                                   url_.substr(7),
                                   "--log",
                                   folder_.path() / "dncd.log",
                                   "--dds-domain",
                                   std::to_string(domain_),
                                   "--dds-tag",
                                   tag_,
                                   "--discovery-interval-ms",
                                   std::to_string(options_.discovery_ms),
                                   "--lease-ms",
                                   std::to_string(options_.lease_ms)};
  if (options_.cells != dds::kFewestCells)  // an earlier server does not know the option
    command.insert(command.end(), {"--dds-cells", std::to_string(options_.cells)});
  if (!options_.store.empty()) command.insert(command.end(), {"--store", options_.store});
  server_.emplace(command, folder_.path() / "dncd.out");
  const auto answers = [&] {
    token_ = read_file(state / "token");
    while (!token_.empty() && token_.back() == '\n') token_.pop_back();
    return !token_.empty() && rest().get("/api/v1/server").status == 200;
  };
  if (!eventually(answers, 60s)) give_up("the server does not answer: " + server_->output());
}

void Shop::kill_server() {
  server_->kill();
}

void Shop::start_gateways() {
  for (std::size_t first = 0; first < options_.machines; first += kPerProcess) {
    const std::size_t count = std::min(kPerProcess, options_.machines - first);
    const auto feeding =
        static_cast<std::size_t>(std::lround(static_cast<double>(count) * options_.feeding));
    const std::vector<std::string> command{options_.programs + "/load_gateways",
                                           std::to_string(domain_),
                                           tag_,
                                           std::to_string(options_.cells),
                                           std::to_string(options_.discovery_ms),
                                           std::to_string(options_.lease_ms),
                                           std::to_string(first + 1),
                                           std::to_string(count),
                                           std::to_string(options_.changes),
                                           std::to_string(options_.records),
                                           std::to_string(feeding)};
    gateways_.emplace_back(command,
                           folder_.path() / ("gateways-" + std::to_string(first) + ".out"));
  }
}

std::size_t Shop::connected() const {
  const auto server = rest().get("/api/v1/server").json();
  return server.is_object() ? server.value("machines_connected", std::size_t{0}) : 0;
}

double Shop::wait_connected() {
  const auto begin = std::chrono::steady_clock::now();
  std::size_t count = 0;
  const auto end = begin + kPatience;
  while ((count = connected()) < options_.machines) {
    if (std::chrono::steady_clock::now() > end) {
      give_up(fmt::format("only {} of {} machines are connected", count, options_.machines));
    }
    std::this_thread::sleep_for(100ms);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void Shop::push_program() {
  const auto client = rest();
  const auto upload =
      client.post("/api/v1/uploads", {{"program", kProgram}, {"control", "fanuc"}}).json();
  const std::string path = "/api/v1/uploads/" + upload.value("id", "none");
  constexpr std::uint64_t kLines = 128 * 1024;  // 4 MiB
  for (std::uint64_t line = 0; line < kProgramLines; line += kLines) {
    const auto reply = client.put_bytes(
        path + "/content?offset=" + std::to_string(line * kLineBytes), program_text(line, kLines));
    if (reply.status != 200) give_up("the program is not taken: " + reply.body);
  }
  const auto reply = client.post(path + "/commit", nlohmann::json::object());
  if (reply.status != 200 && reply.status != 201) give_up("the program is not kept: " + reply.body);
}

void Shop::start_runs() {
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> starters;
  constexpr std::size_t kStarters = 8;
  starters.reserve(kStarters);
  for (std::size_t i = 0; i < kStarters; ++i) {
    starters.emplace_back([&] {
      for (std::size_t n = ++next; n <= options_.machines; n = ++next) {
        test_support::RestClient::Reply reply;
        const auto is_started = [&] {
          reply = rest().post("/api/v1/runs",
                              {{"machine", "mill-" + std::to_string(n)}, {"program", kProgram}});
          return reply.status == 201;
        };
        if (!eventually(is_started, 60s)) give_up("a run does not start: " + reply.body);
      }
    });
  }
  for (auto& starter : starters) starter.join();
}

ProcessUse Shop::gateways_use() const {
  ProcessUse sum;
  for (const auto& gateway : gateways_) {
    const ProcessUse use = use_of(gateway.pid());
    sum.cpu_seconds += use.cpu_seconds;
    sum.memory_bytes += use.memory_bytes;
    sum.threads += use.threads;
  }
  return sum;
}

Kept Shop::drain() {
  for (const auto& gateway : gateways_) gateway.signal(SIGUSR1);
  const auto is_drained = [](const ChildProcess& gateway) {
    return gateway.output().find("drained") != std::string::npos;
  };
  const bool are_all = eventually(
      [&] { return std::all_of(gateways_.begin(), gateways_.end(), is_drained); }, kPatience);
  if (!are_all) give_up("records are not acknowledged");
  Kept kept;
  const auto database = open_database(options_.store, folder_.path() / "server");
  for (const auto& gateway : gateways_) {
    std::istringstream lines(gateway.output());
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string machine;
      Sent sent;
      std::uint64_t text = 0, damaged = 0, refused = 0;
      if (!(words >> machine >> sent.epoch >> sent.records >> text >> damaged >> refused)) continue;
      compare(*database, machine, sent, kept);
      kept.text_bytes += text;
      kept.damaged_texts += damaged;
      kept.refused_statuses += refused;
    }
  }
  return kept;
}

}  // namespace dripline::load
