#include "clients/tools/chart_images/chart_images.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <string>

namespace dripline::chart_images {
namespace {

bool is_cairo_loaded() {
  void* library = dlopen("libcairo.so.2", RTLD_LAZY | RTLD_NOLOAD);
  if (library == nullptr) return false;
  dlclose(library);
  return true;
}
const bool kIsLoadedAtStart = is_cairo_loaded();

Result<void> draw_something(charts::Canvas& canvas) {
  canvas.text({20, 40}, "\xC3\x98 40 H7 \xFF", {14, charts::Anchor::Start, true});
  canvas.circle({100, 100}, 5, charts::kData, {});
  canvas.line({0, 0}, {100, 50}, {charts::kLimit, 1, charts::Dash::Dotted});
  return {};
}

unsigned big_endian(const std::string& bytes, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

TEST(ChartImages, PngHasTheScaledSize) {
  const auto png = draw_png({400, 300, 2}, draw_something);
  ASSERT_TRUE(png) << png.error().what;
  EXPECT_TRUE(png->starts_with("\x89PNG"));
  EXPECT_EQ(big_endian(*png, 16), 800U);
  EXPECT_EQ(big_endian(*png, 20), 600U);
}

TEST(ChartImages, LoadCairoWithTheFirstPicture) {
  EXPECT_FALSE(kIsLoadedAtStart);
  ASSERT_TRUE(draw_png({400, 300, 1}, draw_something));
  EXPECT_TRUE(is_cairo_loaded());
}

TEST(ChartImages, PdfIsOne) {
  const auto pdf = draw_pdf({400, 300, 1}, draw_something);
  ASSERT_TRUE(pdf) << pdf.error().what;
  EXPECT_TRUE(pdf->starts_with("%PDF-"));
}

TEST(ChartImages, PassErrorsOnAndRefuseSizes) {
  const auto failing = [](charts::Canvas&) -> Result<void> { return fail(Errc::Conflict, "no"); };
  const auto refused = draw_png({400, 300, 1}, failing);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "no");
  EXPECT_FALSE(draw_png({100, 300, 1}, draw_something));
  EXPECT_FALSE(draw_png({4000, 3000, 4}, draw_something));
  EXPECT_FALSE(draw_png({400, 300, 0}, draw_something));
}

}  // namespace
}  // namespace dripline::chart_images
