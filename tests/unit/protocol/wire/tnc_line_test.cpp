#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/wire/tnc_frames.hpp"
#include "tests/unit/protocol/wire/tnc_line.hpp"

namespace dripline::wire {
namespace {

using test_support::LineEnd;
using test_support::LineSimulator;
using Request = TransferRequest;
using std::chrono::seconds;
using testing::HasSubstr;

class TncLine : public testing::TestWithParam<Flow> {};

TEST_P(TncLine, GivesTheControlTheProgramItAsksFor) {
  auto wire = line(settings_of(GetParam()));
  serve(wire, kProgram);
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "27"}, wire.now()));
  EXPECT_EQ(wire.run(seconds(60)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
  EXPECT_EQ(wire.control().receptions, 1U);
  EXPECT_EQ(wire.host().sends, 1U);
  EXPECT_TRUE(wire.host().failures.empty()) << wire.host().failures[0].what;
  if (GetParam() == Flow::HeidenhainBcc) {
    EXPECT_EQ(wire.host().accepted, kProgram.size());
    EXPECT_EQ(wire.host().requests[0].name, "27");
  }
}

TEST_P(TncLine, TakesTheProgramThatTheControlPutsOut) {
  auto wire = line(settings_of(GetParam()));
  serve(wire, "");
  ASSERT_TRUE(wire.control().send(kProgram, wire.now(), "27"));
  EXPECT_EQ(wire.run(seconds(60)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.host().received, kProgram);
  EXPECT_EQ(wire.host().receptions, 1U);
  EXPECT_EQ(wire.control().sends, 1U);
}

TEST_P(TncLine, WaitsForTheControlWhenTheHostIsReadyFirst) {
  auto wire = line(settings_of(GetParam()));
  ASSERT_TRUE(wire.host().send(kProgram, wire.now(), "27"));
  EXPECT_EQ(wire.run(seconds(60)), LineSimulator::Outcome::Waiting);
  EXPECT_TRUE(wire.host().line->state().may_wait_without_limit);
  EXPECT_FALSE(wire.host().line->state().waiting_for.empty());
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "27"}, wire.now()));
  EXPECT_EQ(wire.run(wire.now() + seconds(60)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
}

TEST_P(TncLine, LosesNothingWhenTheReceiverHasNoRoomNowAndThen) {
  auto wire = line(settings_of(GetParam()));
  serve(wire, kProgram);
  wire.control().hold_rate = 0.1;
  wire.control().hold_time = seconds(4);
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "27"}, wire.now()));
  EXPECT_EQ(wire.run(seconds(600)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
  EXPECT_EQ(wire.host().sends, 1U);
}

TEST_P(TncLine, ReportsAProgramOfTheControlWithoutAnEnd) {
  auto wire = line(settings_of(GetParam()));
  serve(wire, "");
  ASSERT_TRUE(wire.control().send("0 BEGIN PGM 8 MM\n1 STOP\n", wire.now(), "8"));
  wire.run(seconds(60));
  EXPECT_EQ(wire.host().receptions, 0U);
  ASSERT_FALSE(wire.host().failures.empty());
  EXPECT_THAT(wire.host().failures[0].what, HasSubstr("program incomplete"));
}

INSTANTIATE_TEST_SUITE_P(, TncLine, testing::Values(Flow::Heidenhain, Flow::HeidenhainBcc),
                         [](const auto& tested) {
                           return std::string(tested.param == Flow::Heidenhain ? "standard"
                                                                               : "blockwise");
                         });

// Rows: HD-222 (heading and blocks).
TEST(TncBlockwise, SendsExactlyTheCharactersOfTheProtocol) {
  auto wire = line(settings_of(Flow::HeidenhainBcc));
  wire.keep_traffic(true);
  serve(wire, "1 STOP\n");
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "6"}, wire.now()));
  wire.run(seconds(60));
  const HeidenhainSettings tnc;
  EXPECT_EQ(wire.from_control().seen, make_tnc_block(1, "%6E", tnc) + "\x11\x06\x04");
  EXPECT_EQ(wire.from_host().seen, "\x06" + make_tnc_block(2, "1 STOP", tnc) + "\x03");
}

