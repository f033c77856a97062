#include "clients/tools/lines/line_replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/wire/tnc_frames.hpp"

namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using testing::Contains;
using testing::HasSubstr;
using What = RecordedTraffic::What;

LineSettings settings_of(std::string_view name) {
  return find_template(name).value()->settings;
}

class Recording {
 public:
  explicit Recording(std::string_view line_template)
      : replay_(LineReplay::make(settings_of(line_template)).value()) {}
  Recording& pause(LineTime time) {
    time_ += time;
    return *this;
  }
  Recording& sent(std::string bytes) { return add(What::Sent, std::move(bytes)); }
  Recording& received(std::string bytes) { return add(What::Received, std::move(bytes)); }
  ReplayReport report() { return replay_.finish(); }

 private:
  Recording& add(What what, std::string bytes) {
    replay_.play({time_ += milliseconds(50), what, std::move(bytes)});
    return *this;
  }
  LineReplay replay_;
  LineTime time_{};
};

std::string block(char begin, std::string_view text) {
  return make_tnc_block(begin, text, HeidenhainSettings{});
}

TEST(LineReplay, GivesTheSimulatedControlWhatAHostSent) {
  const auto report = Recording("plain")
                          .sent("N1 G1 X7\r\n")
                          .received("\x13")
                          .pause(milliseconds(9000))
                          .received("\x11")
                          .sent("N2 M30\r\n")
                          .report();
  ASSERT_EQ(report.to_control.size(), 1U);
  EXPECT_EQ(report.to_control[0].text, "N1 G1 X7\nN2 M30\n");
  EXPECT_EQ(report.deviations, 0U);
  EXPECT_EQ(report.sent, 18U);
}

TEST(LineReplay, TakesWhatAControlPunched) {
  const auto report = Recording("plain").received("O0012\r\nN1 M2\r\n").report();
  ASSERT_EQ(report.from_control.size(), 1U);
  EXPECT_EQ(report.from_control[0].text, "O0012\nN1 M2\n");
}

TEST(LineReplay, AnswersABlockwiseTransferAsItWasRecorded) {
  const auto report = Recording("tnc155-bcc")
                          .received(block(1, "%7E") + "\x11")
                          .sent("\x06" + block(2, "0 BEGIN PGM 7 MM"))
                          .received("\x06")
                          .sent(block(2, "1 END PGM 7 MM"))
                          .received("\x06")
                          .sent("\x03")
                          .received("\x04")
                          .report();
  ASSERT_EQ(report.to_control.size(), 1U);
  EXPECT_TRUE(report.to_control[0].has_ended);
  EXPECT_EQ(report.to_control[0].text, "0 BEGIN PGM 7 MM\n1 END PGM 7 MM\n");
  EXPECT_EQ(report.deviations, 0U) << testing::PrintToString(report.findings);
}

TEST(LineReplay, ReportsWhereTheRecordedControlAnsweredOtherwise) {
  auto spoiled = block(2, "1 STOP");
  spoiled[3] = 'X';
  const auto report = Recording("tnc155-bcc")
                          .received(block(1, "%7E") + "\x11")
                          .sent("\x06" + block(2, "0 BEGIN PGM 7 MM"))
                          .received("\x06")
                          .sent(spoiled)
                          .received("\x06")
                          .report();
  EXPECT_EQ(report.deviations, 1U);
  EXPECT_THAT(report.findings,
              Contains(HasSubstr("the recorded control sent ACK, the simulated one NAK")));
}

TEST(LineReplay, TakesWhatATncPutsOutBlockwise) {
  const auto report = Recording("tnc155-bcc")
                          .received(block(1, "%8A") + "\x11")
                          .sent("\x06")
                          .received(block(2, "0 BEGIN PGM 8 MM") + "\x11")
                          .sent("\x06")
                          .received(block(2, "1 END PGM 8 MM") + "\x11")
                          .sent("\x06")
                          .received("\x03\x04")
                          .report();
  ASSERT_EQ(report.from_control.size(), 1U);
  EXPECT_EQ(report.from_control[0].name, "8");
  EXPECT_TRUE(report.from_control[0].has_ended);
}

TEST(LineReplay, ReadsTapeAsTheControlThatRunsIt) {
  const auto report = Recording("tektronix1704-iso")
                          .received("\x11")
                          .sent("\xA5\x0A\x4E\xB1\x0A\x4E\xB2\x4D\x33\x30\x0A")
                          .report();
  ASSERT_EQ(report.to_control.size(), 1U);
  EXPECT_EQ(report.to_control[0].text, "%\nN1\nN2M30\n");
}

}  // namespace
}  // namespace dripline::wire
