#include <algorithm>
#include <filesystem>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/form_conversion.hpp"
#include "clients/cli/offline/motion_conversion.hpp"
#include "clients/cli/offline/tape_conversion.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/lib/byte_source.hpp"
#include "clients/lib/output_file.hpp"
#include "clients/tools/lines/tape_listing.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

namespace dripline::cli {
namespace {

using wire::CharacterCode;
using wire::EndOfBlock;

struct ConvertCommand {
  std::string input, output, from = "auto", to = "ascii", end_of_block, title;
  std::optional<unsigned> leader, trailer;
  bool is_listing = false, has_no_rewind_stop = false, has_parentheses = false;
  bool refuses_comments = false, replaces_wrong = false, keeps_head = false, is_strict = false;
  bool has_decimal_point = false;
  bool has_to = false;
  std::optional<std::int32_t> increment;
  std::string setup;
  MotionConversion motion;
};

constexpr std::size_t kPiece = 64 * 1024;

const std::vector<std::pair<std::string, CharacterCode>> kCodes{
    {"ascii", CharacterCode::Ascii}, {"iso", CharacterCode::Iso}, {"eia", CharacterCode::Eia}};
const std::vector<std::pair<std::string, EndOfBlock>> kEndsOfBlock{{"lf", EndOfBlock::Lf},
                                                                   {"cr", EndOfBlock::Cr},
                                                                   {"crlf", EndOfBlock::CrLf},
                                                                   {"lfcr", EndOfBlock::LfCr},
                                                                   {"lfcrcr", EndOfBlock::LfCrCr}};

template <class Value>
Value value_of(const std::vector<std::pair<std::string, Value>>& values, std::string_view name) {
  return std::ranges::find(values, name, &std::pair<std::string, Value>::first)->second;
}

template <class Value>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, Value>>& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const auto& value : values) names.push_back(value.first);
  return names;
}

Result<CharacterCode> source_code(const ConvertCommand& command, client::FileSource& file) {
  if (command.from != "auto") return value_of(kCodes, command.from);
  std::string head(std::min<std::uint64_t>(file.size(), wire::kDetectionWindow), '\0');
  if (auto read = file.read(0, head); !read) return fail(read.error());
  const auto verdict = wire::detect_code(std::as_bytes(std::span(head)));
  if (!verdict) {
    return fail(verdict.error().code, "{}; name it with --from", verdict.error().what);
  }
  return verdict->code;
}

TapeConversion::Parts parts_of(const ConvertCommand& command, CharacterCode from) {
  TapeConversion::Parts parts;
  const auto to = value_of(kCodes, command.to);
  const bool is_tape = to != CharacterCode::Ascii;
  const auto end = is_tape ? "crlf" : "lf";
  parts.from = {from, from != CharacterCode::Ascii && !command.keeps_head, command.replaces_wrong,
                command.is_strict};
  parts.to.code = to;
  parts.to.end_of_block =
      value_of(kEndsOfBlock, command.end_of_block.empty() ? end : command.end_of_block);
  parts.to.leader = command.leader.value_or(is_tape ? 100 : 0);
  parts.to.trailer = command.trailer.value_or(is_tape ? 100 : 0);
  parts.to.title = command.title;
  parts.to.has_rewind_stop = is_tape && !command.has_no_rewind_stop;
  parts.to.has_parentheses = command.has_parentheses;
  parts.drops_comments =
      to == CharacterCode::Eia && !command.has_parentheses && !command.refuses_comments;
  return parts;
}

/// Calls `take` with one piece after the other, showing how far it is. False: interrupted.
template <class Take>
Result<bool> walk(client::FileSource& file, const std::string& label, Take take) {
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  Progress progress(area, clock, label);
  std::vector<char> buffer(kPiece);
  for (std::uint64_t at = 0; at < file.size();) {
    if (is_interrupted()) return false;
    const auto piece = std::span(buffer).first(std::min<std::uint64_t>(kPiece, file.size() - at));
    if (auto read = file.read(at, piece); !read) return fail(std::move(read.error()));
    if (auto taken = take(std::as_bytes(piece)); !taken) return fail(std::move(taken.error()));
    at += piece.size();
    progress.update(at, file.size());
  }
  return true;
}

