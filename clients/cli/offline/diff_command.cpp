#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/comparison_text.hpp"
#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/comparison/program_comparison.hpp"

namespace dripline::cli {
namespace {

using comparison::ProgramOptions;

struct DiffCommand {
  OfflineCommand first, second;
  bool by_motion = false, normalized = false;
  double tolerance = 0.001;
  unsigned context = 3;
};

/// Text of a file that is listed at most; a listing of more is no help, and is held in memory.
constexpr std::uint64_t kMaxListedLines = 200'000;

ProgramOptions options_of(const DiffCommand& command) {
  ProgramOptions options;
  if (command.normalized) options.by = ProgramOptions::By::Normalized;
  if (command.by_motion) options.by = ProgramOptions::By::Motion;
  options.motion.tolerance = command.tolerance;
  options.context = command.context;
  options.max_lines = kMaxListedLines;
  return options;
}

/// A file with its control, or by its text alone where no control fits and none is needed.
class DiffedFile {
 public:
  static Result<DiffedFile> open(const OfflineCommand& command, bool needs_control) {
    DiffedFile opened;
    auto program = OfflineProgram::open(command);
    if (program) {
      opened.program_.emplace(*std::move(program));
      return opened;
    }
    const bool is_text_enough = !needs_control && command.control.empty() && command.setup.empty();
    if (!is_text_enough || program.error().code != Errc::NotFound) return fail(program.error());
    auto file = MappedFile::open(command.file);
    if (!file) return fail(file.error());
    opened.file_.emplace(*std::move(file));
    return opened;
  }

  std::string_view text() const { return program_ ? program_->text() : file_->text(); }
  interpreter::MemorySource source() const {
    return program_ ? program_->source() : interpreter::MemorySource(text());
  }
  comparison::ProgramSide side(interpreter::ProgramSource& source) const {
    return {.source = source,
            .size = text().size(),
            .dialect = program_ ? &program_->dialect() : nullptr,
            .setup = program_ ? program_->setup() : interpreter::Setup{}};
  }

 private:
  std::optional<OfflineProgram> program_;
  std::optional<MappedFile> file_;
};

int diff(Context& context, const DiffCommand& command) {
  const bool needs_control = command.by_motion || command.normalized;
  auto first = DiffedFile::open(command.first, needs_control);
  if (!first) return complain(first.error());
  auto second = DiffedFile::open(command.second, needs_control);
  if (!second) return complain(second.error());
  auto first_source = first->source(), second_source = second->source();
  const auto result = comparison::compare_programs(
      first->side(first_source), second->side(second_source), options_of(command));
  if (!result) return complain(result.error());
  const nlohmann::ordered_json printed = *result;
  const std::string text = context.wants_json
                               ? json_text(printed)
                               : comparison_text(printed, {command.first.file, command.second.file},
                                                 context.has_color());
  const int written = write_to("-", text, context.wants_json ? Content::Data : Content::Text);
  return written == kExitOk ? comparison_status(printed) : written;
}

}  // namespace

void add_diff_command(Command app, Context& context) {
  auto command = app.add_subcommand("diff", "Compare two programs: their text, or what they do");
  auto options = std::make_shared<DiffCommand>();
  command.add_option("FIRST", options->first.file, "The program as it was")
      .required()
      .type_name("FILE");
  command.add_option("SECOND", options->second.file, "The program as it is")
      .required()
      .type_name("FILE");
  auto normalized =
      command.add_flag("--normalized", options->normalized,
                       "Ignore N numbers, comments, blanks, case and forms of numbers");
  command
      .add_flag("--motion", options->by_motion,
                "Interpret both and compare what they do: path, feeds, speeds, tools, outputs")
      .excludes(normalized);
  command
      .add_option("--tolerance", options->tolerance, "Distance of two paths that are the same, mm")
      .check(in_range(0.0, comparison::kMaxTolerance));
  command.add_option("--unified", options->context, "Lines of context around a change [3]")
      .type_name("N")
      .check(in_range(0u, 1000u));
  command.add_option("--control", options->first.control,
                     "Control of FIRST, and of SECOND (default: detected)");
  command.add_option("--setup", options->first.setup, "TOML file: setup of FIRST, and of SECOND");
  command.add_option("--second-control", options->second.control,
                     "Control of SECOND, where it is another one");
  command.add_option("--second-setup", options->second.setup,
                     "Setup of SECOND, where it is another one");
  add_json_flag(command, context);
  command.footer(
      "No server is needed. With --motion, called programs come from the setup's library, or from "
      "the file's\nfolder. The last line has the class of the edit: comment, same motion, feed and "
      "speed, offsets, geometry\nor other. What the comparison depends on (an alarm, a probe, a "
      "prompt, a variable from outside, a\nblock skip) is listed as a condition.\n\nExit status: 0 "
      "the same, 1 different, or the same on conditions only, 2 usage, unreadable file,\nunknown "
      "control.\n\nExample:\n  dnc diff --motion part.h part.nc --second-control rs274ngc");
  command.callback([&context, options] {
    auto chosen = *options;
    const bool has_own = !chosen.second.control.empty() || !chosen.second.setup.empty();
    if (chosen.second.control.empty()) chosen.second.control = chosen.first.control;
    if (chosen.second.setup.empty() && !has_own) chosen.second.setup = chosen.first.setup;
    context.status = diff(context, chosen);
  });
}

}  // namespace dripline::cli
