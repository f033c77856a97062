#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "clients/tools/post/adaptation.hpp"

namespace dripline::post {

/// A program for a target whose Z, spindle and coolant are the operator's: what it does with them
/// becomes a wait for the operator and an instruction (a message), at the same place of the motion
/// of X and Y. The target waits by itself after each position and at both ends of a chain of cuts:
/// these waits are made here, too, so that a comparison with the target finds each wait that is
/// missing. Pure; between an interpreter and an Adaptation, which leaves repeated waits out.
class OperatorStage final : public interpreter::EventGate {
 public:
  /// `instructs`: instructions become messages.
  OperatorStage(interpreter::EventSink& out, const Grid& grid, bool instructs,
                const interpreter::Position& start)
      : EventGate(out), grid_(grid), instructs_(instructs), start_(start), at_(start) {}

  const std::optional<Refusal>& refusal() const { return refusal_; }
  std::uint64_t operator_actions() const { return operator_actions_; }
  std::uint64_t instructions() const { return instructions_; }
  /// The target asks for tool 1, which the program does not call.
  bool has_assumed_tool() const { return has_assumed_tool_; }

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_dwell(const interpreter::Dwell& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_end(const interpreter::End& event) override;

 private:
  /// What a move changes.
  struct Changes {
    bool moves_plane = false, moves_operator = false;
  };
  bool is_open() const override { return !refusal_; }
  const Target& target() const { return grid_.target(); }
  void refuse(const interpreter::Origin& origin, std::string what);
  Changes changes_of(const interpreter::Position& to) const;
  std::optional<Changes> check(const interpreter::Origin& origin, const interpreter::Position& to,
                               std::string_view what);
  interpreter::Position without_operator(interpreter::Position position) const;
  void wait(const interpreter::Origin& origin);
  void instruct(const interpreter::Origin& origin, const std::string& text);
  std::string place_text(const interpreter::Position& to) const;
  void begin_event(const interpreter::Origin& origin);
  void begin_cut(const interpreter::Origin& origin);

  Grid grid_;
  bool instructs_;
  interpreter::Position start_, at_;
  interpreter::Spindle spindle_;
  interpreter::Coolant coolant_;
  std::optional<int> tool_;  ///< called last
  bool has_begun_ = false;   ///< there is an event
  bool is_tool_pending_ = false, is_in_chain_ = false;
  std::uint64_t operator_actions_ = 0, instructions_ = 0;
  bool has_assumed_tool_ = false;
  std::optional<Refusal> refusal_;
};

}  // namespace dripline::post
