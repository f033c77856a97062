#include <fmt/format.h>
#include <charconv>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/edited_text.hpp"
#include "clients/cli/offline/form_conversion.hpp"
#include "clients/cli/offline/text_search_options.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using program_editing::BlockChange;
using program_editing::EditedProgram;
using program_editing::WordChange;
using program_editing::WordSearch;
using Texts = std::vector<std::pair<std::string, std::string>>;

struct EditCommand {
  EditedText::Place place;
  std::vector<std::string> deletions;
  Texts insertions, replacements;   ///< block numbers and text
  Texts copies, moves;              ///< block numbers, and the block that they come after
  Texts values;                     ///< block numbers and words
  Texts omissions, shortenings;     ///< block numbers and addresses
  std::vector<std::string> wanted;  ///< addresses that are looked for
  TextSearchOptions texts;
  std::optional<std::int32_t> increment;
  std::string setup;  ///< file with the control's options
  bool renumbers = false, protects = false, unprotects = false, is_trial = false;
};

/// "7", or "5..7". Errors: Syntax.
Result<BlockChange> numbers_of(std::string_view text, BlockChange::Kind kind) {
  const std::size_t dots = text.find("..");
  const std::string_view ends[] = {text.substr(0, dots),
                                   dots == std::string_view::npos ? text : text.substr(dots + 2)};
  std::int64_t numbers[2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    std::string_view digits = ends[i];
    if (digits.starts_with('N')) digits.remove_prefix(1);
    std::uint32_t number = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size()) {
      return fail(Errc::Syntax, "'{}' names no blocks: expected a number as 7, or several as 5..7",
                  text);
    }
    numbers[i] = number;
  }
  return BlockChange{kind, numbers[0], numbers[1], {}};
}

Result<std::vector<BlockChange>> changes_of(const EditCommand& command) {
  std::vector<BlockChange> changes;
  for (const auto& text : command.deletions) {
    auto change = numbers_of(text, BlockChange::Kind::Delete);
    if (!change) return fail(change.error());
    changes.push_back(*std::move(change));
  }
  for (const auto& [kind, texts] : {std::pair(BlockChange::Kind::Replace, &command.replacements),
                                    std::pair(BlockChange::Kind::Insert, &command.insertions)}) {
    for (const auto& [numbers, text] : *texts) {
      auto change = numbers_of(numbers, kind);
      if (!change) return fail(change.error());
      if (kind == BlockChange::Kind::Insert && change->first != change->last) {
        return fail(Errc::Syntax, "--insert-after {}: expected one block", numbers);
      }
      change->text = text;
      changes.push_back(*std::move(change));
    }
  }
  return changes;
}

Result<std::vector<WordChange>> word_changes_of(const EditCommand& command) {
  std::vector<WordChange> changes;
  for (const auto& [kind, option, texts] :
       {std::tuple(WordChange::Kind::Set, "--set", &command.values),
        std::tuple(WordChange::Kind::LeaveOut, "--leave-out", &command.omissions),
        std::tuple(WordChange::Kind::Shorten, "--shorten", &command.shortenings)}) {
    for (const auto& [number, word] : *texts) {
      const auto block = numbers_of(number, BlockChange::Kind::Replace);
      if (!block) return fail(block.error());
      if (block->first != block->last) {
        return fail(Errc::Syntax, "{} {}: expected one block", option, number);
      }
      changes.push_back({kind, block->first, word});
    }
  }
  return changes;
}

/// Only controls with numbered blocks have their words changed, and a mark for protection.
tl::unexpected<Error> no_block_editor(const EditedText& original) {
  return fail(Errc::Unsupported,
              "{}: its control keeps a program as lines, without numbers, words or protection of "
              "its own; choose another with --control",
              original.name());
}

/// A block whose words are changed is replaced.
Result<void> add_word_changes(const EditCommand& command, const EditedText& original,
                              std::vector<BlockChange>& changes) {
  const auto words = word_changes_of(command);
  if (!words) return fail(words.error());
  if (words->empty()) return {};
  if (original.editor() == nullptr) return no_block_editor(original);
  const auto replaced = original.editor()->change_words(original.text(), *words);
  if (!replaced) return fail(replaced.error());
  changes.insert(changes.end(), replaced->begin(), replaced->end());
  return {};
}

