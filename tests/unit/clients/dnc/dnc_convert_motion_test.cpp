#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

/// `dnc convert --to CONTROL`.
namespace dripline {
namespace {

using test_support::Dnc;

class DncConvertMotion : public testing::Test {
 protected:
  void SetUp() override { dnc.write("part.h", part); }
  Dnc dnc{DNC_PATH};
  const std::string part =
      "0 BEGIN PGM 12 MM\n1 TOOL DEF 3 L+0 R+4\n2 TOOL CALL 3 Z S900\n"
      "3 L X-20 Y-20 Z+50 R0 FMAX M3\n4 L Z-4 R0 FMAX\n5 L X+0 Y+0 RL F200\n6 L Y+30\n7 L X+40\n"
      "8 L Y+0\n9 L X+0\n10 L X-20 Y-20 R0 FMAX\n11 L Z+50 R0 FMAX M30\n12 END PGM 12 MM\n";
};

TEST_F(DncConvertMotion, WritesAndProves) {
  const auto done = dnc({"convert", "part.h", "-o", "part.nc", "--to", "fanuc"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("Converted part.h (tnc155) -> part.nc (fanuc, program 12, mm): "),
            std::string::npos)
      << done.out;
  EXPECT_NE(done.out.find("Proved: "), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("do the same within 0.001 mm\n"), std::string::npos) << done.out;
  const std::string text = dnc.read("part.nc");
  EXPECT_TRUE(text.starts_with("%\nO0012\nG21 ")) << text;
  EXPECT_NE(text.find("X-4."), std::string::npos) << text;  // the contour, 4 mm to its left
  const auto compared = dnc({"diff", "--motion", "part.h", "part.nc", "--second-control", "fanuc"});
  EXPECT_EQ(compared.status, 0) << compared.out;
  const auto back = dnc({"convert", "part.nc", "-o", "back.h", "--control", "fanuc", "--to",
                         "tnc155", "--name", "99"});
  ASSERT_EQ(back.status, 0) << back.err;
  EXPECT_NE(dnc.read("back.h").find("0 BEGIN PGM 99 MM\r\n"), std::string::npos);
  EXPECT_EQ(dnc({"diff", "--motion", "part.h", "back.h"}).out.find("path"), std::string::npos);
}

TEST_F(DncConvertMotion, SummaryAsJson) {
  const auto done = dnc({"convert", "part.h", "-o", "part.nc", "--to", "linuxcnc", "--json"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto summary = nlohmann::json::parse(done.out);
  EXPECT_EQ(summary.at("from"), "tnc155");
  EXPECT_EQ(summary.at("to"), "linuxcnc");
  EXPECT_EQ(summary.at("units"), "mm");
  EXPECT_EQ(summary.at("proved").at("tolerance"), 0.0001);
  EXPECT_GT(summary.at("proved").at("actions"), 9);
  EXPECT_GT(summary.at("moves"), 7);
  EXPECT_EQ(summary.at("changes").at("rounded_feeds"), 0);
  EXPECT_TRUE(summary.at("conditions").empty());
}

TEST_F(DncConvertMotion, StandardOutputHasTheProgramAlone) {
  const auto done = dnc({"convert", "part.h", "-o", "-", "--to", "rs274ngc"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(done.out.starts_with("%\nG21 ")) << done.out;
  EXPECT_TRUE(done.out.ends_with("M2\n%\n")) << done.out;
  EXPECT_EQ(dnc({"convert", "part.h", "-o", "-", "--to", "rs274ngc", "--json"}).status, 2);
}

TEST_F(DncConvertMotion, RefusesWithTheLineAndLeavesNoFile) {
  dnc.write("fine.nc", "G21 G90 G00 X0 Y0 Z5.\nG01 X10. F12.4\nM30\n");
  dnc.write("fine.h", "what was there before\n");
  const auto refused =
      dnc({"convert", "fine.nc", "-o", "fine.h", "--control", "fanuc", "--to", "tnc155"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(
      refused.err,
      "dnc: fine.nc: line 2: feed of 12.4 mm/min: tnc155 takes 0 decimals, so 12, which is off "
      "by more than 0.5 %\n");
  EXPECT_EQ(dnc.read("fine.h"), "what was there before\n");
}

TEST_F(DncConvertMotion, TellsWhatTheResultDependsOn) {
  dnc.write("start.nc", "G21 G91 G00 X5.\nM30\n");
  const auto args = std::vector<std::string>{"convert",   "start.nc", "-o",   "out.nc",
                                             "--control", "fanuc",    "--to", "rs274ngc"};
  const auto refused = dnc(args);
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("does not do the same at"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--as-set-up"), std::string::npos) << refused.err;
  EXPECT_EQ(dnc.read("out.nc"), "");
  auto accepted = args;
  accepted.emplace_back("--as-set-up");
  const auto done = dnc(accepted);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.err.find("holds for this setup alone: the position from which"), std::string::npos)
      << done.err;
}

TEST_F(DncConvertMotion, LeavesZToTheOperatorOfATwoAxisMill) {
  dnc.write("flat.nc", "G21 G90\nS900 M03\nG00 X0 Y0\nZ2.\nG01 Z-4. F100.\nX10.\nG00 Z5.\nM30\n");
  const auto done =
      dnc({"convert", "flat.nc", "-o", "flat.ptp", "--control", "fanuc", "--to", "prototrak-plus"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.err.find("left to the operator"), std::string::npos) << done.err;
  EXPECT_NE(dnc.read("flat.ptp").find("(Z TO -4. FEED 100)\r\n"), std::string::npos);
  const auto ramp = dnc({"convert", "part.h", "-o", "x", "--to", "prototrak-plus"});
  EXPECT_EQ(ramp.status, 1);
  EXPECT_NE(ramp.err.find("part.h: line 4: rapid move of Z together with X or Y"),
            std::string::npos)
      << ramp.err;
}

TEST_F(DncConvertMotion, KeepsCompensation) {
  const auto kept =
      dnc({"convert", "part.h", "-o", "kept.h", "--to", "itnc", "--keep-compensation"});
  ASSERT_EQ(kept.status, 0) << kept.err;
  EXPECT_NE(dnc.read("kept.h").find("L X+0 Y+0 RL F200\r\n"), std::string::npos)
      << dnc.read("kept.h");
  EXPECT_NE(kept.err.find("by radius 3 of the control: proved with 4 mm and with 3 mm"),
            std::string::npos)
      << kept.err;
  dnc.write("kept.nc", "what was there before\n");
  const auto refused =
      dnc({"convert", "part.h", "-o", "kept.nc", "--to", "fanuc", "--keep-compensation"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("compensation cannot be kept here"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("  part.h, line "), std::string::npos) << refused.err;
  EXPECT_EQ(dnc.read("kept.nc"), "what was there before\n");
}

TEST_F(DncConvertMotion, UsageErrors) {
  EXPECT_EQ(dnc({"convert", "part.h", "--to", "fanuc"}).status, 2);
  EXPECT_EQ(dnc({"convert", "part.h", "-o", "x", "--to", "fanuc", "--list"}).status, 2);
  EXPECT_EQ(dnc({"convert", "part.h", "-o", "x", "--to", "iso", "--name", "4"}).status, 2);
  EXPECT_EQ(dnc({"convert", "part.h", "-o", "x", "--to", "fanuc", "--to-setup", "none"}).status, 2);
  EXPECT_EQ(dnc({"convert", "none.h", "-o", "x", "--to", "fanuc"}).status, 2);
  EXPECT_EQ(dnc({"convert", "part.h", "-o", "x", "--to", "iso", "--keep-compensation"}).status, 2);
}

}  // namespace
}  // namespace dripline
