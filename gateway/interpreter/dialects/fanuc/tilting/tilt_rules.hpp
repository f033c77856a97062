#pragma once

#include "gateway/interpreter/stages/tilting/tilted_path.hpp"

namespace dripline::interpreter::fanuc {

// NOLINTNEXTLINE(google-build-using-namespace): points, rotations and kinematics are the stage's
using namespace tilting;

struct ControlOptions;
struct StrokeZone;

/// The stroke limits and the meaning of F for the stage of tilted planes.
class FanucTiltRules final : public TiltRules {
 public:
  FanucTiltRules(const ControlOptions& options, const StrokeZone& zone)
      : options_(options), zone_(zone) {}

  const Kinematics& kinematics() const override;
  bool sets_axis_feeds() const override { return true; }
  bool helix_feed_is_path() const override;
  bool checks_travel() const override;
  std::string travel_fault(const Position& from, const Position& to, Units units) const override;

 private:
  const ControlOptions& options_;
  const StrokeZone& zone_;
};

}  // namespace dripline::interpreter::fanuc
