#include <bitset>
#include <deque>
#include <set>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// No more programs are searched than these: the verdict is clear long before.
constexpr std::size_t kMaxLookedAt = 100;
constexpr std::int32_t kHighestPlainNumber = 999;
constexpr std::int32_t kHighestIsoNumber = 9999;

/// A program to be loaded.
struct Waiting {
  ProgramIndex program = kMainProgram;
  std::int32_t number = Block::kNone;  ///< as it is called; none of the one that is started
  std::uint64_t line = 0;  ///< of the started program, where it is called; 0 of that program itself
};

/// Loads a program and those it calls, one after the other, as if into the control's memory.
class Loading {
 public:
  Loading(const ControlOptions& options, ProgramSource& source)
      : options_(options), source_(source), memory_(MemoryLimits{.blocks = options.memory_blocks}) {
    waiting_.push_back({});
  }

  std::vector<Diagnostic> run() {
    while (!waiting_.empty()) {
      const Waiting next = waiting_.front();
      waiting_.pop_front();
      load(next);
    }
    return std::move(refused_);
  }

 private:
  void load(const Waiting& waiting) {
    program_ = StoredProgram{};
    program_.number = waiting.number;
    line_ = waiting.line;
    labels_.reset();
    has_wrong_number_ = false;
    read_blocks(waiting);
    if (auto stored = memory_.store(program_); !stored) {
      refuse(ErrorCode::MemoryExceeded, line_ == 0 ? 1 : line_, stored.error().what);
    }
  }

  /// Reads up to the end. Blocks that cannot be read are skipped: the run reports them.
  void read_blocks(const Waiting& waiting) {
    BlockReader reader(source_, {options_.iso_continuation, options_.version});
    TextPlace start;
    start.program = waiting.program;
    reader.seek(start);
    ReadingState state;
    BlockParts parts;
    while (true) {
      const ReadState read = reader.next(state, parts);
      const bool is_passed =
          read == ReadState::Wrong && state.program.form != Form::Unknown && reader.skip_wrong();
      if (read != ReadState::Ready && !is_passed) return;
      if (is_passed) parts.clear();
      program_.form = state.program.form;
      if (program_.number == Block::kNone) program_.number = state.program.number;
      if (++program_.blocks > MemoryLimits::kMaxCounted) return;
      const std::uint64_t line = line_ == 0 ? reader.block_place().line : line_;
      if (parts.count != 0) check_number(parts.blocks[0].number, line);
      for (const Block& block : parts) note(block, line);
      if (parts.count != 0 && parts.blocks[parts.count - 1].kind == BlockKind::End) return;
      reader.drop_window();  // looking for a called program may have used the source
    }
  }

  void note(const Block& block, std::uint64_t line) {
    switch (block.kind) {
      case BlockKind::Label:
        return note_label(block.target, line);
      case BlockKind::ProgramCall:
        return note_call(block.target, line);
      case BlockKind::CycleDefinition:
        if (block.cycle == kProgramCall && block.target != Block::kNone)
          note_call(block.target, line);
        return;
      default:
        return;
    }
  }

  void note_label(std::int32_t label, std::uint64_t line) {
    if (label <= 0 || static_cast<std::size_t>(label) >= labels_.size()) return;
    const auto index = static_cast<std::size_t>(label);
    if (labels_.test(index)) {
      refuse(ErrorCode::NumberAllocated, line, fmt::format("LBL {} is set twice", label));
    }
    labels_.set(index);
  }

  /// A missing program is reported by the run that calls it.
  void note_call(std::int32_t number, std::uint64_t line) {
    if (number == program_.number || called_.size() >= kMaxLookedAt) return;
    if (!called_.insert(number).second) return;
    const ProgramLookup lookup = source_.find(fmt::format("{}", number));
    if (lookup.state != ProgramLookup::State::Found) return;
    waiting_.push_back({lookup.program, number, line});
  }

  /// In memory plain language has three digits of a block number, ISO four.
  void check_number(std::int32_t number, std::uint64_t line) {
    const std::int32_t highest =
        program_.form == Form::Plain ? kHighestPlainNumber : kHighestIsoNumber;
    const bool is_counted = program_.blocks <= MemoryLimits{}.blocks_per_program;
    if (number <= highest || has_wrong_number_ || !is_counted) return;
    has_wrong_number_ = true;
    refuse(ErrorCode::BlockNumberOrder, line, fmt::format("{} is more than {}", number, highest));
  }

  void refuse(ErrorCode code, std::uint64_t line, std::string_view what) {
    const DiagnosticRow& row = error_row(code);
    std::string text(what);
    if (!text.starts_with(row.text)) text = fmt::format("{}: {}", row.text, text);
    if (line_ != 0) text += fmt::format(" (in program {}, which is called here)", program_.number);
    refused_.push_back({row.id, std::move(text), line, 0});
  }

  const ControlOptions& options_;
  ProgramSource& source_;
  ProgramMemory memory_;
  std::deque<Waiting> waiting_;
  std::set<std::int32_t> called_;
  std::vector<Diagnostic> refused_;

  // Of the program that is being loaded.
  StoredProgram program_;
  std::uint64_t line_ = 0;
  std::bitset<255> labels_;
  bool has_wrong_number_ = false;
};

}  // namespace

bool is_protected(std::string_view head) {
  MemorySource source(head);
  BlockReader reader(source);
  ReadingState state;
  BlockParts parts;
  if (reader.next(state, parts) != ReadState::Ready || parts.count == 0) return false;
  return parts.blocks[0].kind == BlockKind::Begin && parts.blocks[0].is_protected;
}

Result<MemoryVerdict> check_memory(const Setup& setup, ProgramSource& source) {
  const auto options = read_options(setup);
  if (!options) return fail(options.error());
  MemoryVerdict verdict;
  verdict.is_binding = options->memory_limits || !options->version.has(Feature::BlockwiseTransfer);
  verdict.refused = Loading(*options, source).run();
  if (verdict.is_binding) return verdict;
  for (Diagnostic& refused : verdict.refused) {
    refused.text += "; it can only be transferred blockwise";
  }
  return verdict;
}

}  // namespace dripline::interpreter::tnc155
