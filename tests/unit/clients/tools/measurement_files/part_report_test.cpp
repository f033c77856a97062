#include "clients/tools/measurement_files/part_report.hpp"

#include <gtest/gtest.h>

#include "tests/unit/clients/tools/measurement_files/sample.hpp"

namespace dripline::measurement_files {
namespace {

TEST(PartReport, HasAPageForEachWorkpieceWithItsVerdict) {
  CountingSource source(sample());
  const std::string html = written([&](const Sink& sink) {
    return write_part_report(source, {"Report <1>", "lathe-1"}, sink);
  });
  EXPECT_EQ(source.passes, 1);
  std::size_t sections = 0;
  for (auto at = html.find("<section>"); at != std::string::npos;
       at = html.find("<section>", at + 1))
    ++sections;
  EXPECT_EQ(sections, 2U);
  EXPECT_NE(html.find("<title>Report &lt;1&gt;</title>"), std::string::npos);
  EXPECT_NE(html.find("<dd class=\"rework\">rework</dd>"), std::string::npos);
  EXPECT_NE(html.find("<td>40.0125</td><td>+0.013</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("S-0007 &lt;&quot;"), std::string::npos);
  EXPECT_NE(html.find("@page"), std::string::npos);
  // Nothing from outside, no script.
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
}

TEST(PartReport, OfNothingIsAnError) {
  ListSource source({});
  EXPECT_EQ(written([&](const Sink& sink) { return write_part_report(source, {}, sink); }),
            "error: a report of no measurement");
}

}  // namespace
}  // namespace dripline::measurement_files
