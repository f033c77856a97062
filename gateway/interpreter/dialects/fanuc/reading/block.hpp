#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/dialects/fanuc/errors.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/words.hpp"
#include "gateway/interpreter/dialects/fanuc/state.hpp"

namespace dripline::interpreter::fanuc {

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
};

/// What ends the block besides running on to the next one.
enum class Ending : std::uint8_t { None, Return, EndOfProgram };

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
    // of a call
    CallKind call = CallKind::Macro;
    bool is_modal_call = false;
    std::uint32_t call_program = 0;
    bool has_call_program = false;
    std::uint32_t call_passes = 1;
    // of a macro statement
    StatementKind statement = StatementKind::None;
    bool condition = false;
    std::uint8_t loop_number = 0;
    std::int32_t variable = 0;
    std::uint32_t statement_column = 0;
    double value = 0;
    std::uint32_t message_begin = 0;  ///< of #3000 and #3006
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
