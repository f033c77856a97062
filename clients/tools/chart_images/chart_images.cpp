#include "clients/tools/chart_images/chart_images.hpp"

#include <memory>
#include <numbers>

#include "clients/tools/chart_images/cairo_library.hpp"
#include "clients/tools/charts/pictures.hpp"
#include "clients/tools/charts/text.hpp"

namespace dripline::chart_images {
namespace {

using charts::Anchor;
using charts::Color;
using charts::Dash;
using charts::Pen;
using charts::Point;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

class CairoCanvas final : public charts::Canvas {
 public:
  CairoCanvas(const Cairo& cairo, cairo_t* context, const Size& size)
      : cairo_(cairo), context_(context), size_(size) {
    cairo_.select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                            CAIRO_FONT_WEIGHT_NORMAL);
    set_color(charts::kWhite);
    cairo_.paint(context_);
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
    cairo_.close_path(context_);
    set_color(fill);
    cairo_.fill(context_);
  }
  void circle(Point center, double radius, Color fill, const Pen& pen) override {
    cairo_.new_path(context_);
    cairo_.arc(context_, center.x, center.y, radius, 0, 2 * std::numbers::pi);
    set_color(fill);
    cairo_.fill_preserve(context_);
    stroke(pen);
  }
  void text(Point at, std::string_view text, const charts::TextStyle& style) override {
    const std::string cleaned = charts::clean_text(text);
    cairo_.select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                            style.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_.set_font_size(context_, style.size);
    cairo_text_extents_t extents{};
    cairo_.text_extents(context_, cleaned.c_str(), &extents);
    const double part = style.anchor == Anchor::Start    ? 0
                        : style.anchor == Anchor::Middle ? 0.5
                                                         : 1;
    cairo_.save(context_);
    cairo_.translate(context_, at.x, at.y);
    if (style.is_upward) cairo_.rotate(context_, -std::numbers::pi / 2);
    cairo_.move_to(context_, -part * extents.x_advance, 0);
    set_color(style.color);
    cairo_.show_text(context_, cleaned.c_str());
    cairo_.restore(context_);
  }

 private:
  void set_color(Color color) {
    cairo_.set_source_rgb(context_, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
  }
  void path(std::span<const Point> points) {
    cairo_.new_path(context_);
    for (const Point& point : points) cairo_.line_to(context_, point.x, point.y);
  }
  void stroke(const Pen& pen) {
    constexpr double kDashed[]{6, 4}, kDotted[]{2, 3};
    cairo_.set_dash(context_, pen.dash == Dash::Dotted ? kDotted : kDashed,
                    pen.dash == Dash::Solid ? 0 : 2, 0);
    cairo_.set_line_width(context_, pen.width);
    cairo_.set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    set_color(pen.color);
    cairo_.stroke(context_);
  }

  const Cairo& cairo_;
  cairo_t* context_;
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

Result<void> check_status(const Cairo& cairo, cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return fail(Errc::Io, "cairo: {}", cairo.status_to_string(status));
}

/// Draws on the surface and reports what cairo noted meanwhile.
Result<void> draw_on(const Cairo& cairo, cairo_surface_t* surface, const Size& size, double scale,
                     const Drawing& draw) {
  const Context context(cairo.create(surface), cairo.destroy);
  cairo.scale(context.get(), scale, scale);
  CairoCanvas canvas(cairo, context.get(), size);
  if (auto drawn = draw(canvas); !drawn) return drawn;
  return check_status(cairo, cairo.status(context.get()));
}

}  // namespace

Result<std::string> draw_png(const Size& size, const Drawing& draw) {
  if (auto good = check_size(size); !good) return fail(good.error());
  const auto loaded = load_cairo();
  if (!loaded) return fail(loaded.error());
  const Cairo& cairo = **loaded;
  const Surface surface(
      cairo.image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(size.width * size.scale),
                                 static_cast<int>(size.height * size.scale)),
      cairo.surface_destroy);
  if (auto drawn = draw_on(cairo, surface.get(), size, size.scale, draw); !drawn)
    return fail(drawn.error());
  std::string png;
  const auto written = cairo.surface_write_to_png_stream(surface.get(), append, &png);
  if (auto good = check_status(cairo, written); !good) return fail(good.error());
  return png;
}

Result<std::string> draw_pdf(const Size& size, const Drawing& draw) {
  if (auto good = check_size(size); !good) return fail(good.error());
  const auto loaded = load_cairo();
  if (!loaded) return fail(loaded.error());
  const Cairo& cairo = **loaded;
  constexpr double kPointsPerUnit = 72.0 / 96;
  std::string pdf;
  const Surface surface(
      cairo.pdf_surface_create_for_stream(append, &pdf, size.width * kPointsPerUnit,
                                          size.height * kPointsPerUnit),
      cairo.surface_destroy);
  if (auto drawn = draw_on(cairo, surface.get(), size, kPointsPerUnit, draw); !drawn)
    return fail(drawn.error());
  cairo.surface_finish(surface.get());
  if (auto good = check_status(cairo, cairo.surface_status(surface.get())); !good)
    return fail(good.error());
  return pdf;
}

}  // namespace dripline::chart_images
