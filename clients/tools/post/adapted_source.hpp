#pragma once

#include <optional>

#include "clients/tools/post/adaptation.hpp"
#include "clients/tools/post/operator_stage.hpp"

namespace dripline::post {

/// All that the events of a source pass before they are written or compared.
class AdaptedSource final : public interpreter::EventRelay<AdaptedSource> {
 public:
  AdaptedSource(interpreter::EventSink& out, const Grid& grid, const AdaptationOptions& options,
                const interpreter::Position& start)
      : adaptation_(out, grid, options, start) {
    if (grid.target().has_operator_axis)
      operator_.emplace(adaptation_, grid, options.passes_messages, start);
  }

  Adaptation& adaptation() { return adaptation_; }
  const std::optional<Refusal>& refusal() const {
    return operator_ && operator_->refusal() ? operator_->refusal() : adaptation_.refusal();
  }
  AdaptationCounts counts() const {
    AdaptationCounts counts = adaptation_.counts();
    if (!operator_) return counts;
    counts.messages -= operator_->instructions();
    counts.operator_actions = operator_->operator_actions();
    counts.assumed_tools = operator_->has_assumed_tool() ? 1 : 0;
    return counts;
  }

 private:
  friend EventRelay;
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    EventSink& front = operator_ ? static_cast<EventSink&>(*operator_) : adaptation_;
    (front.*deliver)(event);
  }

  Adaptation adaptation_;
  std::optional<OperatorStage> operator_;
};

}  // namespace dripline::post
