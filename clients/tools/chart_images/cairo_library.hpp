#pragma once

#include <cairo-pdf.h>
#include <cairo.h>

#include "protocol/base/result.hpp"

namespace dripline::chart_images {

/// The functions of libcairo that pictures need, without `cairo_`. The library is loaded with the
/// first picture: it brings seventeen others along, which cost 1.5 ms, a fifth of a start of `dnc`,
/// and nearly all commands draw nothing.
struct Cairo {
  decltype(&cairo_arc) arc = nullptr;
  decltype(&cairo_close_path) close_path = nullptr;
  decltype(&cairo_create) create = nullptr;
  decltype(&cairo_destroy) destroy = nullptr;
  decltype(&cairo_fill) fill = nullptr;
  decltype(&cairo_fill_preserve) fill_preserve = nullptr;
  decltype(&cairo_image_surface_create) image_surface_create = nullptr;
  decltype(&cairo_line_to) line_to = nullptr;
  decltype(&cairo_move_to) move_to = nullptr;
  decltype(&cairo_new_path) new_path = nullptr;
  decltype(&cairo_paint) paint = nullptr;
  decltype(&cairo_pdf_surface_create_for_stream) pdf_surface_create_for_stream = nullptr;
  decltype(&cairo_restore) restore = nullptr;
  decltype(&cairo_rotate) rotate = nullptr;
  decltype(&cairo_save) save = nullptr;
  decltype(&cairo_scale) scale = nullptr;
  decltype(&cairo_select_font_face) select_font_face = nullptr;
  decltype(&cairo_set_dash) set_dash = nullptr;
  decltype(&cairo_set_font_size) set_font_size = nullptr;
  decltype(&cairo_set_line_join) set_line_join = nullptr;
  decltype(&cairo_set_line_width) set_line_width = nullptr;
  decltype(&cairo_set_source_rgb) set_source_rgb = nullptr;
  decltype(&cairo_show_text) show_text = nullptr;
  decltype(&cairo_status) status = nullptr;
  decltype(&cairo_status_to_string) status_to_string = nullptr;
  decltype(&cairo_stroke) stroke = nullptr;
  decltype(&cairo_surface_destroy) surface_destroy = nullptr;
  decltype(&cairo_surface_finish) surface_finish = nullptr;
  decltype(&cairo_surface_status) surface_status = nullptr;
  decltype(&cairo_surface_write_to_png_stream) surface_write_to_png_stream = nullptr;
  decltype(&cairo_text_extents) text_extents = nullptr;
  decltype(&cairo_translate) translate = nullptr;
};

/// Stays loaded. Errors: Io (the library is missing, or one of its functions). Threads: any.
Result<const Cairo*> load_cairo();

}  // namespace dripline::chart_images
