#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"

namespace dripline::interpreter::centurion {

struct Run;

/// What has to be known about the part before a start in the middle (start_search.hpp), besides the
/// state that it leaves. Used only while the start is searched for.
///
/// The part is interpreted with the memory as it is now. That is right for a parameter which it
/// only reads, or sets before it reads it. One that it reads and then sets (P10=P10+1, G10 with
/// P500=P500+1) has another value now than when that part was executed: the change would be applied
/// twice.
struct StartNotes {
  enum class Use : std::uint8_t {
    None,
    Read,  ///< as the program found it
    Set,   ///< before it was read
    Lost,  ///< read, then set
  };
  /// Of P0 to P999, then PB0 to PB639; empty while no start is searched for.
  std::vector<Use> uses;

  /// The block of the start, when the program has reached it; another place with the same number is
  /// another block.
  bool has_place = false;
  ProgramIndex program = kMainProgram;
  std::uint64_t offset = 0;
  std::uint64_t arrivals = 0;
  std::uint64_t arrival = 0;  ///< the last one's block, counted from 1

  /// What the machine did not receive: its M functions and outputs, each with its last line.
  struct Withheld {
    std::uint16_t code = 0;  ///< of M; or kOutput and more
    bool state = true;       ///< of an output
    std::uint64_t line = 0;
  };
  static constexpr std::uint16_t kOutputOfZ = 1000, kOutputOfX = 2000;
  static constexpr std::size_t kMaxWithheld = 256;
  std::vector<Withheld> withheld;

  bool is_noting() const { return !uses.empty(); }
  void begin() {
    *this = StartNotes{};
    uses.assign(kParameterCount + kByteCount, Use::None);
  }
  void end() { uses.clear(); }

  void note_read(int parameter) {
    if (is_noting()) read_cell(parameter);
  }
  void note_byte_read(int number) {
    if (is_noting()) read_cell(kParameterCount + number);
  }
  void note_set(int parameter) {
    if (is_noting()) set_cell(parameter);
  }
  void note_byte_set(int number) {
    if (is_noting()) set_cell(kParameterCount + number);
  }
  bool has_set(int parameter) const {
    return is_noting() && uses[static_cast<std::size_t>(parameter)] >= Use::Set;
  }
  void withhold(std::uint16_t code, bool state, std::uint64_t line);

 private:
  void read_cell(int cell);
  void set_cell(int cell);
};

/// G11 has written a table. A program that has moved, or set a zero, has used it as well.
void note_table_set(Run& run, int parameter);

/// "P10, PB50"; empty: nothing is lost.
std::string lost_memory_text(const Run& run);
/// "M62 (line 4), output 3 of Z on (line 7)"; empty: nothing was withheld.
std::string withheld_text(const StartNotes& notes);
/// The loops and calls around the start: "the subroutine called before line 12"; empty: there are
/// none.
std::string open_flow_text(const Run& run);

}  // namespace dripline::interpreter::centurion
