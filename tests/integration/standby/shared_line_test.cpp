// A control at the end of a device server, which two servers reach: never fed by both, and never by
// one that may have lost the library.
#include "tests/integration/standby/device_port.hpp"
#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using std::chrono::seconds;
using test_support::eventually;

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

  DevicePort device_;
  std::string id_;
};

/// The control would have half a program in its memory.
TEST_F(SharedLine, IsNotHandedOverInTheMiddleOfATransfer) {
  begin_run();
  ASSERT_LT(shop_->rest(0).post("/api/v1/runs/" + id_ + "/commands", {{"action", "abort"}}).status,
            300);
  ASSERT_TRUE(eventually([&] { return run(0, id_).value("state", "") == "aborted"; }));
  ASSERT_EQ(shop_->rest(0).post("/api/v1/ports/line-1/confirm-reset", {}).status, 204);
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
  EXPECT_EQ(shop_->server(0).wait(), 1) << shop_->log(0);
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
  EXPECT_EQ(shop_->server(0).wait(), 1) << shop_->log(0);
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
