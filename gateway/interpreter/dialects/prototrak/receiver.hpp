#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/dialects/prototrak/event_list.hpp"
#include "gateway/interpreter/dialects/prototrak/words.hpp"

namespace dripline::interpreter::prototrak {

struct Notice {
  std::uint64_t line = 0, offset = 0;
  Diagnostic diagnostic;
};

/// Takes a program's characters as they come over the line and stores its events: both input forms,
/// the control's own G100 to G109 and a Fanuc 6 program after its three changes, even mixed
/// (manual: transfer procedure, blocks, words and events). Nothing is stored when anything is
/// wrong.
class Receiver {
 public:
  enum class State : std::uint8_t { Receiving, Complete, Failed };

  /// One line of the text; its end is layout only.
  State take(const SourceLine& line);
  /// There is no more text.
  State end_of_text(std::uint64_t line);
  /// The text cannot be taken further.
  State fail_line(const DiagnosticRow& fault, std::string_view detail);

  const StoredProgram& program() const { return program_; }
  const std::vector<Notice>& notices() const { return notices_; }
  const Notice& failure() const { return failure_; }  ///< when Failed
  static constexpr std::size_t kMaxBlock = 255;
  static constexpr std::size_t kMaxNotices = 200;

 private:
  /// The words of the block at hand by address, and its G codes.
  struct BlockWords {
    std::vector<Word> words;
    std::vector<int> g_codes;
    const Word* find(Address address) const;
    bool has(Address address) const { return find(address) != nullptr; }
    bool has_g(int code) const;
  };
  /// Words that stay until changed (README, "Decided here").
  struct Modal {
    bool is_metric = false, is_incremental = false;
    ToolSide side = ToolSide::Center;
    double feed = 0, diameter = 0;
    bool has_feed = false;
    std::uint8_t tool = 1;
  };

  bool take_character(char c);
  bool end_block();
  bool fail(const DiagnosticRow& fault, std::string_view detail);
  void notice(const DiagnosticRow& fault, std::string_view detail);

  bool apply_modes(const BlockWords& block);
  bool apply_modal_words(const BlockWords& block);
  bool take_header_words(const BlockWords& block);
  bool make_event(const BlockWords& block);
  bool move_reference(const BlockWords& block);
  bool report_left_words(const BlockWords& block, std::optional<int> event_code);
  void connect_previous(const ProgramEvent& event);
  bool make_converted(const BlockWords& block, int code);
  bool make_native(const BlockWords& block, int code);
  bool fill_cut(const BlockWords& block, ProgramEvent& event);
  bool fill_arc_center(const BlockWords& block, ProgramEvent& event);
  bool fill_repeat(const BlockWords& block, ProgramEvent& event);
  bool fill_rectangle(const BlockWords& block, ProgramEvent& event);
  bool fill_circle(const BlockWords& block, ProgramEvent& event);
  bool fill_conrad(const BlockWords& block, ProgramEvent& event);
  bool store(ProgramEvent event);

  /// Each false when its word is out of range; the value stays when there is no word. The word is
  /// taken from the account of the block.
  bool dimension(const BlockWords& block, Address address, double& mm);
  bool coordinate(const BlockWords& block, Address address, double reference, double& mm);
  bool size(const BlockWords& block, Address address, double least, double& mm);
  bool integer(const BlockWords& block, Address address, std::int64_t least, std::int64_t most,
               std::int64_t& value);
  void take(Address address) {
    ledger_.take(language::WordLedger::Words{1} << static_cast<unsigned>(address));
  }
  double rounded(const Word& word, double value);
  double largest() const;
  bool require(const BlockWords& block, std::initializer_list<Address> addresses);
  XY reference() const;

  enum class Part : std::uint8_t { BeforeStart, Title, Blocks };
  std::uint64_t title_line_ = 0;  ///< of the % before a title
  State state_ = State::Receiving;
  Part part_ = Part::BeforeStart;
  StoredProgram program_;
  Modal modal_;
  std::optional<XY> moved_reference_;  ///< by G92
  language::WordLedger ledger_;        ///< by Address
  bool z_changed_ = false;
  bool z_decides_ = false;  ///< on whether the event before the next is connected to it
  bool has_units_ = false;
  std::string block_;
  bool in_comment_ = false;
  std::uint64_t block_line_ = 0, block_offset_ = 0, line_ = 0, offset_ = 0;
  std::int64_t sequence_ = -1;
  std::vector<Notice> notices_;
  Notice failure_;
};

}  // namespace dripline::interpreter::prototrak
