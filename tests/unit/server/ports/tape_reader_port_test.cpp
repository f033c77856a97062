#include <atomic>

#include "tests/support/line/played_control.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

/// A port as the tape reader of a control: what happens to the tape when it was read.
namespace dripline::server_test {
namespace {

using storage::RunState;
using test_support::PlayedControl;

class TapeReaderPortTest : public PortServiceTest {
 protected:
  void add_reader(const std::string& offer) { add_reader(offer, *store_); }
  void add_reader(const std::string& offer, const storage::Store& store) {
    start_ports(store);
    add_machine("mill", "prototrak-plus");
    auto port = mill();
    port.settings = {{"baud", "115200"},     {"flow", "tape_reader"}, {"offer", offer},
                     {"reader_cps", "5000"}, {"code", "iso"},         {"trailer", "1000"},
                     {"parity", "none"},     {"data_bits", "8"}};
    add_port(port);
    control_ = std::make_unique<PlayedControl>(ports_->port("com1")->settings, line());
  }
  /// The newest first.
  std::vector<storage::Run> runs() {
    return store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {}).value();
  }
  /// The control has asked for a program and got none.
  bool is_asked() { return ports_->port("com1")->request.has_value(); }
  std::unique_ptr<PlayedControl> control_;
};

TEST_F(TapeReaderPortTest, DoesNotRepeatARunThatWasBrokenOff) {
  add_reader("repeat");
  push("TK1", "%\nN1X1\nN2M02\n%\nN1X2\nN2M30\n", "prototrak-plus");
  ASSERT_TRUE(start("TK1"));
  ASSERT_TRUE(control_->line().begin_receive("", control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  ASSERT_TRUE(control_->line().begin_receive("%", control_->now()));  // in the middle of the tape
  ASSERT_TRUE(control_->until([&] { return runs().front().state == RunState::Interrupted; }));
  ASSERT_TRUE(control_->until([&] { return is_asked(); }));
  EXPECT_EQ(runs().size(), 1U);
}

/// A store that cannot keep the end of a run for a while.
class BusyStore final : public test_support::RecordStoreDecorator {
 public:
  using RecordStoreDecorator::RecordStoreDecorator;
  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    if (!batch.endings.empty() && failures_ > 0) {
      --failures_;
      return fail(Errc::Busy, "the database is locked");
    }
    return RecordStoreDecorator::store(batch);
  }
  std::atomic<int> failures_{3};
};

// The control asks at once, and the run whose tape it is has not ended for the store.
TEST_F(TapeReaderPortTest, RepeatsWhenTheEndOfTheRunIsStoredLate) {
  BusyStore records(*store_);
  storage::Store store = test_support::with(*store_, records);
  add_reader("repeat", store);
  push("TK1", "%\nN1X1\nN2M30\n", "prototrak-plus");
  ASSERT_TRUE(start("TK1"));
  ASSERT_TRUE(control_->line().begin_receive("", control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  ASSERT_TRUE(control_->until([&] { return records.failures_ == 0; }));
  ASSERT_TRUE(control_->until([&] { return runs().size() == 2U; }));
  ASSERT_TRUE(control_->line().begin_receive("", control_->now()));
  EXPECT_TRUE(control_->until([&] { return control_->programs.size() == 2; }));
  EXPECT_EQ(runs().back().state, RunState::Completed);
  ports_.reset();  // before the store
}

}  // namespace
}  // namespace dripline::server_test