int end_interrupted() {
  print_error("dnc: the conversion was ended; nothing was written\n");
  return kExitInterrupted;
}

int list(const ConvertCommand& command, CharacterCode code, client::FileSource& file) {
  StandardOutput output;
  wire::TapeListing listing(code);
  std::string text;
  const auto walked = walk(file, command.input, [&](std::span<const std::byte> piece) {
    text.clear();
    listing.list(piece, text);
    return output.write(text);
  });
  if (output.error()) return output.complain();
  if (!walked) return complain(walked.error());
  if (!*walked) return end_interrupted();
  text.clear();
  listing.finish(text);
  return output.write(text) ? kExitOk : output.complain();
}

/// Notes for the user about what was read and left out.
void say_notices(const ConvertCommand& command, const TapeConversion& conversion) {
  const auto& source = conversion.source();
  if (!source.lost_block.empty()) {
    print_error(
        "dnc: {}: no end of block before the first block: '{}' was skipped, as a control "
        "does; --keep-head keeps it\n",
        command.input, source.lost_block);
  }
  if (source.wrong > 0) {
    print_error("dnc: {}: {} rows became '?', the first: {}\n", command.input, source.wrong,
                source.first_wrong->what);
  }
  if (conversion.dropped_comments() > 0) {
    print_error("dnc: {} comments left out, EIA has no parentheses\n",
                conversion.dropped_comments());
  }
}

std::string summary_line(const ConvertCommand& command, CharacterCode from,
                         const TapeConversion& conversion) {
  const auto& source = conversion.source();
  std::string line = fmt::format("Converted {} ({}, {} rows) -> {} ({}): {} blocks", command.input,
                                 wire::code_name(from), source.rows, command.output,
                                 wire::code_name(value_of(kCodes, command.to)), source.blocks);
  if (source.deletes > 0) line += fmt::format(", {} deleted rows left out", source.deletes);
  return line + "\n";
}

/// A fault in the tape or the program is no misuse.
int complain_of_tape(const Error& error) {
  complain(error);
  return error.code == Errc::Io ? kExitUsage : kExitNo;
}

Error named(const ConvertCommand& command, const Error& error) {
  return {error.code, command.input + ": " + error.what};
}

struct Target {
  std::optional<client::OutputFile> file;
  StandardOutput standard;

  Result<void> write(std::string_view bytes) {
    return file ? file->write(bytes) : standard.write(bytes);
  }
};

int convert_to(Context& context, const ConvertCommand& command, CharacterCode from,
               client::FileSource& file) {
  Target target;
  if (command.output != "-") {
    auto output = client::OutputFile::create(command.output);
    if (!output) return complain(output.error());
    target.file.emplace(std::move(*output));
  }
  TapeConversion conversion(parts_of(command, from),
                            [&](std::string_view bytes) { return target.write(bytes); });
  if (auto begun = conversion.begin(); !begun) return complain(begun.error());
  auto walked = walk(file, command.input,
                     [&](std::span<const std::byte> piece) { return conversion.convert(piece); });
  if (walked && !*walked) return end_interrupted();
  auto done = walked ? conversion.finish() : Result<void>(fail(walked.error()));
  if (target.standard.error()) return target.standard.complain();
  if (done && target.file) done = target.file->commit();
  if (!done) return complain_of_tape(named(command, done.error()));
  say_notices(command, conversion);
  if (target.file) context.print(summary_line(command, from, conversion));
  return kExitOk;
}

/// Plain language is asked for, or ISO of a program in plain language.
bool is_between_forms(const ConvertCommand& command, client::FileSource& file) {
  if (command.is_listing || command.from != "auto") return false;
  if (command.to == "plain") return true;
  if (command.to != "iso") return false;
  std::string head(std::min<std::uint64_t>(file.size(), kPiece), '\0');
  return file.read(0, head) && is_plain_language(head);
}

