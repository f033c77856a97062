#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/names.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/codes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {

/// How far a line has come; a question suspends it between two.
enum class Stage : std::uint8_t { Start, Before, Input, Machine, Motion, After };

enum class Oword : std::uint8_t {
  None,
  Alone,  ///< only the label: where M98 jumps to
  Sub,
  EndSub,
  Call,
  Return,
  If,
  ElseIf,
  Else,
  EndIf,
  While,
  EndWhile,
  Do,
  Repeat,
  EndRepeat,
  Break,
  Continue,
};

/// A line that begins with an O word.
struct OwordHead {
  Oword word = Oword::None;
  Label label;
  const char* after = nullptr;  ///< of the word: operands follow
};

struct Setting {
  std::int32_t index = 0;  ///< of a numbered parameter, or -1 - NameId
  double value = 0;
};

/// One line while it is read and executed.
struct Block {
  static constexpr std::size_t kMaxSettings = 50;
  static constexpr int kNone = -1;

  void clear() {
    words.clear();
    stage = Stage::Start;
    g_groups = 0;
    m_groups = 0;
    m_count = 0;
    setting_count = 0;
    motion = kNone;
    axis_user = nullptr;
    comment_begin = comment_end = nullptr;
    words_taken = 0;
  }

  bool has(GGroup group) const { return (g_groups >> static_cast<unsigned>(group) & 1u) != 0; }
  bool has(MGroup group) const { return (m_groups >> static_cast<unsigned>(group) & 1u) != 0; }
  /// Tenths of the G code of the group, kNone where the line has none.
  int g(GGroup group) const {
    return has(group) ? g_codes[static_cast<std::size_t>(group)] : kNone;
  }
  int m(MGroup group) const {
    return has(group) ? m_codes[static_cast<std::size_t>(group)] : kNone;
  }

  Words words;
  Stage stage = Stage::Start;
  std::uint16_t g_groups = 0;
  std::uint8_t m_groups = 0;
  std::uint8_t m_count = 0;
  std::uint8_t setting_count = 0;
  int motion = kNone;               ///< decided for this line
  const GRow* axis_user = nullptr;  ///< the one-shot that takes the axis words
  AddressSet words_taken = 0;       ///< words that the codes of the line take
  std::array<std::int16_t, kGGroups> g_codes{};
  std::array<std::int16_t, kMGroups> m_codes{};
  const char* comment_begin = nullptr;  ///< text of the last comment
  const char* comment_end = nullptr;

  std::array<Setting, kMaxSettings> settings{};
};

}  // namespace dripline::interpreter::rs274ngc
