#include "clients/tools/charts/impl/frame.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dripline::charts {
namespace {

/// Cut at a character's beginning, not inside of its bytes.
std::string cut_to(std::string text, double width, double size) {
  if (text_width(text, size) <= width) return text;
  auto keep = static_cast<std::size_t>(std::max(1.0, width / text_width("x", size) - 1));
  while (keep > 0 && (static_cast<unsigned char>(text[keep]) & 0xC0U) == 0x80) --keep;
  return text.substr(0, keep) + "\xE2\x80\xA6";
}

/// Broken between words; what is still too long is cut.
std::vector<std::string> broken(const std::vector<std::string>& notes, double width, double size) {
  std::vector<std::string> lines;
  for (const std::string& note : notes) {
    std::string line;
    for (std::string_view left = note; !left.empty();) {
      const std::string_view word = left.substr(0, left.find(' '));
      left.remove_prefix(std::min(left.size(), word.size() + 1));
      const bool is_full =
          !line.empty() && text_width(line, size) + text_width(word, size) + size > width;
      if (is_full) lines.push_back(cut_to(std::exchange(line, {}), width, size));
      line += (line.empty() ? "" : " ") + std::string(word);
    }
    lines.push_back(cut_to(line, width, size));
  }
  return lines;
}

}  // namespace

Result<void> check_magnitude(std::string_view what, double value) {
  if (std::abs(value) <= kMaxMagnitude) return {};
  return fail(Errc::LimitExceeded, "{} is {:g}: a picture has numbers from {:g} to {:g}", what,
              value, -kMaxMagnitude, kMaxMagnitude);
}

double text_size_of(const Canvas& canvas) {
  return std::clamp(canvas.width() / 75, 9.0, 14.0);
}

Frame draw_frame(Canvas& canvas, const Caption& caption, const std::vector<std::string>& notes) {
  Frame frame;
  frame.text = text_size_of(canvas);
  const double margin = frame.text;
  const double title = frame.text * 1.35;
  const double width = canvas.width() - 2 * margin;
  double top = margin + title;
  // Bold letters are a little wider than the estimate's; the title has a tenth less room.
  canvas.text({margin, top}, cut_to(caption.title, width * 0.95, title),
              {title, Anchor::Start, true});
  if (!caption.subtitle.empty()) {
    top += frame.text * 1.5;
    canvas.text({margin, top}, cut_to(caption.subtitle, width, frame.text), {frame.text});
  }
  const double line = frame.text * 1.4;
  const std::vector<std::string> lines = broken(notes, width, frame.text);
  const double notes_top =
      canvas.height() - margin * 0.5 - line * static_cast<double>(lines.size());
  double y = notes_top;
  for (const std::string& note : lines) {
    y += line;
    canvas.text({margin, y - frame.text * 0.3}, note, {frame.text});
  }
  top += frame.text;
  frame.inside = {margin, top, width, std::max(40.0, notes_top - top)};
  return frame;
}

int tick_count(double length, double text, double per_tick) {
  return std::clamp(static_cast<int>(length / (text * per_tick)), 2, 12);
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + ", " + unit;
}

Plot plot_in(const Box& area, const Axis& x, const Axis& y, double text, double right, bool has_x) {
  const double left = left_margin(y, text);
  const double below = has_x ? 3.4 * text : 0.6 * text;
  return {{area.left + left, area.top, std::max(40.0, area.width - left - right),
           std::max(30.0, area.height - below)},
          x,
          y};
}

void include(double& low, double& high, double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

}  // namespace dripline::charts
