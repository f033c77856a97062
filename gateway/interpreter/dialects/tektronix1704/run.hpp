#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <string_view>

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/dialects/tektronix1704/options.hpp"

namespace dripline::interpreter::tektronix1704 {

// What can be wrong with a tape. The manual knows one lamp; ids and texts are decided here. From
// TEK0401 on the manual forbids it but does not say what the control does: a warning.

// The rows are named as enumerators are, because they are used as such.
// NOLINTBEGIN(readability-identifier-naming): a row is named as an enumerator would be
struct Fault {
  static constexpr DiagnosticRow Character{"TEK0103", "invalid character"};
  static constexpr DiagnosticRow TooManyDigits{"TEK0104", "too many significant digits"};
  static constexpr DiagnosticRow NoDigits{"TEK0105", "letter without digits"};
  static constexpr DiagnosticRow Sign{"TEK0106", "sign where none is allowed"};
  static constexpr DiagnosticRow GCode{"TEK0107", "G code unknown or option not fitted"};
  static constexpr DiagnosticRow TwoDifferent{"TEK0108", "two different G or M words in one block"};
  static constexpr DiagnosticRow DwellNotAlone{"TEK0109", "G04 is not alone in its block"};
  static constexpr DiagnosticRow BlockTooLong{"TEK0110", "block too long"};
  static constexpr DiagnosticRow NumberNotFound{"TEK0111", "sequence number not found"};
  static constexpr DiagnosticRow ProgramNotFound{"TEK0113", "the tape has no such program"};
  static constexpr DiagnosticRow BlockInLeader{
      "TEK0114", "block before the first end of block of a program would be lost"};
  static constexpr DiagnosticRow TextFailed{"TEK0112", "tape cannot be read"};
  static constexpr DiagnosticRow EndWithoutM{"TEK0120", "end of tape without M02 or M30"};
  static constexpr DiagnosticRow Capacity{"TEK0201", "coordinate capacity exceeded"};
  static constexpr DiagnosticRow Travel{"TEK0202", "machine travel exceeded"};
  static constexpr DiagnosticRow ThreeAxes{"TEK0211", "arc with three end coordinates"};
  static constexpr DiagnosticRow Radius{"TEK0212", "arc radius out of range"};
  static constexpr DiagnosticRow OffTheCircle{"TEK0213", "end point is not on the arc"};
  static constexpr DiagnosticRow Quadrant{"TEK0214", "arc leaves its quadrant"};
  static constexpr DiagnosticRow NoClearance{"TEK0221", "fixed cycle without R"};
  static constexpr DiagnosticRow NoDepth{"TEK0222", "fixed cycle without Z"};
  static constexpr DiagnosticRow PeckUpward{"TEK0223", "G83 with Z above R would cut nothing"};
  static constexpr DiagnosticRow NoFeed{"TEK0301", "no feedrate, or zero"};
  static constexpr DiagnosticRow FeedOutOfRange{"TEK0302", "feedrate out of range"};
  static constexpr DiagnosticRow DwellTooLong{"TEK0303", "dwell out of range"};
  static constexpr DiagnosticRow DwellWithoutF{"TEK0304", "dwell without F"};
  static constexpr DiagnosticRow Synchronization{"TEK0402", "stop in a mode without deceleration"};
  static constexpr DiagnosticRow Turn{"TEK0401",
                                      "direction changes by more than 30 degrees without a stop"};
  static constexpr DiagnosticRow TerminalMove{"TEK0402",
                                              "last move before a stop has no deceleration"};
  static constexpr DiagnosticRow QuillAfterMove{"TEK0403",
                                                "quill moves after a block without deceleration"};
  static constexpr DiagnosticRow MAfterMove{"TEK0404",
                                            "M word in or after a block without deceleration"};
  static constexpr DiagnosticRow MissingEnd{"TEK0411",
                                            "end coordinate of an arc is missing and taken as 0"};
  static constexpr DiagnosticRow NoArc{"TEK0412", "arc ends where it begins: no motion"};
  static constexpr DiagnosticRow CenterBeforePreset{
      "TEK0413", "arc on the center that was stored before G94 moved the zero"};
  static constexpr DiagnosticRow Point{"TEK0421", "decimal point has no meaning here"};
  static constexpr DiagnosticRow Repeated{"TEK0422", "word is repeated; the last one counts"};
  static constexpr DiagnosticRow PresetValue{"TEK0423", "G94 sets zero, whatever value is given"};
  static constexpr DiagnosticRow OddCount{"TEK0424", "odd count is rounded down to the resolution"};
  static constexpr DiagnosticRow NotFitted{"TEK0425",
                                           "word of an option that is not fitted is ignored"};
  static constexpr DiagnosticRow Unused{"TEK0426", "nothing in the block takes"};
  static constexpr DiagnosticRow ReaderLimited{"TEK0431", "reader is slower than the move"};
  static constexpr DiagnosticRow Tape{"TEK0441", "tape is not as the manual wants it"};
};
// NOLINTEND(readability-identifier-naming)

// The words of a block: letters, formats, and what one block has (manual: blocks and words).

enum class Address : std::uint8_t { N, G, X, Y, Z, I, J, K, R, F, S, T, M };
inline constexpr std::size_t kAddressCount = 13;
inline constexpr std::string_view kLetters = "NGXYZIJKRFSTM";

struct WordFormat {
  std::uint8_t digits;  ///< significant ones
  bool is_signed;
};
inline constexpr WordFormat kSequence{3, false}, kCode{2, false}, kCoordinate{6, true},
    kFeed{4, false};
inline constexpr std::array<WordFormat, kAddressCount> kFormats{
    kSequence,   kCode,       kCoordinate, kCoordinate, kCoordinate, kCoordinate, kCoordinate,
    kCoordinate, kCoordinate, kFeed,       kCode,       kCode,       kCode};

constexpr std::uint16_t bit(Address address) {
  return static_cast<std::uint16_t>(1u << static_cast<unsigned>(address));
}
inline constexpr std::uint16_t kEndWords = bit(Address::X) | bit(Address::Y) | bit(Address::Z);
inline constexpr std::uint16_t kCenterWords = bit(Address::I) | bit(Address::J) | bit(Address::K);

/// Values are counts: the digits as an integer, with their sign.
class Words {
 public:
  void clear() { present_ = 0; }
  void set(Address address, std::int32_t value) {
    value_[static_cast<std::size_t>(address)] = value;
    present_ = static_cast<std::uint16_t>(present_ | bit(address));
  }
  bool has(Address address) const { return (present_ & bit(address)) != 0; }
  bool has_any(std::uint16_t set) const { return (present_ & set) != 0; }
  void replace(Address address, std::int32_t value) {
    value_[static_cast<std::size_t>(address)] = value;
  }
  std::int32_t operator[](Address address) const {
    return value_[static_cast<std::size_t>(address)];
  }
  std::uint16_t present() const { return present_; }
  bool empty() const { return present_ == 0; }

