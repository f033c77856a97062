#include <fmt/core.h>
#include <algorithm>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"

/// What the cycles that change coordinates need on the later controls.
namespace dripline::interpreter::tnc155::itnc {

/// Cycle 247: a row of the preset table becomes the datum, and the transformations of the program
/// end (iTNC 530, User's Manual Cycles: datum setting).
bool use_preset(Run& run, int number) {
  const auto& presets = run.options.presets;
  const auto at = std::ranges::find_if(
      presets, [=](const ControlOptions::Preset& preset) { return preset.number == number; });
  if (at == presets.end()) {
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("CYCL DEF 247: the setup has no offset preset{}", number));
  }
  if (run.tilted.is_on())
    return run.fail(ErrorCode::TiltFailed, "CYCL DEF 247 before PLANE RESET or M129");
  if (run.state.is_compensating()) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted, "CYCL DEF 247 within a contour");
  }
  end_contour(run, false);
  Transformation changed = run.state.transformation;
  changed.cancel_cycles();
  changed.datum = values_of(at->datum);
  change_transformation(run, changed);
  return true;
}

bool check_order(Run& run, const Block& block) {
  if (!check_tilted_transformation(run, block)) return false;
  const Transformation& now = run.state.transformation;
  const bool is_mirrored = std::ranges::any_of(now.mirrored, [](bool is) { return is; });
  std::string_view before;
  if (now.rotation != 0) before = "a rotation";
  if (is_mirrored) before = "a mirror image";
  if (now.scale != 1 && block.cycle == 7) before = "a scaling";
  bool changes = false;
  if (block.cycle == 7) {
    for (const Coordinate& word : block.words()) changes |= run.number(word.value) != 0;
  } else if (block.cycle == 8) {
    changes = block.coordinate_count != 0 && !is_mirrored;
  } else if (block.cycle == 10) {
    changes = is_mirrored && run.number(block.angle) != 0;
  }
  if (!changes || before.empty()) return true;
  return run.fail(ErrorCode::NotSupported,
                  fmt::format("CYCL DEF {} after {}: which comes first is not known; end it before",
                              block.cycle, before));
}

}  // namespace dripline::interpreter::tnc155::itnc
