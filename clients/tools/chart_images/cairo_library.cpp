#include "clients/tools/chart_images/cairo_library.hpp"

#include <dlfcn.h>

namespace dripline::chart_images {
namespace {

/// Looks functions up by name and keeps the first error.
class Loader {
 public:
  Loader() : library_(dlopen("libcairo.so.2", RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) note_error();
  }

  template <class Function>
  void operator()(const char* name, Function*& function) {
    if (library_ == nullptr) return;
    function = reinterpret_cast<Function*>(dlsym(library_, name));
    if (function == nullptr) note_error();
  }

  const std::string& error() const { return error_; }

 private:
  void note_error() {
    const char* why = dlerror();
    if (error_.empty()) error_ = why != nullptr ? why : "libcairo.so.2 cannot be loaded";
  }

  void* library_;
  std::string error_;
};

Result<Cairo> load() {
  Loader find;
  Cairo cairo;
  find("cairo_arc", cairo.arc);
  find("cairo_close_path", cairo.close_path);
  find("cairo_create", cairo.create);
  find("cairo_destroy", cairo.destroy);
  find("cairo_fill", cairo.fill);
  find("cairo_fill_preserve", cairo.fill_preserve);
  find("cairo_image_surface_create", cairo.image_surface_create);
  find("cairo_line_to", cairo.line_to);
  find("cairo_move_to", cairo.move_to);
  find("cairo_new_path", cairo.new_path);
  find("cairo_paint", cairo.paint);
  find("cairo_pdf_surface_create_for_stream", cairo.pdf_surface_create_for_stream);
  find("cairo_restore", cairo.restore);
  find("cairo_rotate", cairo.rotate);
  find("cairo_save", cairo.save);
  find("cairo_scale", cairo.scale);
  find("cairo_select_font_face", cairo.select_font_face);
  find("cairo_set_dash", cairo.set_dash);
  find("cairo_set_font_size", cairo.set_font_size);
  find("cairo_set_line_join", cairo.set_line_join);
  find("cairo_set_line_width", cairo.set_line_width);
  find("cairo_set_source_rgb", cairo.set_source_rgb);
  find("cairo_show_text", cairo.show_text);
  find("cairo_status", cairo.status);
  find("cairo_status_to_string", cairo.status_to_string);
  find("cairo_stroke", cairo.stroke);
  find("cairo_surface_destroy", cairo.surface_destroy);
  find("cairo_surface_finish", cairo.surface_finish);
  find("cairo_surface_status", cairo.surface_status);
  find("cairo_surface_write_to_png_stream", cairo.surface_write_to_png_stream);
  find("cairo_text_extents", cairo.text_extents);
  find("cairo_translate", cairo.translate);
  if (!find.error().empty()) return fail(Errc::Io, "pictures need libcairo: {}", find.error());
  return cairo;
}

}  // namespace

Result<const Cairo*> load_cairo() {
  static const Result<Cairo> cairo = load();
  if (!cairo) return fail(cairo.error());
  return &*cairo;
}

}  // namespace dripline::chart_images
