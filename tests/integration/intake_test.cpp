// Hot folders, job queues and webhooks whatever is killed, and client certificates over real TLS.
// DRIPLINE_KILLS changes how often (60 by default).
#include <gtest/gtest.h>
#include <httplib.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "tests/integration/system.hpp"
#include "tests/integration/tls_shop.hpp"

namespace dripline::integration {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::eventually;

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 60;
}

/// Receives webhooks, and keeps the numbers of the events in the order in which they came first.
class Receiver {
 public:
  Receiver() {
    server_.Post("/", [this](const httplib::Request& request, httplib::Response& response) {
      const auto body = json::parse(request.body, nullptr, false);
      const std::lock_guard lock(mutex_);
      const auto number = body.value("number", std::uint64_t{0});
      if (seen_.insert(number).second) {
        order_.push_back(number);
        bodies_.push_back(body);
      } else {
        ++repeated_;
      }
      response.status = 200;
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) test_support::wait_a_little();
  }
  ~Receiver() {
    server_.stop();
    thread_.join();
  }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/"; }
  std::vector<std::uint64_t> order() {
    const std::lock_guard lock(mutex_);
    return order_;
  }
  std::vector<json> bodies() {
    const std::lock_guard lock(mutex_);
    return bodies_;
  }

 private:
  httplib::Server server_;
  int port_ = 0;
  std::thread thread_;
  std::mutex mutex_;
  std::set<std::uint64_t> seen_;
  std::vector<std::uint64_t> order_;
  std::vector<json> bodies_;
  std::uint64_t repeated_ = 0;
};

class Intake : public testing::Test {
 protected:
  void configure(const std::string& toml) {
    std::ofstream(system_.folder() / "dncd.toml") << toml;
    system_.add_server_argument("--config=" + (system_.folder() / "dncd.toml").string());
  }
  /// The moment of a kill is the test's subject, so here it does sleep.
  void wait_a_random_time(int up_to_ms) {
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<>(0, up_to_ms * 1000)(random_)));
  }
  int between(int from, int to) { return std::uniform_int_distribution<>(from, to)(random_); }

  System system_;
  std::mt19937 random_{20261124};
};

/// CAM systems post while the server is killed: every post becomes one revision, in its order, and
/// every revision one event.
TEST_F(Intake, AKillTakesNoFileTwiceAndLosesNoneAndNoEvent) {
  const fs::path folder = system_.folder() / "cam";
  fs::create_directories(folder);
  configure("[[folder]]\nname = \"cam\"\npath = \"" + folder.string() +
            "\"\ncontrol = \"fanuc\"\nunchanged_seconds = 0\npoll_seconds = 1\n[[folder.rule]]\n"
            "matches = '(?P<program>P\\d)_\\d+\\.nc'\nprogram = \"{program}\"\n");
  Receiver receiver;
  system_.start_server();
  ASSERT_EQ(
      system_.rest().post("/api/v1/webhooks", {{"name", "erp"}, {"url", receiver.url()}}).status,
      201);
  std::map<std::string, std::vector<std::string>> posted;
  int number = 0;
  const auto post = [&] {
    const std::string program = "P" + std::to_string(between(1, 3));
    const std::string text = "O1\nG21 G90\nG1 X" + std::to_string(++number) + ". F100.\n" +
                             std::string(static_cast<std::size_t>(between(1, 40)) * 1000, '\n') +
                             "M30\n";
    const std::string name = program + "_" + std::to_string(number) + ".nc";
    const bool is_renamed = number % 2 == 0;
    {
      std::ofstream file(folder / (name + (is_renamed ? ".part" : "")));
      file << text.substr(0, text.size() / 2) << std::flush << text.substr(text.size() / 2);
    }
    if (is_renamed) fs::rename(folder / (name + ".part"), folder / name);
    posted[program].push_back(text);
  };
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    for (int files = between(1, 3); files > 0; --files) post();
    wait_a_random_time(60);
    system_.server().kill();
    if (i % 3 == 0) post();
    system_.start_server();
  }
  const auto has_left = [&] {
    return std::ranges::none_of(fs::directory_iterator(folder),
                                [](const auto& entry) { return entry.is_regular_file(); });
  };
  ASSERT_TRUE(eventually(has_left, std::chrono::seconds(60)));
  EXPECT_TRUE(fs::is_empty(folder / "failed"));
  std::size_t revisions = 0;
  for (const auto& [program, texts] : posted) {
    const auto known =
        system_.rest().get("/api/v1/programs/" + program).json().value("revisions", json::array());
    ASSERT_EQ(known.size(), texts.size()) << program;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const auto content = system_.rest().get("/api/v1/programs/" + program +
                                              "/content?revision=" + std::to_string(i + 1));
      EXPECT_EQ(content.body, texts[i]) << program << " revision " << i + 1;
    }
    revisions += texts.size();
  }
  EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::directory_iterator(folder / "done"), {})),
            revisions);
  ASSERT_TRUE(
      eventually([&] { return receiver.order().size() >= revisions; }, std::chrono::seconds(60)))
      << receiver.order().size() << " of " << revisions;
  const auto order = receiver.order();
  ASSERT_EQ(order.size(), revisions);
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i + 1) << "a gap, or no order";
  EXPECT_EQ(receiver.bodies().front()["kind"], "revision");
}

