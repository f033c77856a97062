#include "clients/tools/measurement_files/part_report.hpp"

#include <gtest/gtest.h>

#include "clients/tools/measurement_files/text_files.hpp"
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

/// As the server judges a part: what has no limits does not spoil it. A part without any limits is
/// unknown.
TEST(PartReport, ValuesWithoutLimitsDoNotDecide) {
  auto all = sample();
  all.resize(2);
  all[0].verdict = measurement::Verdict::Good;
  all[1].characteristic.lower = all[1].characteristic.upper = std::nullopt;
  all[1].verdict = measurement::Verdict::Unknown;
  const auto report = [](const std::vector<measurement::Measurement>& of) {
    ListSource source(of);
    return written([&](const Sink& sink) { return write_part_report(source, {}, sink); });
  };
  EXPECT_NE(report(all).find("<dt>Verdict of these values</dt><dd class=\"good\">good</dd>"),
            std::string::npos);
  all.erase(all.begin());
  EXPECT_NE(report(all).find("<dd class=\"unknown\">unknown</dd>"), std::string::npos);
  EXPECT_NE(report(all).find("<dt>Measured</dt><dd>1 value</dd>"), std::string::npos);
}

TEST(PartReport, NamesAWorkpieceByWhatIsKnown) {
  measurement::Measurement one;
  const auto heading = [&one] {
    ListSource source({one});
    const std::string html =
        written([&](const Sink& sink) { return write_part_report(source, {}, sink); });
    const auto at = html.find("<h2>") + 4;
    return html.substr(at, html.find("</h2>") - at);
  };
  EXPECT_EQ(heading(), "Workpiece without a number");
  one.run = "3f9c0000aaaa";
  EXPECT_EQ(heading(), "Workpiece of run 3f9c0000");
  one.part_id = 17;
  EXPECT_EQ(heading(), "Workpiece 17");
  one.part = "P\x07<&";
  EXPECT_EQ(heading(), "Workpiece P\xEF\xBF\xBD&lt;&amp;");
  one.serial = "\"Ü\"";
  EXPECT_EQ(heading(), "Workpiece &quot;Ü&quot;");
  EXPECT_EQ(heading().find("1970"), std::string::npos);
}

TEST(PartReport, HasNoInfiniteNumbers) {
  measurement::Measurement one;
  one.characteristic = {"D", -1.7e308, -1.7e308, 1.7e308, "mm", 3};
  one.actual = 1.7e308;
  for (const auto write : {+[](MeasurementSource&source, const Sink&sink) {
                             return write_part_report(source, {}, sink);
                           },
                           write_csv}) {
    ListSource source({one});
    const std::string text = written([&](const Sink& sink) { return write(source, sink); });
    for (const char* word : {"inf", "nan"}) EXPECT_EQ(text.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace dripline::measurement_files