// Rows: HD-227 (the control asks for more when there is room).
TEST(TncBlockwise, WaitsWithoutLimitForAControlWhoseMemoryIsFullAndReportsIt) {
  auto wire = line(settings_of(Flow::HeidenhainBcc));
  serve(wire, kProgram);
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "27"}, wire.now()));
  wire.control().on_event = [](LineEnd& end, const Event& event, LineTime now) {
    if (std::holds_alternative<TextReceived>(event)) end.line->set_ready(false, now);
  };
  wire.control().line->set_ready(false, wire.now());
  wire.run_until(std::chrono::hours(3));
  const auto host = wire.host().line->state();
  EXPECT_EQ(host.phase, Phase::Sending);
  EXPECT_TRUE(host.is_stopped);
  EXPECT_EQ(host.waiting_for, "ACK");
  EXPECT_TRUE(host.may_wait_without_limit);
  EXPECT_TRUE(wire.control().line->state().is_stopping);
  EXPECT_EQ(wire.control().received, "0 BEGIN PGM 27 MM\n");
  wire.control().on_event = {};
  wire.control().line->set_ready(true, wire.now());
  EXPECT_EQ(wire.run(wire.now() + seconds(60)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
}

// Rows: HD-216 (what the menu asks for), HD-226 (no number is asked for).
TEST(TncBlockwise, GivesAllProgramsUntilThereIsNoneLeft) {
  auto wire = line(settings_of(Flow::HeidenhainBcc));
  std::vector<std::string> programs = {"%3 G71\nN10 G90\nN9999 %3 G71\n",
                                       "0 BEGIN PGM 4 MM\n1 END PGM 4 MM\n"};
  const auto all = programs;
  wire.host().on_event = [&programs](LineEnd& end, const Event& event, LineTime now) {
    if (!std::holds_alternative<Request>(event)) return;
    if (programs.empty()) {
      EXPECT_TRUE(end.line->refuse("", now));
      return;
    }
    EXPECT_TRUE(end.send(programs.front(), now));
    programs.erase(programs.begin());
  };
  std::vector<std::string> taken;
  while (wire.control().failures.empty() && taken.size() < 5) {
    ASSERT_TRUE(wire.control().line->request({Request::Kind::Directory, ""}, wire.now()));
    ASSERT_EQ(wire.run(wire.now() + seconds(60)), LineSimulator::Outcome::Idle);
    if (wire.control().failures.empty()) taken.push_back(wire.control().received);
  }
  EXPECT_EQ(taken, all);
  EXPECT_EQ(wire.control().failures[0].code, Errc::NotFound);
}

/// A control that has asked for `name`, and what it says to characters from its device.
class AskingControl {
 public:
  explicit AskingControl(std::string name) {
    EXPECT_TRUE(line_->request({Request::Kind::SendProgram, std::move(name)}, {}));
    hear("");
  }
  std::string hear(std::string_view characters) {
    line_->receive(std::as_bytes(std::span(characters)), {});
    std::string sent;
    std::array<std::byte, 64> room{};
    for (std::size_t n = line_->transmit(room, {}); n > 0; n = line_->transmit(room, {})) {
      sent += std::string(reinterpret_cast<const char*>(room.data()), n);
    }
    return sent;
  }
  Phase phase() const { return line_->state().phase; }
  /// Empty: none.
  std::string failure() {
    for (const Event& event : line_->take_events()) {
      if (const auto* failed = std::get_if<TransferFailed>(&event)) return failed->error.what;
    }
    return "";
  }

 private:
  std::unique_ptr<Discipline> line_ =
      make_discipline(settings_of(Flow::HeidenhainBcc), Role::Control).value();
};

// Rows: HD-226 (no number is asked for): ETX a second time ends the list as EOT does (U116).
TEST(TncBlockwise, TakesASecondEtxForTheEndOfTheList) {
  for (const char* answer : {"\x04", "\x03", "\x06\x03"}) {
    AskingControl control("");
    const auto sent = control.hear(answer);
    EXPECT_EQ(control.phase(), Phase::Idle);
    EXPECT_EQ(control.failure(), "the device has no program left");
    EXPECT_EQ(sent, answer[0] == '\x04' ? "" : "\x04");
  }
}

TEST(TncBlockwise, TakesAnEtxForNoEndOfAListWhereOneProgramWasAskedFor) {
  AskingControl control("27");
  EXPECT_EQ(control.hear("\x03"), "");
  EXPECT_EQ(control.phase(), Phase::Requesting);
  control.hear("\x06\x03");
  EXPECT_EQ(control.failure(), "the program has no block");
  AskingControl of_list("");
  const HeidenhainSettings tnc;
  EXPECT_EQ(of_list.hear("\x06" + make_tnc_block(2, "1 STOP", tnc)), "\x06");
  EXPECT_EQ(of_list.hear("\x03"), "\x04");
  EXPECT_EQ(of_list.failure(), "");
}

// Rows: HD-225 (a message in place of a program).
TEST(TncBlockwise, ShowsTheControlWhyItIsRefused) {
  auto wire = line(settings_of(Flow::HeidenhainBcc));
  wire.host().on_event = [](LineEnd& end, const Event& event, LineTime now) {
    if (std::holds_alternative<Request>(event)) {
      EXPECT_TRUE(end.line->refuse("no such program, and a long story about it", now));
    }
  };
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "99"}, wire.now()));
  EXPECT_EQ(wire.run(seconds(60)), LineSimulator::Outcome::Idle);
  ASSERT_EQ(wire.control().failures.size(), 1U);
  EXPECT_EQ(wire.control().failures[0].what, "the device says: no such program, and a long stor");
}

