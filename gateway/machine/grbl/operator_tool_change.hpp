#pragma once

#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::machine::grbl {

/// A board changes no tools: a tool change for which the program itself does not wait gets a stop,
/// before the next motion and at the latest at the end of its block, with the spindle switched off
/// meanwhile. Pure.
class OperatorToolChange final : public interpreter::EventFilter {
 public:
  using EventFilter::EventFilter;
  void begin();
  /// The last moment to change a tool. For a probe move, which is no event.
  void before_motion(const interpreter::Origin& origin);

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_block_end(const interpreter::Origin& origin) override;

 private:
  /// Without a number it is not known which tool the stop was for.
  bool has_stopped_for_tool() const { return has_stopped_ && tool_ && stopped_for_ == tool_; }
  void want_tool() { wants_tool_ = !has_stopped_for_tool(); }
  void stop_for_tool(const interpreter::Origin& origin);
  void turn_off(const interpreter::Origin& origin);

  interpreter::Spindle spindle_;    ///< as commanded last
  std::optional<int> tool_;         ///< that the program has changed to
  bool wants_tool_ = false;         ///< the operator must change it before the axes move
  bool has_stopped_ = false;        ///< since the last motion: there was time for it
  std::optional<int> stopped_for_;  ///< the tool of that stop
};

}  // namespace dripline::machine::grbl
