// Numbers of a line that are for values of later lines, and which axes the line of a probe has.
#include <nlohmann/json.hpp>

#include "tests/unit/clients/tools/report_template/reading.hpp"

namespace dripline::report_template {
namespace {

constexpr std::string_view kNamed = R"([[line]]
form = "LIMITS X {lower.X} {upper.X} Z {lower.Z} {upper.Z}"
[[line]]
form = "{name} IS X {actual.X} Z {actual.Z}"
[[line]]
form = "Z AGAIN {actual.Z}"
)";

TEST(PendingLimits, AreForTheNextValueOfTheirName) {
  Reading reading(kNamed);
  reading.take("LIMITS X 1 2 Z 5 6").take("P IS X 1.5 Z 7");
  reading.take("Z AGAIN 7").take("LIMITS X 1 2 Z 7 8").take("Z AGAIN 7").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "X=1.5 good", "Z=7 scrap", "Z=7 unknown", "Z=7 good", "] scrap"}));
}

/// Of a state that was kept between two lines, also by a version that knew none.
TEST(PendingLimits, AreKept) {
  Reading reading(kNamed);
  reading.take("LIMITS X 1 2 Z 5 6");
  const std::string kept = to_json(reading.interpreter().state());
  const auto read = parse_state(kept);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(*read, reading.interpreter().state());
  ASSERT_EQ(read->pending_of.size(), 2U);
  EXPECT_EQ(read->pending_of.at("Z").upper, 6);
  auto old = nlohmann::json::parse(kept);
  old.erase("pending_of");
  const auto before = parse_state(old.dump());
  ASSERT_TRUE(before) << before.error().what;
  EXPECT_TRUE(before->pending_of.empty());
}

TEST(ProbeAxes, AreAllOrThoseThatMoved) {
  constexpr std::string_view kRecord =
      R"({"to":{"X":10,"Y":20,"Z":-98},"until":"contact","tripped":true,"at":{"X":10,"Y":20,"Z":-0.75}})";
  EXPECT_EQ(line_of_probe(kRecord), "PROBE contact X 10.000000 Y 20.000000 Z -0.750000");
  EXPECT_EQ(line_of_probe(kRecord, ProbeAxes::Moved), "PROBE contact Z -0.750000");
  constexpr std::string_view kAtItsEnd =
      R"({"to":{"X":10,"Z":-98},"until":"contact","tripped":true,"at":{"X":10,"Z":-98}})";
  EXPECT_EQ(line_of_probe(kAtItsEnd, ProbeAxes::Moved), "PROBE contact X 10.000000 Z -98.000000");
  constexpr std::string_view kMissed =
      R"({"to":{"X":10,"Z":-98},"until":"contact","tripped":false,"at":{"X":10,"Z":-97}})";
  EXPECT_EQ(line_of_probe(kMissed, ProbeAxes::Moved), "PROBE none X 10.000000 Z -97.000000");
  constexpr std::string_view kWithoutEnd = R"({"until":"contact","tripped":true,"at":{"X":10}})";
  EXPECT_EQ(line_of_probe(kWithoutEnd, ProbeAxes::Moved), "PROBE contact X 10.000000");
  EXPECT_EQ(line_of_probe("TOUCH 7", ProbeAxes::Moved), "TOUCH 7");
}

TEST(ProbeAxes, AreAKeyOfTheTemplate) {
  EXPECT_EQ(made("probe_axes = 'moved'\n[[line]]\nform = 'X'\nignore = true\n")->probe_axes,
            ProbeAxes::Moved);
  const auto wrong = read_template("probe_axes = 'some'\n[[line]]\nform = 'X'\nignore = true\n");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().what.find("line 1: probe_axes 'some' is none of all, moved"),
            std::string::npos)
      << wrong.error().what;
}

}  // namespace
}  // namespace dripline::report_template
