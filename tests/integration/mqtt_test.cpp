// Records and states at a real broker: outages of the broker, kills of the server, TLS, refusals.
// DRIPLINE_KILLS changes how often (15 by default).
#include <sys/stat.h>
#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>
#include <thread>

#include "server/mqtt/sparkplug_payload.hpp"
#include "storage/sqlite_store.hpp"
#include "tests/integration/mqtt_broker.hpp"
#include "tests/support/program_generator.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/unit/protocol/serial/tcp_peer.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using std::chrono::seconds;
using test_support::eventually;

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 15;
}

class Mqtt : public testing::Test {
 protected:
  Mqtt() : broker_(system_.folder() / "broker", 21000 + system_.domain()) {}

  std::string address(const std::string& scheme = "mqtt") const {
    return scheme + "://127.0.0.1:" + std::to_string(broker_.port());
  }
  void configure(const std::string& lines) {
    const auto file = system_.folder() / "dncd.toml";
    std::ofstream(file) << "[mqtt]\nprefix = \"shop\"\n" << lines;
    system_.add_server_argument("--config=" + file.string());
  }
  void begin(const std::string& lines = "") {
    broker_.start();
    configure("broker = \"" + address() + "\"\n" + lines);
    system_.start_server();
    system_.start_gateway();
    system_.wait_connected();
  }
  json state() const {
    const auto server = system_.rest().get("/api/v1/server").json();
    const bool is_there =
        server.is_object() && server.contains("mqtt") && server["mqtt"].is_object();
    return is_there ? server["mqtt"] : json::object();
  }
  bool is_published(seconds limit = seconds(60)) {
    return eventually([&] { return state().value("records_waiting", 1) == 0; }, limit);
  }
  std::string fault_with(const std::string& part) {
    std::string fault;
    EXPECT_TRUE(eventually([&] {
      const auto now = state();
      fault =
          now.contains("fault") && now["fault"].is_string() ? now["fault"].get<std::string>() : "";
      return fault.find(part) != std::string::npos;
    })) << fault;
    return fault;
  }
  static std::string report_program(std::uint64_t lines) {
    std::string text;
    test_support::write_report_program(lines, 3, [&](std::string_view piece) { text += piece; });
    return text;
  }
  /// The moment of a kill is the test's subject, so here it does sleep.
  void wait_a_random_time(int up_to_ms) {
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<>(0, up_to_ms * 1000)(random_)));
  }
  /// What the server has stored, of the machine's journals.
  std::vector<storage::Record> stored() {
    const SystemClock clock;
    auto store =
        storage::SqliteStore::open({.file = system_.server_state() / "dripline.sqlite"}, clock);
    EXPECT_TRUE(store) << store.error().what;
    std::vector<storage::Record> all;
    const auto epoch = (*store)->machines.find("lathe-1").value().epoch;
    for (std::uint64_t at = 0;;) {
      auto piece = (*store)->records.of_machine_after("lathe-1", {epoch, at}, 1000).value();
      if (piece.empty()) return all;
      at = piece.back().number;
      all.insert(all.end(), piece.begin(), piece.end());
    }
  }
  /// Every stored record once, whole; repeats only with equal ids and contents. Their order at the
  /// subscriber is the broker's, which promises none with several messages in flight to it; the
  /// order in which they are published is tested with RecordFeed and Publisher.
  void expect_all(Subscriber& subscriber) {
    ASSERT_TRUE(is_published()) << state();
    system_.server().signal(SIGTERM);
    EXPECT_EQ(system_.server().wait(), 0);
    const auto records = stored();
    const auto distinct = [&] {
      std::set<std::string> ids;
      for (const auto& message : subscriber.received("/records/"))
        ids.insert(json::parse(message.payload).at("id"));
      return ids.size();
    };
    ASSERT_TRUE(eventually([&] { return distinct() >= records.size(); }, seconds(60)))
        << distinct() << " of " << records.size();
    std::map<std::string, std::string> payloads;
    std::vector<json> first;
    std::size_t repeats = 0;
    for (const auto& message : subscriber.received("/records/")) {
      const auto body = json::parse(message.payload);
      const auto [known, is_new] = payloads.emplace(body.at("id"), message.payload);
      if (is_new) first.push_back(body);
      repeats += is_new ? 0 : 1;
      EXPECT_EQ(known->second, message.payload) << "a repeat is the same in every byte";
      EXPECT_EQ(message.topic, "shop/lathe-1/records/" + body.at("kind").get<std::string>());
    }
    ASSERT_EQ(first.size(), records.size()) << repeats << " repeats";
    const auto number = [](const json& body) { return body.at("number").get<std::uint64_t>(); };
    std::size_t displaced = 0;
    for (std::size_t i = 0; i < records.size(); ++i)
      displaced += number(first[i]) == records[i].number ? 0 : 1;
    std::stable_sort(first.begin(), first.end(), [&](const json& one, const json& other) {
      return number(one) < number(other);
    });
    for (std::size_t i = 0; i < records.size(); ++i) {
      ASSERT_EQ(first[i].at("number"), records[i].number);
      ASSERT_EQ(first[i].at("text"), records[i].text);
    }
    std::printf("%zu records, %zu repeats, %zu not in their place\n", records.size(), repeats,
                displaced);
  }

  System system_;
  Broker broker_;
  std::mt19937 random_{20261127};
};

