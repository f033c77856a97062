#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

Port make_port(const std::string& name, const std::string& address) {
  Port port;
  port.name = name;
  port.machine = "mill-3";
  port.address = address;
  port.line_template = "tnc155";
  port.settings = {{"baud", "4800"}, {"answer_limit_ms", "none"}, {"baud_note", ""}};
  port.rules = "[[rule]]\nname = \"ask\"\n";
  port.is_enabled = false;
  return port;
}

class PortTest : public ContractTest {};

TEST_P(PortTest, IsKeptAsItWasGiven) {
  ASSERT_TRUE(store_->ports.save(make_port("line-2", "/dev/ttyUSB1")));
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "tcp://10.0.0.9:4001")));
  reopen();
  const auto ports = store_->ports.list();
  ASSERT_TRUE(ports) << ports.error().what;
  ASSERT_EQ(ports->size(), 2u);
  EXPECT_EQ(ports->at(0).name, "line-1");
  const Port& port = ports->at(1);
  const Port given = make_port("line-2", "/dev/ttyUSB1");
  EXPECT_EQ(port.machine, given.machine);
  EXPECT_EQ(port.address, given.address);
  EXPECT_EQ(port.line_template, given.line_template);
  EXPECT_EQ(port.settings, given.settings) << "in their order";
  EXPECT_EQ(port.rules, given.rules);
  EXPECT_FALSE(port.is_enabled);
}

TEST_P(PortTest, SavedAgainReplacesEverything) {
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0")));
  Port changed;
  changed.name = "line-1";
  changed.machine = "mill-4";
  changed.address = "/dev/ttyS1";
  ASSERT_TRUE(store_->ports.save(changed));
  const auto port = store_->ports.list()->at(0);
  EXPECT_EQ(port.machine, "mill-4");
  EXPECT_EQ(port.address, "/dev/ttyS1");
  EXPECT_TRUE(port.settings.empty());
  EXPECT_TRUE(port.rules.empty());
  EXPECT_TRUE(port.is_enabled);
}

