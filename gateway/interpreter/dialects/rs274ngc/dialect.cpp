#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/rs274ngc/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "gateway/interpreter/dialects/rs274ngc/interpreter.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"
#include "gateway/interpreter/dialects/rs274ngc/startup_code.hpp"

namespace dripline::interpreter {
namespace {

using namespace rs274ngc;

/// The free parameters that the setup gives are those that the control's file lists.
std::vector<int> listed_parameters(const Setup& setup) {
  std::vector<int> numbers;
  for (const VariableRecord& variable : setup.variables) {
    const std::size_t digits = variable.name.starts_with('#') ? 1 : 0;
    int number = 0;
    const char* end = variable.name.data() + variable.name.size();
    const auto read = std::from_chars(variable.name.data() + digits, end, number);
    if (read.ec == std::errc() && read.ptr == end) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

Result<std::unique_ptr<Interpreter>> make(const Setup& setup, ProgramSource& source,
                                          EventSink& sink) {
  auto options = read_options(setup);
  if (!options) return fail(options.error());
  State state;
  std::vector<Tool> tools;
  auto parameters = std::make_unique<Parameters>();
  if (auto loaded = load_memory(setup, *options, state, *parameters, tools); !loaded) {
    return fail(loaded.error());
  }
  if (auto begun = apply_startup_code(*options, state); !begun) return fail(begun.error());
  auto made = std::make_unique<Rs274NgcInterpreter>(std::move(*options), std::move(tools),
                                                    std::move(state), *parameters, source, sink);
  made->set_parameter_file(listed_parameters(setup));
  return std::unique_ptr<Interpreter>(std::move(made));
}

/// The text without blanks and comments, in capitals: marks are looked for in this.
std::string squeeze(std::string_view head) {
  std::string text;
  bool in_comment = false;
  for (const char c : head) {
    if (c == '(') in_comment = true;
    if (!in_comment && !is_blank(c)) text += upper(c);
    if (c == ')' || is_end_of_line(c)) in_comment = false;
  }
  return text;
}

bool has(std::string_view text, std::string_view mark) {
  return text.find(mark) != std::string_view::npos;
}

/// `O1 sub`, `O<name> call`: an O word with a word after it.
bool has_oword(std::string_view text) {
  for (const std::string_view word :
       {"SUB\n", "CALL", "WHILE[", "IF[", "REPEAT[", "DO\n", "ENDIF"}) {
    std::size_t at = text.find(word);
    for (; at != std::string_view::npos; at = text.find(word, at + 1)) {
      const std::size_t line = text.rfind('\n', at);
      const std::size_t begin = line == std::string_view::npos ? 0 : line + 1;
      if (begin < at && text[begin] == 'O') return true;
    }
  }
  return false;
}

int likelihood(std::string_view head, std::string_view file_name) {
  const std::string text = squeeze(head);
  for (const std::string_view foreign :
       {"BEGINPGM", "TOOLCALL", "GOTO", "DPRNT[", "POPEN", "THEN"}) {
    if (has(text, foreign)) return 0;
  }
  int points = 0;
  if (text.find_first_of("GXYZ") != std::string::npos) points += 10;
  if (file_name.ends_with(".ngc")) points += 60;
  if (has_oword(text)) points += 70;
  for (const std::string_view mark : {"#<", "G38.2", "G59.1", "G92.1", "G92.2", "G61.1", "G64P"}) {
    if (has(text, mark)) points += 25;
  }
  return std::min(points, 95);
}

constexpr std::array kStatusFields{status_field::kCompensation, status_field::kToolLengthX,
                                   status_field::kToolLengthZ,  status_field::kToolRadius,
                                   status_field::kWorkSystem,   status_field::kIncremental,
                                   status_field::kCycle};

}  // namespace

const Dialect kRs274NgcDialect{.name = "rs274ngc",
                               .title = "RS274/NGC (NIST, LinuxCNC)",
                               .likelihood = &likelihood,
                               .make = &make,
                               // The language's machine has a changer with slots (NIST 3.6, M6):
                               // only a machine without `tool_changer` stops for a tool change.
                               .mdi_blocks = 10,
                               .waits_at_tool_change = true,
                               .options = &list_options,
                               .text = {.has_diameter_codes = true},
                               .status_fields = kStatusFields,
                               .length_shifts_position = true,
                               .moves_with_length = true};

}  // namespace dripline::interpreter