/// A job's parts are those of its completed runs, however often the server was killed meanwhile.
TEST_F(Intake, AKillCountsNoPartTwiceAndLosesNone) {
  system_.start_server();
  system_.start_gateway();
  system_.wait_connected();
  system_.push("O0300", "G00 X1.\nG04 P0.02\nM30\n");
  const int wanted = std::max(5, kills() / 5);
  const auto job = system_.rest().post("/api/v1/machines/lathe-1/jobs",
                                       {{"program", "O0300"}, {"quantity", wanted}});
  ASSERT_EQ(job.status, 201) << job.body;
  const auto state = [&] {
    const auto list = system_.rest().get("/api/v1/machines/lathe-1/jobs?state=closed").json();
    const auto jobs = list.value("jobs", json::array());
    return jobs.empty() ? std::string() : jobs[0].value("state", "");
  };
  int tries = 0;
  while (state() != "done" && ++tries < 5 * wanted && !HasFailure()) {
    system_.wait_connected();
    const auto started = system_.rest().post("/api/v1/machines/lathe-1/start-job", json::object());
    if (tries % 2 == 0) {
      wait_a_random_time(60);
      system_.server().kill();
      system_.start_server();
      system_.wait_connected();
    }
    const auto idle = [&] {
      const auto active = system_.rest().get("/api/v1/runs?machine=lathe-1&state=active").json();
      const auto ordered = system_.rest().get("/api/v1/runs?machine=lathe-1&state=ordered").json();
      return active.value("runs", json::array()).empty() &&
             ordered.value("runs", json::array()).empty();
    };
    ASSERT_TRUE(eventually(idle, std::chrono::seconds(60)));
  }
  const auto closed = system_.rest().get("/api/v1/machines/lathe-1/jobs?state=closed").json();
  ASSERT_EQ(closed["jobs"].size(), 1u);
  EXPECT_EQ(closed["jobs"][0]["completed"], wanted);
  const auto runs =
      system_.rest().get("/api/v1/runs?machine=lathe-1&state=completed&limit=1000").json();
  EXPECT_EQ(runs["runs"].size(), static_cast<std::size_t>(wanted));
  for (const auto& run : runs["runs"]) EXPECT_EQ(run["job"], closed["jobs"][0]["id"]);
  const auto more = system_.rest().post("/api/v1/machines/lathe-1/start-job", json::object());
  EXPECT_EQ(more.status, 404) << "nothing waits any more";
}

class ClientCertificates : public testing::Test {
 protected:
  test_support::Finished dnc(const std::string& arguments, const std::string& user) {
    return shop_.dnc(arguments, user);
  }
  TlsShop shop_;
};

TEST_F(ClientCertificates, AreUsersWithoutTokens) {
  shop_.start();
  for (const std::string user : {"anna", "bert"}) {
    shop_.files.issue(user);
    const auto added = dnc("user add " + user + " --role viewer", "token");
    ASSERT_EQ(added.status, 0) << added.output;
  }
  shop_.files.issue("admin", "strangers");
  const auto who = dnc("program list", "anna");
  EXPECT_EQ(who.status, 0) << who.output;
  const auto denied = dnc("user list", "anna");
  EXPECT_EQ(denied.status, 4) << denied.output;
  EXPECT_EQ(dnc("program list", "").status, 4) << "without a certificate and a token";
  // Another authority's certificate of the same name ends in the handshake.
  const auto stranger = dnc("program list", "admin");
  EXPECT_EQ(stranger.status, 3) << stranger.output;
  const std::string trail = shop_.file("trail");
  ASSERT_EQ(dnc("audit export " + trail, "token").status, 0);
  std::stringstream entries;
  entries << std::ifstream(trail).rdbuf();
  EXPECT_NE(entries.str().find("certificate " + shop_.files.serial("anna")), std::string::npos)
      << "who was refused the users";
  // Revoked while the server runs: it reads the list again.
  shop_.files.revoke("anna");
  EXPECT_TRUE(eventually([&] { return dnc("program list", "anna").status == 4; },
                         std::chrono::seconds(40)));
  EXPECT_EQ(dnc("program list", "bert").status, 0);
}

}  // namespace
}  // namespace dripline::integration