  template <class Archive>
  friend void visit(Archive& archive, Words& words) {
    archive(words.value_, words.present_);
  }

 private:
  std::array<std::int32_t, kAddressCount> value_{};
  std::uint16_t present_ = 0;
};

enum class Motion : std::uint8_t {
  G00,  ///< line, rest at the end
  G01,  ///< line
  G02,  ///< arc clockwise
  G03,  ///< arc counterclockwise
  G20,  ///< arc clockwise, rest at the end
  G30,  ///< arc counterclockwise, rest at the end
  G50,  ///< rapid
  Cycle,
};
constexpr bool is_arc(Motion motion) {
  return motion >= Motion::G02 && motion <= Motion::G30;
}
/// The slides do not come to rest at the end.
constexpr bool flows_on(Motion motion) {
  return motion >= Motion::G01 && motion <= Motion::G03;
}

enum class ReaderState : std::uint8_t {
  Hunt,  ///< ignores everything up to the first end of block
  Data,
  Pass,    ///< reads over programs before the one that is wanted, executing nothing
  Search,  ///< reads forward to a sequence number, executing nothing
};

/// A block as far as it has been read: a comment can hold ends of blocks, so a block can take
/// several lines.
struct BlockInProgress {
  Words words;
  bool in_comment = false;
  bool is_begun = false;  ///< `origin` holds its first line
  bool has_word = false;  ///< a letter waits for its digits
  bool has_sign = false, is_negative = false, has_digit = false, has_tab = false;
  bool tab_is_told = false;
  Address address{};
  std::int32_t value = 0;
  std::uint8_t digits = 0;       ///< significant
  std::uint32_t characters = 0;  ///< on the tape, end of block included
  std::bitset<500> faults;       ///< reported already, by the numbers of their ids
  bool is_bad = false;           ///< a fault that leaves the block out
};

/// The last move, for the rules about stops and for the reader's time (manual: G01, buffering).
struct LastMove {
  bool flows = false;  ///< it was in G01, G02 or G03 and nothing has stopped since
  std::array<double, kAxes> direction{};  ///< at its end; not of unit length
  Origin origin;
  std::uint64_t block = 0;  ///< that made it
  double feed = 0;          ///< mm per minute
  double length = 0;
};

struct State {
  RunPhase phase = RunPhase::Running;
  ReaderState reader = ReaderState::Hunt;
  bool has_header = false;
  std::uint64_t blocks = 0;
  std::uint32_t mdi_done = 0;
  TextPlace place;

