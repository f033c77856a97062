#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/serial/impl/tty_settings.hpp"

namespace dripline::serial {

namespace {

/// Characters as they are, "(41)" for a faulty one, "(break)".
std::string decoded(const std::vector<std::uint8_t>& bytes) {
  ParityMarks marks;
  std::string text;
  for (const std::uint8_t byte : bytes) {
    const auto item = marks.feed(byte);
    if (!item) continue;
    if (const auto* faulty = std::get_if<ParityMarks::Faulty>(&*item)) {
      text += faulty->is_break ? "(break)" : "(" + std::to_string(faulty->character) + ")";
    } else {
      text += static_cast<char>(std::get<std::uint8_t>(*item));
    }
  }
  return text;
}

TEST(ParityMarks, PassesCharactersThrough) {
  EXPECT_EQ(decoded({'G', '0', 0, 'X'}), std::string("G0\0X", 4));
}

TEST(ParityMarks, TakesADoubledFfForOne) {
  EXPECT_EQ(decoded({'A', 0xFF, 0xFF, 'B'}),
            "A\xFF"
            "B");
}

TEST(ParityMarks, ReportsAFaultyCharacterAndContinues) {
  EXPECT_EQ(decoded({'A', 0xFF, 0x00, 41, 'B'}), "A(41)B");
}

TEST(ParityMarks, ReportsABreak) {
  EXPECT_EQ(decoded({0xFF, 0x00, 0x00, 'B'}), "(break)B");
}

TEST(ParityMarks, ReportsAFaultyFf) {
  EXPECT_EQ(decoded({0xFF, 0x00, 0xFF, 'B'}), "(255)B");
}

wire::LineSettings settings(std::string_view short_form) {
  wire::LineSettings settings;
  EXPECT_TRUE(wire::apply_short_form(short_form, settings));
  return settings;
}

struct Format {
  const char* name;
  const char* text;
  speed_t rate;
  tcflag_t flags;
};
class FillModesTable : public testing::TestWithParam<Format> {};

TEST_P(FillModesTable, SetsRateAndFormat) {
  termios modes{};
  ASSERT_TRUE(fill_modes(settings(GetParam().text), modes));
  EXPECT_EQ(::cfgetospeed(&modes), GetParam().rate);
  EXPECT_EQ(::cfgetispeed(&modes), GetParam().rate);
  EXPECT_EQ(modes.c_cflag & (CSIZE | CSTOPB | PARENB | PARODD | CMSPAR), GetParam().flags);
}

INSTANTIATE_TEST_SUITE_P(
    , FillModesTable,
    testing::Values(Format{"plain", "9600n81", B9600, CS8},
                    Format{"centurion", "9600e72", B9600, CS7 | PARENB | CSTOPB},
                    Format{"odd", "2400o71", B2400, CS7 | PARENB | PARODD},
                    Format{"mark", "4800m71", B4800, CS7 | PARENB | PARODD | CMSPAR},
                    Format{"space", "115200s82", B115200, CS8 | PARENB | CMSPAR | CSTOPB}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(FillModes, LeavesFlowControlToTheDisciplineAndMarksFaults) {
  termios modes{};
  modes.c_iflag = IXON | IXOFF | ICRNL | ISTRIP | IGNPAR;
  modes.c_cflag = CRTSCTS;
  modes.c_lflag = ICANON | ECHO | ISIG;
  modes.c_oflag = OPOST;
  ASSERT_TRUE(fill_modes(settings("9600e71"), modes));
  EXPECT_EQ(modes.c_iflag, static_cast<tcflag_t>(INPCK | PARMRK));
  EXPECT_EQ(modes.c_cflag & CRTSCTS, 0U);
  EXPECT_EQ(modes.c_lflag & (ICANON | ECHO | ISIG), 0U);
  EXPECT_EQ(modes.c_oflag & OPOST, 0U);
}

TEST(FillModes, RefusesARateThatTtysDoNotHave) {
  wire::LineSettings odd;
  odd.baud = 250000;
  termios modes{};
  const auto done = fill_modes(odd, modes);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::Unsupported);
  EXPECT_NE(done.error().what.find("baud 250000"), std::string::npos);
  EXPECT_EQ(modes.c_cflag, 0U);
}

TEST(FillModes, RefusesOneAndAHalfStopBits) {
  wire::LineSettings odd;
  odd.stop_bits = wire::StopBits::OneAndHalf;
  termios modes{};
  ASSERT_FALSE(fill_modes(odd, modes));
}

TEST(Difference, NamesWhatADeviceDidNotTake) {
  termios wanted{}, got{};
  ASSERT_TRUE(fill_modes(settings("9600e71"), wanted));
  ASSERT_TRUE(fill_modes(settings("9600e71"), got));
  EXPECT_EQ(difference(wanted, got), "");
  ASSERT_TRUE(fill_modes(settings("9600e81"), got));
  EXPECT_EQ(difference(wanted, got), "data_bits");
  ASSERT_TRUE(fill_modes(settings("9600n71"), got));
  EXPECT_EQ(difference(wanted, got), "parity");
  ASSERT_TRUE(fill_modes(settings("4800e71"), got));
  EXPECT_EQ(difference(wanted, got), "baud");
}

}  // namespace

}  // namespace dripline::serial
