#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dripline::integration {

/// A method of feeding a control over a line: the server's ports and a gateway beside the control
/// have to do the same.
struct Protocol {
  const char* name;
  std::vector<std::string> settings;
  const char* request = "";  ///< what the control asks for; nothing: it is fed unasked
  bool prints_back = true;
};

inline auto every_protocol() {
  return testing::Values(
      Protocol{"xonxoff", {"flow=xonxoff"}}, Protocol{"rtscts", {"flow=rtscts"}},
      Protocol{"none", {"flow=none", "line_delay_ms=2"}},
      Protocol{"dc_codes", {"flow=dc_codes", "start_char=%", "end_char=%"}, "next"},
      Protocol{"xmodem", {"flow=xmodem", "control=plain"}, "", false},
      Protocol{"heidenhain", {"flow=heidenhain", "control=plain"}, "next"},
      Protocol{"heidenhain_bcc", {"flow=heidenhain_bcc", "control=plain"}, "77"});
}

}  // namespace dripline::integration