/// The blocks themselves, after another one.
Result<void> add_copies(const Texts& copies, bool moves, const EditedText& original,
                        std::vector<BlockChange>& changes) {
  for (const auto& [blocks, place] : copies) {
    const auto from = numbers_of(blocks, BlockChange::Kind::Delete);
    if (!from) return fail(from.error());
    auto to = numbers_of(place, BlockChange::Kind::Insert);
    if (!to) return fail(to.error());
    const std::string_view option = moves ? "--move" : "--copy";
    if (to->first != to->last)
      return fail(Errc::Syntax, "{} {} {}: expected one block to put them after", option, blocks,
                  place);
    if (moves && to->first >= from->first && to->first <= from->last)
      return fail(Errc::Syntax, "--move {} {}: block {} is moved itself", blocks, place, to->first);
    auto text = original.text_of(from->first, from->last);
    if (!text) return fail(text.error());
    to->text = *std::move(text);
    changes.push_back(*std::move(to));
    if (moves) changes.push_back(*from);
  }
  return {};
}

Result<EditedProgram> change_blocks(const EditCommand& command, const EditedText& original) {
  auto changes = changes_of(command);
  if (!changes) return fail(changes.error());
  for (const bool moves : {false, true}) {
    auto added = add_copies(moves ? command.moves : command.copies, moves, original, *changes);
    if (!added) return fail(added.error());
  }
  if (auto added = add_word_changes(command, original, *changes); !added)
    return fail(added.error());
  if (auto added = command.texts.add_changes(original, *changes); !added)
    return fail(added.error());
  if (changes->empty()) return EditedProgram{original.text(), {}, 0};
  return original.edited(*changes);
}

Result<void> change_all(const EditCommand& command, const EditedText& original,
                        EditedProgram& edited) {
  if (!command.renumbers && !command.protects && !command.unprotects) return {};
  const auto* editor = original.editor();
  if (editor == nullptr) return no_block_editor(original);
  if (command.renumbers) {
    const auto usual = block_increment_of(command.setup);
    if (!usual) return fail(usual.error());
    auto text = editor->renumber(edited.text, command.increment.value_or(*usual));
    if (!text) return fail(text.error());
    edited.text = *std::move(text);
  }
  if (command.protects || command.unprotects) {
    auto text = editor->protect(edited.text, command.protects);
    if (!text) return fail(text.error());
    edited.text = *std::move(text);
  }
  return {};
}

Result<EditedProgram> edited_program(const EditCommand& command, const EditedText& original) {
  const bool may_change = command.place.overrides_protection || command.unprotects;
  if (original.is_protected() && !may_change) {
    return fail(
        Errc::Conflict,
        "{} is protected against editing; --unprotect lifts that, --force edits it all the same",
        original.name());
  }
  auto edited = change_blocks(command, original);
  if (!edited) return edited;
  if (auto done = change_all(command, original, *edited); !done) return fail(done.error());
  return edited;
}

nlohmann::ordered_json edit_json(const EditedProgram& edited, const std::string& written) {
  nlohmann::ordered_json json{{"changes", nlohmann::ordered_json::array()},
                              {"renumbered", edited.renumbered},
                              {"written", nullptr}};
  for (const auto& change : edited.changes) {
    json["changes"].push_back({{"mark", std::string(1, change.mark)}, {"block", change.text}});
  }
  if (!written.empty()) json["written"] = written;
  return json;
}

std::string edit_text(Context& context, const EditedProgram& edited) {
  std::string text;
  for (const auto& [mark, block] : edited.changes) {
    text += styled(fmt::format("{}{}", mark, printable(block)),
                   mark == '+' ? Style::Good : Style::Bad, context.has_color()) +
            "\n";
  }
  if (edited.renumbered > 0) text += fmt::format("{} blocks renumbered\n", edited.renumbered);
  return text;
}

nlohmann::ordered_json block_json(const WordSearch::Found& found) {
  nlohmann::ordered_json json{{"block", nullptr}, {"line", found.line}, {"text", found.text}};
  if (found.block != program_editing::kNoNumber) json["block"] = found.block;
  return json;
}

