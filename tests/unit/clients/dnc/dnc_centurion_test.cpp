#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"

/// Verbs for the Centurion control's own files.
namespace dripline {
namespace {

using test_support::Dnc;

class DncCenturion : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};
};

TEST_F(DncCenturion, ChartShowsTheIndexAndAPage) {  // CEN-230
  dnc.write("charts.dat",
            "            SHOP CHARTS\r\nTAPS.DAT    * Tapping\r\n..\\X.DAT    out\r\n");
  dnc.write("TAPS.DAT", "M6 5.0\nM8 6.8\n");
  EXPECT_EQ(dnc({"chart", "charts.dat"}).out, "     SHOP CHARTS\n  2  * Tapping\n  3  out\n");
  EXPECT_EQ(dnc({"chart", "charts.dat", "2"}).out, "M6 5.0\nM8 6.8\n");
  EXPECT_EQ(dnc({"chart", "charts.dat", "1"}).status, 2) << "no page after a heading";
  EXPECT_EQ(dnc({"chart", "charts.dat", "3"}).status, 2)
      << "a page does not lead out of the folder";
  EXPECT_EQ(dnc({"chart", "charts.dat", "9"}).status, 2);
}

TEST_F(DncCenturion, ExtractWritesEachProgramOnce) {  // CEN-202
  dnc.write("all.txt", "O12\nX1\nO7\nX2\nO12\nX3\n");
  EXPECT_EQ(dnc({"extract", "all.txt"}).status, 0);
  EXPECT_EQ(dnc.read("O0007"), "O7\nX2\n");
  EXPECT_EQ(dnc.read("O0012"), "O12\nX3\n") << "the later one stays";
  const auto again = dnc({"extract", "all.txt"});
  EXPECT_EQ(again.status, 1);
  EXPECT_NE(again.err.find("O0007"), std::string::npos) << again.err;
  EXPECT_EQ(dnc({"extract", "all.txt", "--replace"}).status, 0);
}

TEST_F(DncCenturion, ExtractNamesAFolderThatIsNotThere) {
  dnc.write("all.txt", "O12\nX1\n");
  const auto refused = dnc({"extract", "all.txt", "-o", "absent"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err, "dnc: absent: there is no such folder; make it first\n");
}

TEST_F(DncCenturion, ExtractWritesNothingOfATextThatDoesNotBeginWithANumber) {
  dnc.write("all.txt", "X9\nO12\nX1\n");
  EXPECT_EQ(dnc({"extract", "all.txt"}).status, 1);
  EXPECT_EQ(dnc.read("O0012"), "");
  dnc.write("none.txt", "X9\n");
  EXPECT_EQ(dnc({"extract", "none.txt"}).status, 1);
}

}  // namespace
}  // namespace dripline
