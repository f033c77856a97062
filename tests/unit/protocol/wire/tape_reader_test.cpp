#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/tape_code.hpp"
#include "tests/support/line/line_simulator.hpp"

namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::LineEnd;
using test_support::LineSimulator;
using testing::HasSubstr;

const std::string kProgram = "%\nN1G1X-25Y40F8\nN2Y0\nN30Z-7\nN40M30\n";

LineSettings settings_of(CharacterCode code) {
  return find_template(code == CharacterCode::Eia ? "tektronix1704" : "tektronix1704-iso")
      .value()
      ->settings;
}

LineSimulator line(const LineSettings& settings) {
  return LineSimulator({settings, make_discipline(settings, Role::Host).value(),
                        make_discipline(settings, Role::Control).value()});
}

class TapeReaderLine : public testing::TestWithParam<CharacterCode> {};

TEST_P(TapeReaderLine, ReadsTheProgramAndWindsBack) {
  auto wire = line(settings_of(GetParam()));
  ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  EXPECT_EQ(wire.run(seconds(20)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
  EXPECT_EQ(wire.control().receptions, 1U);
  EXPECT_EQ(wire.host().sends, 1U);
  ASSERT_EQ(wire.host().requests.size(), 1U);  // wound back: the program once more
  ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  EXPECT_EQ(wire.run(wire.now() + seconds(20)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
}

// A rewind stop after the last program, and ends of block of two characters: after M30 nothing is
// left that the control could have read.
TEST_P(TapeReaderLine, IsReadWhereNoBlockIsLeft) {
  for (const std::string_view end : {"", "%\n", "\n%\n"}) {
    for (const EndOfBlock ends : {EndOfBlock::Lf, EndOfBlock::CrLf}) {
      auto settings = settings_of(GetParam());
      if (GetParam() != CharacterCode::Eia) settings.end_of_block = ends;
      auto wire = line(settings);
      ASSERT_TRUE(wire.host().send(kProgram + std::string(end), wire.now()));
      ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
      EXPECT_EQ(wire.run(seconds(20)), LineSimulator::Outcome::Idle);
      EXPECT_EQ(wire.control().received, kProgram) << end;
      EXPECT_EQ(wire.host().sends, 1U) << end;
      EXPECT_TRUE(wire.host().failures.empty()) << end;
      EXPECT_EQ(wire.host().requests.size(), 1U) << end;
    }
  }
}

// A tape that is wound back in its middle has not been read.
TEST_P(TapeReaderLine, IsNotReadWhereABlockIsLeft) {
  auto wire = line(settings_of(GetParam()));
  ASSERT_TRUE(wire.host().send("%\nN1M30\n%\nN2X7\nN3M02\n", wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  wire.run(seconds(20));
  ASSERT_EQ(wire.host().failures.size(), 1U);
  EXPECT_EQ(wire.host().failures[0].what, "the control wound the tape back");
}

// What it skipped before the first end of block is the head of its program, and no block after it.
TEST_P(TapeReaderLine, GivesTheHeadThatItSkipped) {
  auto settings = settings_of(GetParam());
  settings.leader = 0;
  auto control = make_discipline(settings, Role::Control).value();
  ASSERT_TRUE(control->begin_receive("", {}));
  CharacterEncoder encoder(settings.code, settings.end_of_block);
  std::vector<std::byte> rows;
  ASSERT_TRUE(encoder.encode("N40X3\nN50Y1\nN60M02\n", rows));
  control->receive(rows, {});
  std::string text;
  for (const auto& event : control->take_events()) {
    if (const auto* got = std::get_if<TextReceived>(&event)) text += got->text;
  }
  EXPECT_EQ(text, "N40X3\nN50Y1\nN60M02\n");
}

// The control stops the reader at M02; cycle start runs it on, over the leader of the next program.
TEST_P(TapeReaderLine, ReadsTheNextProgramOfTheTape) {
  const std::string first = "%\nN1G1X-25Y40F8\nN2M02\n", second = "%\nN1Y7\nN2M02\n";
  auto wire = line(settings_of(GetParam()));
  ASSERT_TRUE(wire.host().send(first + second, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  wire.run(wire.now() + seconds(20));
  EXPECT_EQ(wire.control().received, first);
  EXPECT_EQ(wire.host().sends, 0U) << "the second program is still to come";
  EXPECT_EQ(wire.host().line->state().waiting_for, "run");
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  wire.run(wire.now() + seconds(20));
  EXPECT_EQ(wire.control().received, second);
  EXPECT_EQ(wire.host().sends, 1U) << "stopped after its last character";
  EXPECT_TRUE(wire.host().requests.empty());
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  wire.run(wire.now() + milliseconds(200));
  EXPECT_EQ(wire.host().requests.size(), 1U) << "a looped tape continues";
  ASSERT_TRUE(wire.host().send(first, wire.now()));
  wire.run(wire.now() + seconds(20));
  EXPECT_EQ(wire.control().received, first) << "the reader runs already";
}

// The control has read the last block before the owner has marked it as the last.
TEST_P(TapeReaderLine, LearnsLateThatNothingFollows) {
  for (const std::string_view end : {"M02", "M30"}) {
    const auto settings = settings_of(GetParam());
    auto host = make_discipline(settings, Role::Host).value();
    ASSERT_TRUE(host->begin_send("", {}));
    ASSERT_TRUE(host->offer(fmt::format("%\nN1{}\n", end), false, {}));
    std::array<std::byte, 400> rows{};
    LineTime now = seconds(9);
    for (int i = 0; i < 400; ++i) (void)host->transmit(rows, now += milliseconds(4));
    const auto command = [&](char c) {
      const auto byte = static_cast<std::byte>(c);
      host->receive({&byte, 1}, now);
    };
    command('\x13');
    if (end == "M30") command('\b');
    const auto ends = [&] {
      return std::ranges::count_if(host->take_events(), [](const Event& event) {
        return std::holds_alternative<TransferEnded>(event);
      });
    };
    EXPECT_EQ(ends(), 0) << end;
    ASSERT_TRUE(host->offer("", true, now));
    if (end == "M02") host->tick(now + seconds(2));
    EXPECT_EQ(ends(), 1) << end;
  }
}

TEST_P(TapeReaderLine, KeepsItsRate) {
  for (const double rate : {150.0, 300.0, 500.0}) {
    auto settings = settings_of(GetParam());
    settings.reader.characters_per_second = rate;
    settings.leader = settings.trailer = 0;
    auto wire = line(settings);
    std::string program = "%\n";
    for (int i = 0; i < 300; ++i) program += "N7X1\n";
    ASSERT_TRUE(wire.host().send(program + "M2\n", wire.now()));
    ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
    wire.run(seconds(60));
    const double time = std::chrono::duration<double>(wire.now()).count();
    EXPECT_NEAR(time, static_cast<double>(program.size()) / rate, 0.01 * time + 0.03) << rate;
  }
}

TEST_P(TapeReaderLine, StopsAtOnceWhenTheControlHasNoRoom) {
  auto wire = line(settings_of(GetParam()));
  wire.control().hold_rate = 0.05;
  wire.control().hold_time = milliseconds(700);
  ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  EXPECT_EQ(wire.run(seconds(60)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
}

TEST_P(TapeReaderLine, RunsBlockByBlock) {
  auto settings = settings_of(GetParam());
  settings.reader.stops_at_end_of_block = true;
  auto wire = line(settings);
  ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
  EXPECT_EQ(wire.run(seconds(20)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, kProgram);
}

TEST_P(TapeReaderLine, FindsABlockWithoutTakingTheOnesBefore) {
  auto wire = line(settings_of(GetParam()));
  ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("N030", wire.now()));
  EXPECT_EQ(wire.run(seconds(20)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(wire.control().received, "%\nN30Z-7\nN40M30\n");
}

TEST_P(TapeReaderLine, ReportsABlockThatIsNotOnTheTape) {
  auto wire = line(settings_of(GetParam()));
  ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
  ASSERT_TRUE(wire.control().line->begin_receive("N31", wire.now()));
  wire.run(seconds(20));
  ASSERT_EQ(wire.control().failures.size(), 1U);
  EXPECT_EQ(wire.control().failures[0].code, Errc::NotFound);
  EXPECT_EQ(wire.control().failures[0].what, "block N31 is not on the tape");
  EXPECT_EQ(wire.host().sends, 1U) << "the tape was read to its end";
}

// Rows: TK-04.
TEST_P(TapeReaderLine, StopsAtASpoiledRowAndDropsTheBlock) {
  const std::pair<ReaderFault, std::string> faults[] = {{ReaderFault::Parity, "wrong parity"},
                                                        {ReaderFault::Chad, "wrong parity"}};
  for (const auto& [fault, words] : faults) {
    auto settings = settings_of(GetParam());
    auto control = make_discipline(settings, Role::Control).value();
    settings.reader.fault = fault;
    settings.reader.fault_row = 100 + 2 + 15 + 2;  // leader, rewind stop and end, block 1, N2
    LineSimulator wire(
        {settings, make_discipline(settings, Role::Host).value(), std::move(control)});
    ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
    ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
    wire.run(seconds(20));
    ASSERT_EQ(wire.control().failures.size(), 1U);
    EXPECT_THAT(wire.control().failures[0].what, HasSubstr("READ ERROR at row 119: " + words));
    EXPECT_EQ(wire.control().received, "%\nN1G1X-25Y40F8\n");
    EXPECT_TRUE(wire.host().line->state().is_stopped);
  }
}

TEST_P(TapeReaderLine, HasTheFaultsOfAReaderThatNoCodeShows) {
  const std::pair<ReaderFault, std::string> faults[] = {
      {ReaderFault::MissingSprocket, "missing sprocket hole"},
      {ReaderFault::SprocketSpacing, "wrong sprocket hole spacing"}};
  for (const auto& [fault, words] : faults) {
    auto settings = settings_of(GetParam());
    auto host = make_discipline(settings, Role::Host).value();
    settings.reader.fault = fault;
    settings.reader.fault_row = 120;
    LineSimulator wire(
        {settings, std::move(host), make_discipline(settings, Role::Control).value()});
    ASSERT_TRUE(wire.host().send(kProgram, wire.now()));
    ASSERT_TRUE(wire.control().line->begin_receive("", wire.now()));
    wire.run(seconds(20));
    ASSERT_EQ(wire.control().failures.size(), 1U);
    EXPECT_EQ(wire.control().failures[0].what, "READ ERROR at row 120: " + words);
  }
}

INSTANTIATE_TEST_SUITE_P(, TapeReaderLine, testing::Values(CharacterCode::Eia, CharacterCode::Iso),
                         [](const auto& tested) { return std::string(code_name(tested.param)); });

TEST(TapeReaderControl, ChecksNoParityBeforeTheFirstEndOfBlock) {
  auto control = make_discipline(settings_of(CharacterCode::Eia), Role::Control).value();
  ASSERT_TRUE(control->begin_receive("", {}));
  const std::string_view tape = "\x03\x0F\xF0\x33\x0B\x80\x45\x01\x54\x02\x80";
  control->receive(std::as_bytes(std::span(tape)), {});
  std::string text;
  for (const auto& event : control->take_events()) {
    EXPECT_FALSE(std::holds_alternative<TransferFailed>(event));
    if (const auto* got = std::get_if<TextReceived>(&event)) text += got->text;
  }
  EXPECT_EQ(text, "%\nN1M2\n");
}

TEST(TapeReaderHost, NamesWhatEiaCannotSay) {
  auto host = make_discipline(settings_of(CharacterCode::Eia), Role::Host).value();
  ASSERT_TRUE(host->begin_send("", {}));
  const auto refused = host->offer("N1\nN2 (ROUGH)\n", true, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "line 2, column 4: '(' is not a character of the EIA code");
}

}  // namespace
}  // namespace dripline::wire
