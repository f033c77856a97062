#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// The choices of the miscellaneous screen and what each one posts.

struct PostedChoice {
  std::string_view name, posted;
};

inline constexpr auto kFeedModes =
    std::to_array<PostedChoice>({{"none", ""}, {"revolution", "G99"}, {"minute", "G98"}});
inline constexpr auto kSpindleModes =
    std::to_array<PostedChoice>({{"none", ""}, {"surface speed", "G96"}, {"rpm", "G97"}});
inline constexpr auto kGears =
    std::to_array<PostedChoice>({{"none", ""}, {"low", "M41"}, {"medium", "M42"}, {"high", "M43"}});
inline constexpr auto kSpindles =
    std::to_array<PostedChoice>({{"none", ""}, {"cw", "M3"}, {"ccw", "M4"}, {"off", "M5"}});
inline constexpr auto kCoolants =
    std::to_array<PostedChoice>({{"none", ""}, {"on", "M8"}, {"off", "M9"}});
inline constexpr auto kCompensations =
    std::to_array<PostedChoice>({{"none", ""}, {"left", "G41"}, {"right", "G42"}, {"off", "G40"}});
inline constexpr auto kStops =
    std::to_array<PostedChoice>({{"none", ""}, {"program", "M0"}, {"optional", "M1"}});
/// To the clearances (G45 Z, G46 X) or to the tool change position (G47 Z, G48 X).
inline constexpr auto kRetracts = std::to_array<PostedChoice>({{"none", ""},
                                                               {"z clear", "G45"},
                                                               {"x clear", "G46"},
                                                               {"z-x clear", "G45 G46"},
                                                               {"x-z clear", "G46 G45"},
                                                               {"z home", "G47"},
                                                               {"x home", "G48"},
                                                               {"z-x home", "G47 G48"},
                                                               {"x-z home", "G48 G47"}});
inline constexpr auto kCuttingModes =
    std::to_array<PostedChoice>({{"none", ""}, {"exact stop", "G61"}, {"continuous", "G64"}});
inline constexpr auto kProgramModes =
    std::to_array<PostedChoice>({{"none", ""}, {"absolute", "G93"}, {"incremental", "G91"}});
inline constexpr auto kWorkCoordinates = std::to_array<PostedChoice>({{"none", ""},
                                                                      {"1", "G54"},
                                                                      {"2", "G55"},
                                                                      {"3", "G56"},
                                                                      {"4", "G57"},
                                                                      {"5", "G58"},
                                                                      {"6", "G59"}});
inline constexpr auto kOptionalFunctions =
    std::to_array<PostedChoice>({{"none", ""},
                                 {"chuck in", "M21"},
                                 {"chuck out", "M22"},
                                 {"bar feed", "M23"},
                                 {"tailstock in", "M24"},
                                 {"tailstock out", "M25"},
                                 {"parts catcher in", "M26"},
                                 {"parts catcher out", "M27"},
                                 {"air blast on", "M28"},
                                 {"air blast off", "M29"},
                                 {"accessory 1", "M31"},
                                 {"accessory 2", "M32"},
                                 {"accessory 3", "M33"},
                                 {"accessory 4", "M34"},
                                 {"accessory 5", "M35"}});

template <std::size_t Size>
std::vector<std::string_view> names_of(const std::array<PostedChoice, Size>& choices) {
  std::vector<std::string_view> names;
  for (const auto& choice : choices) names.push_back(choice.name);
  return names;
}

template <std::size_t Size>
std::string_view posted(const std::array<PostedChoice, Size>& choices, std::size_t index) {
  return index < Size ? choices[index].posted : std::string_view();
}

}  // namespace dripline::conversational
