// A conversion for a control that has not everything: rows HD-238 and HD-239.
#include <gtest/gtest.h>

#include "clients/tools/tnc_conversion/conversion.hpp"

namespace dripline::tnc_conversion {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

/// For the control that `options` describe; "" where the program converts.
std::string refusal(const std::string& text, Form form, const std::string& options) {
  const auto control = read_options(*parse_setup("[control]\n" + options));
  EXPECT_TRUE(control) << control.error().what;
  if (!control) return "no such control";
  const auto done = convert_program(text, form, conversion_options(*control));
  return done ? "" : done.error().what;
}
std::string plain(const std::string& blocks, const std::string& options, Form form = Form::Iso) {
  return refusal("0 BEGIN PGM 7 MM\n1 TOOL CALL 3 Z S 800\n" + blocks + "9 END PGM 7 MM\n", form,
                 options);
}
std::string iso(const std::string& blocks, const std::string& options) {
  return refusal("%7 G71 *\nN10 T3 G17 S800 *\n" + blocks + "N9999 %7 G71 *\n", Form::Plain,
                 options);
}

// HD-049, HD-238
TEST(Tnc155VersionConversion, MakesNoG38ForSoftwareThatDoesNotKnowIt) {
  EXPECT_EQ(plain("2 STOP M05\n", "software = 8"), "");
  EXPECT_EQ(plain("2 STOP M05\n", "software = 7"),
            "line 3: STOP is G38 in ISO: a TNC 155 A with software 07 has no G38 (from software "
            "08)");
  EXPECT_EQ(plain("2 STOP M05\n", "software = 7", Form::Plain), "");
  EXPECT_EQ(iso("N20 G38 *\n", "software = 7"),
            "line 3, column 1: ILLEGAL G-CODE: G38: a TNC 155 A with software 07 has no G38 (from "
            "software 08)");
}

// HD-238
TEST(Tnc155VersionConversion, RefusesWhatTheSoftwareHasNotInEitherForm) {
  const std::string no_probe =
      "a TNC 155 A with software 05 has no touch probe functions (from software 06)";
  EXPECT_EQ(
      plain("2 TCH PROBE 0.0 REF. PLANE Q5 Z-\n3 TCH PROBE 0.1 X+1 Y+1 Z-2\n", "software = 5"),
      "line 3, column 1: NOT SUPPORTED: TCH PROBE: " + no_probe);
  EXPECT_EQ(iso("N20 G55 P01 5 P02 Z- P03 G90 X+1 Y+1 Z-2 *\n", "software = 5"),
            "line 3, column 1: ILLEGAL G-CODE: G55: " + no_probe);
  EXPECT_EQ(iso("N20 G51 T4 *\n", "software = 1").substr(0, 36),
            "line 3, column 1: ILLEGAL G-CODE: G5");
  EXPECT_EQ(iso("N20 S9500 *\n", "software = 5").substr(0, 33),
            "line 3, column 1: WRONG RPM: S 95");
  EXPECT_EQ(plain("2 TOOL CALL S 9500\n", "software = 5").substr(0, 33),
            "line 3, column 1: WRONG RPM: S 95");
}

// HD-239
TEST(Tnc155VersionConversion, RefusesThreeAxesAndHelicesForEAndV) {
  const std::string line = "2 L X+1 Y+2 R0 F90\n3 L X+2 Y+3 Z+4\n";
  const std::string iso_line = "N20 G01 G40 G90 X+1 Y+2 F90 *\nN30 X+2 Y+3 Z+4 *\n";
  EXPECT_EQ(plain(line, "model = \"TNC 155 A\""), "");
  EXPECT_EQ(iso(iso_line, "model = \"TNC 155 A\""), "");
  const std::string no_lines =
      "NOT SUPPORTED: XYZ in one block: a TNC 155 V has no straight lines of three axes at once";
  EXPECT_EQ(plain(line, "model = \"TNC 155 V\""), "line 4, column 1: " + no_lines);
  EXPECT_EQ(iso(iso_line, "model = \"TNC 155 V\""), "line 4, column 1: " + no_lines);
  EXPECT_EQ(
      plain("2 CC X+0 Y+0\n3 L X+5 Y+0 R0 F90\n4 CP IPA+720 IZ+4 DR+\n", "model = \"TNC 151 E\""),
      "line 5, column 1: NOT SUPPORTED: an arc with Z: a TNC 151 E has no helices");
}

}  // namespace
}  // namespace dripline::tnc_conversion
