// Programs that pass a line without a run are known to the server that begins after a kill.
#include <atomic>

#include "server/ports/programs/transfer_log.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::TransferDirection;
using End = storage::TransferState;

/// A store of ports that can be made to refuse what is written about transfers.
class RefusingPorts final : public storage::PortStore {
 public:
  explicit RefusingPorts(storage::PortStore& inner) : inner_(inner) {}
  Result<void> save(const storage::Port& port) override { return inner_.save(port); }
  Result<std::vector<storage::Port>> list() override { return inner_.list(); }
  Result<void> remove(const std::string& name) override { return inner_.remove(name); }
  Result<void> save_transfer(const storage::PortTransfer& transfer) override {
    return refuses ? full() : inner_.save_transfer(transfer);
  }
  Result<void> note_progress(const storage::PortTransfer& transfer) override {
    return refuses || refuses_progress ? full() : inner_.note_progress(transfer);
  }
  Result<void> drop_transfer(const storage::PortTransfer& transfer) override {
    return refuses ? full() : inner_.drop_transfer(transfer);
  }
  Result<std::vector<storage::PortTransfer>> transfers(const std::string& port) override {
    return inner_.transfers(port);
  }
  std::atomic<bool> refuses = false, refuses_progress = false;

 private:
  static Result<void> full() { return fail(Errc::Io, "the disk is full"); }
  storage::PortStore& inner_;
};

class TransferLogTest : public PortServiceTest {
 protected:
  void add_mill(const std::vector<std::pair<std::string, std::string>>& more = {}) {
    start_ports();
    add_machine("mill");
    auto port = mill();
    for (const auto& setting : more) port.settings.push_back(setting);
    add_port(port);
  }
  std::optional<storage::PortTransfer> kept(TransferDirection direction) {
    const auto all = store_->ports.transfers("com1").value();
    for (const auto& transfer : all)
      if (transfer.direction == direction) return transfer;
    return std::nullopt;
  }
  /// As a server that is killed leaves it: no end is stored.
  void leave_active(TransferDirection direction, std::uint64_t passed, std::uint64_t at_most) {
    ports_.reset();
    storage::PortTransfer transfer;
    transfer.port = "com1";
    transfer.direction = direction;
    transfer.id = "left-1";
    if (direction == TransferDirection::Send) transfer.programs = {"O1 revision 1"};
    transfer.size = direction == TransferDirection::Send ? 900 : 0;
    transfer.passed = passed;
    transfer.at_most = at_most;
    transfer.began = system_clock_.now();
    ASSERT_TRUE(store_->ports.save_transfer(transfer));
  }
  void start_again() {
    start_ports();
    ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  }
  bool has_audited(const std::string& action, const std::string& words) {
    const auto entries = store_->audit.list({.limit = 20}).value();
    return std::ranges::any_of(entries, [&](const auto& entry) {
      return entry.action == action && entry.subject == "com1" &&
             entry.detail.find(words) != std::string::npos;
    });
  }
};

TEST_F(TransferLogTest, OfWhatIsSentIsStoredBeforeItsFirstByteAndWithItsEnd) {
  add_mill({{"wait_for_xon", "yes"}});
  push("O1", "O1\nM30\n");
  const auto sent = ports_->send("com1", {{.program = "O1", .revision = {}}});
  ASSERT_TRUE(sent) << sent.error().what;
  const auto begun = kept(TransferDirection::Send);
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->id, sent->id);
  EXPECT_EQ(begun->programs, std::vector<std::string>{"O1 revision 1"});
  EXPECT_EQ(begun->state, End::Active);
  EXPECT_EQ(begun->size, 7u);
  EXPECT_EQ(begun->passed, 0u);
  line().write("\x11");
  EXPECT_EQ(line().read_until("M30\n"), "O1\nM30\n");
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Send)->state == End::Completed; }));
  EXPECT_EQ(kept(TransferDirection::Send)->passed, 7u);
  EXPECT_TRUE(wait([&] { return has_audited("port.sent", "completed: O1 revision 1, 7 of 7"); }));
  EXPECT_TRUE(ports_->port("com1")->transfer->ended);
}

TEST_F(TransferLogTest, NoByteLeavesThatTheStoreDoesNotKnowOf) {
  add_mill();
  push("O1", blocks(6000));
  ASSERT_TRUE(ports_->send("com1", {{.program = "O1", .revision = {}}}));
  std::size_t received = 0;
  for (int piece = 0; piece < 40; ++piece) {
    received += line().read_for(std::chrono::milliseconds(10)).size();
    const auto transfer = kept(TransferDirection::Send);
    ASSERT_TRUE(transfer);
    EXPECT_GE(transfer->at_most, received);
    EXPECT_LE(transfer->passed, transfer->at_most);
  }
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Send)->state == End::Aborted; }));
}

