// A control that was offered a program and is in the middle of it asks for the rest with the same
// words, and gets no other program's text.
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

/// A TNC in the middle of a program that it was offered.
class BrokenOffer : public PortServiceTest {
 protected:
  static std::string tnc_program(int number, int blocks) {
    std::string text = fmt::format("0 BEGIN PGM {} MM\n", number);
    for (int i = 1; i <= blocks; ++i) text += fmt::format("{} L X+{} Y-{} F200 M\n", i, i, i);
    return text + fmt::format("{} END PGM {} MM\n", blocks + 1, number);
  }
  void add_tnc() {
    start_ports();
    add_machine("mill", "tnc155");
    auto port = mill();
    port.line_template = "tnc155";
    port.settings = {{"baud", "9600"}, {"leader", "0"}};
    add_port(port);
  }
  void begin_offer() {
    add_tnc();
    push("21.h", tnc_program(21, 2000), "tnc155");
    push("22.h", tnc_program(22, 2000), "tnc155");
    line().write("\x11");
    line().read_until("\n5 L ");
    line().write("\x13");
    line().read_for(std::chrono::milliseconds(100));
  }
  void expect_told() {
    line().write("\x11");
    EXPECT_EQ(line().read_until("\x04"), "\x04");
  }
  void expect_offered_again() {
    // As at a control, again when nothing comes: the answer before may not have ended yet.
    std::string offered;
    EXPECT_TRUE(wait([&] {
      line().write("\x11");
      offered += line().read_for(std::chrono::milliseconds(300));
      return offered.find("\n1 L ") != std::string::npos;
    }));
    EXPECT_NE(offered.find("BEGIN PGM 21 "), std::string::npos);
  }
};

TEST_F(BrokenOffer, OfALineThatWasLostIsNotFollowedByTheNextProgram) {
  begin_offer();
  line().pull();
  ASSERT_TRUE(wait([&] { return !ports_->port("com1")->is_open; }));
  line().put_back();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  line().read_for(std::chrono::milliseconds(50));
  expect_told();
  EXPECT_NE(ports_->port("com1")->request->answer.find("21.h revision 1 was broken off"),
            std::string::npos)
      << ports_->port("com1")->request->answer;
  expect_offered_again();
}

TEST_F(BrokenOffer, OfAnotherServerIsKnown) {
  begin_offer();
  EXPECT_TRUE(ports_->check_idle("com1"));
  const auto ends = ports_->check_free_to_end("com1");
  ASSERT_FALSE(ends);
  EXPECT_NE(ends.error().what.find("sending what its control asked for"), std::string::npos);
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  expect_told();  // by the protocol, and so it knows
  ASSERT_TRUE(
      wait([&] { return store_->audit.list({.limit = 1})->front().action == "port.offered"; }));
  expect_offered_again();
}

TEST_F(BrokenOffer, IsNoneWhenItWentThrough) {
  add_tnc();
  push("21.h", tnc_program(21, 2), "tnc155");
  line().write("\x11");
  line().read_until("\x03");
  line().write("\x04");
  ASSERT_TRUE(
      wait([&] { return store_->audit.list({.limit = 1})->front().action == "port.offered"; }));
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  expect_offered_again();
}

}  // namespace
}  // namespace dripline::server_test
