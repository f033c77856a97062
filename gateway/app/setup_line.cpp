#include "gateway/app/setup_line.hpp"

namespace dripline::gateway {

Result<wire::LineSettings> line_settings_of(const LineOptions& line,
                                            const interpreter::Options& control) {
  wire::LineSettings settings = line.settings;
  const bool is_named = line.changes.find("tnc_heading=") != std::string::npos;
  if (settings.flow != wire::Flow::HeidenhainBcc || is_named ||
      control.find("heading_letter") == nullptr) {
    return settings;
  }
  const auto letter = control.choice("heading_letter", {"%", "H"}, 0);
  if (!letter) return fail(letter.error());
  settings.heidenhain.heading = *letter == 0 ? '%' : 'H';
  return settings;
}

}  // namespace dripline::gateway
