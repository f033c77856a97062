// RTS/CTS on the lines of a TNC: row HD-220.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/line/line_simulator.hpp"

namespace dripline::wire {
namespace {

using std::chrono::seconds;
using test_support::LineEnd;
using test_support::LineSimulator;
using testing::HasSubstr;

const std::string kProgram =
    "0 BEGIN PGM 27 MM\n1 TOOL CALL 3 Z S800\n2 L X+4,5 Y-2 R0 F300 M3\n3 L Z-8\n4 END PGM 27 MM\n";

LineSettings rts_settings() {
  return find_template("tnc155-rts").value()->settings;
}

/// One end of a line whose other end the test plays.
struct TncEnd {
  explicit TncEnd(Role role, TncStop stop = TncStop::Rts) {
    LineSettings settings = rts_settings();
    settings.leader = 0;
    settings.heidenhain.stop = stop;
    settings.hold_limit = seconds(5);
    line = make_discipline(settings, role).value();
  }
  void hear(std::string_view text) { line->receive(std::as_bytes(std::span(text)), now); }
  void set_cts(bool is_on) { line->lines({.cts = is_on}, now); }
  std::string say(std::size_t most = 1000) {
    std::string sent(most, '\0');
    sent.resize(line->transmit(std::as_writable_bytes(std::span(sent)), now));
    return sent;
  }
  std::unique_ptr<Discipline> line;
  LineTime now{};
};

class TncRtsCts : public testing::TestWithParam<Role> {};

// Rows: HD-220 (a line whose CTS is off gets no character, no control character either).
TEST_P(TncRtsCts, SendsNothingWhileCtsIsOff) {
  TncEnd end(GetParam());
  ASSERT_TRUE(end.line->begin_send("27", end.now));
  ASSERT_TRUE(end.line->offer(kProgram, true, end.now));
  if (GetParam() == Role::Host) end.hear("\x11");
  EXPECT_EQ(end.say(8), kProgram.substr(0, 8));
  end.set_cts(false);
  EXPECT_EQ(end.say(), "");
  EXPECT_TRUE(end.line->state().is_stopped);
  EXPECT_EQ(end.line->state().waiting_for, "CTS");
  end.hear("\x11");
  EXPECT_EQ(end.say(), "") << "DC1 is no CTS";
  end.set_cts(true);
  EXPECT_FALSE(end.line->state().is_stopped);
  EXPECT_EQ(end.say(4), kProgram.substr(8, 4));
  end.set_cts(false);
  end.line->abort(end.now);
  EXPECT_EQ(end.say(), "") << "EOT waits too";
  end.set_cts(true);
  EXPECT_EQ(end.say(), "\x04");
}

// Rows: HD-220
TEST_P(TncRtsCts, DropsItsRtsWhileItHasNoRoom) {
  TncEnd end(GetParam());
  EXPECT_TRUE(end.line->output_lines().rts);
  end.line->set_ready(false, end.now);
  EXPECT_FALSE(end.line->output_lines().rts);
  ASSERT_TRUE(end.line->begin_receive("", end.now));
  EXPECT_EQ(end.say(), GetParam() == Role::Control ? "\x11" : "") << "the request, and no DC3";
  end.hear("0 BEGIN PGM 3 MM\r\n");
  EXPECT_TRUE(end.line->state().is_stopping);
  EXPECT_EQ(end.say(), "");
  end.line->set_ready(true, end.now);
  EXPECT_TRUE(end.line->output_lines().rts);
  EXPECT_EQ(end.say(), "") << "RTS says it";
}

// Rows: HD-220
TEST_P(TncRtsCts, GivesUpWhenCtsStaysOffTooLong) {
  TncEnd end(GetParam());
  end.set_cts(false);
  ASSERT_TRUE(end.line->begin_send("27", end.now));
  ASSERT_TRUE(end.line->offer(kProgram, true, end.now));
  if (GetParam() == Role::Host) end.hear("\x11");
  ASSERT_EQ(end.line->deadline(), LineTime(seconds(5)));
  end.now = seconds(5);
  end.line->tick(end.now);
  EXPECT_EQ(end.line->state().phase, Phase::Idle);
  std::string failures;
  for (const auto& event : end.line->take_events()) {
    if (const auto* failed = std::get_if<TransferFailed>(&event)) failures += failed->error.what;
  }
  EXPECT_EQ(failures, "no CTS in time");
}

INSTANTIATE_TEST_SUITE_P(, TncRtsCts, testing::Values(Role::Host, Role::Control),
                         [](const auto& tested) {
                           return std::string(tested.param == Role::Host ? "host" : "control");
                         });

// Rows: HD-220 (MP222: bit 2, bit 3, both).
TEST(TncStops, AreObeyedByTheParameter) {
  struct Case {
    TncStop stop;
    bool by_dc3, by_cts;
  };
  for (const Case& tested : {Case{TncStop::Dc3, true, false}, Case{TncStop::Rts, false, true},
                             Case{TncStop::Both, true, true}}) {
    TncEnd end(Role::Host, tested.stop);
    ASSERT_TRUE(end.line->begin_send("27", end.now));
    ASSERT_TRUE(end.line->offer(kProgram, true, end.now));
    end.hear("\x11");
    EXPECT_NE(end.say(5), "");
    end.hear("\x13");
    EXPECT_EQ(end.say(5).empty(), tested.by_dc3);
    end.hear("\x11");
    EXPECT_NE(end.say(5), "");
    end.set_cts(false);
    EXPECT_EQ(end.say(5).empty(), tested.by_cts);
    end.hear("\x13");
    end.set_cts(true);
    EXPECT_EQ(end.say(5).empty(), tested.by_dc3) << "CTS does not lift a DC3";
  }
  TncEnd both(Role::Host, TncStop::Both);
  both.line->set_ready(false, both.now);
  both.hear("0 BEGIN PGM 3 MM\r\n");
  EXPECT_FALSE(both.line->output_lines().rts);
  EXPECT_EQ(both.say(), "") << "a receiver that has RTS says no DC3";
}

// Rows: HD-220 (blockwise is governed by ACK alone).
TEST(TncStops, AreNotForBlockwiseTransfer) {
  LineSettings settings = find_template("tnc155-bcc").value()->settings;
  settings.heidenhain.stop = TncStop::Rts;
  const auto made = make_discipline(settings, Role::Host);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().what, HasSubstr("tnc_stop"));
}

struct HandshakeCase {
  std::string name;
  LineSettings settings;
};
class TncHandshake : public testing::TestWithParam<HandshakeCase> {};

// Rows: HD-220 (both ends hold each other; nothing is lost, and nothing leaves while CTS is off).
TEST_P(TncHandshake, CarriesProgramsBothWaysWithReceiversThatHaveNoRoomNowAndThen) {
  const LineSettings& settings = GetParam().settings;
  LineSimulator wire({settings, make_discipline(settings, Role::Host).value(),
                      make_discipline(settings, Role::Control).value()});
  const bool is_plain = settings.flow == Flow::RtsCts;
  wire.control().hold_rate = wire.host().hold_rate = 0.1;
  wire.control().hold_time = wire.host().hold_time = std::chrono::milliseconds(200);
  if (is_plain) {
    ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
    ASSERT_TRUE(wire.host().send(kProgram, wire.now(), "27"));
  } else {
    wire.host().on_event = [](LineEnd& end, const Event& event, LineTime now) {
      if (const auto* request = std::get_if<TransferRequest>(&event)) {
        EXPECT_TRUE(end.send(kProgram, now, request->name));
      }
    };
    ASSERT_TRUE(
        wire.control().line->request({TransferRequest::Kind::SendProgram, "27"}, wire.now()));
  }
  EXPECT_EQ(wire.run(seconds(600)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
  EXPECT_EQ(wire.from_host().given_after_stop, 0U);
  ASSERT_TRUE(wire.control().send(kProgram, wire.now(), "27"));
  EXPECT_EQ(wire.run(wire.now() + seconds(600)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.host().received, kProgram);
  EXPECT_EQ(wire.from_control().given_after_stop, 0U);
  EXPECT_TRUE(wire.host().failures.empty() && wire.control().failures.empty());
}

LineSettings plain_rts_settings() {
  LineSettings settings = find_template("tnc155").value()->settings;
  EXPECT_TRUE(set_value(settings, "flow", "rtscts"));
  return settings;
}

INSTANTIATE_TEST_SUITE_P(, TncHandshake,
                         testing::Values(HandshakeCase{"standard", rts_settings()},
                                         HandshakeCase{"flow_rtscts", plain_rts_settings()}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace dripline::wire