nlohmann::ordered_json search_json(const WordSearch& search) {
  auto found = nlohmann::ordered_json::array(), unread = nlohmann::ordered_json::array();
  for (const auto& block : search.found) found.push_back(block_json(block));
  for (const auto& [block, reason] : search.unread) {
    unread.push_back(block_json(block));
    unread.back()["reason"] = reason;
  }
  return {{"blocks", std::move(found)}, {"unread", std::move(unread)}};
}

/// Lists the blocks that have a word with one of the addresses.
int show_found(Context& context, const EditCommand& command, const EditedText& original) {
  if (original.editor() == nullptr) return complain(no_block_editor(original).value());
  const auto search = original.editor()->search(original.text(), command.wanted);
  if (!search) return complain(search.error()), kExitNo;
  if (context.wants_json) {
    context.print(json_text(search_json(*search)));
  } else {
    std::string text;
    for (const auto& found : search->found) text += printable(found.text) + "\n";
    if (text.empty()) text = fmt::format("No block has {}.\n", fmt::join(command.wanted, " or "));
    context.print(text);
  }
  for (const auto& [block, reason] : search->unread) {
    complain(Error{Errc::Syntax, fmt::format("line {}, \"{}\" cannot be read: {}", block.line,
                                             printable(block.text), reason)});
  }
  return search->unread.empty() && !search->found.empty() ? kExitOk : kExitNo;
}

/// Errors: Syntax (nothing to do, or two things that do not go together).
Result<void> check_commands(const EditCommand& command) {
  const bool has_changes =
      !command.deletions.empty() || !command.insertions.empty() || !command.replacements.empty() ||
      !command.copies.empty() || !command.moves.empty() || !command.values.empty() ||
      !command.omissions.empty() || !command.shortenings.empty() || command.renumbers ||
      command.protects || command.unprotects || command.texts.changes();
  if (auto checked = command.texts.check(); !checked) return checked;
  if (!has_changes && command.wanted.empty() && !command.texts.finds()) {
    return fail(
        Errc::Syntax,
        "nothing to do: expected --delete, --replace, --insert-after, --copy, --move, --set, "
        "--leave-out, --shorten, --change, --renumber, --protect, --unprotect, --find or "
        "--find-text");
  }
  if (has_changes && !command.wanted.empty()) {
    return fail(Errc::Syntax, "--find only shows blocks: expected no changes beside it");
  }
  if (command.texts.finds() && (has_changes || !command.wanted.empty())) {
    return fail(Errc::Syntax,
                "--find-text only shows lines: expected no changes and no --find beside it");
  }
  if (command.place.file.empty() == command.place.program.empty()) {
    return fail(Errc::Syntax, "expected FILE or --program NAME, and not both");
  }
  return {};
}

int edit(Context& context, const EditCommand& command) {
  if (auto checked = check_commands(command); !checked) return complain(checked.error());
  EditedText original(context, command.place);
  if (!original.is_open()) return context.status;
  if (!command.wanted.empty()) return show_found(context, command, original);
  if (command.texts.finds()) return command.texts.show(context, original);
  const auto edited = edited_program(command, original);
  if (!edited) {
    complain(edited.error());
    return edited.error().code == Errc::Unsupported ? kExitUsage : kExitNo;
  }
  std::string written;
  if (!command.is_trial) {
    if (const int status = original.save(edited->text, written); status != kExitOk) return status;
  }
  if (context.wants_json) {
    context.print(json_text(edit_json(*edited, written)));
    return kExitOk;
  }
  context.print(edit_text(context, *edited));
  context.print(written.empty() ? "Nothing was written (--dry-run).\n"
                                : fmt::format("Wrote {}.\n", written));
  return kExitOk;
}

void add_place_options(Command command, EditedText::Place& place) {
  command.add_option("FILE", place.file, "NC program to edit in place");
  command.add_option("--program", place.program,
                     "Edit a program of the server; the change becomes its next revision");
  command.add_option("--control", place.control,
                     "Control of the program [detected from the text, or as the server has it]");
  command.add_option("-o,--output", place.output, "Write to this file, not in place");
  command.add_option("--comment", place.comment, "Say what changed; kept with the revision");
  command.add_flag("--force", place.overrides_protection,
                   "Edit even a program that is protected against editing");
}

