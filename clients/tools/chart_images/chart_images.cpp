#include "clients/tools/chart_images/chart_images.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <memory>
#include <numbers>

#include "clients/tools/charts/pictures.hpp"
#include "clients/tools/charts/text.hpp"

namespace dripline::chart_images {
namespace {

using charts::Anchor;
using charts::Color;
using charts::Dash;
using charts::Pen;
using charts::Point;

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using Context = std::unique_ptr<cairo_t, ContextDeleter>;

class CairoCanvas final : public charts::Canvas {
 public:
  CairoCanvas(cairo_t* context, const Size& size) : cairo_(context), size_(size) {
    cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    set_color(charts::kWhite);
    cairo_paint(cairo_);
  }

  double width() const override { return size_.width; }
  double height() const override { return size_.height; }

  void polyline(std::span<const Point> points, const Pen& pen) override {
    if (points.size() < 2) return;
    path(points);
    stroke(pen);
  }
  void polygon(std::span<const Point> points, Color fill) override {
    path(points);
    cairo_close_path(cairo_);
    set_color(fill);
    cairo_fill(cairo_);
  }
  void circle(Point center, double radius, Color fill, const Pen& pen) override {
    cairo_new_path(cairo_);
    cairo_arc(cairo_, center.x, center.y, radius, 0, 2 * std::numbers::pi);
    set_color(fill);
    cairo_fill_preserve(cairo_);
    stroke(pen);
  }
  void text(Point at, std::string_view text, const charts::TextStyle& style) override {
    const std::string cleaned = charts::clean_text(text);
    cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, style.size);
    cairo_text_extents_t extents{};
    cairo_text_extents(cairo_, cleaned.c_str(), &extents);
    const double part = style.anchor == Anchor::Start    ? 0
                        : style.anchor == Anchor::Middle ? 0.5
                                                         : 1;
    cairo_save(cairo_);
    cairo_translate(cairo_, at.x, at.y);
    if (style.is_upward) cairo_rotate(cairo_, -std::numbers::pi / 2);
    cairo_move_to(cairo_, -part * extents.x_advance, 0);
    set_color(style.color);
    cairo_show_text(cairo_, cleaned.c_str());
    cairo_restore(cairo_);
  }

 private:
  void set_color(Color color) {
    cairo_set_source_rgb(cairo_, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
  }
  void path(std::span<const Point> points) {
    cairo_new_path(cairo_);
    for (const Point& point : points) cairo_line_to(cairo_, point.x, point.y);
  }
  void stroke(const Pen& pen) {
    constexpr double kDashed[]{6, 4}, kDotted[]{2, 3};
    cairo_set_dash(cairo_, pen.dash == Dash::Dotted ? kDotted : kDashed,
                   pen.dash == Dash::Solid ? 0 : 2, 0);
    cairo_set_line_width(cairo_, pen.width);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    set_color(pen.color);
    cairo_stroke(cairo_);
  }

  cairo_t* cairo_;
  Size size_;
};

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

Result<void> check_size(const Size& size) {
  const double width = size.width * size.scale, height = size.height * size.scale;
  if (size.width >= charts::kMinWidth && size.height >= charts::kMinHeight && size.scale >= 0.25 &&
      width <= charts::kMaxSide && height <= charts::kMaxSide) {
    return {};
  }
  return fail(Errc::LimitExceeded,
              "a picture of {} x {}, {} times: {} x {} at least, {} pixels at most", size.width,
              size.height, size.scale, charts::kMinWidth, charts::kMinHeight, charts::kMaxSide);
}

Result<void> check_status(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return fail(Errc::Io, "cairo: {}", cairo_status_to_string(status));
}

/// Draws on the surface and reports what cairo noted meanwhile.
Result<void> draw_on(cairo_surface_t* surface, const Size& size, double scale,
                     const Drawing& draw) {
  const Context context(cairo_create(surface));
  cairo_scale(context.get(), scale, scale);
  CairoCanvas canvas(context.get(), size);
  if (auto drawn = draw(canvas); !drawn) return drawn;
  return check_status(cairo_status(context.get()));
}

}  // namespace

Result<std::string> draw_png(const Size& size, const Drawing& draw) {
  if (auto good = check_size(size); !good) return fail(good.error());
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                   static_cast<int>(size.width * size.scale),
                                                   static_cast<int>(size.height * size.scale)));
  if (auto drawn = draw_on(surface.get(), size, size.scale, draw); !drawn)
    return fail(drawn.error());
  std::string png;
  const auto written = cairo_surface_write_to_png_stream(surface.get(), append, &png);
  if (auto good = check_status(written); !good) return fail(good.error());
  return png;
}

Result<std::string> draw_pdf(const Size& size, const Drawing& draw) {
  if (auto good = check_size(size); !good) return fail(good.error());
  constexpr double kPointsPerUnit = 72.0 / 96;
  std::string pdf;
  const Surface surface(cairo_pdf_surface_create_for_stream(
      append, &pdf, size.width * kPointsPerUnit, size.height * kPointsPerUnit));
  if (auto drawn = draw_on(surface.get(), size, kPointsPerUnit, draw); !drawn)
    return fail(drawn.error());
  cairo_surface_finish(surface.get());
  if (auto good = check_status(cairo_surface_status(surface.get())); !good)
    return fail(good.error());
  return pdf;
}

}  // namespace dripline::chart_images
