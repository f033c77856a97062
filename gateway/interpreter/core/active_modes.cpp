#include "gateway/interpreter/core/active_modes.hpp"

namespace dripline::interpreter {

std::string_view hole_cycle_name(int g_code) {
  switch (g_code) {
    case 73:
      return "peck drill with short retracts";
    case 74:
      return "left tap";
    case 76:
      return "fine bore";
    case 81:
      return "drill";
    case 82:
      return "drill with dwell";
    case 83:
      return "peck drill";
    case 84:
      return "tap";
    case 85:
      return "bore";
    case 86:
      return "bore with spindle stop";
    case 87:
      return "back bore";
    case 88:
      return "bore with manual retract";
    case 89:
      return "bore with dwell";
    default:
      return {};
  }
}

}  // namespace dripline::interpreter
