#include "clients/tools/lines/line_diagnosis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <bit>

#include "protocol/wire/character_coder.hpp"

namespace dripline::wire {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string kProgram = "N10 G90 G1 X12.5 Y-40.25 F300\nN20 X0 M8\nN30 Z-7.125\nN40 M30\n";

std::string on_line(CharacterCode code, EndOfBlock end) {
  CharacterEncoder encoder(code, end);
  std::vector<std::byte> line;
  EXPECT_TRUE(encoder.encode(kProgram, line));
  return {reinterpret_cast<const char*>(line.data()), line.size()};
}

std::string with_bit(std::string text, Parity parity) {
  for (char& c : text) {
    const bool is_odd = std::popcount(static_cast<unsigned char>(c)) % 2 != 0;
    const bool is_set = parity == Parity::Mark || (parity == Parity::Even && is_odd) ||
                        (parity == Parity::Odd && !is_odd);
    if (is_set) c = static_cast<char>(c | 0x80);
  }
  return text;
}

LineSample sample(unsigned baud, std::string bytes) {
  LineSample heard;
  heard.tried.baud = baud;
  heard.bytes = std::move(bytes);
  return heard;
}

struct Heard {
  const char* name;
  std::string bytes;
  unsigned data_bits;
  Parity parity;
  CharacterCode code;
  EndOfBlock end;
};

class Diagnosis : public testing::TestWithParam<Heard> {};

TEST_P(Diagnosis, ReadsTheSettingsFromEightBits) {
  const auto& heard = GetParam();
  LineObservation seen;
  seen.samples = {sample(2400, "\xFE\xE6\x06\x98\x1E\xFE\xE6\x06\x98\x80"),
                  sample(4800, heard.bytes)};
  seen.samples[0].framing_faults = 9;
  const auto diagnosis = diagnose(seen);
  ASSERT_TRUE(diagnosis.settings);
  EXPECT_EQ(diagnosis.settings->baud, 4800U);
  EXPECT_EQ(diagnosis.settings->data_bits, heard.data_bits);
  EXPECT_EQ(diagnosis.settings->parity, heard.parity);
  EXPECT_EQ(diagnosis.settings->code, heard.code);
  if (heard.code != CharacterCode::Eia) {
    EXPECT_EQ(diagnosis.settings->end_of_block, heard.end);
  }
  EXPECT_GT(diagnosis.confidence, kGoodScore);
}

INSTANTIATE_TEST_SUITE_P(
    , Diagnosis,
    testing::Values(
        Heard{"plain", on_line(CharacterCode::Ascii, EndOfBlock::CrLf), 8, Parity::None,
              CharacterCode::Ascii, EndOfBlock::CrLf},
        Heard{"even", with_bit(on_line(CharacterCode::Ascii, EndOfBlock::LfCrCr), Parity::Even), 7,
              Parity::Even, CharacterCode::Ascii, EndOfBlock::LfCrCr},
        Heard{"odd", with_bit(on_line(CharacterCode::Ascii, EndOfBlock::Lf), Parity::Odd), 7,
              Parity::Odd, CharacterCode::Ascii, EndOfBlock::Lf},
        Heard{"mark", with_bit(on_line(CharacterCode::Ascii, EndOfBlock::Cr), Parity::Mark), 7,
              Parity::Mark, CharacterCode::Ascii, EndOfBlock::Cr},
        Heard{"eia", on_line(CharacterCode::Eia, EndOfBlock::Lf), 8, Parity::None,
              CharacterCode::Eia, EndOfBlock::Lf}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(LineDiagnosis, HearsANinthBit) {
  auto heard = sample(9600, kProgram);
  heard.framing_faults = kProgram.size();
  EXPECT_TRUE(read_sample(heard).has_ninth_bit);
  EXPECT_LT(read_sample(heard).score, 0.6);
  EXPECT_FALSE(read_sample(sample(9600, kProgram)).has_ninth_bit);
}

TEST(LineDiagnosis, TrustsNoHandfulOfCharacters) {
  EXPECT_LT(read_sample(sample(9600, "G1")).score, 0.5);
  EXPECT_GT(read_sample(sample(9600, kProgram)).score, 0.99);
}

TEST(LineDiagnosis, DistinguishesAMissingGroundFromAWrongRate) {
  LineObservation seen;
  seen.samples = {sample(9600, "")};
  seen.samples[0].breaks = 20;
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("Most are breaks")));
  seen.samples[0].breaks = 0;
  seen.samples[0].framing_faults = 20;
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("the rate is one that was not tried")));
  EXPECT_FALSE(diagnose(seen).settings);
}

// Rows: PT-02, PT-38: jumpers and the tester's lights are detected by the modem lines.
TEST(LineDiagnosis, ExplainsSilenceByTheModemLines) {
  LineObservation seen;
  seen.samples = {sample(9600, "")};
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("no modem lines")));
  seen.wiring = LineWiring{{false, false, false}, {false, false, false}, {false, false, false}};
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("nothing is at the other end")));
  seen.wiring->all_on = {true, true, true};
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("null modem")));
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("CTS follows our RTS")));
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("DSR follows our DTR")));
  seen.is_echoed = true;
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("comes back")));
}

TEST(LineDiagnosis, ReportsHowTheControlObeysXoff) {
  LineObservation seen;
  seen.samples = {sample(9600, kProgram)};
  seen.after_stop = 17;
  EXPECT_THAT(diagnose(seen).findings, Contains("After XOFF 17 more characters came."));
  seen.never_stopped = true;
  EXPECT_THAT(diagnose(seen).findings, Contains(HasSubstr("does not listen to XOFF")));
}

}  // namespace
}  // namespace dripline::wire
