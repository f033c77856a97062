#include "clients/tools/program_editing/program_editor.hpp"

#include <algorithm>
#include <array>

#include "clients/tools/program_editing/tnc155/tnc_editor.hpp"
#include "clients/tools/program_editing/tnc155/whole_program.hpp"

namespace dripline::program_editing {
namespace {

constexpr std::array kEditors{ProgramEditor{.control = "tnc155",
                                            .protect = &with_protection,
                                            .edit = &edit_program,
                                            .change_words = &change_words,
                                            .search = &search_words,
                                            .renumber = &renumbered}};

}  // namespace

const ProgramEditor* find_program_editor(std::string_view control) {
  const auto found = std::ranges::find(kEditors, control, &ProgramEditor::control);
  return found == kEditors.end() ? nullptr : &*found;
}

}  // namespace dripline::program_editing
