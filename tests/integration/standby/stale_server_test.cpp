// A server that was frozen, or cut off, while another one took its library over, and comes back:
// what it sends to a real gateway. The test plays the servers.
#include <gtest/gtest.h>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>

#include "protocol/dds/endpoint.hpp"
#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A server in the test's hands.
class PlayedServer {
 public:
  explicit PlayedServer(const dds::NetworkOptions& options) : session_(options.term) {
    dds::ServerHandlers handlers;
    handlers.on_announce = [this](dds::Announce m) { note([&] { announce_ = std::move(m); }); };
    handlers.on_lost = [this](const std::string&) { note([&] { announce_.reset(); }); };
    handlers.on_status = [this](dds::Status m) { note([&] { status_ = std::move(m); }); };
    handlers.on_command_result = [this](const dds::CommandResult& m) {
      note([&] { results_[m.id] = m.accepted; });
    };
    auto opened = dds::ServerEndpoint::open(options, std::move(handlers));
    EXPECT_TRUE(opened) << opened.error().what;
    if (opened) endpoint_ = *std::move(opened);
  }

  bool wait_connected(milliseconds limit = test_support::kPatience) {
    return wait([&] { return announce_ && status_; }, limit);
  }
  bool wait_lost() {
    return wait([&] { return !announce_; }, test_support::kPatience);
  }
  /// Sets the feed override at the machine; nullopt: it was not answered in time.
  std::optional<bool> command(const std::string& id, double override, milliseconds limit) {
    dds::Command message;
    message.machine = "lathe-1";
    message.id = id;
    message.action = dds::CommandAction::FeedOverride;
    message.value = override;
    message.server = session_;
    message.number = ++number_;
    {
      const std::lock_guard lock(mutex_);
      if (status_) message.deadline = status_->steady + seconds(30);
      if (announce_) message.session = announce_->session;
    }
    const auto begun = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begun < limit) {
      (void)endpoint_->write(message);  // as the real one repeats it
      if (wait([&] { return results_.contains(id); }, milliseconds(200))) return results_[id];
    }
    return std::nullopt;
  }
  bool wait_override(double override) {
    return wait([&] { return status_ && status_->feed_override == override; },
                test_support::kPatience);
  }

 private:
  template <class Change>
  void note(Change change) {
    {
      const std::lock_guard lock(mutex_);
      change();
    }
    changed_.notify_all();
  }
  template <class Holds>
  bool wait(Holds holds, milliseconds limit) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, limit, holds);
  }

  const std::uint64_t session_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<dds::Announce> announce_;
  std::optional<dds::Status> status_;
  std::map<std::string, bool> results_;
  std::uint64_t number_ = 0;
  std::unique_ptr<dds::ServerEndpoint> endpoint_;  // last: its callbacks use the others
};

std::size_t count_of(const std::string& words, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

TEST(StaleServer, IsNotListenedToByAGatewayThatHasSeenItsSuccessor) {
  std::optional<FileLock> lock;
  dds::NetworkOptions network;
  network.domain = static_cast<std::uint32_t>(take_domain(lock));
  network.tag = "stale-" + std::to_string(::getpid());
  network.discovery_interval_ms = 100;
  network.lease_ms = 1500;
  const auto open = [&](std::uint64_t term, int place) {
    network.term = term;
    network.port = static_cast<std::uint16_t>(7410 + 250 * network.domain + 100 * place);
    return std::make_unique<PlayedServer>(network);
  };
  const test_support::TemporaryFolder folder;
  auto stale = open(41, 0);
  test_support::ChildProcess gateway(
      {program_path("dncgw"), "--machine", "lathe-1", "--control", "centurion", "--state",
       folder.path() / "gateway", "--log", folder.path() / "gateway.log", "--server",
       fmt::format("127.0.0.1:{},127.0.0.1:{}", 7410 + 250 * network.domain,
                   7510 + 250 * network.domain),
       "--dds-domain", std::to_string(network.domain), "--dds-tag", network.tag,
       "--discovery-interval-ms", "100", "--lease-ms", "1500"},
      folder.path() / "gateway.out");
  ASSERT_TRUE(stale->wait_connected()) << gateway.output();
  EXPECT_EQ(stale->command("c1", 0.8, seconds(10)), true);
  EXPECT_TRUE(stale->wait_override(0.8));

  auto active = open(42, 1);
  ASSERT_TRUE(active->wait_connected());
  EXPECT_TRUE(stale->wait_lost());
  EXPECT_EQ(stale->command("c2", 0.6, seconds(1)), std::nullopt) << "also a lower override";
  EXPECT_EQ(active->command("c3", 0.9, seconds(10)), true);
  EXPECT_TRUE(active->wait_override(0.9));

  active.reset();  // and nobody is left but the one of before
  EXPECT_FALSE(stale->wait_connected(seconds(3)) && stale->command("c4", 0.5, seconds(2)));
  auto third = open(43, 1);
  ASSERT_TRUE(third->wait_connected());
  EXPECT_TRUE(third->wait_override(0.9)) << "nothing of it was carried out";
  std::stringstream log;
  log << std::ifstream(folder.path() / "gateway.log").rdbuf();
  EXPECT_EQ(count_of("a server of term 41 is not listened to", log.str()), 1u) << log.str();
}

}  // namespace
}  // namespace dripline::integration