// Rows: HD-224 (NAK).
TEST(TncBlockwise, RepeatsARefusedBlockThreeTimesAndThenStops) {
  const auto settings = settings_of(Flow::HeidenhainBcc);
  auto host = make_discipline(settings, Role::Host).value();
  const auto hear = [&](std::string_view characters) {
    host->receive(std::as_bytes(std::span(characters)), LineTime{});
    std::string sent;
    std::array<std::byte, 64> room{};
    for (std::size_t n = host->transmit(room, LineTime{}); n > 0; n = host->transmit(room, {})) {
      sent += std::string(reinterpret_cast<const char*>(room.data()), n);
    }
    return sent;
  };
  const HeidenhainSettings tnc;
  ASSERT_TRUE(host->begin_send("", {}));
  ASSERT_TRUE(host->offer("1 STOP\n2 STOP\n", true, {}));
  const auto block = make_tnc_block(2, "1 STOP", tnc);
  EXPECT_EQ(hear(make_tnc_block(1, "%7E", tnc) + "\x11"), "\x06" + block);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(hear("\x15"), block);
  EXPECT_EQ(hear("\x15"), make_tnc_block(1, "PROGRAM INCOMPLETE", tnc));
  EXPECT_EQ(host->state().phase, Phase::Idle);
  const auto events = host->take_events();
  EXPECT_TRUE(std::holds_alternative<TransferFailed>(events.back()));
}

TEST(TncBlockwise, TakesNoSecondAckForTheNextBlock) {
  const auto settings = settings_of(Flow::HeidenhainBcc);
  auto host = make_discipline(settings, Role::Host).value();
  const HeidenhainSettings tnc;
  const auto heading = make_tnc_block(1, "%7E", tnc);
  ASSERT_TRUE(host->begin_send("", {}));
  ASSERT_TRUE(host->offer("1 STOP\n2 STOP\n", true, {}));
  host->receive(std::as_bytes(std::span(heading)), {});
  std::array<std::byte, 64> room{};
  host->transmit(room, {});
  const std::string_view acks = "\x06\x06";
  host->receive(std::as_bytes(std::span(acks)), {});  // the second: block 2 has not left yet
  std::uint64_t accepted = 0;
  for (const auto& event : host->take_events()) {
    if (const auto* taken = std::get_if<TextAccepted>(&event)) accepted = taken->bytes;
  }
  EXPECT_EQ(accepted, 7U);
}

