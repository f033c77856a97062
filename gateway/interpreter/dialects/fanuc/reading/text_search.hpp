#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Places that jumps go to, found in text that may still be arriving.
namespace dripline::interpreter::fanuc {

/// How a block begins, and whether it begins or ends a loop.
struct BlockHead {
  enum class Kind : std::uint8_t { Empty, Sequence, Program, Percent, Other };
  Kind kind = Kind::Empty;
  std::uint32_t number = 0;
  std::string_view name = {};  ///< of a program that has one; in the text
  int loop = 0;                ///< m of DO m, -m of END m
  bool is_bare = false;        ///< a sequence number, and nothing more
};
/// The text must end with a LF.
BlockHead read_head(const char* begin, const char* end);

/// A DO that has been passed and not its END.
struct OpenLoop {
  std::uint8_t number = 1;
  std::uint64_t offset = 0;  ///< of the DO block
};
struct OpenLoops {
  static constexpr std::size_t kMax = 3;
  std::array<OpenLoop, kMax> loop{};
  std::size_t count = 0;
};

/// Searches continue where they stopped when called again with the same question, and give back
/// after a bounded number of lines. What they found is kept for as long as the run lasts: it only
/// saves searching again.
class TextSearch {
 public:
  using Outcome = language::SearchOutcome;

  explicit TextSearch(Run& run) : run_(run) {}

  /// The block N`label`: forward from `from` to the end of the program, then from its head.
  /// `open` holds the loops around `from`, and afterwards those around what was found.
  Outcome find_label(const TextPosition& from, std::uint32_t label, OpenLoops& open,
                     TextPosition& found);
  /// Numbers of the blocks of a contour.
  struct Contour {
    std::uint32_t first = 0, last = 0;
    bool is_left_at_its_end = false;  ///< the program continues there when the contour comes later
    friend bool operator==(const Contour&, const Contour&) = default;
  };
  /// Whether these blocks of the program around `from` are one contour: Found, or Missing with the
  /// reason in `why`.
  Outcome check_contour(const TextPosition& from, const Contour& contour, std::string& why);
  /// The program that a jump calls, in the text that was started.
  Outcome find_program(const Jump& jump, TextPosition& found);
  /// The END of the loop that begins at `head`; `after` is the block after it.
  Outcome find_end(const TextPosition& head, const TextPosition& after, std::uint8_t number,
                   LoopFrame& loop);

 private:
  static constexpr unsigned kBlocksPerCall = 1u << 16;
  static constexpr std::size_t kKnown = 256;

  struct KnownLabel {
    bool is_used = false;
    std::uint32_t label = 0;
    TextPosition from;
    TextPosition found;
    OpenLoops open;
  };
  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t line = 0;
  };
  struct LabelSearch {
    bool is_running = false;
    bool from_head = false;
    std::uint32_t label = 0;
    TextPosition from;
    TextPosition next;
    OpenLoops open;
  };
  /// Both ends of a contour, and how often the program has their numbers.
  struct ContourSearch {
    bool is_known = false;  ///< what is asked
    bool is_right = false;  ///< was found: the jump's own search may follow, and wait
    Contour contour;
    TextPosition from;
    TextPosition next;
    std::uint64_t skipped_line = 0;    ///< of a block between the cycle and N`first`; 0: none yet
    std::uint64_t begin = 0, end = 0;  ///< offsets of what was found
    unsigned begins = 0, ends = 0;
  };
  struct EndSearch {
    bool is_running = false;
    TextPosition head;
    TextPosition next;
    OpenLoops open;
  };

  Outcome load(const TextPosition& at) { return language::outcome_of(run_.text.load(at)); }
  Outcome continue_label_search(LabelSearch& search);
  /// The head of the block at `at`, which moves after it.
  Outcome next_block(TextPosition& at, BlockHead& head, TextPosition& block);
  KnownLabel& known_label(const TextPosition& from, std::uint32_t label);
  static Outcome follow(const BlockHead& head, std::uint64_t offset, OpenLoops& open);

  Run& run_;
  std::array<KnownLabel, kKnown> labels_{};
  std::array<LoopFrame, kKnown> loops_{};
  LabelSearch label_search_;
  ContourSearch contour_search_;
  EndSearch end_search_;
  const Place* known_program(const Jump& jump) const;

  std::unordered_map<std::uint32_t, Place> programs_;  ///< by number
  std::unordered_map<std::string, Place> named_programs_;
  TextPosition programs_next_;
  bool programs_complete_ = false;
};

}  // namespace dripline::interpreter::fanuc
