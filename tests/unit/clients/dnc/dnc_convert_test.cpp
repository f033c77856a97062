#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using test_support::Dnc;

class DncConvert : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};
  const std::string program = "%\nN1G1X-25Y4F8\nN2Y0\nN3M30\n";
};

TEST_F(DncConvert, GoesRoundThroughBothTapeCodes) {
  dnc.write("a.nc", program);
  for (const std::string code : {"eia", "iso"}) {
    const auto there = dnc({"convert", "a.nc", "-o", code, "--to", code, "--title", "A-7"});
    ASSERT_EQ(there.status, 0) << there.err;
    EXPECT_NE(there.out.find("4 blocks"), std::string::npos) << there.out;
    ASSERT_EQ(dnc({"convert", code, "-o", "back.nc"}).status, 0);
    EXPECT_EQ(dnc.read("back.nc"), program) << code;
  }
  ASSERT_EQ(dnc({"convert", "eia", "-o", "eia.iso", "--to", "iso", "--leader", "7"}).status, 0);
  EXPECT_EQ(dnc.read("eia.iso").substr(0, 10), std::string("\0\0\0\0\0\0\0\xA5\x8D\n", 10));
}

TEST_F(DncConvert, ChangesTheFormOfTncPrograms) {
  const std::string plain =
      "0 BEGIN PGM 5 MM\r\n1 TOOL CALL 2 Z S 400,000\r\n2 L X+1,500 R0 F80 M\r\n"
      "3 END PGM 5 MM\r\n";
  const std::string iso =
      "%5 G71 *\r\nN10 T2 G17 S400 *\r\nN20 G01 G40 G90 X+1,5 F80 *\r\n"
      "N9999 %5 G71 *\r\n";
  dnc.write("a.h", plain);
  const auto there = dnc({"convert", "a.h", "-o", "a.i", "--to", "iso"});
  ASSERT_EQ(there.status, 0) << there.err;
  EXPECT_EQ(there.out, "Converted a.h -> a.i (ISO)\n");
  EXPECT_EQ(dnc.read("a.i"), iso);
  EXPECT_EQ(dnc({"convert", "a.i", "-o", "-", "--to", "plain"}).out, plain);
  EXPECT_EQ(dnc({"convert", "a.h", "-o", "-", "--to", "iso", "--eob", "lf", "--increment", "0",
                 "--decimal-point"})
                .out,
            "%5 G71 *\nT2 G17 S400 *\nG01 G40 G90 X+1.5 F80 *\nN9999 %5 G71 *\n");
  dnc.write("point.toml", "[control]\ndecimal_sign = \"point\"\n");
  EXPECT_EQ(dnc({"convert", "a.h", "-o", "-", "--to", "iso", "--setup", "point.toml"}).out,
            "%5 G71 *\r\nN10 T2 G17 S400 *\r\nN20 G01 G40 G90 X+1.5 F80 *\r\nN9999 %5 G71 *\r\n");
  // HD-066
  dnc.write("mod.toml", "[control]\nblock_increment = 3\n");
  EXPECT_EQ(dnc({"convert", "a.h", "-o", "-", "--to", "iso", "--setup", "mod.toml"}).out,
            "%5 G71 *\r\nN3 T2 G17 S400 *\r\nN6 G01 G40 G90 X+1,5 F80 *\r\nN9999 %5 G71 *\r\n");
  EXPECT_EQ(
      dnc({"convert", "a.h", "-o", "-", "--to", "iso", "--setup", "mod.toml", "--increment", "20"})
          .out,
      "%5 G71 *\r\nN20 T2 G17 S400 *\r\nN40 G01 G40 G90 X+1,5 F80 *\r\nN9999 %5 G71 *\r\n");
  dnc.write("wrong.toml", "[control]\ndecimal_sign = \"dot\"\n");
  EXPECT_EQ(dnc({"convert", "a.h", "-o", "-", "--to", "iso", "--setup", "wrong.toml"}).status, 1);
  dnc.write("b.h", "0 BEGIN PGM 5 MM\n1 C X1 Y1 DR+ R0 F MAX M\n");
  const auto refused = dnc({"convert", "b.h", "-o", "b.i", "--to", "iso"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "dnc: b.h: line 2: F MAX of this block has no counterpart in ISO\n");
  EXPECT_EQ(dnc.read("b.i"), "");
}

// HD-238: a copy under the name of the other form would be taken for the conversion.
TEST_F(DncConvert, RefusesACopyUnderTheOtherFormsName) {
  dnc.write("a.h", "0 BEGIN PGM 5 MM\r\n1 L X+1 R0 F80 M\r\n2 END PGM 5 MM\r\n");
  const auto refused = dnc({"convert", "a.h", "-o", "a.i"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "dnc: a.h is a TNC program in plain language and a.i is named as one in ISO: --to iso "
            "converts it, --to ascii copies its text\n");
  EXPECT_EQ(dnc.read("a.i"), "");
  EXPECT_EQ(dnc({"convert", "a.h", "-o", "a.i", "--to", "ascii"}).status, 0);
  EXPECT_EQ(dnc({"convert", "a.h", "-o", "b.h"}).status, 0);
  ASSERT_EQ(dnc({"convert", "a.h", "-o", "a.i", "--to", "iso"}).status, 0);
  EXPECT_EQ(dnc({"convert", "a.i", "-o", "c.h"}).status, 2);
}

// HD-238, HD-239: the setup says which control it is.
TEST_F(DncConvert, ConvertsAndChecksForTheControlOfTheSetup) {
  dnc.write("a.h", "0 BEGIN PGM 5 MM\n1 TOOL CALL 0 Z S 400\n2 STOP\n3 END PGM 5 MM\n");
  dnc.write("a.i", "%5 G71*\nN10 G38*\nN9999 %5 G71*\n");
  dnc.write("old.toml", "[control]\nsoftware = 7\n");
  dnc.write("new.toml", "[control]\nsoftware = 8\n");
  const auto convert = [&](const char* setup) {
    return dnc({"convert", "a.h", "-o", "b.i", "--to", "iso", "--setup", setup});
  };
  const auto refused = convert("old.toml");
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err,
            "dnc: a.h: line 3: STOP is G38 in ISO: a TNC 155 A with software 07 has no G38 (from "
            "software 08)\n");
  EXPECT_EQ(dnc.read("b.i"), "");
  EXPECT_EQ(convert("new.toml").status, 0);
  const auto alarm = dnc({"check", "a.i", "--setup", "old.toml"});
  EXPECT_EQ(alarm.status, 1);
  EXPECT_NE(alarm.out.find("a.i:2:1: alarm TNC-ILLEGAL-G: ILLEGAL G-CODE: G38: a TNC 155 A with "
                           "software 07 has no G38"),
            std::string::npos)
      << alarm.out;
  EXPECT_EQ(dnc({"check", "a.i", "--setup", "new.toml"}).status, 0);
  EXPECT_EQ(dnc({"check", "a.i"}).status, 0);
}

TEST_F(DncConvert, NamesWhatEiaCannotSayAndWritesNothing) {
  dnc.write("a.nc", "N1G1\nN2X[4]\n");
  const auto refused = dnc({"convert", "a.nc", "--from", "ascii", "-o", "b.ptp", "--to", "eia"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "dnc: a.nc: line 2, column 4: '[' is not a character of the EIA code\n");
  EXPECT_EQ(dnc.read("b.ptp"), "");
}

TEST_F(DncConvert, LeavesCommentsOutOfEiaAndSaysSo) {
  dnc.write("a.nc", "N1(ROUGH 7)G1X2\nN2M30\n");
  const auto done = dnc({"convert", "a.nc", "--from", "ascii", "-o", "b.ptp", "--to", "eia"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.err, "dnc: 1 comments left out, EIA has no parentheses\n");
  EXPECT_EQ(dnc({"convert", "b.ptp", "-o", "-"}).out, "%\nN1G1X2\nN2M30\n");
  EXPECT_EQ(
      dnc({"convert", "a.nc", "--from", "ascii", "-o", "c", "--to", "eia", "--refuse-comments"})
          .status,
      1);
  ASSERT_EQ(
      dnc({"convert", "a.nc", "--from", "ascii", "-o", "c", "--to", "eia", "--eia-parentheses"})
          .status,
      0);
  EXPECT_EQ(dnc({"convert", "c", "-o", "-"}).out, "%\nN1(ROUGH 7)G1X2\nN2M30\n");
}

TEST_F(DncConvert, SaysWhereATapeCannotBeRead) {
  dnc.write("a.ptp", std::string("\x0B\x80\x45\x01\x67\x03\x80\x45\x02\x80", 10));
  const auto refused = dnc({"convert", "a.ptp", "--from", "eia", "-o", "a.nc"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err,
            "dnc: a.ptp: row 6, line 2, column 4: 0x03 has not the parity of the EIA code\n");
  const auto replaced = dnc({"convert", "a.ptp", "--from", "eia", "-o", "-", "--replace-wrong"});
  EXPECT_EQ(replaced.out, "%\nN1G?\nN2\n");
  EXPECT_NE(replaced.err.find("1 rows became '?'"), std::string::npos) << replaced.err;
}

TEST_F(DncConvert, ListsATapeByItsHoles) {
  dnc.write("a.ptp", std::string("\0\0\x0B\x80\x45\x01\x67\x01\x80\x45\x02\x67\x04\x80", 14));
  const auto listed = dnc({"convert", "a.ptp", "--list"});
  EXPECT_EQ(listed.status, 0) << listed.err;
  EXPECT_EQ(listed.out.substr(0, 90),
            "         1  .....:...  00       blank, 2 rows\n"
            "         3  ....o:.oo  0B  %    rewind stop\n");
}

TEST_F(DncConvert, RefusesWhatItDoesNotKnow) {
  dnc.write("noise", "\xC3\x28\xA0\xA1\xE2\x82\x28\xF0\x28\x8C\xBC");
  EXPECT_EQ(dnc({"convert", "noise", "-o", "x"}).status, 1);
  EXPECT_EQ(dnc({"convert", "missing", "-o", "x"}).status, 2);
  EXPECT_EQ(dnc({"convert", "noise", "-o", "x", "--to", "ebcdic"}).status, 2);
  EXPECT_EQ(dnc({"convert", "noise", "--from", "iso"}).status, 2);
  dnc.write("a.nc", program);
  EXPECT_EQ(dnc({"convert", "a.nc", "-o", "x", "--to", "eia", "--leader", "200000"}).status, 2);
}

}  // namespace
}  // namespace dripline
