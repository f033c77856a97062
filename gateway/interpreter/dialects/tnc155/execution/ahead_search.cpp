#include "gateway/interpreter/dialects/tnc155/execution/ahead_search.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <functional>

#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

namespace dripline::interpreter::tnc155 {

AheadSearch::AheadSearch(ProgramSource& source, ReaderOptions options) : reader_(source, options) {}

void AheadSearch::begin() {
  at_ = TextPlace{};
  state_ = ReadingState{};
  blocks_ = 0;
}

/// Of an ISO program only the words are read: the run resolves them.
AheadSearch::Step AheadSearch::next() {
  reader_.seek(at_);
  const bool knew_form = state_.program.form != Form::Unknown;
  ReadState read = is_iso() ? reader_.next_words(state_) : reader_.next(state_, parts_);
  if (read == ReadState::Wrong && is_iso() && !knew_form) {
    reader_.seek(at_);
    read = reader_.next_words(state_);
  }
  switch (read) {
    case ReadState::Ready:
      at_ = reader_.place();
      ++blocks_;
      return Step::Read;
    case ReadState::NotYet:
      return Step::NotYet;
    case ReadState::Wrong:
      if (state_.program.form == Form::Unknown || !reader_.skip_wrong()) return Step::End;
      at_ = reader_.place();
      ++blocks_;
      return Step::Skipped;
    default:
      return Step::End;
  }
}

/// The last block of a program.
bool AheadSearch::is_over() const {
  if (!is_iso()) return parts_.blocks[0].kind == BlockKind::End;
  const IsoBlock& block = reader_.iso_block();
  return blocks_ > 1 && block.program != IsoBlock::kNone &&
         (block.has(IsoGroup::Unit) || block.program == state_.program.number);
}

bool AheadSearch::is_definition(std::int32_t number) {
  if (!is_iso()) {
    definition_ = parts_.blocks[0];
  } else {
    const IsoBlock& block = reader_.iso_block();
    if (!block.has_code(IsoGroup::Tool, 99)) return false;
    definition_.clear(BlockKind::ToolDefinition);
    definition_.target = block.tool;
    definition_.length = block.length;
    if (block.has(IsoSlot::R)) definition_.radius = block.value(IsoSlot::R);
  }
  return definition_.kind == BlockKind::ToolDefinition && definition_.target == number &&
         (definition_.length.is_programmed() || definition_.radius.is_programmed());
}

AheadSearch::Outcome AheadSearch::find_tool(std::int32_t number, std::uint64_t max_blocks) {
  const auto tool = static_cast<std::size_t>(number);
  if (undefined_.test(tool)) return Outcome::Missing;
  if (tool_ != number) begin();
  tool_ = number;
  reader_.drop_window();
  for (unsigned count = 0; count < kBlocksPerCall; ++count) {
    const Step step = next();
    if (step == Step::NotYet) return Outcome::NotYet;
    const bool is_found = step == Step::Read && is_definition(number);
    if (is_found || step == Step::End || blocks_ >= max_blocks ||
        (step == Step::Read && is_over())) {
      tool_ = Block::kNone;  // the next search starts from the beginning
      undefined_.set(tool, !is_found);
      return is_found ? Outcome::Found : Outcome::Missing;
    }
  }
  return Outcome::More;
}

std::int32_t AheadSearch::block_number() const {
  return is_iso() ? reader_.iso_block().number : parts_.blocks[0].number;
}

/// The program that the block read last calls; kNone: none.
std::int32_t AheadSearch::called_program() const {
  if (!is_iso()) {
    const Block& block = parts_.blocks[0];
    const bool calls = block.kind == BlockKind::ProgramCall ||
                       (block.kind == BlockKind::CycleDefinition && block.cycle == kProgramCall);
    return calls ? block.target : Block::kNone;
  }
  const IsoBlock& block = reader_.iso_block();
  if (blocks_ == 1) return Block::kNone;  // the program's own number
  if (block.has_code(IsoGroup::Cycle, 39)) return block.called_program;
  return block.has(IsoGroup::Unit) ? Block::kNone : block.program;
}

/// The use of labels in the block read last.
AheadSearch::LabelUse AheadSearch::label_use() const {
  LabelUse use;
  if (!is_iso()) {
    const Block& block = parts_.blocks[0];
    if (block.kind == BlockKind::Label) use.set = block.target;
    const bool jumps = block.kind == BlockKind::Function && block.function >= 9;
    const bool compares = block.kind == BlockKind::Comparison;
    if (block.kind == BlockKind::LabelCall || jumps || compares) use.used = block.target;
    use.returns = block.kind == BlockKind::LabelCall && block.repeats == Block::kNone;
    const std::int32_t label = std::max(use.set, use.used);
    const std::hash<std::string_view> hash;
    if (label > 255) use.later = hash(parts_.itnc.name) + static_cast<std::size_t>(label);
    return use;
  }
  const IsoBlock& block = reader_.iso_block();
  if (block.has(IsoGroup::Label)) {
    use.set = block.label;
  } else {
    use.used = block.label;
    use.returns = block.function == IsoBlock::kNone && block.repeats == IsoBlock::kNone;
  }
  return use;
}

/// With more labels than are kept it may lead back.
bool AheadSearch::comes_back_later(bool is_before, const LabelUse& use) {
  constexpr std::size_t kMost = 20'000;
  if (is_before) {
    if (use.set > 0 && later_before_.size() <= kMost) later_before_[use.later] = true;
    return false;
  }
  const auto at = later_before_.find(use.later);
  if (at == later_before_.end()) return use.used > 0 && later_before_.size() > kMost;
  return use.used > 0 && (!use.returns || at->second);
}

/// Notes the labels before the place; after it: the block leads back over it.
bool AheadSearch::comes_back(bool is_before) {
  const LabelUse use = label_use();
  if (use.later != 0) return comes_back_later(is_before, use);
  const auto is_label = [](std::int32_t label) { return label >= 0 && label < 256; };
  if (is_before) {
    if (use.set == 0) {
      is_sub_open_.reset();
      for (auto& [label, is_open] : later_before_) is_open = false;
    }
    if (use.set > 0 && is_label(use.set)) {
      before_.set(static_cast<std::size_t>(use.set));
      is_sub_open_.set(static_cast<std::size_t>(use.set));
    }
    return false;
  }
  if (!is_label(use.used)) return false;
  return (use.returns ? is_sub_open_ : before_).test(static_cast<std::size_t>(use.used));
}

AheadSearch::Outcome AheadSearch::find_return(const TextPlace& place) {
  reader_.drop_window();
  for (unsigned count = 0; count < kBlocksPerCall; ++count) {
    const Step step = next();
    if (step == Step::NotYet) return Outcome::NotYet;
    if (step == Step::End) return Outcome::Missing;
    if (step == Step::Skipped) continue;
    if (comes_back(reader_.block_place().offset < place.offset)) return Outcome::Found;
    if (is_over()) return Outcome::Missing;
  }
  return Outcome::More;
}

AheadSearch::Outcome AheadSearch::look_up() {
  const ProgramLookup lookup = reader_.find(fmt::format("{}", *wanted_));
  if (lookup.state == ProgramLookup::State::NotYet) return Outcome::NotYet;
  called_.push_back(*wanted_);
  wanted_.reset();
  return lookup.state == ProgramLookup::State::NotFound ? Outcome::Found : Outcome::Missing;
}

AheadSearch::Outcome AheadSearch::find_missing_program() {
  reader_.drop_window();
  while (blocks_ < kMaxBlocks && called_.size() < kMaxPrograms) {
    if (wanted_) {
      if (const Outcome outcome = look_up(); outcome != Outcome::Missing) return outcome;
    }
    const Step step = next();
    if (step == Step::NotYet) return Outcome::NotYet;
    if (step == Step::Skipped) continue;
    if (step == Step::End || is_over()) return Outcome::Missing;
    const std::int32_t number = called_program();
    const bool is_new = number != Block::kNone && number != state_.program.number &&
                        std::ranges::find(called_, number) == called_.end();
    if (is_new) wanted_ = number;
  }
  return Outcome::Missing;
}

}  // namespace dripline::interpreter::tnc155
