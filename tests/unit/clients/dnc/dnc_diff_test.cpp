// `dnc diff`: two programs by text, in normal form and by motion.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"

namespace dripline {
namespace {

using nlohmann::json;

constexpr const char* kNgc =
    "G21 G90 G94 G17\nT1 M6\nS1000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX10\nG3 X20 Y10 I0 J10\nM2\n";

class DncDiff : public testing::Test {
 protected:
  DncDiff() { dnc.write("a.ngc", kNgc); }
  /// The program with one text replaced, as b.ngc.
  void change(std::string_view from, std::string_view to) {
    std::string text = kNgc;
    text.replace(text.find(from), from.size(), to);
    dnc.write("b.ngc", text);
  }
  test_support::DncResult diff(std::vector<std::string> options) const {
    options.insert(options.begin(), {"diff", "--control", "rs274ngc"});
    options.insert(options.end(), {"a.ngc", "b.ngc"});
    return dnc(options);
  }
  test_support::Dnc dnc{DNC_PATH};
};

TEST_F(DncDiff, TheSameTextIsSilence) {
  dnc.write("b.ngc", kNgc);
  const auto same = diff({});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_EQ(same.out, "");
}

TEST_F(DncDiff, ListsChangedLinesWithTheirContext) {
  change("X10\n", "X11\n");
  const auto different = diff({"--unified", "1"});
  EXPECT_EQ(different.status, 1) << different.err;
  EXPECT_EQ(different.out,
            "--- a.ngc\n+++ b.ngc\n@@ -5,3 +5,3 @@ other\n G1 Z-1 F100\n-X10\n+X11\n"
            " G3 X20 Y10 I0 J10\n1 place: 1 line removed, 1 added\nclass: other\n");
}

TEST_F(DncDiff, WithoutAKnownControlTheTextIsComparedAlone) {
  dnc.write("a.txt", "hello\n");
  dnc.write("b.txt", "world\n");
  EXPECT_EQ(dnc({"diff", "a.txt", "b.txt"}).status, 1);
  EXPECT_EQ(dnc({"diff", "--motion", "a.txt", "b.txt"}).status, 2);
  EXPECT_EQ(dnc({"diff", "a.txt", "none.txt"}).status, 2);
}

TEST_F(DncDiff, NormalizedIgnoresHowItIsWritten) {
  change("G1 Z-1 F100", "n5 g01 z-1.0 f100.00 (down)");
  EXPECT_EQ(diff({"--normalized"}).status, 0);
  EXPECT_EQ(diff({}).status, 1);
}

TEST_F(DncDiff, ByMotionNamesThePlacesWithBothLines) {
  change("G0 X0 Y0 Z5", "(above)\nG0 X0 Y0 Z5.5");
  const auto different = diff({"--motion"});
  EXPECT_EQ(different.status, 1) << different.err;
  EXPECT_NE(different.out.find("path: 0.5000 mm apart\n  a.ngc:4: G0 X0 Y0 Z5\n"
                               "      rapid to X0 Y0 Z5\n  b.ngc:5: G0 X0 Y0 Z5.5\n"),
            std::string::npos)
      << different.out;
  EXPECT_TRUE(different.out.ends_with("class: geometry\n")) << different.out;
}

TEST_F(DncDiff, ByMotionOtherTextOfTheSameMovesIsTheSame) {
  change("X10\nG3 X20 Y10 I0 J10", "G91 X10\nG90 G3 X20 Y10 R10");
  const auto same = diff({"--motion"});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_TRUE(same.out.starts_with("same motion: ")) << same.out;
  EXPECT_TRUE(same.out.ends_with("class: same motion\n")) << same.out;
}

TEST_F(DncDiff, ByMotionAsJsonHasTheClassOfTheEdit) {
  const auto class_of = [this](std::string_view from, std::string_view to) {
    change(from, to);
    return json::parse(diff({"--motion", "--json"}).out).at("class").get<std::string>();
  };
  EXPECT_EQ(class_of("G21", "G21"), "none");
  EXPECT_EQ(class_of("M2\n", "M2 (end)\n"), "comment");
  EXPECT_EQ(class_of("F100", "F120"), "feed_and_speed");
  EXPECT_EQ(class_of("S1000", "S900"), "feed_and_speed");
  EXPECT_EQ(class_of("S1000 M3", "S900 M3\nG10 L2 P1 X1"), "offsets");
  EXPECT_EQ(class_of("G94 G17", "G94 G17 G55"), "offsets");
  EXPECT_EQ(class_of("Z-1", "Z-2"), "geometry");
  EXPECT_EQ(class_of("M2", "M8\nM2"), "other");
}

TEST_F(DncDiff, WhatDependsOnTheMachineIsNotTheSame) {
  change("M2", "(at the end)\nM2");
  EXPECT_EQ(diff({"--motion"}).status, 0);
  dnc.write("a.ngc", std::string("G0 X#500\n") + kNgc);
  dnc.write("b.ngc", std::string("G0  X#500\n") + kNgc);
  const auto depends = diff({"--motion"});
  EXPECT_EQ(depends.status, 1);
  EXPECT_TRUE(depends.out.starts_with(
      "condition: a.ngc:1: the value may come from outside: #500: G0 X#500\n"))
      << depends.out;
}

TEST_F(DncDiff, HoldsAcrossControls) {
  dnc.write("a.h",
            "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+0\n2 TOOL CALL 1 Z S1000\n"
            "3 L X+0 Y+0 Z+5 R0 FMAX M3\n4 L Z-1 R0 F100\n5 L X+10\n6 END PGM 1 MM\n");
  dnc.write("b.ngc", "G21 G90 G94\nT1 M6\nS1000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX10\nM2\n");
  const auto across = dnc({"diff", "--motion", "a.h", "b.ngc", "--second-control", "rs274ngc"});
  EXPECT_NE(across.out.find("two controls"), std::string::npos) << across.out << across.err;
}

TEST_F(DncDiff, ATextOfAnotherControlThanSaidIsAnErrorOfUse) {
  EXPECT_EQ(dnc({"diff", "--control", "none", "a.ngc", "a.ngc"}).status, 2);
  EXPECT_EQ(dnc({"diff", "--motion", "--normalized", "a.ngc", "a.ngc"}).status, 2);
}

/// Two revisions, compared by the server.
class DncProgramDiff : public testing::Test {
 protected:
  DncProgramDiff() {
    dnc.environment["DRIPLINE_SERVER"] = server.url();
    dnc.environment["DRIPLINE_TOKEN"] = test_support::FakeServer::kToken;
  }
  static json answer() {
    return json::parse(R"json({"by":"text","same":false,"class":"comment","machine":null,
        "first":{"program":"O1","revision":3,"control":"fanuc"},
        "second":{"program":"O1","revision":4,"control":"fanuc"},
        "text":{"same":false,"change":"comment","hunk_count":1,"removed":1,"added":1,"complete":true,
          "hunks":[{"change":"comment","before":["O1"],"after":[],
            "first":{"line":2,"count":1,"lines":["M30 (A)"]},
            "second":{"line":2,"count":1,"lines":["M30\u001b[2J"]}}]}})json");
  }
  test_support::FakeServer server;
  test_support::Dnc dnc{DNC_PATH};
};

TEST_F(DncProgramDiff, ListsWhatTheServerHasFound) {
  server.set_answer("GET /api/v1/programs/O1/comparison", answer());
  const auto different = dnc({"program", "diff", "O1@3", "O1@4"});
  EXPECT_EQ(different.status, 1) << different.err;
  EXPECT_EQ(different.out,
            "--- O1@3\n+++ O1@4\n@@ -1,2 +1,2 @@ comment\n O1\n-M30 (A)\n+M30 [2J\n"
            "1 place: 1 line removed, 1 added\nclass: comment\n");
  json same = answer();
  same["same"] = same["text"]["same"] = true;
  server.set_answer("GET /api/v1/programs/O1/comparison", same);
  EXPECT_EQ(dnc({"program", "diff", "O1@3", "--json"}).status, 0);
}

TEST_F(DncProgramDiff, OneIsForProgramsThatDifferAlone) {
  EXPECT_EQ(dnc({"program", "diff", "O9", "O9@2"}).status, 2);  // not found
  server.set_answer("GET /api/v1/programs/O1/comparison", json{{"by", "text"}});
  const auto odd = dnc({"program", "diff", "O1"});
  EXPECT_EQ(odd.status, 3);
  EXPECT_NE(odd.err.find("not as expected"), std::string::npos) << odd.err;
}

}  // namespace
}  // namespace dripline
