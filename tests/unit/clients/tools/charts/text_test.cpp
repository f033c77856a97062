#include "clients/tools/charts/text.hpp"

#include <gtest/gtest.h>

#include "clients/tools/charts/svg_canvas.hpp"

namespace dripline::charts {
namespace {

TEST(XmlText, KeepsWhatIsTextAndReplacesTheRest) {
  EXPECT_EQ(xml_text("\xC3\x98 40 <H7> & \"x\""), "\xC3\x98 40 &lt;H7&gt; &amp; &quot;x&quot;");
  EXPECT_EQ(clean_text("a\x01"
                       "b"),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(clean_text("\xFF\xC3"), "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(clean_text("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(clean_text("\xF0\x9F\x94\xA7"), "\xF0\x9F\x94\xA7");
}

TEST(SvgCanvas, WritesNothingThatATextSmuggledIn) {
  SvgCanvas canvas(400, 300, "<script>alert(1)</script>");
  canvas.text({10, 10}, "</text><script>x</script>", {});
  canvas.line({0, 0}, {10.5, -0.001}, {kLimit, 1.5, Dash::Dashed});
  const std::string svg = std::move(canvas).finish();
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(svg.find("points=\"0,0 10.5,0\""), std::string::npos);
  EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos);
  EXPECT_TRUE(
      svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400\" height=\"300\""));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

}  // namespace
}  // namespace dripline::charts
