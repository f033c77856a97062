#include "server/mqtt/mqtt_settings.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <fstream>

#include "server/mqtt/topics.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::mqtt {
namespace {

std::string error_of(const std::string& lines) {
  const auto read = read_mqtt("[mqtt]\n" + lines);
  return read ? "" : read.error().what;
}

TEST(MqttSettings, AreOffWithoutASection) {
  const auto settings = read_mqtt("state = '/var'\n");
  ASSERT_TRUE(settings);
  EXPECT_FALSE(settings->is_on());
  EXPECT_TRUE(check_exposure(*settings));
}

TEST(MqttSettings, HaveDefaults) {
  const auto settings = read_mqtt("[mqtt]\nbroker = 'mqtts://broker.example'\n");
  ASSERT_TRUE(settings) << settings.error().what;
  EXPECT_EQ(settings->host, "broker.example");
  EXPECT_EQ(settings->port, 8883);
  EXPECT_TRUE(settings->has_tls);
  EXPECT_FALSE(settings->is_loopback);
  EXPECT_EQ(settings->prefix, "dripline");
  EXPECT_EQ(settings->qos, 2);
  EXPECT_TRUE(settings->is_status_retained);
  EXPECT_TRUE(settings->kinds.empty());
  EXPECT_FALSE(settings->has_sparkplug());
}

TEST(MqttSettings, TakeEveryKey) {
  const auto settings = read_mqtt(
      "[mqtt]\nbroker = 'mqtts://[::1]:9'\nca = 'ca.pem'\ncertificate = 'c.pem'\nkey = 'k.pem'\n"
      "user = 'dripline'\npassword_file = 'pw'\nclient_id = 'shop-1'\nprefix = 'plant/hall-2'\n"
      "qos = 1\nkinds = ['output', 'alarm']\nstatus = true\nretain_status = false\n"
      "status_interval_ms = 2000\nprotocol = '3.1.1'\nopen_network = true\n"
      "sparkplug_group = 'Hall 2'\nsparkplug_node = 'dnc'\n");
  ASSERT_TRUE(settings) << settings.error().what;
  EXPECT_EQ(settings->host, "::1");
  EXPECT_EQ(settings->port, 9);
  EXPECT_TRUE(settings->is_loopback);
  EXPECT_EQ(settings->kinds, (std::vector<std::string>{"output", "alarm"}));
  EXPECT_EQ(settings->status_interval, std::chrono::seconds(2));
  EXPECT_FALSE(settings->is_version_5);
  EXPECT_FALSE(settings->is_status_retained);
  EXPECT_TRUE(settings->is_open_network_allowed);
  EXPECT_EQ(settings->qos, 1);
  EXPECT_EQ(settings->sparkplug_group, "Hall 2");
  EXPECT_EQ(settings->sparkplug_node, "dnc");
}

struct Refusal {
  const char* name;
  const char* lines;
  const char* error;
};
class MqttRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(MqttRefusal, NamesLineAndKey) {
  const auto error = error_of(GetParam().lines);
  EXPECT_NE(error.find(GetParam().error), std::string::npos) << error;
}

INSTANTIATE_TEST_SUITE_P(
    , MqttRefusal,
    testing::Values(
        Refusal{"no_broker", "qos = 1\n", "line 1: [mqtt] needs a broker"},
        Refusal{"unknown_key", "broker = 'mqtt://h'\nqso = 1\n", "line 3: key 'qso'"},
        Refusal{"scheme", "broker = 'http://h'\n", "line 2: broker 'http://h' must be mqtt://"},
        Refusal{"no_host", "broker = 'mqtt://:1883'\n", "must be mqtt://HOST:PORT"},
        Refusal{"user_in_address", "broker = 'mqtt://u@h'\n", "must be mqtt://HOST:PORT"},
        Refusal{"port", "broker = 'mqtt://h:99999'\n", "no port from 1 to 65535"},
        Refusal{"port_zero", "broker = 'mqtt://h:0'\n", "no port from 1 to 65535"},
        Refusal{"wildcard", "broker = 'mqtt://h'\nprefix = 'a/+'\n", "line 3: prefix 'a/+'"},
        Refusal{"empty_level", "broker = 'mqtt://h'\nprefix = 'a//b'\n", "line 3: prefix"},
        Refusal{"brokers_own", "broker = 'mqtt://h'\nprefix = '$SYS'\n", "line 3: prefix"},
        Refusal{"qos_0", "broker = 'mqtt://h'\nqos = 0\n", "line 3: qos is 0: 1 to 2"},
        Refusal{"kind", "broker = 'mqtt://h'\nkinds = ['run']\n", "'run' is no kind of record"},
        Refusal{"half_a_certificate", "broker = 'mqtts://h'\nkey = 'k'\n", "belong together"},
        Refusal{"ca_without_tls", "broker = 'mqtt://h'\nca = 'c'\n", "belong to mqtts://"},
        Refusal{"password_of_nobody", "broker = 'mqtt://h'\npassword_file = 'p'\n", "needs a user"},
        Refusal{"nothing", "broker = 'mqtt://h'\nkinds = []\nstatus = false\n",
                "nothing is published"},
        Refusal{"protocol", "broker = 'mqtt://h'\nprotocol = '4'\n", "line 3: protocol '4'"},
        Refusal{"group", "broker = 'mqtt://h'\nsparkplug_group = 'a/b'\n",
                "line 3: sparkplug_group 'a/b' must be a name"},
        Refusal{"interval", "broker = 'mqtt://h'\nstatus_interval_ms = 1\n", "100 to 60000"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(MqttExposure, BeyondThisComputerNeedsTlsOrConsent) {
  const auto verdict = [](const std::string& lines) {
    return check_exposure(read_mqtt("[mqtt]\nbroker = " + lines + "\n").value());
  };
  for (const char* good : {"'mqtt://127.0.0.1'", "'mqtt://localhost:1'", "'mqtt://[::1]'",
                           "'mqtts://broker.example'", "'mqtt://10.0.0.2'\nopen_network = true"})
    EXPECT_TRUE(verdict(good)) << good;
  for (const char* bad : {"'mqtt://10.0.0.2'", "'mqtt://broker.example'", "'mqtt://[fe80::1]'",
                          "'mqtt://localhost.example'", "'mqtt://127.0.0.1.example'"}) {
    const auto judged = verdict(bad);
    ASSERT_FALSE(judged) << bad;
    EXPECT_EQ(judged.error().code, Errc::Denied);
    EXPECT_NE(judged.error().what.find("open_network"), std::string::npos);
  }
}

TEST(MqttExposure, SecretsAreTheirOwnersAlone) {
  const test_support::TemporaryFolder folder;
  const std::string file = (folder.path() / "password").string();
  MqttSettings settings = read_mqtt("[mqtt]\nbroker='mqtt://127.0.0.1'\nuser='u'\n").value();
  settings.password_file = file;
  EXPECT_NE(check_exposure(settings).error().what.find("cannot be read"), std::string::npos);
  std::ofstream(file) << "s3cret\nmore\n";
  ::chmod(file.c_str(), 0644);
  EXPECT_EQ(check_exposure(settings).error().code, Errc::Denied);
  EXPECT_NE(check_exposure(settings).error().what.find("chmod 600"), std::string::npos);
  ::chmod(file.c_str(), 0600);
  EXPECT_TRUE(check_exposure(settings));
  EXPECT_EQ(read_password(settings).value(), "s3cret");
  std::ofstream(file, std::ios::trunc) << "\n";
  EXPECT_FALSE(check_exposure(settings)) << "no password is a mistake, not an empty one";
}

TEST(MqttTopics, NameMachineAndKind) {
  storage::Record record;
  record.machine = "lathe-1";
  record.epoch = 7;
  record.number = 42;
  record.kind = "output";
  EXPECT_EQ(record_topic("plant/hall-2", record), "plant/hall-2/lathe-1/records/output");
  EXPECT_EQ(record_id(record), "lathe-1-7-42");
  EXPECT_EQ(status_topic("dripline", "lathe-1"), "dripline/lathe-1/status");
  EXPECT_EQ(online_topic("dripline"), "dripline/online");
}

}  // namespace
}  // namespace dripline::mqtt
