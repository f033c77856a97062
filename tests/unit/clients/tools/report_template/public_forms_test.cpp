// Templates for reports from outside the project: forms that the documents of public macro and post
// processor libraries and of a measuring instrument give, with values of our own. Each takes less
// than ten lines.
#include "tests/unit/clients/tools/report_template/reading.hpp"

namespace dripline::report_template {
namespace {

void expect_short(std::string_view toml) {
  EXPECT_LT(std::ranges::count(toml, '\n'), 10) << toml;
}

/// G800 nominal and normal, G801 measured, G802 deviation: how CAM posts let Fanuc-class controls
/// print points of a surface.
TEST(PublicForm, SurfacePoints) {
  const std::string_view toml = R"([[line]]
form = ["G800 N{p} X{nominal.X} Y{nominal.Y} Z{nominal.Z} I{i} J{j} K{k} O{o} U{u} L{l}", "G801 N{p} X{actual.X} Y{actual.Y} Z{actual.Z} R{r}"]
characteristic = "{characteristic}{p}"
tolerance = 0.05
[[line]]
pattern = 'START|END'
ignore = true
)";
  expect_short(toml);
  Reading reading(toml);
  reading.take("START");
  reading.take("G800 N1 X10.0000 Y20.0000 Z-5.0000 I0.000000 J0.000000 K1.000000 O0. U0.05 L-0.05");
  reading.take("G801 N1 X10.0000 Y20.0010 Z-4.9380 R3.0000");
  reading.take("END").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "X1=10.0000 good", "Y1=20.0010 good", "Z1=-4.9380 scrap", "] scrap"}));
}

/// Columns between bars, as a digital readout prints its tolerance report (HEIDENHAIN ND 1300,
/// addendum to the manual): status, feature, coefficient, actual, nominal, limits, picture.
TEST(PublicForm, ColumnsBetweenBars) {
  const std::string_view toml = R"([[line]]
form = "|{status}|{kind} {id} |{axis} |{actual} |{nominal} |{lower} |{upper} |{picture:text}|"
characteristic = "{kind}{id} {axis}"
)";
  expect_short(toml);
  Reading reading(toml);
  reading.take("|P|Cir 3  |r  | 12.0041 | 12.0000 | 11.9900 | 12.0100 |--+--|\r\n");
  reading.take("|F|Cir 4  |X  |-40.0210 |-40.0000 |-40.0200 |-39.9800 |+----|\r\n").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "Cir3 r=12.0041 good", "Cir4 X=-40.0210 scrap", "] scrap"}));
}

/// What a Grbl 1.1 board answers to a probe move, as its interface is documented.
TEST(PublicForm, GrblProbe) {
  const std::string_view toml = R"([[line]]
form = "[PRB:{actual.X},{actual.Y},{actual.Z}:1]"
characteristic = "{characteristic}{ordinal}"
[[line]]
form = "[PRB:{miss}:0]"
ignore = true
)";
  expect_short(toml);
  Reading reading(toml);
  reading.take("[PRB:0.000,0.000,-1.250:1]").take("[PRB:0.000,0.000,-9.000:0]");
  EXPECT_EQ(reading.brought,
            (Brought{"[", "X1=0.000 unknown", "Y1=0.000 unknown", "Z1=-1.250 unknown"}));
}

}  // namespace
}  // namespace dripline::report_template
