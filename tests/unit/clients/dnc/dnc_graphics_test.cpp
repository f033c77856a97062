#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

constexpr const char* kSlot =
    "%\nO1\nT1 M6\nG90 G21\nG0 X20. Y40.\nG1 Z-4. F100\nX80.\nG0 Z5.\nM30\n%\n";

class DncGraphics : public testing::Test {
 protected:
  DncGraphics() { dnc.write("slot.nc", kSlot); }
  template <class... More>
  auto graphics(More... more) {
    return dnc({"graphics", "--control", "fanuc", "slot.nc", "--tool-radius", "5", more...});
  }
  Dnc dnc{DNC_PATH};
};

TEST_F(DncGraphics, CutsAndDraws) {
  const auto result = graphics("--blank", "X0:100,Y0:80,Z-20:0", "-o", "slot.png", "--heights",
                               "slot.json", "--hardcopy", "slot.prn", "--json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto report = json::parse(result.out);
  EXPECT_EQ(report.at("blank").at("X"), json::parse("[0.0, 100.0]"));
  EXPECT_NEAR(report.at("removed_mm3").get<double>(), (600 + 78.54) * 4, 20);
  EXPECT_EQ(dnc.read("slot.png").substr(1, 3), "PNG");
  EXPECT_EQ(dnc.read("slot.prn").substr(0, 2), "\x1b\x43");
  const auto heights = json::parse(dnc.read("slot.json"));
  EXPECT_EQ(heights.at("heights").size(),
            heights.at("columns").get<std::size_t>() * heights.at("rows").get<std::size_t>());
}

TEST_F(DncGraphics, MagnifiesAPart) {
  const auto result = graphics("--blank", "X0:100,Y0:80,Z-20:0", "--magnify", "X40:60", "--json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(json::parse(result.out).at("removed_mm3").get<double>(), 20 * 10 * 4, 10);
}

TEST_F(DncGraphics, SaysWhatIsMissingOrWrong) {
  const auto no_blank = graphics("-o", "a.png");
  EXPECT_EQ(no_blank.status, 2);
  EXPECT_NE(no_blank.err.find("--blank"), std::string::npos) << no_blank.err;
  EXPECT_EQ(graphics("--blank", "X0:100,Y0:80").status, 2);
  EXPECT_EQ(graphics("--blank", "X100:0,Y0:80,Z-20:0").status, 2);
  const auto no_tool =
      dnc({"graphics", "--control", "fanuc", "slot.nc", "--blank", "X0:100,Y0:80,Z-20:0"});
  EXPECT_EQ(no_tool.status, 0);
  EXPECT_NE(no_tool.err.find("line 6"), std::string::npos) << no_tool.err;
}

TEST_F(DncGraphics, DrawsWhatWasCutBeforeAnAlarm) {
  dnc.write("bad.nc", "T1 M6\nG90 G21\nG0 X20. Y40.\nG1 Z-4. F100\nG999\n");
  const auto result = dnc({"graphics", "--control", "fanuc", "bad.nc", "--tool-radius", "5",
                           "--blank", "X0:100,Y0:80,Z-20:0", "--json"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NEAR(json::parse(result.out).at("removed_mm3").get<double>(), 78.54 * 4, 5);
}

/// HD-238, HD-239: what a TNC's model and software can show.
class DncTncGraphics : public testing::Test {
 protected:
  DncTncGraphics() {
    dnc.write("plate.h",
              "0 BEGIN PGM 1 MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 BLK FORM 0.2 X+100 Y+80 Z+0\n"
              "3 TOOL DEF 1 L+0 R+5\n4 TOOL CALL 1 Z S 100\n5 L X+20 Y+40 R0 F MAX\n"
              "6 L Z-4 R0 F100\n7 L X+80\n8 END PGM 1 MM\n");
  }
  template <class... More>
  auto graphics(const std::string& control, More... more) {
    dnc.write("mill.toml", "[control]\n" + control);
    return dnc({"graphics", "plate.h", "--setup", "mill.toml", "--size", "32", more...});
  }
  Dnc dnc{DNC_PATH};
};

TEST_F(DncTncGraphics, NameTheProgramThatIsAbsentBeforeTheBlankIs) {
  dnc.write("calls.h", "0 BEGIN PGM 2 MM\n1 CALL PGM 99\n2 END PGM 2 MM\n");
  const auto refused = dnc({"graphics", "--control", "tnc155", "calls.h", "-o", "a.png"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("99"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("line 2"), std::string::npos) << refused.err;
  EXPECT_EQ(refused.err.find("give one"), std::string::npos) << refused.err;
}

TEST_F(DncTncGraphics, AreThoseOfATnc155) {
  EXPECT_EQ(dnc({"graphics", "plate.h", "-o", "a.png", "--size", "32"}).status, 0);
  EXPECT_EQ(graphics("model = \"TNC 155 E\"\nsoftware = 1\n", "-o", "b.png").status, 0);
  const auto on_151 = graphics("model = \"TNC 151 A\"\n", "-o", "c.png");
  EXPECT_EQ(on_151.status, 2);
  EXPECT_NE(on_151.err.find("graphics: a TNC 151 A has no graphics"), std::string::npos)
      << on_151.err;
  EXPECT_EQ(dnc.read("c.png"), "");
}

TEST_F(DncTncGraphics, ArrangeThreePlanesAsInTheUsFromSoftware06) {
  const auto planes = [&](int software, const char* how) {
    return graphics("software = " + std::to_string(software) + "\n", "--view", "planes",
                    "--arrangement", how, "-o", "planes.png");
  };
  EXPECT_EQ(planes(5, "din").status, 0);
  EXPECT_EQ(planes(6, "us").status, 0);
  const auto refused = planes(5, "us");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--arrangement us: a TNC 155 A with software 05 has no US projection"),
            std::string::npos)
      << refused.err;
}

TEST_F(DncTncGraphics, ArePrintedFromSoftware03InTheDataBitsThatThereAre) {
  const auto print = [&](const std::string& control) {
    return graphics(control, "--hardcopy", "plate.prn");
  };
  EXPECT_NE(print("software = 2\n")
                .err.find("--hardcopy: a TNC 155 A with software 02 has no "
                          "hardcopy of its graphics (from software 03)"),
            std::string::npos);
  EXPECT_EQ(print("software = 8\n").status, 0);
  EXPECT_EQ(print("software = 7\nmachine_parameters = { MP222 = 169 }\n").status, 0);
  for (const char* seven_bits : {"", "machine_parameters = { MP222 = 168 }\n"}) {
    const auto refused = print(std::string("software = 7\n") + seven_bits);
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("MP222 must be 169 for it, in [control.machine_parameters] it is "
                               "168"),
              std::string::npos)
        << refused.err;
  }
}

// HD-199: the blank lies where the datum is, with or without a shift.
TEST(DncGraphicsOfATnc, CutsTheBlankWhereTheDatumIs) {
  Dnc dnc{DNC_PATH};
  const std::string blank = "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+100 Y+100 Z+0\n";
  const std::string slot =
      "TOOL DEF 1 L+0 R+5\nTOOL CALL 1 Z S1000\nL X+50 Y-20 Z+5 R0 F9999\nL Z-10 F500\nL "
      "Y+120\n";
  const auto program = [](const std::string& blocks) {
    return "BEGIN PGM 1 MM\n" + blocks + "END PGM 1 MM\n";
  };
  dnc.write("slot.h", program(blank + slot));
  dnc.write("shifted.h", program("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+30\n" + blank + slot));
  dnc.write("datum.toml", "[[offset]]\nname = \"datum\"\nX = 200\nZ = -7\n");
  for (const auto& [file, x] : {std::pair("slot.h", 200), std::pair("shifted.h", 230)}) {
    const auto result = dnc({"graphics", file, "--setup", "datum.toml", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto report = json::parse(result.out);
    EXPECT_EQ(report.at("blank").at("X"), json({x, x + 100}));
    EXPECT_EQ(report.at("blank").at("Z"), json({-27, -7}));
    EXPECT_NEAR(report.at("removed_mm3").get<double>(), 100 * 10 * 10, 250) << file;
  }
}

// HD-204
TEST(DncGraphicsOfATnc, ShowsNothingOfAToolAcrossTheBlank) {
  Dnc dnc{DNC_PATH};
  const auto cut = [&](const std::string& call) {
    dnc.write("slot.h",
              "BEGIN PGM 1 MM\nBLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+100 Y+100 Z+0\nTOOL DEF "
              "1 L+0 R+5\n" +
                  call + "L X+50 Y-20 Z+5 R0 F9999\nL Z-10 F500\nL Y+120\nEND PGM 1 MM\n");
    return dnc({"graphics", "slot.h"});
  };
  for (const char* call : {"TOOL CALL 1 Y S1000\n", "TOOL CALL 1 S1000\n", ""}) {
    const auto result = cut(call);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.out.starts_with("0 cuts, 0.0 cm3")) << call << result.out;
    EXPECT_NE(result.err.find("PGM-SECTION CANNOT BE SHOWN: line"), std::string::npos)
        << call << result.err;
  }
  EXPECT_TRUE(cut("TOOL CALL 1 Z S1000\n").out.starts_with("3 cuts"));
}

// HD-206: the control's own printer bytes, unless a printer is named.
TEST(DncGraphicsOfATnc, PrintsWithTheBytesOfTheMachineParameters) {
  Dnc dnc{DNC_PATH};
  dnc.write("block.h",
            "BEGIN PGM 1 MM\nBLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+100 Y+100 Z+0\n"
            "END PGM 1 MM\n");
  const auto print = [&](const std::string& parameters, const std::string& printer) {
    dnc.write("own.toml", "[control]\nmachine_parameters = { " + parameters + " }\n");
    std::vector<std::string> words{"graphics", "block.h",    "--setup",
                                   "own.toml", "--hardcopy", "block.prn"};
    if (!printer.empty()) words.insert(words.end(), {"--printer", printer});
    return dnc(words);
  };
  const std::string own =
      "MP226 = 602, MP227 = 23040, MP230 = 881, MP231 = 29299, MP222 = 169";  // 5A 5A, 71 72 73
  ASSERT_EQ(print(own, "").status, 0);
  EXPECT_EQ(dnc.read("block.prn").substr(0, 5), "ZZqrs");
  ASSERT_EQ(print("MP222 = 169 }\n[[control.user_parameters]]\nparameter = 226\nvalue = 602\n"
                  "[[control.user_parameters]]\nparameter = 227\nvalue = 23040\n#",
                  "")
                .status,
            0);
  EXPECT_EQ(dnc.read("block.prn").substr(0, 2), "ZZ") << "user parameters count as well";
  ASSERT_EQ(print(own, "epson").status, 0);
  EXPECT_EQ(dnc.read("block.prn").substr(0, 2), "\x1b\x43");
  ASSERT_EQ(print("MP222 = 169", "").status, 0);
  EXPECT_EQ(dnc.read("block.prn").substr(0, 2), "\x1b\x43");
  EXPECT_NE(print("MP226 = 2049", "").err.find("MP226: 8 bytes"), std::string::npos);
  EXPECT_NE(print("MP233 = 65536", "").err.find("MP233 = 65536: expected a whole number"),
            std::string::npos);
}

/// CEN-227: a lathe's program.
class DncTurning : public testing::Test {
 protected:
  DncTurning() {
    dnc.write("pin.nc",
              "O7\nG21 G98 F100\nP156=50\nP157=20\nT0101M6\nG0 X16 Z2\nG1 Z-30\nX22\nM30\n");
    dnc.write(
        "lathe.toml",
        "units = \"mm\"\n[[tool]]\nnumber = 1\ntip = 3\n[control]\nnegative_limit = { X = -1, "
        "Z = -60 }\npositive_limit = { X = 30, Z = 20 }\n");
  }
  template <class... More>
  auto graphics(More... more) {
    return dnc({"graphics", "--control", "centurion", "pin.nc", "--setup", "lathe.toml", more...});
  }
  Dnc dnc{DNC_PATH};
};

TEST_F(DncTurning, TurnsAndDraws) {
  const auto result =
      graphics("-o", "pin.png", "--heights", "pin.json", "--path", "--limits", "--zone", "--json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto report = json::parse(result.out);
  EXPECT_EQ(report.at("bar").at("Z"), json::parse("[-50.0, 0.0]"));
  EXPECT_EQ(report.at("bar").at("diameter"), json::parse("[0.0, 20.0]"));
  const double ring = 3.14159265 / 4 * (20 * 20 - 16 * 16) * 30;
  EXPECT_NEAR(report.at("removed_mm3").get<double>(), ring, 0.02 * ring);
  EXPECT_EQ(dnc.read("pin.png").substr(1, 3), "PNG");
  const auto contour = json::parse(dnc.read("pin.json"));
  EXPECT_NEAR(contour.at("outer_radius").back().get<double>(), 8, 0.1);
  EXPECT_NEAR(contour.at("outer_radius").front().get<double>(), 10, 0.1);
}

TEST_F(DncTurning, DrawsThePathsOfToolAndPart) {
  dnc.write("pin.nc",
            "O7\nG21 G98 F100\nP156=50\nP157=20\nT0101M6\nM3 S500\nG0 X22 Z2\n"
            "G71 P1 Q2 U1 W.5 D2 R1\nN1 G0 X10\nG1 Z-20\nX18 Z-30\nN2 X22\n"
            "G0 X8\nG1 G42 Z0\nX10 Z-1\nG40 X30\nM30\n");
  const auto drawn = [this](auto... options) {
    const auto result = graphics("--view", "path", "-o", "path.png", "--json", options...);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(json::parse(result.out).at("part_moves"), 6) << result.out;
    return dnc.read("path.png");
  };
  const std::string tool = drawn(), part = drawn("--part-path"),
                    both = drawn("--part-path", "--path");
  EXPECT_NE(tool, part);
  EXPECT_NE(both, part);
  EXPECT_NE(both, tool);
  EXPECT_NE(graphics("--part-path").out.find("6 pieces of the part path"), std::string::npos);
  dnc.write("mill.nc", "O1\nG21 G98 F100\nG0 X16. Z2.\nG1 Z-30.\nM30\n");
  const auto other = dnc({"graphics", "--control", "fanuc-t", "mill.nc", "--part-path"});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("only a Centurion"), std::string::npos) << other.err;
}

TEST_F(DncTurning, TakesAnotherBarAndWindow) {
  const auto result =
      graphics("--blank", "X10:30,Z-40:1", "--magnify", "X0:32,Z-20:2", "-o", "tube.png", "--json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(json::parse(result.out).at("bar").at("diameter"), json::parse("[10.0, 30.0]"));
}

TEST_F(DncTurning, SaysWhatIsMissingOrWrong) {
  EXPECT_EQ(graphics("--view", "plan").status, 2);
  EXPECT_EQ(graphics("--blank", "X0:30").status, 2);
  EXPECT_EQ(graphics("--tool-width", "3").status, 2);
  dnc.write("pin.nc", "G21 G98 F100\nG0 X16 Z2\nG1 Z-30\nM30\n");
  const auto no_bar = graphics("-o", "a.png");
  EXPECT_EQ(no_bar.status, 2);
  EXPECT_NE(no_bar.err.find("--blank"), std::string::npos) << no_bar.err;
  EXPECT_EQ(graphics("--view", "path", "-o", "a.png").status, 0);
}

}  // namespace
}  // namespace dripline