/// A host that answers at once is heard while the DC1 after the BCC is still to leave.
TEST(TncBlockwise, TakesAnAnswerThatOvertakesTheDc1BehindTheBlock) {
  const auto control = make_discipline(settings_of(Flow::HeidenhainBcc), Role::Control).value();
  const auto sent = [&](std::size_t most) {
    std::vector<std::byte> room(most);
    room.resize(control->transmit(room, LineTime{}));
    return std::string(reinterpret_cast<const char*>(room.data()), room.size());
  };
  const auto hear = [&](char answer) {
    control->receive(std::as_bytes(std::span(&answer, 1)), LineTime{});
  };
  ASSERT_TRUE(control->begin_send("8", LineTime{}));
  EXPECT_EQ(sent(5).substr(0, 4), "\x01%8A");
  EXPECT_EQ(sent(1).size(), 1U);  // ETB and BCC are out, DC1 is not
  hear(6);
  ASSERT_TRUE(control->offer("0 STOP\n1 STOP\n", true, LineTime{}));
  EXPECT_EQ(sent(10).substr(0, 9), std::string("\x11\x02", 2) + "0 STOP\x17");
  hear(6);
  EXPECT_EQ(sent(64).substr(0, 9), std::string("\x11\x02", 2) + "1 STOP\x17");
}

TEST(TncBlockwise, TakesARepeatedBlockOnce) {
  const auto settings = settings_of(Flow::HeidenhainBcc);
  auto control = make_discipline(settings, Role::Control).value();
  const HeidenhainSettings tnc;
  ASSERT_TRUE(control->begin_receive("7", {}));
  std::array<std::byte, 64> room{};
  control->transmit(room, {});
  const auto block = make_tnc_block(2, "1 STOP", tnc);
  const std::string heard = "\x06" + block + block + make_tnc_block(2, "2 STOP", tnc) + "\x03";
  control->receive(std::as_bytes(std::span(heard)), {});
  std::string text;
  for (const auto& event : control->take_events()) {
    if (const auto* got = std::get_if<TextReceived>(&event)) text += got->text;
  }
  EXPECT_EQ(text, "1 STOP\n2 STOP\n");
  const auto count = control->transmit(room, {});
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(room.data()), count), "\x06\x06\x06\x04");
}

TEST(TncBlockwise, NamesTheCharacterThatCannotStandInABlock) {
  auto host = make_discipline(settings_of(Flow::HeidenhainBcc), Role::Host).value();
  ASSERT_TRUE(host->begin_send("7", {}));
  const auto refused = host->offer("0 BEGIN PGM 7 MM\n1 L X\t4\n", true, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "line 2, column 6: character 0x09 cannot stand in a TNC block");
}

TEST(TncBlockwise, RefusesControlCharactersThatExcludeEachOther) {
  auto settings = settings_of(Flow::HeidenhainBcc);
  settings.heidenhain.nak = settings.heidenhain.ack;
  EXPECT_FALSE(make_discipline(settings, Role::Host));
  settings.heidenhain.nak = 0x13;
  EXPECT_FALSE(make_discipline(settings, Role::Host));
  settings.heidenhain.nak = 48;
  EXPECT_FALSE(make_discipline(settings, Role::Host));
}

TEST(TncBlockwise, SendsNoOtherProgramThanTheOneAskedFor) {
  auto wire = line(settings_of(Flow::HeidenhainBcc));
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "15"}, wire.now()));
  wire.run(seconds(2));
  EXPECT_TRUE(wire.host().line->state().is_asked);
  EXPECT_TRUE(wire.host().send(kProgram, wire.now(), "27"));
  wire.run(seconds(20));
  EXPECT_EQ(wire.control().received, "");
  ASSERT_FALSE(wire.control().failures.empty());
  EXPECT_THAT(wire.control().failures[0].what, HasSubstr("15 NOT READY"));
  EXPECT_TRUE(wire.host().line->state().awaits_start);
}

}  // namespace
}  // namespace dripline::wire
