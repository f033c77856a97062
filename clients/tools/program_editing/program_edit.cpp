#include "clients/tools/program_editing/program_edit.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "clients/tools/program_editing/tnc155/whole_program.hpp"
#include "protocol/base/lines.hpp"

namespace dripline::program_editing {

namespace {

/// The lines of a change that are not blank.
std::vector<std::string_view> entered_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") != std::string_view::npos) lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Collects the change of each block, then lists the steps in order.
class Plan {
 public:
  explicit Plan(std::span<const std::int64_t> numbers)
      : numbers_(numbers), dropped_(numbers.size(), false), entered_(numbers.size()) {}

  Result<void> add(const BlockChange& change) {
    const auto lines = entered_lines(change.text);
    if (change.kind != BlockChange::Kind::Delete && lines.empty()) {
      return fail(Errc::Syntax, "nothing is there to put in at block {}", change.first);
    }
    if (change.kind == BlockChange::Kind::Insert) return insert(change.first, lines);
    const auto range = find_blocks(numbers_, change.first, change.last);
    if (!range) return fail(range.error());
    if (auto dropped = drop(range->first, range->second); !dropped) return dropped;
    append(entered_[range->first].in_place, lines);
    return {};
  }

  std::vector<EditStep> steps() const {
    std::vector<EditStep> steps;
    for (const auto line : in_front_) steps.push_back({EditStep::Kind::Enter, 0, line});
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      steps.push_back({dropped_[i] ? EditStep::Kind::Drop : EditStep::Kind::Keep, i, {}});
      for (const auto line : entered_[i].in_place)
        steps.push_back({EditStep::Kind::Enter, i, line});
      for (const auto line : entered_[i].after) steps.push_back({EditStep::Kind::Enter, i, line});
    }
    return steps;
  }

 private:
  using Lines = std::vector<std::string_view>;
  struct Entered {
    Lines in_place;  ///< the lines of a block that is replaced
    Lines after;
  };

  static void append(Lines& to, const Lines& lines) {
    to.insert(to.end(), lines.begin(), lines.end());
  }

  Result<void> insert(std::int64_t number, const Lines& lines) {
    if (number == 0 && std::ranges::find(numbers_, 0) == numbers_.end()) {
      append(in_front_, lines);
      return {};
    }
    const auto place = find_block(numbers_, number);
    if (!place) return fail(place.error());
    append(entered_[*place].after, lines);
    return {};
  }

  Result<void> drop(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i <= last; ++i) {
      if (dropped_[i]) {
        return fail(Errc::Conflict, "block {} is taken out or replaced twice", numbers_[i]);
      }
      dropped_[i] = true;
    }
    return {};
  }

  std::span<const std::int64_t> numbers_;
  std::vector<bool> dropped_;
  std::vector<Entered> entered_;
  Lines in_front_;
};

tl::unexpected<Error> no_block(std::span<const std::int64_t> numbers, std::int64_t number) {
  std::optional<std::int64_t> lowest, highest;
  for (const std::int64_t there : numbers) {
    if (there < 0) continue;
    lowest = std::min(lowest.value_or(there), there);
    highest = std::max(highest.value_or(there), there);
  }
  if (!lowest) return fail(Errc::NotFound, "block {}: the program has no block numbers", number);
  return fail(Errc::NotFound, "block {} is not there: the program has blocks {} to {}", number,
              *lowest, *highest);
}

std::string without_end(std::string_view line) {
  return std::string(line.substr(0, line.find_last_not_of("\r\n") + 1));
}

std::vector<std::int64_t> numbers_of_lines(std::size_t count) {
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<std::int64_t>(i) + 1);
  return numbers;
}

}  // namespace

Result<std::size_t> find_block(std::span<const std::int64_t> numbers, std::int64_t number) {
  const auto found = std::ranges::find(numbers, number);
  if (number < 0 || found == numbers.end()) return no_block(numbers, number);
  if (std::find(found + 1, numbers.end(), number) != numbers.end()) {
    return fail(Errc::Conflict, "block {} occurs more than once: renumber first", number);
  }
  return static_cast<std::size_t>(found - numbers.begin());
}

Result<std::pair<std::size_t, std::size_t>> find_blocks(std::span<const std::int64_t> numbers,
                                                        std::int64_t first, std::int64_t last) {
  if (last < first)
    return fail(Errc::Syntax, "blocks {}..{}: the range runs backwards", first, last);
  const auto begin = find_block(numbers, first);
  if (!begin) return fail(begin.error());
  const auto end = find_block(numbers, last);
  if (!end) return fail(end.error());
  return std::pair(*begin, *end);
}

Result<std::vector<EditStep>> plan_edit(std::span<const std::int64_t> numbers,
                                        std::span<const BlockChange> changes) {
  Plan plan(numbers);
  for (const BlockChange& change : changes) {
    if (auto added = plan.add(change); !added) return fail(added.error());
  }
  return plan.steps();
}

Result<EditedProgram> edit_lines(std::string_view text, std::span<const BlockChange> changes) {
  const auto lines = lines_with_ends(text);
  const auto steps = plan_edit(numbers_of_lines(lines.size()), changes);
  if (!steps) return fail(steps.error());
  const std::string_view line_end = line_end_of(text);
  EditedProgram edited;
  for (const EditStep& step : *steps) {
    if (step.kind == EditStep::Kind::Drop) {
      edited.changes.push_back({'-', without_end(lines[step.block])});
      continue;
    }
    if (!edited.text.empty() && edited.text.back() != '\n') edited.text += line_end;
    if (step.kind == EditStep::Kind::Keep) {
      edited.text += lines[step.block];
      continue;
    }
    edited.text += step.entered;
    edited.text += line_end;
    edited.changes.push_back({'+', std::string(step.entered)});
  }
  return edited;
}

Result<std::string> text_of_lines(std::string_view text, std::int64_t first, std::int64_t last) {
  const auto lines = lines_with_ends(text);
  const auto range = find_blocks(numbers_of_lines(lines.size()), first, last);
  if (!range) return fail(range.error());
  std::string found;
  for (std::size_t i = range->first; i <= range->second; ++i) found += without_end(lines[i]) + "\n";
  return found;
}

std::string_view line_end_of(std::string_view text) {
  const std::size_t end = text.find('\n');
  return end != std::string_view::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

namespace {

constexpr std::array kEditors{ProgramEditor{.control = "tnc155",
                                            .protect = &with_protection,
                                            .edit = &edit_program,
                                            .text_of = &text_of_blocks,
                                            .change_words = &change_words,
                                            .search = &search_words,
                                            .renumber = &renumbered}};

}  // namespace

const ProgramEditor* find_program_editor(std::string_view control) {
  const auto found = std::ranges::find(kEditors, control, &ProgramEditor::control);
  return found == kEditors.end() ? nullptr : &*found;
}

}  // namespace dripline::program_editing
