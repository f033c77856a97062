#include <gtest/gtest.h>

#include "tests/support/line/line_events.hpp"
#include "tests/unit/protocol/wire/tnc_line.hpp"

/// The standard protocol of the TNC: text between NUL and ETX, held by DC1 and DC3.
namespace dripline::wire {
namespace {

using test_support::LineSimulator;
using Request = TransferRequest;
using std::chrono::seconds;

TEST(TncStandard, KeepsTheRequestUntilTheControlTakesItBack) {
  auto host = make_discipline(settings_of(Flow::Heidenhain), Role::Host).value();
  const auto hear = [&](std::string_view text) {
    host->receive(std::as_bytes(std::span(text)), LineTime{});
  };
  hear("\x11");
  EXPECT_TRUE(host->state().is_asked);
  hear("\x04");
  EXPECT_FALSE(host->state().is_asked);
  ASSERT_TRUE(host->begin_send("", {}));
  EXPECT_TRUE(host->state().awaits_start);
  host->abort({});
  hear("\x11");
  ASSERT_TRUE(host->begin_send("", {}));
  EXPECT_FALSE(host->state().awaits_start);
}

/// The control has room again for a program that another host has begun.
TEST(TncStandard, AHostThatWasReplacedInTheMiddleTakesNoReleaseForAStart) {
  for (const bool is_begun_before : {false, true}) {
    auto host = make_discipline(settings_of(Flow::Heidenhain), Role::Host).value();
    std::array<std::byte, 60> room{};
    const auto hear = [&](std::string_view text) {
      host->receive(std::as_bytes(std::span(text)), LineTime{});
    };
    const auto say = [&] {
      const auto size = host->transmit(room, {});
      return std::string(reinterpret_cast<const char*>(room.data()), size);
    };
    host->expect_release();
    if (is_begun_before) {
      ASSERT_TRUE(host->begin_send("5", {}));
      ASSERT_TRUE(host->offer(kProgram, true, {}));
    }
    hear("\x11");
    EXPECT_EQ(say(), "\x04");
    EXPECT_NE(test_support::event_lines(host->take_events()).find("refused the release\n"),
              std::string::npos);
    EXPECT_FALSE(host->state().is_asked);
    EXPECT_EQ(host->state().awaits_start, is_begun_before);
    hear("\x11");
    EXPECT_EQ(host->state().is_asked, !is_begun_before);
    EXPECT_EQ(say().empty(), !is_begun_before);
  }
}

TEST(TncStandard, AControlThatEndsTheTransmissionItselfMayBeginAgain) {
  auto host = make_discipline(settings_of(Flow::Heidenhain), Role::Host).value();
  const std::string heard = "\x04\x11";
  host->expect_release();
  host->receive(std::as_bytes(std::span(heard)), {});
  EXPECT_TRUE(host->state().is_asked);
}

// Rows: HD-221 (leader, line ends, end characters).
TEST(TncStandard, SendsExactlyTheCharactersOfTheProtocol) {
  auto settings = settings_of(Flow::Heidenhain);
  settings.leader = 3;
  auto wire = line(settings);
  wire.keep_traffic(true);
  serve(wire, "0 BEGIN PGM 5 MM\n1 END PGM 5 MM\n");
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, ""}, wire.now()));
  wire.run(seconds(60));
  EXPECT_EQ(wire.from_control().seen, "\x11\x04");
  EXPECT_EQ(wire.from_host().seen,
            std::string(3, '\0') + "0 BEGIN PGM 5 MM\r\n1 END PGM 5 MM\r\n\x03");
}

TEST(TncStandard, SkipsOtherProgramsUntilTheWantedOne) {
  auto wire = line(settings_of(Flow::Heidenhain));
  serve(wire, "0 BEGIN PGM 3 MM\n1 STOP\n2 END PGM 3 MM\n" + kProgram + "0 BEGIN PGM 9 MM\n");
  ASSERT_TRUE(wire.control().line->request({Request::Kind::SendProgram, "27"}, wire.now()));
  EXPECT_EQ(wire.run(seconds(60)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
  EXPECT_EQ(wire.host().sends, 1U);
}

TEST(TncStandard, SeparatesProgramsThatFollowEachOtherWithoutAnEndCharacter) {
  auto host = make_discipline(settings_of(Flow::Heidenhain), Role::Host).value();
  const std::string heard = "0 BEGIN PGM 3 MM\r\n1 END PGM 3 MM\r\n%8 G71\r\nN9999 %8 G71\r\n\x03";
  host->receive(std::as_bytes(std::span(heard)), {});
  std::vector<std::string> names;
  std::size_t ended = 0;
  for (const auto& event : host->take_events()) {
    if (const auto* began = std::get_if<TransferBegan>(&event)) names.push_back(began->name);
    ended += std::holds_alternative<TransferEnded>(event);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"", "8"}));
  EXPECT_EQ(ended, 2U);
}

// Rows: HD-231 (a program that is not complete).
TEST(TncStandard, ReportsAMissingBlockAndWrongParity) {
  auto host = make_discipline(settings_of(Flow::Heidenhain), Role::Host).value();
  const auto hear = [&](std::string_view text) {
    host->receive(std::as_bytes(std::span(text)), LineTime{});
  };
  hear("0 BEGIN PGM 3 MM\r\n2 L X");
  host->fault(LineFault::Parity, {});
  hear("4\r\n3 END PGM 3 MM\r\n\x03");
  std::string text, faults;
  for (const auto& event : host->take_events()) {
    if (const auto* got = std::get_if<TextReceived>(&event)) text += got->text;
    if (const auto* fault = std::get_if<LineError>(&event)) faults += fault->error.what + "|";
  }
  EXPECT_EQ(text, "0 BEGIN PGM 3 MM\n2 L X?4\n3 END PGM 3 MM\n");
  EXPECT_EQ(faults, "parity error after '2 L X'|block 2 came after block 0|");
}

// Rows: HD-219 (DC1 and DC3).
TEST(TncStandard, StopsSendingBetweenDc3AndDc1) {
  auto host = make_discipline(settings_of(Flow::Heidenhain), Role::Host).value();
  ASSERT_TRUE(host->begin_send("5", {}));
  ASSERT_TRUE(host->offer(kProgram, true, {}));
  std::array<std::byte, 60> room{};
  EXPECT_EQ(host->transmit(room, {}), 0U);
  const auto hear = [&](char c) { host->receive(std::as_bytes(std::span(&c, 1)), LineTime{}); };
  hear(0x11);
  EXPECT_EQ(host->transmit(room, {}), 60U);
  hear(0x13);
  EXPECT_EQ(host->transmit(room, {}), 0U);
  EXPECT_TRUE(host->state().is_stopped);
  hear(0x11);
  EXPECT_EQ(host->transmit(room, {}), 60U);
}

}  // namespace
}  // namespace dripline::wire
