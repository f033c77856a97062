#include "gateway/interpreter/dialects/fanuc/tilting/tilt_rules.hpp"

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {

const Kinematics& FanucTiltRules::kinematics() const {
  return options_.kinematics;
}

bool FanucTiltRules::helix_feed_is_path() const {
  return options_.helix_feed_is_path;
}

bool FanucTiltRules::checks_travel() const {
  return options_.checks_stroke() || zone_.is_on;
}

std::string FanucTiltRules::travel_fault(const Position& from, const Position& to,
                                         Units units) const {
  const LengthDisplay display{.units = units, .x_is_diameter = options_.x_is_diameter};
  return stroke_fault(options_, zone_, {from, to, display});
}

}  // namespace dripline::interpreter::fanuc
