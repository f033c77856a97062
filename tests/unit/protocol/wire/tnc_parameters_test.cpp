#include "protocol/wire/tnc_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Rows: HD-217 (baud rates), HD-218 (MP 222), HD-232 (MP 218 to 224).
namespace dripline::wire {
namespace {

using testing::HasSubstr;

TncInterface with(TncParameters parameters) {
  return {std::move(parameters), 2400, {}};
}
std::string refusal(TncParameters parameters) {
  const auto line = line_of_tnc(with(std::move(parameters)));
  return line ? "" : line.error().what;
}

// HD-217
TEST(TncBaudRates, AreEight) {
  for (const unsigned baud : {110u, 150u, 300u, 600u, 1200u, 2400u, 4800u, 9600u}) {
    EXPECT_TRUE(check_tnc_baud(baud)) << baud;
    const auto line = line_of_tnc({{}, baud, {}});
    ASSERT_TRUE(line) << line.error().what;
    EXPECT_EQ(line->baud, baud);
  }
  for (const unsigned baud : {0u, 75u, 19200u}) EXPECT_FALSE(check_tnc_baud(baud)) << baud;
  EXPECT_EQ(line_of_tnc({{}, 19200, {}}).error().what,
            "baud 19200: a TNC 151/155 has 110, 150, 300, 600, 1200, 2400, 4800, 9600");
}

TEST(TncParameters, AreTheTemplatesByDefault) {
  const auto standard = line_of_tnc({});
  ASSERT_TRUE(standard) << standard.error().what;
  const auto blockwise = line_of_tnc(with({{223, 1}}));
  ASSERT_TRUE(blockwise) << blockwise.error().what;
  for (const SettingRow& row : setting_rows()) {
    EXPECT_EQ(row.get(*standard), row.get(find_template("tnc155").value()->settings)) << row.key;
    EXPECT_EQ(row.get(*blockwise), row.get(find_template("tnc155-bcc").value()->settings))
        << row.key;
  }
}

struct FormatCase {
  const char* name;
  int value;
  const char* line;
  bool has_printable_bcc;
};
class TncFormat : public testing::TestWithParam<FormatCase> {};

// HD-218: the bits of MP 222.
TEST_P(TncFormat, IsTheLines) {
  const auto line = line_of_tnc(with({{222, GetParam().value}, {223, 1}}));
  ASSERT_TRUE(line) << line.error().what;
  EXPECT_EQ(short_form(*line), GetParam().line);
  EXPECT_EQ(line->heidenhain.bcc_is_printable, GetParam().has_printable_bcc);
}
INSTANTIATE_TEST_SUITE_P(
    , TncFormat,
    testing::Values(FormatCase{"usual", 168, "2400e71", false},
                    FormatCase{"for_a_graphic_printer", 169, "2400e81", false},
                    FormatCase{"printable_bcc", 170, "2400e71", true},
                    FormatCase{"stopped_by_rts_too", 172, "2400e71", false},
                    FormatCase{"odd", 184, "2400o71", false},
                    FormatCase{"odd_means_nothing_without_parity", 153, "2400n81", false},
                    FormatCase{"one_and_a_half_stop_bits", 40, "2400e71.5", false},
                    FormatCase{"two_stop_bits", 104, "2400e72", false},
                    FormatCase{"one_stop_bit_too", 232, "2400e71", false}),
    [](const auto& tested) { return std::string(tested.param.name); });

// HD-220: what stops the sender, on the standard interface.
TEST(TncParameters, SayWhatStopsTheSender) {
  const auto stop = [](int format, int protocol) {
    const auto line = line_of_tnc(with({{222, format}, {223, protocol}}));
    EXPECT_TRUE(line) << line.error().what;
    return line->heidenhain.stop;
  };
  EXPECT_EQ(stop(168, 0), TncStop::Dc3);
  EXPECT_EQ(stop(160, 0), TncStop::Dc3);
  EXPECT_EQ(stop(164, 0), TncStop::Rts);
  EXPECT_EQ(stop(172, 0), TncStop::Both);
  EXPECT_EQ(stop(164, 1), TncStop::Dc3) << "blockwise the ACK holds the sender";
}

TEST(TncParameters, RefuseWhatNoControlHas) {
  EXPECT_EQ(refusal({{222, 256}}), "MP222 = 256: expected a whole number from 0 to 255");
  EXPECT_EQ(refusal({{222, 168.5}}), "MP222 = 168.5: expected a whole number from 0 to 255");
  EXPECT_EQ(refusal({{71, -1}}), "MP71 = -1: expected a whole number from 0 to 65535");
  EXPECT_EQ(refusal({{223, 2}}), "MP223 = 2: expected a whole number from 0 to 1");
}

// HD-232
TEST(TncParameters, ReplaceTheControlCharacters) {
  const auto line = line_of_tnc(with({{71, 5 * 256 + 25},
                                      {218, 'E' * 256 + 'D'},
                                      {219, 'A' * 256 + 'D'},
                                      {220, 2 * 256 + 24},
                                      {221, 22 * 256 + 7},
                                      {223, 1},
                                      {224, 14}}));
  ASSERT_TRUE(line) << line.error().what;
  const auto& tnc = line->heidenhain;
  EXPECT_EQ(std::string({tnc.etx, tnc.stx, tnc.etb, tnc.soh, tnc.ack, tnc.nak, tnc.eot}),
            std::string({25, 5, 24, 2, 7, 22, 14}));
  EXPECT_EQ(tnc.heading, 'D');
  // 0 is the usual EOT, and an end of program alone leaves STX
  const auto sparing = line_of_tnc(with({{71, 26}, {223, 1}, {224, 0}}));
  ASSERT_TRUE(sparing) << sparing.error().what;
  EXPECT_EQ(sparing->heidenhain.etx, 26);
  EXPECT_EQ(sparing->heidenhain.stx, 2);
  EXPECT_EQ(sparing->heidenhain.eot, 4);
}

TEST(TncParameters, OfTheBlockwiseTransferMeanNothingToTheStandardInterface) {
  const auto line = line_of_tnc(with({{218, 0}, {219, 0}, {220, 0}, {221, 0}}));
  ASSERT_TRUE(line) << line.error().what;
  EXPECT_EQ(line->heidenhain.soh, 1);
}

TEST(TncParameters, RefuseHeadingsAndCharactersThatNoControlHas) {
  EXPECT_THAT(refusal({{218, 'X' * 256 + 'H'}, {223, 1}}),
              HasSubstr("MP218 = 22600: the high byte is 88; headings end with E, 69"));
  EXPECT_THAT(refusal({{219, 'X' * 256 + 'H'}, {223, 1}}), HasSubstr("MP219 = 22600"));
  EXPECT_THAT(refusal({{218, 'E' * 256 + 'D'}, {223, 1}}), HasSubstr("one letter for headings"));
  EXPECT_THAT(refusal({{218, 'E' * 256 + 'Q'}, {219, 'A' * 256 + 'Q'}, {223, 1}}),
              HasSubstr("the low byte is 81; headings begin with %, H or D"));
  EXPECT_THAT(refusal({{221, 6 * 256 + 6}, {223, 1}}), HasSubstr("TNC control character 6"));
  EXPECT_THAT(refusal({{71, 100}}), HasSubstr("TNC control character 100"));
}

// The letter: of the setup, else of MP 218, else %.
TEST(TncParameters, TakeTheHeadingFromWhoKnowsIt) {
  TncInterface interface {
    {{223, 1}}, 2400, {}
  };
  EXPECT_EQ(line_of_tnc(interface)->heidenhain.heading, '%');
  interface.parameters[218] = 17736;
  interface.parameters[219] = 16712;
  EXPECT_EQ(line_of_tnc(interface)->heidenhain.heading, 'H');
  interface.heading = '%';
  EXPECT_EQ(line_of_tnc(interface)->heidenhain.heading, '%');
}

TEST(TncParameters, OfALineGiveThatLineAgain) {
  for (const char* name : {"tnc155", "tnc155-rts", "tnc155-bcc"}) {
    for (const char* form : {"2400e71", "9600n82", "300o71.5", "110e81"}) {
      LineSettings line = find_template(name).value()->settings;
      ASSERT_TRUE(apply_short_form(form, line));
      if (line.flow == Flow::HeidenhainBcc) {
        line.heidenhain.heading = 'H';
        line.heidenhain.bcc_is_printable = true;
        line.heidenhain.nak = 24;
      }
      const auto parameters = tnc_parameters_of_line(line);
      ASSERT_TRUE(parameters) << parameters.error().what;
      const auto again = line_of_tnc({*parameters, line.baud, {}});
      ASSERT_TRUE(again) << again.error().what;
      for (const SettingRow& row : setting_rows()) EXPECT_EQ(row.get(*again), row.get(line));
    }
  }
  const auto usual = tnc_parameters_of_line(find_template("tnc155").value()->settings);
  EXPECT_EQ(usual->at(71), 515);
  EXPECT_EQ(usual->at(222), 168);
  EXPECT_EQ(usual->at(220), 279);
  EXPECT_EQ(usual->at(221), 5382);
}

TEST(TncParameters, NameWhatTheyHaveNoValueFor) {
  const auto refused = [](std::string_view key, std::string_view value) {
    LineSettings line = find_template("tnc155").value()->settings;
    EXPECT_TRUE(set_value(line, key, value));
    const auto parameters = tnc_parameters_of_line(line);
    return parameters ? "" : parameters.error().what;
  };
  EXPECT_THAT(refused("flow", "xmodem"), HasSubstr("has the flow heidenhain or heidenhain_bcc"));
  EXPECT_THAT(refused("baud", "19200"), HasSubstr("baud 19200"));
  EXPECT_THAT(refused("parity", "mark"), HasSubstr("parity"));
  EXPECT_THAT(refused("code", "iso"), HasSubstr("eia and iso fill 8 bits"));
}

}  // namespace
}  // namespace dripline::wire