TEST_F(Mqtt, KillsAndOutagesLoseNoRecord) {
  begin();
  Subscriber subscriber(broker_.port());
  system_.push("O0300", report_program(300));
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    const auto id = system_.start_run("O0300");
    const bool is_outage = i % 3 == 1;
    wait_a_random_time(200);
    if (is_outage) broker_.end();
    wait_a_random_time(200);
    system_.server().kill();
    if (is_outage && i % 2 == 0) broker_.start();
    system_.start_server();
    if (is_outage && i % 2 == 1) broker_.start();
    system_.wait_connected();
    EXPECT_EQ(system_.wait_ended(id).value("state", ""), "completed");
  }
  expect_all(subscriber);
}

TEST_F(Mqtt, ABrokerThatHangsDelaysNothing) {
  begin();
  Subscriber subscriber(broker_.port());
  system_.push("O0300", report_program(3000));
  ASSERT_EQ(system_.wait_ended(system_.start_run("O0300")).value("state", ""), "completed");
  ASSERT_TRUE(is_published());
  const auto memory = system_.server().peak_memory();
  broker_.freeze();
  for (int i = 0; i < 3; ++i) {
    const auto id = system_.start_run("O0300");
    ASSERT_EQ(system_.wait_ended(id).value("state", ""), "completed");
    EXPECT_EQ(system_.report_lines(id).size(), 3000u) << "stored at once";
  }
  EXPECT_GT(state().value("records_waiting", 0), 8000);
  if (!test_support::kIsSanitized) {  // it keeps what was freed
    EXPECT_LT(system_.server().peak_memory(), memory + (24u << 20)) << "what waits is on the disk";
  }
  const auto waiting = state().value("records_waiting", 0);
  const auto begun = std::chrono::steady_clock::now();
  broker_.thaw();
  ASSERT_TRUE(is_published()) << state();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  std::printf("%d records published in %.1f s\n", waiting, took.count());
  expect_all(subscriber);
}

TEST_F(Mqtt, StatesAreRetainedAndTheEndOfTheServerIsToldByTheBroker) {
  begin();
  ASSERT_TRUE(eventually([&] { return state().value("states_published", 0) > 1; }));
  Subscriber subscriber(broker_.port());
  ASSERT_TRUE(eventually([&] { return !subscriber.received("shop/lathe-1/status").empty(); }));
  EXPECT_TRUE(subscriber.received("shop/lathe-1/status").front().is_retained);
  EXPECT_EQ(subscriber.last("shop/lathe-1/status").at("name"), "lathe-1");
  EXPECT_TRUE(
      eventually([&] { return subscriber.last("shop/lathe-1/status").value("connected", false); }));
  const auto is_online = [&](bool wanted) {
    return eventually(
        [&] { return subscriber.last("shop/online").value("online", !wanted) == wanted; });
  };
  EXPECT_TRUE(is_online(true));
  system_.server().kill();
  EXPECT_TRUE(is_online(false)) << "the last will";
  system_.start_server();
  EXPECT_TRUE(is_online(true));
  const auto shown =
      test_support::run_to_end({program_path("dnc"), "--server", system_.url(), "--token-file",
                                (system_.server_state() / "token").string(), "server", "status"},
                               system_.folder() / "dnc.out");
  EXPECT_NE(shown.output.find("MQTT"), std::string::npos) << shown.output;
  EXPECT_NE(shown.output.find(address() + ", connected since"), std::string::npos) << shown.output;
  const auto metrics = system_.rest().get("/api/v1/metrics").body;
  EXPECT_NE(metrics.find("dripline_mqtt_connected 1\n"), std::string::npos);
  system_.server().signal(SIGTERM);
  EXPECT_EQ(system_.server().wait(), 0);
  EXPECT_TRUE(is_online(false));
}

