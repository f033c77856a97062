#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

class RemovedMachine : public MachineServiceTest {
 protected:
  void SetUp() override {
    start_service();
    announce();
    ASSERT_TRUE(wait_notified(machines_, [](const auto& view) { return view.is_connected; }));
  }
  /// Once what is known of it is stored.
  Result<void> remove() {
    Result<void> removed;
    (void)test_support::eventually([&] {
      removed = service_->remove("lathe-1", "anna");
      return removed || removed.error().what.find("is just being stored") == std::string::npos;
    });
    return removed;
  }
};

TEST_F(RemovedMachine, IsNotConnected) {
  const auto refused = remove();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  network_.on_lost("lathe-1");
  ASSERT_TRUE(remove());
  EXPECT_TRUE(service_->machines().empty());
  EXPECT_EQ(service_->machine("lathe-1").error().code, Errc::NotFound);
  EXPECT_TRUE(store_->machines.list()->empty());
  EXPECT_EQ(remove().error().code, Errc::NotFound);
}

TEST_F(RemovedMachine, IsThereAgainWhenItAnnouncesItself) {
  network_.on_lost("lathe-1");
  ASSERT_TRUE(remove());
  announce();
  EXPECT_TRUE(test_support::eventually([&] { return service_->machine("lathe-1").has_value(); }));
  EXPECT_TRUE(test_support::eventually([&] { return store_->machines.list()->size() == 1; }));
}

}  // namespace
}  // namespace dripline::server_test
