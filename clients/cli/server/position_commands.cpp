#include "clients/cli/server/position_commands.hpp"

#include <fmt/core.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "clients/cli/offline/edited_text.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {
namespace {

struct PositionCommand {
  std::string machine;
  client::PositionToSet setting;
  std::uint64_t tool = 0;
  std::string axes;
  EditedText::Place into;             ///< program of the server, or none
  std::optional<std::int32_t> after;  ///< block of it
};

int set_position(Context& context, client::Client& client, const PositionCommand& command) {
  auto answer = client.set_position(command.machine, command.setting);
  if (!answer) return complain(answer.error());
  if (context.wants_json) {
    context.print(json_text(*answer));
  } else {
    context.print(fmt::format("{}: {}\n", command.machine, answer->text));
  }
  return kExitOk;
}

int touch_off(Context& context, client::Client& client, const PositionCommand& command) {
  PositionCommand of_tool = command;
  of_tool.setting.tool = command.tool;
  return set_position(context, client, of_tool);
}

/// Puts the block into the program that is being edited, as its control would.
int put_into(Context& context, const PositionCommand& command, const std::string& block) {
  const EditedText::Place& into = command.into;
  EditedText original(context, into);
  if (!original.is_open()) return context.status;
  if (original.is_protected()) {
    complain(Error{Errc::Conflict, fmt::format("{} is protected against editing: dnc edit "
                                               "--unprotect lifts that",
                                               into.program)});
    return kExitNo;
  }
  using program_editing::BlockChange;
  const BlockChange change{BlockChange::Kind::Insert, *command.after, *command.after, block};
  const auto edited = original.edited({&change, 1});
  if (!edited) return complain(edited.error()), kExitNo;
  std::string written;
  if (const int status = original.save(edited->text, written); status != kExitOk) return status;
  if (context.wants_json) {
    context.print(json_text({{"block", block}, {"written", written}}));
    return kExitOk;
  }
  for (const auto& [mark, text] : edited->changes)
    context.print(fmt::format("{}{}\n", mark, printable(text)));
  context.print(fmt::format("Wrote {}.\n", written));
  return kExitOk;
}

int play_back(Context& context, client::Client& client, const PositionCommand& command) {
  if (command.into.program.empty() == command.after.has_value())
    return complain(Error{Errc::Syntax, "--into PROGRAM and --after BLOCK belong together"});
  auto answer = client.play_back(command.machine, command.axes);
  if (!answer) return complain(answer.error());
  if (command.after) return put_into(context, command, answer->block);
  context.print(context.wants_json ? json_text(*answer) : answer->block + "\n");
  return kExitOk;
}

void add_setting_options(Command command, Context& context, PositionCommand& options) {
  command.add_option("AXIS", options.setting.axis, "Letter of the axis").required();
  command
      .add_option("VALUE", options.setting.value,
                  "The coordinate that the present position gets; X of a lathe is a diameter")
      .required();
  command
      .add_option("--unit", options.setting.unit,
                  "Unit of VALUE; needed unless it is 0. Rotary axes: degrees, without a unit")
      .check(one_of({"mm", "in", "deg"}));
  command.add_option("--offset", options.setting.offset,
                     "Work offset, e.g. G54; a TNC has one datum and takes none");
  add_json_flag(command, context);
}

}  // namespace

void add_position_verbs(Command group, Context& context) {
  constexpr std::string_view kCommon =
      "Nothing moves. It is refused while a run is active, while the axes move or their position "
      "is "
      "not known, and while\na shift, rotation, scaling or mirror image is in force. What is set "
      "is "
      "in the control's memory from then on\n(dnc memory show, dnc offset history); a restart of a "
      "run that was cut off before is refused after it.\nThe answer names the tool's length that "
      "was in force. It is refused where that is not certain: in the middle of a move\nwith which "
      "a length came into force, with a tilted tool, and a datum along an axis whose tool MDI has "
      "lost.\n\n";
  auto datum = group.add_subcommand("datum", "Set a datum from the machine's position");
  auto options = std::make_shared<PositionCommand>();
  datum.add_option("MACHINE", options->machine, "The machine").required();
  add_setting_options(datum, context, *options);
  datum.footer(fmt::format(
      "{}{}", kCommon,
      "Fanuc, RS274/NGC: every axis of a work offset. Centurion: its Z, to 0. TNC: every "
      "axis of its datum.\n\nExample:\n  dnc machine datum mill-1 X 12.5 --unit mm "
      "--offset G54"));
  run_at_server(datum, context, options, set_position);

  auto touch = group.add_subcommand("touch-off", "Set a tool's length from the machine's position");
  auto tool = std::make_shared<PositionCommand>();
  touch.add_option("MACHINE", tool->machine, "The machine").required();
  touch.add_option("TOOL", tool->tool, "Number of the tool, or of its offset")
      .required()
      .check(in_range(1, 99'999'999));
  add_setting_options(touch, context, *tool);
  touch.footer(fmt::format(
      "{}{}", kCommon,
      "VALUE is a coordinate of --offset. Mills: Z. Lathes: X and Z; the wear of that axis "
      "becomes 0. A TNC has the length in\nTOOL DEF of a program: see dnc machine "
      "playback. A machine of LinuxCNC or a board of the Grbl class does not move by\nlengths of "
      "tools: it is refused there.\n\nExample:\n  dnc machine touch-off lathe-1 3 X 40.02 --unit "
      "mm --offset G54"));
  run_at_server(touch, context, tool, touch_off);

  auto playback = group.add_subcommand(
      "playback", "Print the machine's position as the words of a block (TNC)");
  auto axes = std::make_shared<PositionCommand>();
  playback.add_option("MACHINE", axes->machine, "The machine").required();
  playback.add_option("AXES", axes->axes, "Letters of the axes, in the order of the block")
      .required();
  playback.add_option("--into", axes->into.program,
                      "Put the block into this program of the server; it becomes a revision");
  playback.add_option("--after", axes->after, "With --into: the block that it comes after")
      .check(in_range(0, 9'999'999));
  playback.add_option("--comment", axes->into.comment, "Say what changed; kept with the revision");
  add_json_flag(playback, context);
  playback.footer(
      "The actual position key of a TNC: coordinates of the datum in mm and degrees, without feed "
      "and M function. They contain the radius of the\ntool that was used, so its TOOL DEF has R "
      "0.\n\nExample:\n  dnc "
      "machine playback mill-3 XY\n  dnc machine playback mill-3 XY --into 15.h --after 4");
  run_at_server(playback, context, axes, play_back);
}

}  // namespace dripline::cli
