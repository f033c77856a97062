#include <cstdint>

#include "clients/tools/program_editing/program_edit.hpp"
#include "clients/tools/program_editing/tnc155/block_words.hpp"
#include "clients/tools/program_editing/tnc155/cut_program.hpp"

/// Any text is edited word by word or refused: a word that gets the value it has leaves its block
/// as the control writes it, unless it is refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::program_editing;
  if (size > 1024) return 0;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string addresses[] = {"X", "Q", "F"};
  (void)search_words(text, addresses);
  const CutProgram program(text);
  for (const TextBlock& block : program.blocks()) {
    const std::string own = block.text();
    for (const BlockWord& word : words_of(own, program.form())) {
      const std::string typed = std::string(word.address) + std::string(word.value);
      const WordChange same{WordChange::Kind::Set, block.number, typed};
      const auto once = change_words(text, {&same, 1});
      const auto edited = once ? edit_program(text, *once) : EditedProgram{};
      if (!once || !edited || edited->changes.size() != 2) continue;
      const auto twice = change_words(edited->text, {&same, 1});
      if (twice && twice->front().text != once->front().text) __builtin_trap();
      for (const auto kind : {WordChange::Kind::LeaveOut, WordChange::Kind::Shorten}) {
        const WordChange out{kind, block.number, std::string(word.address)};
        (void)change_words(text, {&out, 1});
      }
    }
  }
  return 0;
}
