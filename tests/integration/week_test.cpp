// A week of a CAM group with the real programs, over TLS, by people with certificates: pushed,
// reviewed, rejected, approved, released, run, edited on the floor, compared, accepted, withdrawn.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <sstream>

#include "protocol/base/descriptor.hpp"
#include "tests/integration/tls_shop.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::Finished;

/// A control at the end of a TCP line, which punches what its operator wants.
class PunchingControl {
 public:
  PunchingControl() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_.get(), 1), 0);
    socklen_t size = sizeof address;
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  void punch(const std::string& text) {
    if (!line_) line_ = Descriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    ASSERT_TRUE(line_);
    ASSERT_EQ(::send(line_.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }

 private:
  Descriptor listener_, line_;
  int port_ = 0;
};

class Week : public testing::Test {
 protected:
  void SetUp() override {
    const std::string policy = shop_.file("policy.toml");
    std::ofstream(policy) << "runs = \"release\"\n[approve]\nfour_eyes = true\n"
                             "[reject]\ncomment = true\n";
    shop_.system.add_server_argument("--policy=" + policy);
    shop_.start();
    for (const auto& [name, role] : std::map<std::string, std::string>{{"anna", "programmer"},
                                                                       {"bert", "approver"},
                                                                       {"olga", "operator"},
                                                                       {"quentin", "viewer"}}) {
      shop_.files.issue(name);
      good(shop_.dnc("user add " + name + " --role " + role + " --group all", "token"));
    }
    shop_.system.start_gateway();
    ASSERT_TRUE(test_support::eventually([&] {
      const auto machines = parsed(as("quentin", "machine list --json"))["machines"];
      return machines.size() == 1 && machines[0].value("connected", false);
    }));
  }
  Finished as(const std::string& user, const std::string& arguments) {
    return shop_.dnc(arguments, user);
  }
  static void good(const Finished& done) { EXPECT_EQ(done.status, 0) << done.output; }
  static void refused(const Finished& done, const std::string& part) {
    EXPECT_NE(done.status, 0) << done.output;
    EXPECT_NE(done.output.find(part), std::string::npos) << done.output;
  }
  json parsed(const Finished& done) {
    EXPECT_EQ(done.status, 0) << done.output;
    return json::parse(done.output, nullptr, false);
  }
  void push(const std::string& text) {
    std::ofstream(shop_.file("O0200.nc")) << text;
    good(
        as("anna", "program push " + shop_.file("O0200.nc") + " --name O0200 --control centurion"));
  }
  json wait_ended(const std::string& run) {
    json found;
    EXPECT_TRUE(test_support::eventually([&] {
      found = parsed(as("olga", "run show " + run + " --json"));
      return found.value("state", "") != "ordered" && found.value("state", "") != "active";
    }));
    return found;
  }

  TlsShop shop_;
};

constexpr const char* kFirst = "S500 M03\nG00 X1.\nG01 X2. F10.\nM30\n";
constexpr const char* kSecond = "S500 M03\nG00 X1.\nG01 X2. F8.\nM30\n";
constexpr const char* kOnTheFloor = "%\nO0200\nS500 M03\nG00 X1.\nG01 X2. F6.\nM30\n%\n";

TEST_F(Week, OfACamGroup) {
  // Monday: a first draft, which its reviewer does not like.
  push(kFirst);
  refused(as("olga", "run start lathe-1 O0200"), "is draft");
  refused(as("quentin", "program submit O0200 1"), "needs programmer");
  good(as("anna", "program submit O0200 1 --comment \"please look\""));
  refused(as("bert", "program reject O0200 1"), "comment");
  good(as("bert", "program reject O0200 1 --comment \"feed is too high\""));

  // Tuesday: the second is approved by another person, and released.
  push(kSecond);
  good(as("anna", "program submit O0200 2"));
  refused(as("anna", "program approve O0200 2"), "needs approver");
  good(as("bert", "program approve O0200 2"));
  refused(as("olga", "run start lathe-1 O0200"), "is approved");
  good(as("bert", "program release O0200 2"));

  // Wednesday: the operator takes it from the queue.
  good(as("anna", "job add lathe-1 O0200 --quantity 1"));
  refused(as("quentin", "job start lathe-1"), "needs operator");
  const auto first = parsed(as("olga", "job start lathe-1 --json"));
  EXPECT_EQ(first["revision"], 2);
  const auto ended = wait_ended(first["id"]);
  EXPECT_EQ(ended["state"], "completed") << ended.dump();
  EXPECT_EQ(ended["allowed_as"], "released");
  EXPECT_EQ(ended["author"], "olga");
  EXPECT_EQ(parsed(as("quentin", "job list lathe-1 --closed --json"))["jobs"][0]["state"], "done");

  // Thursday: an operator lowers the feed at a control and punches the program.
  PunchingControl control;
  good(shop_.dnc("port add line-2 --machine lathe-2 --address " + control.address() +
                     " --template centurion idle_end_ms=300 rest_gap_ms=300",
                 "token"));
  control.punch(kOnTheFloor);
  json waiting;
  ASSERT_TRUE(test_support::eventually([&] {
    waiting = parsed(as("quentin", "import list --json"))["imports"];
    return waiting.size() == 1;
  }));
  EXPECT_EQ(waiting[0]["program"], "O0200");
  EXPECT_EQ(waiting[0]["revision"], 3);
  const auto shown = parsed(as("quentin", "import show O0200 3 --json"));
  EXPECT_EQ(shown["compared_with"], 2) << "the released one";
  refused(as("anna", "import accept O0200 3"), "needs approver");
  good(as("bert", "import accept O0200 3 --comment \"chatter\""));
  refused(as("olga", "run start lathe-1 O0200 --revision 3"), "is draft");

  // Friday: it is released in its turn, run, and withdrawn; the old one is still good.
  good(as("anna", "program submit O0200 3"));
  good(as("bert", "program approve O0200 3"));
  good(as("bert", "program release O0200 3"));
  const auto second = parsed(as("olga", "run start lathe-1 O0200 --json"));
  EXPECT_EQ(second["revision"], 3);
  const auto again = wait_ended(second["id"]);
  EXPECT_EQ(again["state"], "completed") << again.dump();
  good(as("bert", "program withdraw O0200 3 --comment \"insert was worn\""));
  EXPECT_EQ(parsed(as("olga", "run start lathe-1 O0200 --json"))["revision"], 2);

  // And all of it is in the trail, with who it was and by which certificate.
  good(shop_.dnc("audit verify", "bert"));
  good(shop_.dnc("audit export " + shop_.file("trail"), "bert"));
  std::stringstream trail;
  trail << std::ifstream(shop_.file("trail")).rdbuf();
  for (const char* action :
       {"program.store", "program.submit", "program.reject", "program.approve", "program.release",
        "job.add", "run.start", "run.end", "program.accept", "program.withdraw", "access.refused"})
    EXPECT_NE(trail.str().find(action), std::string::npos) << action;
  EXPECT_NE(trail.str().find("certificate " + shop_.files.serial("bert")), std::string::npos);
}

}  // namespace
}  // namespace dripline::integration