int convert_between_forms(Context& context, const ConvertCommand& command,
                          client::FileSource& file) {
  if (command.output.empty()) {
    return complain(Error{Errc::Syntax, "convert needs -o FILE (or -o -)"});
  }
  if (!command.end_of_block.empty() && command.end_of_block != "lf" &&
      command.end_of_block != "crlf") {
    return complain(Error{Errc::Syntax, "--eob of a TNC program is lf or crlf"});
  }
  const FormConversion conversion{command.input,
                                  command.output,
                                  command.to == "plain",
                                  command.has_decimal_point,
                                  command.end_of_block == "lf",
                                  command.increment,
                                  command.setup};
  return convert_form(context, conversion, file);
}

/// The name of the output asks for the TNC's other form, and `--to` was not given: a copy would be
/// taken for the conversion.
Result<void> check_output_name(const ConvertCommand& command, client::FileSource& file) {
  if (command.has_to || command.is_listing || command.from != "auto") return {};
  const bool is_iso_name = command.output.ends_with(".i") || command.output.ends_with(".I");
  const bool is_plain_name = command.output.ends_with(".h") || command.output.ends_with(".H");
  if (!is_iso_name && !is_plain_name) return {};
  std::string head(std::min<std::uint64_t>(file.size(), kPiece), '\0');
  if (auto read = file.read(0, head); !read) return fail(read.error());
  using interpreter::tnc155::Form;
  const Form form = interpreter::tnc155::detect_form(head);
  const bool is_other = form == (is_iso_name ? Form::Plain : Form::Iso);
  if (!is_other) return {};
  return fail(Errc::Syntax,
              "{} is a TNC program in {} and {} is named as one in {}: --to {} converts it, --to "
              "ascii copies its text",
              command.input, is_iso_name ? "plain language" : "ISO", command.output,
              is_iso_name ? "ISO" : "plain language", is_iso_name ? "iso" : "plain");
}

/// To a control's language, from the motion.
int convert_to_control(Context& context, const ConvertCommand& command) {
  if (command.is_listing || command.from != "auto" || !command.end_of_block.empty()) {
    return complain(Error{Errc::Syntax, "--list, --from and --eob are for tapes, --to " +
                                            command.to + " is a control"});
  }
  MotionConversion conversion = command.motion;
  conversion.source.file = command.input;
  conversion.source.setup = command.setup;
  conversion.output = command.output;
  conversion.to = command.to;
  return convert_by_motion(context, conversion);
}

int convert(Context& context, const ConvertCommand& command) {
  if (is_motion_target(command.to)) return convert_to_control(context, command);
  auto file = client::FileSource::open(command.input);
  if (!file) return complain(file.error());
  if (is_between_forms(command, *file)) return convert_between_forms(context, command, *file);
  if (command.to == "plain") {
    return complain(Error{Errc::Syntax, "--to plain goes with neither --from nor --list"});
  }
  if (auto named_right = check_output_name(command, *file); !named_right) {
    return complain(named_right.error());
  }
  const auto from = source_code(command, *file);
  if (!from) return complain_of_tape(named(command, from.error()));
  catch_interrupts();
  if (command.is_listing) return list(command, *from, *file);
  if (command.output.empty()) {
    return complain(Error{Errc::Syntax, "convert needs -o FILE (or -o -), or --list"});
  }
  return convert_to(context, command, *from, *file);
}

