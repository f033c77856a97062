#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/fanuc/errors.hpp"
#include "gateway/interpreter/dialects/fanuc/state.hpp"

namespace dripline::interpreter::fanuc {

// The addresses of this control and the words of one block.

// clang-format off
enum class Address : std::uint8_t {
  A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z
};
// clang-format on
inline constexpr std::size_t kAddressCount = 26;
constexpr char letter(Address address) {
  return static_cast<char>('A' + static_cast<int>(address));
}
constexpr Address address_of(char capital) {
  return static_cast<Address>(capital - 'A');
}

using AddressSet = std::uint32_t;
constexpr AddressSet set_of(Address address) {
  return AddressSet{1} << static_cast<unsigned>(address);
}
template <class... Addresses>
constexpr AddressSet set_of(Address first, Addresses... rest) {
  return set_of(first) | set_of(rest...);
}

using enum Address;
inline constexpr AddressSet kLinearWords = set_of(X, Y, Z, U, V, W);
inline constexpr AddressSet kRotaryWords = set_of(A, B, C);
inline constexpr AddressSet kAxisWords = kLinearWords | kRotaryWords;
inline constexpr AddressSet kCenterWords = set_of(I, J, K);
constexpr AddressSet set_of_axis(Axis axis) {
  constexpr std::array<Address, kAxisCount> kLetters{X, Y, Z, A, B, C, U, V, W};
  return set_of(kLetters[static_cast<std::size_t>(axis)]);
}

/// How a word's number was written: what it means depends on it.
enum class WordForm : std::uint8_t {
  Whole,     ///< no decimal point
  Point,     ///< with a decimal point
  Computed,  ///< from variables
};

struct Word {
  double value = 0;
  std::uint16_t column = 0;   ///< 1-based byte of the block
  std::uint8_t decimals = 0;  ///< digits written after the point
  WordForm form = WordForm::Whole;
  bool is_negative = false;  ///< a minus was written, even before zero
};

/// Values as written. The last word of an address counts.
class Words {
 public:
  void clear() { present_ = 0; }
  AddressSet present() const { return present_; }
  bool has(Address address) const { return (present_ & set_of(address)) != 0; }
  bool has_any(AddressSet set) const { return (present_ & set) != 0; }
  const Word& operator[](Address address) const { return word_[static_cast<std::size_t>(address)]; }
  void set(Address address, const Word& word) {
    present_ |= set_of(address);
    word_[static_cast<std::size_t>(address)] = word;
  }
  /// `word`, of another address, replaces that of `old`.
  void replace(Address old, Address address, const Word& word) {
    present_ &= ~set_of(old);
    set(address, word);
  }
  /// 0 when there is no such word.
  std::uint32_t column(Address address) const { return has(address) ? (*this)[address].column : 0; }
  /// Of the first word written that is in `set`; 0 when there is none.
  std::uint32_t first_column(AddressSet set) const {
    std::uint32_t first = 0;
    for (AddressSet left = present_ & set; left != 0; left &= left - 1) {
      const std::uint32_t at = word_[static_cast<std::size_t>(std::countr_zero(left))].column;
      if (first == 0 || at < first) first = at;
    }
    return first;
  }

 private:
  AddressSet present_ = 0;
  std::array<Word, kAddressCount> word_{};
};

/// How far a block has come; a question suspends it between or within stages. Reading has no effect
/// on anything but the block, so that a question in it starts the block again.
enum class Stage : std::uint8_t { Start, Execution, AfterMove };

enum class BlockKind : std::uint8_t {
  Nc,
  Macro,  ///< an assignment or a control word
  Call,   ///< G65, G66 and codes that call: the words are arguments
};

/// What a macro statement does once it has been read.
enum class StatementKind : std::uint8_t {
  None,
  Assign,
  Goto,
  Loop,
  EndLoop,
  OpenPort,
  ClosePort,
  Print,
  Name,  ///< SETVN
};

/// What ends the block besides running on to the next one.
enum class Ending : std::uint8_t { None, Return, EndOfProgram };

/// A corner word: `,R` and `,C`.
enum class CornerKind : std::uint8_t { None, Round, Chamfer };

/// One argument of a macro call, in the order written.
struct Argument {
  char letter = 'A';
  double value = 0;
};

struct Block {
  static constexpr std::size_t kMaxM = 8;
  static constexpr std::size_t kMaxArguments = 64;
  static constexpr std::size_t kMaxWarnings = 8;
  static constexpr std::uint8_t kNoCode = 0xFF;
  static constexpr std::uint32_t kKeepPasses = 0xFFFF'FFFF;

  struct Parts {
    Stage stage = Stage::Start;
    BlockKind kind = BlockKind::Nc;
    bool has_code = false;
    bool has_motion = false;  ///< axis words that moved: a modal macro call follows
    Ending ending = Ending::None;
    bool rewinds = false;                     ///< M30
    std::uint32_t ending_number = 0;          ///< P of M99, 0 when there is none
    std::uint32_t passes_left = kKeepPasses;  ///< L of M99: of the call that it ends
    std::uint8_t one_shot = kNoCode;
    std::uint8_t last_motion_group = 0;  ///< 1 or 9: which of the two came later
    bool p_is_work_system = false;       ///< P is that of G54.1
    bool begins_cycle = false;           ///< the mode of hole cycles
    std::uint8_t m_count = 0;
    std::uint8_t argument_count = 0;
    std::uint8_t warning_count = 0;
    std::uint32_t groups = 0;    ///< bit per modal group that the block names
    AddressSet negatives = 0;    ///< words written with a minus,
    AddressSet points = 0;       ///< and with a decimal point
    std::uint32_t g_column = 0;  ///< of the one-shot code, or of the last G
    std::uint32_t end = 0;       ///< offset of what ends the block
    CornerKind corner = CornerKind::None;
    std::uint32_t corner_column = 0;
    double corner_size = 0;  ///< millimeters
    // of a call
    CallKind call = CallKind::Macro;
    bool is_modal_call = false;
    std::uint32_t call_program = 0;
    bool has_call_program = false;
    std::uint32_t name_begin = 0;  ///< of the <NAME> of a program, without its brackets
    std::uint32_t name_end = 0;    ///< 0: there is none
    std::uint32_t call_passes = 1;
    // of a macro statement
    StatementKind statement = StatementKind::None;
    bool condition = false;
    std::uint8_t loop_number = 0;
    std::int32_t variable = 0;
    std::uint32_t statement_column = 0;
    double value = 0;
    std::uint32_t message_begin = 0;  ///< of #3000 and #3006; the names of SETVN
    std::uint32_t message_end = 0;
  };
  struct PendingWarning {
    const DiagnosticRow* row = nullptr;
    std::uint32_t column = 0;
  };

  void clear() {
    words.clear();
    parts = Parts{};
  }
  void warn(const DiagnosticRow& row, std::uint32_t column) {
    for (std::size_t i = 0; i < parts.warning_count; ++i) {
      if (*warnings[i].row == row) return;  // once a block is enough
    }
    if (parts.warning_count == kMaxWarnings) return;
    warnings[parts.warning_count++] = {&row, column};
  }
  bool names(Group group) const { return (parts.groups >> group & 1u) != 0; }

  Words words;
  Parts parts;
  std::array<std::uint8_t, kGroupCount> g{};  ///< of the groups that the block names
  std::array<std::int32_t, kMaxM> m{};
  std::array<Argument, kMaxArguments> arguments{};
  std::array<PendingWarning, kMaxWarnings> warnings{};
};

}  // namespace dripline::interpreter::fanuc
