#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

/// A run that continues after the block that is named continues where the control has not been.
TEST_F(PortServiceTest, CountsAllThatWasSentWhenTheServerStops) {
  start_ports();
  auto port = mill();
  port.settings = {{"baud", "19200"}, {"eob", "lf"}};
  add_port(port);
  push("O1", blocks(500));
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  std::string came = line().read_until("\nN50 ");
  ports_.reset();
  came += line().read_for(std::chrono::milliseconds(50));
  const auto stopped = store_->runs.find(run->id);
  EXPECT_EQ(stopped->state, storage::RunState::Interrupted);
  EXPECT_EQ(stopped->counters.sent, came.size()) << stopped->reason;
}

TEST_F(PortServiceTest, KeepsPortsAndOpensThemAgain) {
  start_ports();
  add_port(mill());
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(ports_->ports().size(), 1u);
  EXPECT_EQ(ports_->port("com1")->settings.baud, 115200u);
  ASSERT_TRUE(ports_->remove("com1"));
  EXPECT_EQ(ports_->port("com1").error().code, Errc::NotFound);
  EXPECT_EQ(ports_->machines().machine("mill").error().code, Errc::NotFound);
}

TEST_F(PortServiceTest, HasOneOwnerForALineAndOneLineForAMachine) {
  start_ports();
  add_port(mill());
  auto other = mill();
  other.name = "com2";
  other.machine = "lathe";
  const auto same_line = ports_->save(other);
  ASSERT_FALSE(same_line);
  EXPECT_EQ(same_line.error().code, Errc::Busy);
  EXPECT_NE(same_line.error().what.find("port 'com1' of machine 'mill'"), std::string::npos);
  other.machine = "mill";
  other.address = "/dev/line2";
  const auto same_machine = ports_->save(other);
  ASSERT_FALSE(same_machine);
  EXPECT_EQ(same_machine.error().code, Errc::Busy);
  other.is_enabled = false;
  EXPECT_TRUE(ports_->save(other));
  EXPECT_EQ(ports_->ports().size(), 2u);
}

TEST_F(PortServiceTest, RefusesBadPortsAndChangesNothing) {
  start_ports();
  const auto code = [&](auto change) {
    auto port = mill();
    change(port);
    const auto saved = ports_->save(port);
    return saved ? std::optional<Errc>{} : saved.error().code;
  };
  EXPECT_EQ(code([](auto& port) { port.address = "pigeon://roof"; }), Errc::Syntax);
  EXPECT_EQ(code([](auto& port) { port.line_template = "abacus"; }), Errc::NotFound);
  EXPECT_EQ(code([](auto& port) { port.settings.emplace_back("color", "red"); }), Errc::NotFound);
  EXPECT_EQ(code([](auto& port) { port.settings = {{"baud", "1"}}; }), Errc::LimitExceeded);
  EXPECT_EQ(code([](auto& port) {
              port.settings = {{"flow", "xmodem"}, {"data_bits", "7"}};
            }),
            Errc::Unsupported);
  EXPECT_EQ(code([](auto& port) { port.rules = "[[rule]]"; }), Errc::Syntax);
  EXPECT_EQ(code([](auto& port) { port.machine = "Mill!"; }), Errc::Syntax);
  EXPECT_TRUE(ports_->ports().empty());
  EXPECT_TRUE(store_->ports.list()->empty());
}

TEST_F(PortServiceTest, TakesPortsFromTheConfiguration) {
  auto port = mill();
  port.line_template = "centurion";
  start_ports(*store_, {port});
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(store_->ports.list()->size(), 1u);
  EXPECT_EQ(store_->machines.find("mill")->control, "centurion");
}

/// A store in which no machine can be entered: its disk is full.
class ClosedMachines final : public test_support::MachineStoreDecorator {
 public:
  using MachineStoreDecorator::MachineStoreDecorator;
  Result<void> save(const storage::Machine& machine) override {
    if (is_full_) return fail(Errc::Io, "the disk is full");
    return MachineStoreDecorator::save(machine);
  }
  std::atomic<bool> is_full_{false};
};

TEST_F(PortServiceTest, OpensPortsWhenThereIsRoomToStoreAgain) {
  ASSERT_TRUE(store_->ports.save(mill()));
  ClosedMachines machines(*store_);
  machines.is_full_ = true;
  storage::Store store = test_support::with(*store_, machines);
  start_ports(store);
  EXPECT_EQ(ports_->port("com1")->fault, "the disk is full");
  ports_->open_due();
  EXPECT_FALSE(ports_->port("com1")->is_open);
  machines.is_full_ = false;
  ports_->open_due();
  EXPECT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(ports_->port("com1")->fault, "");
  ports_.reset();  // before the store
}

TEST_F(PortServiceTest, ChangesAnOpenPort) {
  start_ports();
  add_port(mill());
  auto port = mill();
  port.settings[0].second = "9600";
  add_port(port);
  EXPECT_EQ(ports_->port("com1")->settings.baud, 9600u);
  push("O1", "G0\n");
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(line().read_until("\n"), "G0\n");
}

TEST_F(PortServiceTest, TestsALineInWords) {
  start_ports();
  add_port(mill());
  const auto quiet = ports_->test("com1");
  ASSERT_TRUE(quiet);
  EXPECT_TRUE(quiet->is_passed);
  line().write("\x13");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->line.is_stopped; }));
  const auto held = ports_->test("com1");
  ASSERT_TRUE(held);
  EXPECT_FALSE(held->is_passed);
  bool is_named = false;
  for (const auto& words : held->findings) is_named |= words.find("XOFF") != std::string::npos;
  EXPECT_TRUE(is_named);
  EXPECT_EQ(ports_->test("com9").error().code, Errc::NotFound);
}

TEST_F(PortServiceTest, RecordsAndPublishesTraffic) {
  start_ports();
  std::mutex mutex;
  std::string sent;
  ports_->on_traffic([&](const ports::PortTraffic& entry) {
    const std::lock_guard lock(mutex);
    if (entry.what == ports::TrafficKind::Sent) sent += entry.bytes;
  });
  add_port(mill());
  push("O1", "G0 X1\n");
  ASSERT_TRUE(start("O1"));
  line().read_until("\n");
  ASSERT_TRUE(wait([&] {
    const std::lock_guard lock(mutex);
    return sent == "G0 X1\n";
  }));
  std::string recorded;
  for (const auto& entry : recording()) {
    if (entry.what == ports::TrafficKind::Sent) recorded += entry.bytes;
  }
  EXPECT_EQ(recorded, "G0 X1\n");
  EXPECT_EQ(ports_->port("com1")->sent, 6u);
  ports_->on_traffic({});
}

TEST_F(PortServiceTest, JudgesATextByThePortsRules) {
  start_ports();
  add_port(mill("[[rule]]\nname = \"all\"\nmatches = \"^X\"\naction = \"ignore\"\n"));
  EXPECT_EQ(ports_->test_rules("com1", "X1\n")->rule, "all");
  EXPECT_EQ(ports_->test_rules("com9", "X1\n").error().code, Errc::NotFound);
}

}  // namespace
}  // namespace dripline::server_test