TEST_F(Mqtt, ARefusalOfTheBrokerIsShownAndPassesOverNothing) {
  std::ofstream(broker_.folder() / "acl")
      << "topic readwrite shop/+/status\ntopic readwrite shop/online\n"
         "topic read shop/#\n";
  broker_.start("allow_anonymous true\nacl_file " + (broker_.folder() / "acl").string() + "\n");
  configure("broker = \"" + address() + "\"\n");
  system_.start_server();
  system_.start_gateway();
  system_.wait_connected();
  system_.push("O0300", report_program(10));
  system_.wait_ended(system_.start_run("O0300"));
  const auto fault = fault_with("refuses a message for shop/");
  EXPECT_NE(fault.find("uthorized"), std::string::npos) << fault;
  EXPECT_GT(state().value("records_waiting", 0), 10);
  EXPECT_EQ(state().value("records_published", -1), 0);
}

TEST_F(Mqtt, TakesTlsWithCertificatesUserAndPassword) {
  const auto file = [&](const std::string& name) { return (broker_.folder() / name).string(); };
  const auto sh = [&](const std::string& command) {
    const auto done = test_support::run_to_end(
        {"/bin/sh", "-c", "cd " + broker_.folder().string() + " && " + command}, file("sh.out"));
    ASSERT_EQ(done.status, 0) << done.output;
  };
  for (const std::string name : {"broker", "dncd", "stranger"}) {
    sh("openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=" +
       name + " -addext subjectAltName=IP:127.0.0.1 -keyout " + name + ".key -out " + name +
       ".pem");
  }
  sh("mosquitto_passwd -c -b users dripline s3cret && chmod 600 users");
  const std::string listener = "allow_anonymous false\npassword_file " + file("users") +
                               "\ncertfile " + file("broker.pem") + "\nkeyfile " +
                               file("broker.key") + "\ncafile " + file("dncd.pem") +
                               "\nrequire_certificate true\n";
  broker_.start(listener);
  std::ofstream(file("password")) << "s3cret\n";
  ::chmod(file("password").c_str(), 0600);
  const auto lines = [&](const std::string& ca) {
    return "broker = \"" + address("mqtts") + "\"\nca = \"" + file(ca) + "\"\ncertificate = \"" +
           file("dncd.pem") + "\"\nkey = \"" + file("dncd.key") +
           "\"\nuser = \"dripline\"\npassword_file = \"" + file("password") + "\"\n";
  };
  configure(lines("stranger.pem"));
  system_.start_server();
  const auto fault = fault_with("TLS");
  EXPECT_FALSE(state().value("connected", true)) << "a stranger's broker";
  system_.server().kill();
  std::ofstream(system_.folder() / "dncd.toml") << "[mqtt]\nprefix = \"shop\"\n"
                                                << lines("broker.pem");
  system_.start_server();
  EXPECT_TRUE(eventually([&] { return state().value("connected", false); })) << state();
  std::ofstream(file("password")) << "wrong\n";
  system_.server().kill();
  system_.start_server();
  fault_with("uthorized");
}