  /// Programs of the tape, counted from 1: the one under the reader, the one to be executed, and
  /// the one after whose rewind stop the reader is. 0: there has been none.
  std::uint32_t part = 1, wanted = 1, head = 0;
  bool has_block = false;     ///< the program under the reader has a block
  bool is_rewound = false;    ///< its end has wound the tape back
  bool is_tape_over = false;  ///< nothing comes after the program that has ended
  bool reads_on = false;      ///< a program was executed before this one

  Motion motion = Motion::G00;
  std::uint8_t cycle = 0;  ///< 80 to 89
  bool is_incremental = false;
  bool drills = false;                        ///< G99
  std::array<std::int64_t, kAxes> program{};  ///< counts
  std::array<std::int64_t, kAxes> origin{};   ///< machine counts of program zero
  std::array<std::int64_t, kAxes> center{};   ///< I, J, K stores, program counts
  std::array<bool, kAxes> is_center_old{};    ///< G94 has moved the zero since it was stored
  std::array<bool, kAxes> has_moved{};
  Plane plane = Plane::XY;
  std::int32_t feed = -1;  ///< counts; -1: never set
  std::int32_t spindle_code = 0, tool_code = 0;
  bool has_clearance = false, has_depth = false;
  std::int64_t clearance = 0, depth = 0;  ///< R and Z of cycles, program counts
  SpindleState spindle = SpindleState::Off;
  bool flood = false, mist = false;
  LastMove last;
  BlockInProgress block;
};

using Counts = std::array<std::int64_t, kAxes>;

/// One run: what the files of this folder work on. Functions that cannot go on give false and
/// leave the reason in `alarm`.
struct Run : BlockRun {
  Run(ControlOptions control_options, EventSink& event_sink);

  /// The sink, after the header has been delivered.
  EventSink& events() {
    if (!state.has_header) [[unlikely]]
      deliver_header();
    return sink;
  }

  using BlockRun::fail;
  [[gnu::cold]] bool fail(const DiagnosticRow& fault) { return fail(fault, 0); }
  [[gnu::cold]] void warn(const DiagnosticRow& fault, const Origin& at, std::uint32_t column = 0,
                          std::string_view detail = {});
  /// What the manual forbids without naming an effect: a warning, or an alarm when strict.
  [[gnu::cold]] bool object(const DiagnosticRow& fault, std::uint32_t column = 0,
                            std::string_view detail = {});

  double machine_mm(std::size_t axis, double program_counts) const {
    const double sign = options.mirror[axis] ? -1 : 1;
    return (static_cast<double>(state.origin[axis]) + sign * program_counts) * mm_per_count;
  }

  const ControlOptions options;
  const double mm_per_count;
  EventSink& sink;
  State state;
  Position position;            ///< of the machine; axes that have moved are marked
  language::WordLedger ledger;  ///< of the block being executed

 private:
  [[gnu::cold]] void deliver_header();
};

/// The state between two blocks; snapshot.cpp.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::tektronix1704
