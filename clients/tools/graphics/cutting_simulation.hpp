#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "clients/tools/graphics/height_field.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::graphics {

/// The blank, and what is not known from the program.
struct SimulationSettings {
  /// Instead of the program's own blank; in machine coordinates (spindle axis: `spindle`).
  std::optional<Cuboid> blank;
  std::optional<interpreter::Axis> spindle;
  /// Radius of tools that neither the program nor the setup gives one; absent: their cuts are not
  /// shown.
  std::optional<Length> tool_radius;
  std::vector<interpreter::ToolRecord> tools;  ///< of the setup
  interpreter::Position start;
  std::size_t cells_along = 512;  ///< of the longer side
  /// Shown instead of the whole blank, as a part of it.
  std::optional<Cuboid> detail;
  /// Draws a helix too; TNC 155 leaves it out.
  bool shows_helices = false;
  /// Called now and then with the block that was just cut: for a progress bar.
  std::function<void(const interpreter::Origin&)> on_progress;
};

/// Why a part of a program is not in the picture.
enum class Omission : std::uint8_t {
  Helix,       ///< the control shows none
  RotaryAxis,  ///< a fourth axis moved
  NoTool,      ///< no tool was called, or it has no radius
  ToolAxis,    ///< the tool was called without an axis, or with another than the blank's
};
struct OmittedSection {
  interpreter::Origin origin;  ///< the first block of its kind
  Omission why = Omission::Helix;
  std::uint64_t moves = 0;
};

/// The axes of the work plane and the spindle's, in right-handed order.
struct WorkFrame {
  interpreter::Axis first = interpreter::Axis::X;
  interpreter::Axis second = interpreter::Axis::Y;
  interpreter::Axis along = interpreter::Axis::Z;
  static WorkFrame of(interpreter::Axis spindle);
  FramePoint point(const interpreter::Position& position) const;
};

/// Cuts the blank with what a program does: a sink for its events. One thread.
class CuttingSimulation final : public interpreter::EventSink {
 public:
  explicit CuttingSimulation(SimulationSettings settings);

  /// The part so far; absent before there is a blank.
  const std::optional<HeightField>& part() const { return part_; }
  const WorkFrame& frame() const { return frame_; }
  /// The whole blank, even when only a detail is shown.
  const std::optional<Cuboid>& blank() const { return blank_; }
  const std::vector<OmittedSection>& omitted() const { return omitted_; }
  /// A blank that cannot be: absent, or why.
  const std::optional<Error>& failure() const { return failure_; }
  std::uint64_t cuts() const { return cuts_; }

  void on_blank(const interpreter::Blank& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_warning(const interpreter::Warning& event) override;
  void on_block_end(const interpreter::Origin& event) override;

 private:
  void begin(const Cuboid& blank, interpreter::Axis spindle);
  void move(const interpreter::Origin& origin, const interpreter::Position& to);
  bool can_show(const interpreter::Origin& origin, const interpreter::Position& to);
  void omit(const interpreter::Origin& origin, Omission why);
  void cut(const FramePoint& from, const FramePoint& to);

  SimulationSettings settings_;
  WorkFrame frame_;
  std::optional<Cuboid> blank_;
  std::optional<HeightField> part_;
  std::optional<Error> failure_;
  std::optional<double> radius_;
  bool is_across_ = false;  ///< the tool called last is not along the blank's axis
  interpreter::Position at_;
  std::vector<OmittedSection> omitted_;  ///< at most one of each kind
  std::uint64_t cuts_ = 0;
};

}  // namespace dripline::graphics
