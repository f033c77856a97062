#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "gateway/interpreter/dialects/centurion/codes/g_codes.hpp"
#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/dialects/centurion/reading/words.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"

namespace dripline::interpreter::centurion {

/// How far a block has been executed; a question suspends it between or within stages.
enum class Stage : std::uint8_t {
  Start,
  Items,
  Execution,
  BeforeMove,
  Move,
  AfterMove,
  PostMove,
  Flow
};

/// What follows the block, other than the next one.
enum class Ending : std::uint8_t { None, Return, Wend, OperatorEnd, EndOfProgram };

/// What calls a program with arguments; M6 gives none.
enum class MacroCaller : std::uint8_t { G65, CustomCode, M6 };

struct TextRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  bool empty() const { return begin == end; }
};

/// `,R` `,C` and BACK, in program units.
struct CornerWords {
  struct Back {
    double slope = 0;  ///< degrees
    blending::Back which = blending::Back::Nearest;
  };
  std::optional<double> round, chamfer;
  std::optional<Back> back;
  std::uint32_t column = 0;
};

/// One block while it is read and executed. Values are kept, text is not: ranges are offsets within
/// the block.
struct Block {
  static constexpr std::size_t kMaxCodes = 16;

  struct Parts {
    Stage stage = Stage::Start;
    Ending ending = Ending::None;
    bool has_code = false;
    bool is_assignment_only = true;  ///< nothing but parameters set: legal as data after G10
    bool has_axis_words_before_input = false;
    std::uint8_t g_count = 0;
    std::uint8_t m_count = 0;
    std::uint8_t m_next = 0;  ///< the M code to continue with in this stage
    std::uint16_t macro = 0;  ///< the program that is called with the words as arguments
    MacroCaller caller = MacroCaller::G65;
    std::uint8_t axis_row = kNoRow;  ///< the G row that decides what the axis words mean
    bool rests = false;              ///< G9
    std::optional<ProbeUntil> probe;
    std::uint8_t thread_code = 0;  ///< G32, G34, G35 or G36; 0 = none
    std::uint32_t resume = 0;      ///< offset of the item to continue with
    AddressSet taken = 0;          ///< words that the G codes of the block take
    std::optional<int> tool;       ///< of a T word
    int tool_offset = -1;          ///< its offset digits; -1 when it had none
    std::optional<double> dwell;   ///< seconds
    TextRange comment;             ///< the first one
    JumpKind jump = JumpKind::None;
    bool jump_is_call_word = false;
    bool while_condition = false;
    std::uint32_t jump_number = 0;
    bool has_corner_words = false;  ///< they are in `Block::corner_words`
  };

  bool is_back_line() const { return parts.has_corner_words && corner_words.back; }
  void clear() {
    words.clear();
    parts = Parts{};
  }

  Words words;
  Parts parts;
  CornerWords corner_words;                 ///< when `Parts::has_corner_words`
  std::array<std::uint8_t, kMaxCodes> g{};  ///< row indexes, in the order written
  std::array<std::uint8_t, kMaxCodes> m{};  ///< numbers
};

}  // namespace dripline::interpreter::centurion