TEST_F(TransferLogTest, ThatCannotBeStoredSendsNothing) {
  RefusingPorts refusing(store_->ports);
  const storage::Store store{store_->programs,     store_->uploads,  store_->machines,
                             store_->runs,         store_->records,  refusing,
                             store_->setups,       store_->audit,    store_->accounts,
                             store_->releases,     store_->imports,  store_->report_templates,
                             store_->measurements, store_->archives, store_->offsets,
                             store_->attachments,  store_->search,   store_->folders,
                             store_->jobs,         store_->webhooks, store_->record_readers};
  start_ports(store);
  add_machine("mill");
  add_port(mill());
  const std::string text = blocks(20);
  push("O1", text);
  refusing.refuses = true;
  const auto refused = ports_->send("com1", {{.program = "O1", .revision = {}}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Io);
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(100)), "");
  EXPECT_FALSE(ports_->port("com1")->transfer) << "nothing was begun";
  refusing.refuses = false;
  refusing.refuses_progress = true;
  ASSERT_TRUE(ports_->send("com1", {{.program = "O1", .revision = {}}}));
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(300)), "") << "it waits for the store";
  EXPECT_EQ(ports_->port("com1")->transfer->state, line::TransferState::Sending);
  EXPECT_EQ(kept(TransferDirection::Send)->at_most, 0u);
  refusing.refuses_progress = false;
  EXPECT_EQ(line().read_until("N200 G1 X20.5 Y-20.25\n"), text);
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Send)->state == End::Completed; }));
  ports_.reset();  // it uses the stores of this test
}

TEST_F(TransferLogTest, OfAServerThatWasKilledSaysWhatTheControlMayHave) {
  add_mill();
  push("O1", blocks(3));
  leave_active(TransferDirection::Send, 128, 512);
  start_again();
  const auto view = ports_->port("com1");
  ASSERT_TRUE(view->transfer);
  EXPECT_EQ(view->transfer->state, line::TransferState::Interrupted);
  EXPECT_EQ(view->transfer->sent, 128u);
  EXPECT_EQ(view->transfer->at_most, 512u);
  EXPECT_EQ(view->transfer->programs, std::vector<std::string>{"O1 revision 1"});
  EXPECT_NE(view->transfer->reason.find("at least 128 and at most 512 of 900 bytes"),
            std::string::npos)
      << view->transfer->reason;
  EXPECT_TRUE(has_audited("port.sent", "interrupted: O1 revision 1: the server stopped"));
  EXPECT_EQ(kept(TransferDirection::Send)->state, End::Interrupted);
  start_again();
  EXPECT_EQ(ports_->port("com1")->transfer->state, line::TransferState::Interrupted) << "still";
  EXPECT_EQ(ports_->send("com1", {{.program = "O1", .revision = {}}}).error().code, Errc::Conflict);
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  ASSERT_TRUE(ports_->send("com1", {{.program = "O1", .revision = {}}}));
  line().read_until("N30 G1 X3.5 Y-3.25\n");
  EXPECT_TRUE(wait(
      [&] { return ports_->port("com1")->transfer->state == line::TransferState::Completed; }));
}

/// Its DC1 asks for the rest of what it has a part of, and would get another program there.
TEST_F(TransferLogTest, OfAServerThatWasKilledLetsNoRequestBeAnswered) {
  start_ports();
  add_machine("mill", "tnc155");
  auto port = mill();
  port.line_template = "tnc155";
  port.settings = {{"baud", "9600"}, {"leader", "0"}};
  add_port(port);
  push("21.h", "0 BEGIN PGM 21 MM\n1 L X+1\n2 END PGM 21 MM\n", "tnc155");
  leave_active(TransferDirection::Send, 20, 40);
  start_again();
  for (int time = 0; time < 2; ++time) {
    line().write("\x11");
    EXPECT_EQ(line().read_until("\x04"), "\x04");
  }
  EXPECT_NE(ports_->port("com1")->request->answer.find("O1 revision 1 was broken off"),
            std::string::npos);
  ASSERT_TRUE(ports_->send("com1", {{.program = "21.h", .revision = {}}}));
  line().write("\x11");
  line().read_until("\x03");
  line().write("\x04");
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Send)->state == End::Completed; }));
  line().write("\x11");
  EXPECT_NE(line().read_until("\n1 L ").find("BEGIN PGM 21 "), std::string::npos);
}

TEST_F(TransferLogTest, OfWhatComesHasItsProgramWithItsEnd) {
  add_mill();
  line().write("%\nO77\nG0 X1\n");
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Receive).has_value(); }));
  EXPECT_EQ(kept(TransferDirection::Receive)->state, End::Active);
  EXPECT_EQ(ports_->port("com1")->reception->state, line::TransferState::Receiving);
  line().write("M30\n%\n");
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Receive)->state == End::Completed; }));
  EXPECT_EQ(kept(TransferDirection::Receive)->programs, std::vector<std::string>{"O77 revision 1"});
  line().write("%\nO78\nG0 X1\n");
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Receive)->state == End::Active; }));
  line().pull();
  ASSERT_TRUE(wait([&] { return kept(TransferDirection::Receive)->state == End::Interrupted; }));
  EXPECT_TRUE(wait([&] { return has_audited("port.received", "nothing of it is stored"); }));
}

/// However long the control pauses: its rest is no program.
TEST_F(TransferLogTest, OfACutOffProgramKnowsItsRest) {
  add_mill();
  leave_active(TransferDirection::Receive, 100, 100);
  start_again();
  EXPECT_EQ(ports_->port("com1")->reception->state, line::TransferState::Interrupted);
  EXPECT_TRUE(has_audited("port.received", "at least 100 bytes had come"));
  let_pass_idle_end();
  let_pass_idle_end();
  line().write("0 X5\nN6 G1\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 2; }));
  const auto records = *store_->records.machine_report("mill", {}, 100);
  const std::string rest = " \xe2\x80\xa6 (may be the rest of an earlier transmission)";
  EXPECT_EQ(records[0].text, "0 X5" + rest + " \xe2\x80\xa6 (line not ended)");
  EXPECT_EQ(records[1].text, "N6 G1" + rest);
}

}  // namespace
}  // namespace dripline::server_test
