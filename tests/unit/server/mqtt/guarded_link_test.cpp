#include "server/mqtt/guarded_link.hpp"

#include <gtest/gtest.h>

#include "tests/unit/server/mqtt/fake_link.hpp"

namespace dripline::mqtt {
namespace {

using std::chrono::milliseconds;

class GuardedLink : public testing::Test {
 protected:
  GuardedLink() {
    auto fake = std::make_unique<FakeLink>();
    broker_ = fake.get();
    link_ = make_guarded_link(std::move(fake), [this] { return has_place_; });
  }
  const Message message_{.topic = "shop/online", .payload = "{}"};
  bool has_place_ = true;
  FakeLink* broker_ = nullptr;
  std::unique_ptr<BrokerLink> link_;
};

TEST_F(GuardedLink, PassesEverythingOnWhileThePlaceIsOurs) {
  ASSERT_TRUE(link_->open(message_, "commands"));
  EXPECT_EQ(broker_->subscribed(), "commands");
  EXPECT_TRUE(link_->wait(milliseconds(0)).is_connected);
  EXPECT_TRUE(link_->publish(message_));
  EXPECT_EQ(link_->wait(milliseconds(0)).acknowledged.size(), 1u);
  link_->close();
  EXPECT_EQ(broker_->closed, 1);
  EXPECT_EQ(broker_->dropped, 0);
}

/// The broker publishes the will, so that subscribers know that the states are old.
TEST_F(GuardedLink, IsDroppedWithoutAWordWhenThePlaceIsLost) {
  ASSERT_TRUE(link_->open(message_, ""));
  ASSERT_TRUE(link_->wait(milliseconds(0)).is_connected);
  has_place_ = false;
  EXPECT_EQ(link_->publish(message_).error().code, Errc::Busy);
  const auto lost = link_->wait(milliseconds(0));
  EXPECT_TRUE(lost.is_lost);
  EXPECT_NE(lost.fault.find("another one may have taken over"), std::string::npos);
  link_->close();
  EXPECT_EQ(broker_->closed, 0);
  EXPECT_GE(broker_->dropped, 1);
  EXPECT_TRUE(broker_->received("").empty());
}

/// Otherwise two servers with one client id would end each other's connections for ever.
TEST_F(GuardedLink, IsNotOpenedBeforeThePlaceIsConfirmedAgain) {
  has_place_ = false;
  EXPECT_EQ(link_->open(message_, "").error().code, Errc::Busy);
  EXPECT_EQ(broker_->opened, 0);
  has_place_ = true;
  EXPECT_TRUE(link_->open(message_, ""));
}

}  // namespace
}  // namespace dripline::mqtt
