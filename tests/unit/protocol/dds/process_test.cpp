// Ends that are killed and stopped from outside, as processes of their own.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <filesystem>

#include "network.hpp"

namespace dripline::dds::test {
namespace {

class PeerProcess {
 public:
  explicit PeerProcess(std::vector<std::string> arguments) {
    int input[2], output[2];
    if (pipe2(input, O_CLOEXEC) != 0 || pipe2(output, O_CLOEXEC) != 0) std::abort();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
    const std::string path =
        (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "dds_peer").string();
    arguments.insert(arguments.begin(), path);
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    if (posix_spawn(&pid_, path.c_str(), &actions, nullptr, argv.data(), environ) != 0) {
      throw std::runtime_error("cannot start " + path);
    }
    posix_spawn_file_actions_destroy(&actions);
    close(input[0]);
    close(output[1]);
    input_ = input[1];
    char open[5];
    if (read(output[0], open, sizeof open) != sizeof open) throw std::runtime_error("no peer");
    close(output[0]);
  }
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;
  ~PeerProcess() {
    kill_now();
    close(input_);
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// Gone, sockets and all, when this returns.
  void kill_now() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

 private:
  pid_t pid_ = 0;
  int input_ = -1;
};

class Process : public Network {
 protected:
  std::unique_ptr<PeerProcess> start_server() {
    return std::make_unique<PeerProcess>(
        std::vector<std::string>{"server", std::to_string(options_.domain), options_.tag,
                                 std::to_string(options_.lease_ms)});
  }
  std::unique_ptr<PeerProcess> start_gateway(std::uint64_t session) {
    return std::make_unique<PeerProcess>(
        std::vector<std::string>{"gateway", std::to_string(options_.domain), options_.tag,
                                 std::to_string(options_.lease_ms), std::to_string(session)});
  }
  static void expect_answer(TestServer& server, const std::string& id) {
    Command command;
    command.machine = "lathe-1";
    command.id = id;
    ASSERT_TRUE(server.endpoint->write(command));
    const auto result = server.results.take();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->id, id);
  }
};

using Steady = std::chrono::steady_clock;

// A lease much longer than the test's patience: nothing here may wait for a ghost to be given up.
constexpr std::uint32_t kLongLease = 30'000;

// Not before: until its lease ends a killed server looks like a running one.
TEST_F(Process, AGatewayMeetsTheSuccessorOfAKilledServerWhenItsLeaseEnds) {
  options_.lease_ms = 600;
  open_server();  // finds a free domain, then is gone
  auto server = start_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  server->kill_now();
  server = start_server();
  auto connected = gateway->server.take();
  if (connected == false) connected = gateway->server.take();  // the successor was a little slower
  ASSERT_EQ(connected, true);
  ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 5)));
  const auto ack = gateway->acks.take();
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->number, 5U);
}

TEST_F(Process, AKilledServerNeverHoldsUpTheGatewaysWrites) {
  options_.lease_ms = kLongLease;
  open_server();
  auto server = start_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  server->kill_now();
  const auto start = Steady::now();
  for (std::uint64_t n = 1; n <= 4 * kRecordWindow; ++n) {
    ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", n)));
  }
  EXPECT_LT(Steady::now() - start, 2s);  // one wait for the ghost would take the 30 s of its lease
}

TEST_F(Process, AServerMeetsTheSuccessorOfAKilledGatewayWhenItsLeaseEnds) {
  options_.lease_ms = 600;
  auto server = open_server();
  auto gateway = start_gateway(1);
  ASSERT_EQ(server->announces.take().value().session, 1U);
  expect_answer(*server, "first");
  gateway->kill_now();
  gateway = start_gateway(2);
  ASSERT_EQ(server->announces.take().value().session, 2U);
  expect_answer(*server, "second");
}

TEST_F(Process, AServerKeepsToAGatewayThatLives) {
  options_.lease_ms = 600;
  auto server = open_server();
  auto gateway = start_gateway(1);
  ASSERT_EQ(server->announces.take().value().session, 1U);
  auto second = start_gateway(2);
  EXPECT_EQ(server->rivals.take(), true);
  expect_answer(*server, "first");
  EXPECT_EQ(server->announces.size(), 0U) << "the newest does not simply win";
  gateway->kill_now();
  EXPECT_EQ(server->rivals.take(), false);
  ASSERT_EQ(server->announces.take().value().session, 2U);
  EXPECT_EQ(server->lost.size(), 0U);
}

TEST_F(Process, AStoppedGatewayNeverHoldsUpTheServersWrites) {
  options_.lease_ms = kLongLease;
  auto server = open_server();
  auto gateway = start_gateway(1);
  ASSERT_TRUE(server->announces.take());
  gateway->signal(SIGSTOP);
  const auto start = Steady::now();
  for (std::uint64_t n = 0; n < 4 * kBlockWindow; ++n) {
    ASSERT_TRUE(server->endpoint->write(block_data("lathe-1", n * kMaxBlockBytes, kMaxBlockBytes)));
  }
  EXPECT_LT(Steady::now() - start, 2s);
}

TEST_F(Process, AKilledGatewayIsLostAfterItsLease) {
  options_.lease_ms = 300;
  auto server = open_server();
  auto gateway = start_gateway(1);
  ASSERT_TRUE(server->announces.take());
  gateway->kill_now();
  EXPECT_EQ(server->lost.take(), "lathe-1");
}

TEST_F(Process, AStoppedGatewayIsLostAndComesBack) {
  options_.lease_ms = 300;
  auto server = open_server();
  auto gateway = start_gateway(1);
  ASSERT_TRUE(server->announces.take());
  gateway->signal(SIGSTOP);
  EXPECT_EQ(server->lost.take(), "lathe-1");
  gateway->signal(SIGCONT);
  ASSERT_TRUE(server->announces.take());
  expect_answer(*server, "after");
}

TEST_F(Process, AStoppedServerIsMissedAndComesBack) {
  options_.lease_ms = 300;
  open_server();
  auto server = start_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  server->signal(SIGSTOP);
  EXPECT_EQ(gateway->server.take(), false);
  server->signal(SIGCONT);
  EXPECT_EQ(gateway->server.take(), true);
  // The awakened server may give the gateway up once more before all is well, so what is written
  // now can be lost. The outbox sends again, and so does this.
  std::optional<RecordAck> ack;
  for (const auto start = Steady::now(); !ack && Steady::now() - start < kDeadline;) {
    ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 5)));
    ack = gateway->acks.take(200ms);
  }
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->number, 5U);
}

}  // namespace
}  // namespace dripline::dds::test