void add_options(Command command, ConvertCommand& options) {
  auto codes = names_of(kCodes);
  command.add_option("IN", options.input, "Tape image or program text").required();
  command.add_option("-o,--output", options.output, "File to write; - for standard output");
  auto targets = codes;
  targets.push_back("plain");
  for (auto& target : motion_targets()) targets.push_back(std::move(target));
  command
      .add_option("--to", options.to,
                  "Write eia, iso, or ascii (program text; the default); for a TNC 151/155 "
                  "program: iso or plain; the name of a control: a program for it, from the motion "
                  "of IN")
      .check(one_of(targets));
  codes.push_back("auto");
  command.add_option("--from", options.from, "Read eia, iso, ascii, or auto (detected from IN)")
      .check(one_of(codes));
  command.add_flag("--list", options.is_listing, "List IN row by row with its holes, as text");
  command
      .add_option("--eob", options.end_of_block,
                  "Set the end of block of ISO and ASCII: lf, cr, crlf, lfcr, lfcrcr")
      .check(one_of(names_of(kEndsOfBlock)));
  command.add_option("--leader", options.leader,
                     "Punch this many blank rows in front, 10 to an inch [tapes: 100]");
  command.add_option("--trailer", options.trailer,
                     "Punch this many blank rows at the end [tapes: 100]");
  command.add_option("--title", options.title, "Punch a human-readable title into the leader");
  command.add_flag("--no-rewind-stop", options.has_no_rewind_stop,
                   "Omit the rewind stop before the first block");
  command.add_flag("--eia-parentheses", options.has_parentheses,
                   "Punch ( and ) in EIA as 1A and 4A, as some controls read them");
  command.add_flag("--refuse-comments", options.refuses_comments,
                   "Fail on comments, which EIA cannot carry, instead of leaving them out");
  command.add_flag("--keep-head", options.keeps_head,
                   "Read the text before the first end of block as a block");
  command.add_flag("--replace-wrong", options.replaces_wrong,
                   "Write '?' for rows that cannot be read, instead of an error");
  command.add_flag("--decimal-point", options.has_decimal_point,
                   "TNC programs: write a decimal point instead of the comma");
  command
      .add_option("--increment", options.increment,
                  "TNC programs: step of ISO block numbers, 0: no numbers [block_increment of "
                  "--setup, else 10]")
      .check(in_range(0, 99));
  command.add_option(
      "--setup", options.setup,
      "TOML file: setup of IN's control. TNC programs: its options (decimal_sign, "
      "iso_continuation, block_increment, model and software; what that control lacks is refused)");
  command.add_flag("--strict-blanks", options.is_strict, "Refuse blank tape inside an EIA block");
  add_motion_options(command, options.motion);
}

}  // namespace

void add_convert_command(Command app, Context& context) {
  auto command = app.add_subcommand(
      "convert",
      "Convert tape images between EIA, ISO and text, TNC programs between their forms, and any "
      "program to another control");
  auto options = std::make_shared<ConvertCommand>();
  add_options(command, *options);
  add_json_flag(command, context);
  command.footer(
      "No server is needed. A tape is read as a control reads it: nothing applies before the first "
      "end of block; deletes and blanks are left out.\n\nA program that begins with BEGIN PGM is "
      "plain language of a HEIDENHAIN TNC 151/155: --to iso makes it the control's ISO form "
      "(--from ascii: an ISO tape of the text), --to plain makes plain language of ISO. What has "
      "no counterpart in the other form is refused.\n\n--to CONTROL runs IN and writes its motion "
      "as a "
      "program of that control: absolute, cycles and subprograms executed, compensation resolved "
      "or, with --keep-compensation, kept. "
      "What the control does not have is refused with its line. The result is interpreted as that "
      "control does and compared with IN, action by action; a file that is not proved to do the "
      "same "
      "is not written. linuxcnc is rs274ngc with profile = \"linuxcnc\".\n\nExit status: 0 "
      "converted, 1 the tape or the "
      "program cannot be converted, 2 usage, unreadable file.\n\nExamples:\n  dnc convert "
      "shaft.ptp -o shaft.nc\n  dnc convert shaft.nc -o shaft.ptp --to eia --title SHAFT-4\n  dnc "
      "convert shaft.ptp --list | less\n  dnc convert plate.h -o plate.i --to iso\n  dnc convert "
      "plate.h -o plate.nc --to fanuc --name 1234");
  command.callback([&context, command, options] {
    options->has_to = command.get_option("--to").count() != 0;
    const std::string stray = given_motion_option(command);
    if (!stray.empty() && !is_motion_target(options->to)) {
      context.status = complain(Error{Errc::Syntax, stray + " goes with --to CONTROL"});
      return;
    }
    context.status = convert(context, *options);
  });
}

}  // namespace dripline::cli
