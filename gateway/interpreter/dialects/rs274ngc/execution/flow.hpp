#pragma once

#include <unordered_map>

#include "gateway/interpreter/dialects/rs274ngc/reading/oword_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Loops, conditions, subprograms (LinuxCNC: O-codes). A place that the program goes to is looked
/// for by passing over lines, as they arrive, and then kept: the second pass of a loop jumps.
namespace dripline::interpreter::rs274ngc {

class Flow {
 public:
  explicit Flow(Run& run) : run_(run) {}

  /// A line with an O word; `at` is on the O. Sets Run::next, and State::skip when lines must be
  /// passed over first. False: see Run::pause.
  bool execute(const char* at);
  /// The subprogram that has the contour of a lathe cycle; the run continues after the line.
  bool call_contour(std::int64_t number);
  /// M98 and M99 of the line.
  bool execute_fanuc(int m_code);
  /// One line that is passed over: Run::next is where the run continues.
  bool pass_over();
  /// The text of a program is over. False: an alarm, or the source has yet to answer.
  bool end_of_text();
  /// Whether the next thing to do is to ask the source for a called file.
  bool wants_file() const { return run_.state.skip.until >= SkipFor::SubFile; }
  bool look_up_file();

  /// Drops what was learned about another run's text and state.
  void reset();

 private:
  using Handler = bool (Flow::*)(const OwordHead&);
  static Handler handler_of(Oword word);
  bool read_head(const char* at, OwordHead& head, Handler& handler);

  bool begin_sub(const OwordHead& head);
  bool end_sub(const OwordHead& head);
  bool leave_sub(const OwordHead& head);
  bool call(const OwordHead& head);
  bool enter_sub(Label label);
  bool read_arguments(const char* at);
  bool begin_if(const OwordHead& head);
  bool next_branch(const OwordHead& head);
  bool end_if(const OwordHead& head);
  bool begin_while(const OwordHead& head);
  bool begin_do(const OwordHead& head);
  bool begin_repeat(const OwordHead& head);
  bool end_loop(const OwordHead& head);
  bool leave_loop(const OwordHead& head);
  bool test_do(const OwordHead& head, BlockFrame& frame);

  bool condition(const OwordHead& head, double& value);
  bool refuse(const DiagnosticRow& code, const OwordHead& head, const char* detail = "");
  bool push(BlockKind kind, const OwordHead& head, std::uint64_t left);
  /// The frame of `label` in this call; those within it are left. nullptr: there is none.
  BlockFrame* frame_of(Label label);
  bool count_pass();
  bool know(const OwordHead& head, bool is_subprogram);
  bool know_later_sub(const OwordHead& head);
  bool refuse_missing_sub();
  const KnownLabel* find_label(Label scope, Label label);
  Label scope() const;
  bool return_from_call();
  bool push_call(const TextPlace& entry, Label scope, bool is_fanuc, std::uint64_t passes);
  bool skip_to(SkipFor until, Label label);
  void land(const TextPlace& place);

  struct PlaceHash {
    std::size_t operator()(const TextPlace& place) const {
      return std::hash<std::uint64_t>{}(place.offset * 31 + place.program * 7919 + place.line);
    }
  };
  struct LabelHash {
    std::size_t operator()(const std::pair<std::int64_t, std::int64_t>& key) const {
      return std::hash<std::int64_t>{}(key.first * 1'000'003 + key.second);
    }
  };
  static constexpr std::size_t kMaxPlaces = 4096;

  /// How the O word of a line reads, of the line that had its slot last: a loop's lines are read
  /// once and looked up by their place from the second pass on.
  struct KnownHead {
    std::uint64_t offset = 0;
    ProgramIndex program = kMainProgram;
    std::uint32_t after = 0;  ///< OwordHead::after in the line; 0: nothing is known
    Label label;
    Oword word = Oword::None;
    Handler handler = nullptr;
  };
  static constexpr std::size_t kKnownHeads = 256;

  Run& run_;
  std::array<KnownHead, kKnownHeads> heads_{};                  ///< only a cache, by offset
  std::unordered_map<TextPlace, TextPlace, PlaceHash> places_;  ///< only a cache
  std::unordered_map<std::pair<std::int64_t, std::int64_t>, std::size_t, LabelHash> label_index_;
  std::array<double, kArguments> arguments_{};
  std::size_t argument_count_ = 0;
};

}  // namespace dripline::interpreter::rs274ngc