void add_word_options(Command command, EditCommand& options) {
  command
      .add_option("--set", options.values,
                  "Set a word of a block: 4 F250, 4 \"IX+2.5\", 2 \"TOOL CALL 3\"")
      .type_name("BLOCK WORD")
      .allow_extra_args(false);
  command
      .add_option("--leave-out", options.omissions,
                  "Remove a word from a block; the value in force stays (NO ENT)")
      .type_name("BLOCK ADDRESS")
      .allow_extra_args(false);
  command
      .add_option("--shorten", options.shortenings,
                  "Remove a word of a block and all after it (END)")
      .type_name("BLOCK ADDRESS")
      .allow_extra_args(false);
  command
      .add_option("--find", options.wanted,
                  "List the blocks that have a word with this address: X, IX, F, \"TOOL CALL\"; Q "
                  "finds every use")
      .type_name("ADDRESS")
      .allow_extra_args(false);
}

}  // namespace

void add_edit_command(Command app, Context& context) {
  auto command = app.add_subcommand(
      "edit",
      "Edit a program: delete, replace, insert, copy, move and renumber blocks, change words");
  auto options = std::make_shared<EditCommand>();
  add_place_options(command, options->place);
  command.add_option("--delete", options->deletions, "Delete blocks: 7, or 5..7")
      .type_name("BLOCKS")
      .allow_extra_args(false);
  command.add_option("--replace", options->replacements, "Replace blocks by this text")
      .type_name("BLOCKS TEXT")
      .allow_extra_args(false);
  command
      .add_option("--insert-after", options->insertions,
                  "Insert text after a block; several lines are several blocks")
      .type_name("BLOCK TEXT")
      .allow_extra_args(false);
  command.add_option("--copy", options->copies, "Copy blocks after a block: 5..7 12")
      .type_name("BLOCKS BLOCK")
      .allow_extra_args(false);
  command.add_option("--move", options->moves, "Move blocks after a block: 5..7 12")
      .type_name("BLOCKS BLOCK")
      .allow_extra_args(false);
  add_word_options(command, *options);
  options->texts.add_to(command);
  auto renumber = command
                      .add_option("--renumber", options->increment,
                                  "Renumber all blocks as the control does; in ISO with this step, "
                                  "0: no numbers [block_increment of --setup, else 10]")
                      .expected(0, 1)
                      .check(in_range(0, 99))
                      .type_name("STEP");
  command.add_option("--setup", options->setup,
                     "TOML file with the options of the control (block_increment)");
  auto protects = command.add_flag("--protect", options->protects,
                                   "Protect the program against editing (P, G50)");
  command.add_flag("--unprotect", options->unprotects, "Remove that protection").excludes(protects);
  command.add_flag("--dry-run", options->is_trial, "Show the change without writing it");
  add_json_flag(command, context);
  command.footer(
      "All numbers are those before the edit. Blocks of a tnc155 program are named by block "
      "number;\n"
      "inserted text is read as the control reads it and written in its layout, and the blocks "
      "after\n"
      "it are renumbered. Words are named by their address as written in the block (X is not IX);\n"
      "values are set first, then words are removed. Blocks of other controls are named by line,\n"
      "and have no words, but --find-text and --change take any text of a line.\nThe changed "
      "blocks are shown; a file is replaced as a whole or not at "
      "all.\n\nExit status: 0 done, 1 the control or the server refused and nothing was changed, "
      "or "
      "--find\nor --find-text found nothing, 2 usage.\n\nExamples:\n  dnc edit 15.h --delete 5..7 "
      "--insert-after 9 \"L X+10 R0 F MAX M\"\n "
      " dnc edit 15.h --move 5..7 12\n  dnc edit 15.h --set 4 F250 --leave-out 5 M\n  dnc edit "
      "15.h --find \"TOOL CALL\"\n  dnc "
      "edit O0200 --change T0101 T0202 --whole-words --within 10..40\n  dnc "
      "edit --program 15.h --replace 4 \"TOOL CALL 2 Z S800\" --comment \"new tool\"");
  command.callback([&context, options, renumber] {
    options->renumbers = renumber.count() > 0;
    context.status = edit(context, *options);
  });
}

}  // namespace dripline::cli
