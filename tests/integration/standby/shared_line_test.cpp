// A control at the end of a device server, which two servers reach: never fed by both, and never by
// one that may have lost the library.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <array>
#include <atomic>
#include <thread>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::eventually;

/// A device server that lets several computers use its port at once, as many do.
class OpenDeviceServer {
 public:
  OpenDeviceServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    auto* address = reinterpret_cast<sockaddr*>(&place);
    EXPECT_EQ(::bind(listener_.get(), address, size), 0);
    EXPECT_EQ(::listen(listener_.get(), 4), 0);
    ::getsockname(listener_.get(), address, &size);
    address_ = "tcp://127.0.0.1:" + std::to_string(ntohs(place.sin_port));
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  const std::string& address() const { return address_; }
  std::size_t received() const { return received_; }
  bool stays_silent(milliseconds time) const {
    const std::size_t before = received_;
    std::this_thread::sleep_for(time);
    return received_ == before;
  }

 private:
  void serve(const std::stop_token& stop) {
    std::vector<Descriptor> clients;
    while (!stop.stop_requested()) {
      std::vector<pollfd> ends{{listener_.get(), POLLIN, 0}};
      for (const auto& client : clients) ends.push_back({client.get(), POLLIN, 0});
      if (::poll(ends.data(), ends.size(), 20) <= 0) continue;
      for (std::size_t i = clients.size(); i > 0; --i) {
        std::array<char, 256> piece;
        if (ends[i].revents == 0) continue;
        const auto got = ::recv(clients[i - 1].get(), piece.data(), piece.size(), 0);
        if (got > 0) received_ += static_cast<std::size_t>(got);
        if (got <= 0) clients.erase(clients.begin() + static_cast<std::ptrdiff_t>(i - 1));
      }
      if (ends[0].revents != 0) clients.emplace_back(::accept(listener_.get(), nullptr, nullptr));
    }
  }
  Descriptor listener_;
  std::string address_;
  std::atomic<std::size_t> received_ = 0;
  std::jthread thread_;
};

/// A control at the end of a device server, which both servers reach.
class SharedLine : public TwoServersTest {
 protected:
  /// A run that takes its line for some minutes.
  void begin_run() {
    begin();
    const nlohmann::json settings{
        {"machine", "mill-1"}, {"address", device_.address()}, {"template", "plain"}};
    const auto added = shop_->rest(0).put_bytes("/api/v1/ports/line-1", settings.dump());
    ASSERT_LT(added.status, 300) << added.body;
    std::string text = "O1\n";
    for (int i = 1; i < 6000; ++i) text += fmt::format("N{} G1 X{}\n", i, i % 9);
    shop_->push(0, "O1", text);
    ASSERT_TRUE(eventually([&] { return port(0).value("open", false); })) << port(0).dump();
    const auto begun =
        shop_->rest(0).post("/api/v1/runs", {{"machine", "mill-1"}, {"program", "O1"}});
    ASSERT_EQ(begun.status, 201) << begun.body;
    id_ = begun.json().value("id", "none");
    ASSERT_TRUE(eventually([&] { return device_.received() > 500; }));
  }
  nlohmann::json port(int server) const {
    return shop_->rest(server).get("/api/v1/ports/line-1").json();
  }

  OpenDeviceServer device_;
  std::string id_;
};

/// The control would have half a program in its memory.
TEST_F(SharedLine, IsNotHandedOverInTheMiddleOfATransfer) {
  begin_run();
  ASSERT_LT(shop_->rest(0).post("/api/v1/runs/" + id_ + "/commands", {{"action", "abort"}}).status,
            300);
  ASSERT_TRUE(eventually([&] { return run(0, id_).value("state", "") == "aborted"; }));
  const auto sent = shop_->rest(0).post("/api/v1/ports/line-1/transfers",
                                        {{"programs", nlohmann::json::array({"O1"})}});
  ASSERT_LT(sent.status, 300) << sent.body;
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("port 'line-1' of machine 'mill-1' is sending"), std::string::npos)
      << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
}

/// Two programs at once on one line would be another program at the control.
TEST_F(SharedLine, IsFedByNobodyWhoMayHaveLostTheLibrary) {
  begin_run();
  cables_[0]->pull();
  ASSERT_TRUE(shop_->wait_active(1));
  EXPECT_TRUE(device_.stays_silent(seconds(2)));
  EXPECT_EQ(run(1, id_).value("state", ""), "interrupted");
  EXPECT_NE(port(0).dump().find("nothing is sent"), std::string::npos) << port(0).dump();
  cables_[0]->plug();
  EXPECT_EQ(shop_->server(0).wait(seconds(30)), 1) << shop_->log(0);
  EXPECT_TRUE(device_.stays_silent(seconds(1)));
}

TEST_F(SharedLine, IsSentNothingByAServerThatWakesUp) {
  begin_run();
  shop_->freeze(0);
  ASSERT_TRUE(shop_->wait_active(1));
  ASSERT_TRUE(eventually([&] { return run(1, id_).value("state", "") == "interrupted"; }));
  ASSERT_TRUE(device_.stays_silent(seconds(1)));
  const std::size_t before = device_.received();
  shop_->thaw(0);
  EXPECT_EQ(shop_->server(0).wait(seconds(30)), 1) << shop_->log(0);
  EXPECT_EQ(device_.received(), before);
}

/// The database was away, and no other server has the library: the run continues where it was.
TEST_F(SharedLine, IsFedAgainWhenThePlaceIsRenewed) {
  begin_run();
  shop_->server(1).kill();
  cables_[0]->pull();
  ASSERT_TRUE(eventually([&] { return device_.stays_silent(seconds(1)); }));
  const std::size_t before = device_.received();
  cables_[0]->plug();
  EXPECT_TRUE(eventually([&] { return device_.received() > before + 500; })) << shop_->log(0);
  EXPECT_EQ(run(0, id_).value("state", ""), "active");
  EXPECT_TRUE(port(0)["fault"].is_null()) << port(0).dump();
}

/// The standby's own /dev/ttyUSB0 is another machine's.
TEST_F(SharedLine, ADeviceOfTheOtherComputerIsNotOpened) {
  begin();
  auto database = connect();
  const nlohmann::json settings{{"machine", "mill-1"}, {"address", "/dev/null"}};
  const auto added = shop_->rest(0).put_bytes("/api/v1/ports/line-1", settings.dump());
  ASSERT_LT(added.status, 300) << added.body;
  EXPECT_NE(database.text("SELECT host FROM port").value_or(""), "");
  ASSERT_TRUE(database.execute("UPDATE port SET host = 'srv-1'"));
  shop_->server(0).kill();
  ASSERT_TRUE(shop_->wait_active(1));
  const auto port = shop_->rest(1).get("/api/v1/ports/line-1");
  EXPECT_NE(port.body.find("is a device of computer srv-1"), std::string::npos) << port.body;
  EXPECT_NE(port.body.find("rfc2217"), std::string::npos) << port.body;
}

}  // namespace
}  // namespace dripline::integration