TEST_P(PortTest, TwoDoNotShareALine) {
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0")));
  const auto refused = store_->ports.save(make_port("line-2", "/dev/ttyS0"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  EXPECT_EQ(refused.error().what, "address /dev/ttyS0 is port line-1's already");
  EXPECT_EQ(store_->ports.list()->size(), 1u);
  EXPECT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0"))) << "its own";
}

TEST_P(PortTest, RemovedIsGoneWithItsSettings) {
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0")));
  ASSERT_TRUE(store_->ports.remove("line-1"));
  EXPECT_TRUE(store_->ports.list()->empty());
  EXPECT_EQ(query("SELECT count(*) FROM port_setting"), 0);
  const auto again = store_->ports.remove("line-1");
  EXPECT_EQ(again.error().code, Errc::NotFound);
  EXPECT_EQ(again.error().what, "port line-1 is not known");
}

PortTransfer make_transfer(UtcTime began) {
  PortTransfer transfer;
  transfer.port = "line-1";
  transfer.id = "transfer-1";
  transfer.programs = {"O1 revision 2", "clamp 3.nc revision 1"};
  transfer.size = 640;
  transfer.at_most = 128;
  transfer.began = began;
  transfer.after_run = "";  // no run yet: as it is stored
  return transfer;
}

TEST_P(PortTest, KeepsTheLatestTransferOfEachDirection) {
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0")));
  EXPECT_TRUE(store_->ports.transfers("line-1")->empty());
  PortTransfer sent = make_transfer(clock_.now());
  ASSERT_TRUE(store_->ports.save_transfer(sent));
  PortTransfer received = sent;
  received.direction = TransferDirection::Receive;
  received.id = "reception-1";
  received.programs = {};
  received.size = 0;
  ASSERT_TRUE(store_->ports.save_transfer(received));
  reopen();
  EXPECT_EQ(store_->ports.transfers("line-1").value(), (std::vector{sent, received}));
  sent.state = TransferState::Aborted;
  sent.reason = "stopped by cam";
  sent.passed = 12;
  sent.ended = clock_.now();
  ASSERT_TRUE(store_->ports.save_transfer(sent));
  EXPECT_EQ(store_->ports.transfers("line-1").value(), (std::vector{sent, received}));
  PortTransfer next = make_transfer(clock_.now());
  next.id = "transfer-2";
  ASSERT_TRUE(store_->ports.save_transfer(next));
  EXPECT_EQ(store_->ports.transfers("line-1").value(), (std::vector{next, received}));
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS1")));
  EXPECT_EQ(store_->ports.transfers("line-1")->size(), 2u) << "the port was changed";
  ASSERT_TRUE(store_->ports.remove("line-1"));
  EXPECT_TRUE(store_->ports.transfers("line-1")->empty());
}

TEST_P(PortTest, ProgressIsOfTheActiveTransferOnly) {
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0")));
  PortTransfer transfer = make_transfer(clock_.now());
  ASSERT_TRUE(store_->ports.save_transfer(transfer));
  transfer.passed = 100;
  transfer.at_most = 300;
  ASSERT_TRUE(store_->ports.note_progress(transfer));
  EXPECT_EQ(store_->ports.transfers("line-1").value(), std::vector{transfer});
  PortTransfer another = transfer;
  another.id = "transfer-9";
  ASSERT_TRUE(store_->ports.drop_transfer(another));
  EXPECT_EQ(store_->ports.transfers("line-1")->size(), 1u) << "that one is not the latest";
  another.passed = 101;
  ASSERT_TRUE(store_->ports.note_progress(another));
  EXPECT_EQ(store_->ports.transfers("line-1").value(), std::vector{transfer});
  transfer.state = TransferState::Completed;
  transfer.ended = clock_.now();
  ASSERT_TRUE(store_->ports.save_transfer(transfer));
  another.id = transfer.id;
  ASSERT_TRUE(store_->ports.note_progress(another));
  EXPECT_EQ(store_->ports.transfers("line-1").value(), std::vector{transfer});
}

TEST_P(PortTest, RefusesATransferThatCannotBe) {
  PortTransfer transfer = make_transfer(clock_.now());
  EXPECT_EQ(store_->ports.save_transfer(transfer).error().code, Errc::NotFound);
  ASSERT_TRUE(store_->ports.save(make_port("line-1", "/dev/ttyS0")));
  transfer.ended = clock_.now();
  EXPECT_EQ(store_->ports.save_transfer(transfer).error().code, Errc::Syntax);
  EXPECT_TRUE(store_->ports.transfers("line-1")->empty());
}

struct BadPort {
  const char* name;
  void (*spoil)(Port& port);
  Errc code;
  const char* says;
  friend void PrintTo(const BadPort& c, std::ostream* out) { *out << c.name; }
};
class BadPortTest : public ContractTestOf<BadPort> {};

TEST_P(BadPortTest, IsRefusedAndChangesNothing) {
  Port port = make_port("line-1", "/dev/ttyS0");
  given().spoil(port);
  const auto refused = store_->ports.save(port);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, given().code);
  EXPECT_NE(refused.error().what.find(given().says), std::string::npos) << refused.error().what;
  EXPECT_TRUE(store_->ports.list()->empty());
}

ON_BOTH_ENGINES_WITH(
    BadPortTest,
    BadPort{"Name", [](Port& p) { p.name = "Line 1"; }, Errc::Syntax, "port name 'Line 1'"},
    BadPort{"Machine", [](Port& p) { p.machine = ""; }, Errc::Syntax, "machine name"},
    BadPort{"Address", [](Port& p) { p.address = ""; }, Errc::Syntax, "address is empty"},
    BadPort{"Twice", [](Port& p) { p.settings.emplace_back("baud", "9600"); }, Errc::Syntax,
            "'baud' is given twice"},
    BadPort{"Settings", [](Port& p) { p.settings.resize(kMaxPortSettings + 1); },
            Errc::LimitExceeded, "65 settings, at most 64"},
    BadPort{"Rules", [](Port& p) { p.rules.resize(kMaxPortRules + 1); }, Errc::LimitExceeded,
            "32769 bytes, at most 32768"});

ON_BOTH_ENGINES(PortTest);

}  // namespace
}  // namespace dripline::storage
