#pragma once

#include <bitset>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// Searches a program ahead of the run: in the order of its text, ignoring labels and jumps, and
/// skipping blocks that cannot be read (the run stops at them). A search resumes where it stopped
/// when it is called again, and returns after a bounded number of blocks. The windows of other
/// readers of the source are stale after a search.
class AheadSearch {
 public:
  enum class Outcome : std::uint8_t { Found, Missing, NotYet, More };

  AheadSearch(ProgramSource& source, ReaderOptions options);

  /// As many blocks as the control's memory has.
  static constexpr std::uint64_t kMaxBlocks = 3'100;

  /// The first TOOL DEF of this tool, with a length or a radius, in the program that was started,
  /// among so many blocks.
  Outcome find_tool(std::int32_t number, std::uint64_t max_blocks);
  /// After Found.
  const Block& definition() const { return definition_; }
  Units units() const { return state_.program.units; }

  /// The first program that the started one calls, by CALL PGM or cycle 12, and that the source
  /// does not have. Looks at as many blocks as the control's memory has, and at as many programs.
  Outcome find_missing_program();
  /// After Found.
  std::int32_t missing_program() const { return called_.back(); }
  const TextPlace& place() const { return reader_.block_place(); }  ///< of the block that calls it
  std::int32_t block_number() const;

  /// Finds a block that leads back over the one at `place` of the program that was started: a
  /// repeat or a jump from after it to a label before it, or a call of the subprogram that it is
  /// in. Searches the whole program.
  Outcome find_return(const TextPlace& place);
  const ProgramForm& program() const { return state_.program; }

 private:
  static constexpr unsigned kBlocksPerCall = 1u << 14;
  static constexpr std::size_t kMaxPrograms = 32;

  enum class Step : std::uint8_t { Read, Skipped, NotYet, End };

  void begin();
  Step next();
  bool is_iso() const { return state_.program.form == Form::Iso; }
  bool is_definition(std::int32_t number);
  std::int32_t called_program() const;
  bool is_over() const;
  struct LabelUse {
    std::int32_t set = Block::kNone;   ///< LBL
    std::int32_t used = Block::kNone;  ///< CALL LBL, a jump
    bool returns = false;              ///< the use: of a subprogram
    std::size_t later = 0;             ///< of a label with a name or above 255: its hash
  };
  LabelUse label_use() const;
  bool comes_back_later(bool is_before, const LabelUse& use);
  bool comes_back(bool is_before);
  Outcome look_up();

  BlockReader reader_;
  TextPlace at_;  ///< of the next block
  ReadingState state_;
  BlockParts parts_;
  std::uint64_t blocks_ = 0;
  std::int32_t tool_ = Block::kNone;  ///< being looked for
  Block definition_;
  std::bitset<256> undefined_;    ///< tools that were looked for in vain
  std::bitset<256> before_;       ///< labels in front of the place that is looked at
  std::bitset<256> is_sub_open_;  ///< and no LBL 0 between them and the place
  /// The same for the other labels, by their hashes: whether no LBL 0 is between them and the
  /// place. Two labels of one hash can only refuse a start.
  std::map<std::size_t, bool> later_before_;
  std::vector<std::int32_t> called_;    ///< programs looked up
  std::optional<std::int32_t> wanted_;  ///< to be looked up before the search continues
};

}  // namespace dripline::interpreter::tnc155
