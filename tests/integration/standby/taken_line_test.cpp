// What a control at the end of a device server gets when the server that feeds it ends: nothing
// twice, and nothing that was not commanded.
#include <csignal>

#include "tests/integration/standby/line_takeover.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using test_support::eventually;

class TakenLine : public LineTakeover {};
class TakenRfc2217Line : public LineTakeover {
 protected:
  TakenRfc2217Line() : LineTakeover(DevicePort::Kind::Rfc2217) {}
};

constexpr int kBaud = 1, kDataSize = 2, kParity = 3, kStopSize = 4;

/// The rate, the format and the characters of one server are the other one's too.
TEST_F(TakenRfc2217Line, IsSetUpAgainAndGetsNothingTwice) {
  begin_with_port({{"template", "plain"}, {"settings", {{"line", "19200e72"}, {"eob", "lf"}}}});
  const std::string text = program("O1\n", 6000);
  shop_->push(0, "O1", text);
  const std::string id = start(0, "O1");
  ASSERT_TRUE(eventually([&] { return device_.received() > 500; }));
  kill_first();
  ASSERT_EQ(device_.connections(), 2u);
  const auto of_second = device_.settings(1);
  EXPECT_EQ(of_second.at(kBaud), 19200u);
  EXPECT_EQ(of_second.at(kDataSize), 7u);
  EXPECT_EQ(of_second.at(kParity), 3u);
  EXPECT_EQ(of_second.at(kStopSize), 2u);
  EXPECT_EQ(of_second, device_.settings(0));
  ASSERT_TRUE(wait_state(1, id, "interrupted"));
  EXPECT_NE(run(1, id).value("reason", "").find("at least"), std::string::npos) << run(1, id);
  EXPECT_TRUE(device_.stays_silent(milliseconds(700))) << "nothing was commanded";
  const std::size_t before = device_.received();
  EXPECT_EQ(device_.text(), text.substr(0, before)) << "a part of it, once";
  EXPECT_LE(run(1, id).value("sent", 0u), before);
  confirm_reset(1);
  start(1, "O1");
  ASSERT_TRUE(eventually([&] { return device_.received() > before + 500; }));
  EXPECT_TRUE(text.starts_with(device_.text(before))) << device_.text(before);
}

TEST_F(TakenLine, OfRawTcpIsOpenedAtOnceAfterAnOrderlyEnd) {
  begin_with_port({{"template", "plain"}, {"settings", {{"eob", "lf"}}}});
  const std::string text = program("O1\n", 3000);
  shop_->push(0, "O1", text);
  const std::string id = start(0, "O1");
  ASSERT_TRUE(eventually([&] { return device_.received() > 300; }));
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("is in a run"), std::string::npos) << refused.body;
  shop_->server(0).signal(SIGTERM);
  expect_taken();
  EXPECT_EQ(run(1, id).value("state", ""), "interrupted");
  EXPECT_TRUE(device_.stays_silent(milliseconds(700)));
  EXPECT_EQ(device_.text(), text.substr(0, device_.received()));
  EXPECT_EQ(run(1, id).value("sent", 0u), device_.received()) << "an end knows all";
}

TEST_F(TakenLine, IsHandedOverBetweenTwoRuns) {
  begin_with_port({{"template", "plain"}, {"settings", {{"eob", "lf"}}}});
  const std::string text = program("O1\n", 3);
  shop_->push(0, "O1", text);
  ASSERT_TRUE(wait_state(0, start(0, "O1"), "completed"));
  ASSERT_TRUE(eventually([&] { return device_.text() == text; }));
  EXPECT_EQ(shop_->rest(0).post("/api/v1/server/drain", json::object()).status, 202);
  expect_taken();
  ASSERT_TRUE(wait_state(1, start(1, "O1"), "completed"));
  ASSERT_TRUE(eventually([&] { return device_.received() >= 2 * text.size(); }));
  EXPECT_EQ(device_.text(), text + text);
}

/// It has room for the rest, and gets no other program's text.
TEST_F(TakenLine, ThatAFanucReleasesStartsNothing) {
  begin_with_port({{"template", "fanuc"}, {"settings", {{"baud", 19200}}}});
  shop_->push(0, "O1", program("O1\n", 3000), "fanuc");
  shop_->push(0, "O2", program("O2\n", 5), "fanuc");
  device_.write("\x11");
  const std::string id = start(0, "O1");
  ASSERT_TRUE(wait_text("\nN9 "));
  device_.write("\x13");
  received_at_rest();
  kill_first();
  ASSERT_TRUE(wait_state(1, id, "interrupted"));
  const std::size_t before = device_.received();
  device_.write("\x11");
  ASSERT_TRUE(eventually([&] {
    return port(1).dump().find("DC1 came for the program that was broken off") != std::string::npos;
  }));
  const std::string next = start(1, "O2");
  EXPECT_TRUE(device_.stays_silent(milliseconds(500)));
  device_.write("\x13");
  device_.write("\x11");
  ASSERT_TRUE(wait_text("M30\n%", before));
  EXPECT_EQ(device_.text(before), "%\n" + program("O2\n", 5) + "%");
  EXPECT_TRUE(wait_state(1, next, "completed"));
}

}  // namespace
}  // namespace dripline::integration
