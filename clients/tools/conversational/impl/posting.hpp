#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "clients/tools/conversational/events.hpp"
#include "clients/tools/conversational/post.hpp"

namespace dripline::conversational {

/// One block of program text, word by word. Blank entries post nothing.
class BlockText {
 public:
  BlockText() = default;
  explicit BlockText(std::string_view first) { code(first); }
  /// A word or several, copied.
  BlockText& code(std::string_view text);
  BlockText& word(std::string_view letters, const Entry& value);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The program while it grows, and what later events need of earlier ones.
class Posting {
 public:
  explicit Posting(const PostOptions& options) : options_(options) {}

  /// Appends the block, unless it is empty.
  void block(const BlockText& block);
  void block(std::string_view text) { block(BlockText(text)); }
  /// `Pn = value`, unless blank.
  void parameter(int number, const Entry& value);
  void parameter(int number, std::string_view expression);
  /// The clearances return to the start point of a cycle.
  void clearances(const Entry& start_x, const Entry& start_z);

  /// The motion code of the geometry posted just before, empty when it was something else.
  std::string_view motion() const { return motion_; }
  void set_motion(std::string_view code) { motion_ = code; }

  const PostOptions& options() const { return options_; }
  std::string take() { return std::move(text_); }

  std::optional<int> pattern;  ///< being described

 private:
  const PostOptions& options_;
  std::string text_;
  std::string_view motion_;  ///< a literal
};

/// `G40`, `G41` or `G42`.
std::string_view code_of(Compensation compensation);

void post(Posting& out, const ProgramSetup& event);
void post(Posting& out, const Position& event);
void post(Posting& out, const Line& event);
void post(Posting& out, const Arc& event);
void post(Posting& out, const Tangents& event);
void post(Posting& out, const ThreePointArc& event);
void post(Posting& out, const ThreadLine& event);
void post(Posting& out, const RoughCycle& event);
void post(Posting& out, const PatternRepeat& event);
void post(Posting& out, const EndCycle& event);
void post(Posting& out, const FinishCycle& event);
void post(Posting& out, const SingleCut& event);
void post(Posting& out, const SingleThread& event);
void post(Posting& out, const MultipleThread& event);
void post(Posting& out, const DrillCycle& event);
void post(Posting& out, const TapCycle& event);
void post(Posting& out, const GrooveCycle& event);
void post(Posting& out, const ToolSelection& event);
void post(Posting& out, const Miscellaneous& event);
void post(Posting& out, const ProgramCall& event);
void post(Posting& out, const Scaling& event);
void post(Posting& out, const Rotation& event);
void post(Posting& out, const Mirror& event);
void post(Posting& out, const FloatingZero& event);
void post(Posting& out, const EndOfProgram& event);

/// `BACK C0 W30`: the end of a line's block.
void add_extend_back(BlockText& block, const ExtendBack& back);

}  // namespace dripline::conversational