TEST_F(Mqtt, MachinesAreDevicesOfASparkplugNode) {
  broker_.start();
  Subscriber host(broker_.port(), "spBv1.0/#");
  configure("broker = \"" + address() +
            "\"\nsparkplug_group = \"hall\"\nsparkplug_node = \"dnc\"\n");
  system_.start_server();
  system_.start_gateway();
  system_.wait_connected();
  const auto gets = [&](const std::string& topic, std::size_t number) {
    return eventually([&] { return host.received("spBv1.0/hall/" + topic).size() >= number; });
  };
  ASSERT_TRUE(gets("NBIRTH/dnc", 1));
  ASSERT_TRUE(gets("DBIRTH/dnc/lathe-1", 1));
  for (const auto& message : host.received("spBv1.0")) EXPECT_FALSE(message.is_retained);
  system_.push("O0300", report_program(10));
  system_.wait_ended(system_.start_run("O0300"));
  ASSERT_TRUE(gets("DDATA/dnc/lathe-1", 1));
  const auto birth = host.received("DBIRTH").back().payload;
  EXPECT_NE(birth.find("status/execution"), std::string::npos);
  host.publish("spBv1.0/hall/NCMD/dnc", "not a payload");
  host.publish("spBv1.0/hall/NCMD/dnc",
               mqtt::encode({.time = UtcTime{},
                             .seq = {},
                             .metrics = {{mqtt::kRebirth, mqtt::Metric::Type::Boolean, true}}}));
  EXPECT_TRUE(gets("NBIRTH/dnc", 2));
  EXPECT_TRUE(gets("DBIRTH/dnc/lathe-1", 2));
  EXPECT_EQ(state().at("sparkplug").at("rebirths"), 1);
  const std::size_t dead = host.received("NDEATH").size();
  system_.gateway().kill();
  EXPECT_TRUE(gets("DDEATH/dnc/lathe-1", 1));
  system_.server().kill();
  EXPECT_TRUE(gets("NDEATH/dnc", dead + 1)) << "the last will";
  system_.start_server();
  EXPECT_TRUE(gets("NBIRTH/dnc", 3));
  system_.server().signal(SIGTERM);
  EXPECT_EQ(system_.server().wait(), 0);
  EXPECT_TRUE(gets("NDEATH/dnc", dead + 2));
}

/// The server lives, and names what the broker has sent.
TEST_F(Mqtt, BytesOfABrokerThatAreNoMqttAreAFaultAndNoMore) {
  struct Case {
    const char* what;
    std::string bytes, fault;
  };
  const std::vector<Case> cases{
      {"an undefined property", {"\x20\x05\0\0\x02\x7f\x01", 7}, "property 127"},
      {"256 MB by the header", "\x30\xff\xff\xff\x7f" + std::string(200'000, 'x'),
       "a packet of 268435455 bytes: at most 262144"},
      {"no MQTT", "HTTP/1.1 400 Bad Request\r\n" + std::string(100, ' '), "a packet of type 4"}};
  serial::TcpPeer peer;
  ASSERT_TRUE(peer.is_listening());
  configure("broker = \"mqtt://127.0.0.1:" + std::to_string(peer.port()) + "\"\n");
  system_.start_server();
  for (const auto& one : cases) {
    SCOPED_TRACE(one.what);
    const auto has_fault = [&] {
      if (peer.accept(1000)) {
        peer.read(20);
        peer.write(one.bytes);
      }
      const auto fault = state().value("fault", json());
      return fault.is_string() && fault.get<std::string>().find(one.fault) != std::string::npos;
    };
    ASSERT_TRUE(eventually(has_fault, seconds(120))) << state() << system_.server().output();
  }
  EXPECT_TRUE(system_.server().is_running());
  EXPECT_FALSE(state().value("connected", true));
  system_.server().signal(SIGTERM);
  EXPECT_EQ(system_.server().wait(), 0);
}

TEST_F(Mqtt, IsRefusedBeyondThisComputerWithoutTls) {
  configure("broker = \"mqtt://broker.example\"\n");
  system_.launch_server();
  EXPECT_EQ(system_.server().wait(), 2);
  EXPECT_NE(system_.server().output().find("open_network"), std::string::npos)
      << system_.server().output();
}

}  // namespace
}  // namespace dripline::integration
