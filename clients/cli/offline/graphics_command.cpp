#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/graphics_options.hpp"
#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/offline/turning_graphics.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/offline/offline_run.hpp"

namespace dripline::cli {
namespace {

using graphics::CuttingSimulation;
using graphics::HeightField;
using graphics::Picture;

constexpr std::size_t kUsualCells = 512;

Result<graphics::SimulationSettings> settings_of(const GraphicsCommand& command,
                                                 const interpreter::Setup& setup) {
  graphics::SimulationSettings settings;
  settings.tools = setup.tools;
  settings.start = setup.start;
  settings.cells_along = command.size.value_or(kUsualCells);
  settings.shows_helices = command.shows_helices;
  if (command.tool_radius > 0) {
    settings.tool_radius =
        command.is_inch ? Length::inch(command.tool_radius) : Length::mm(command.tool_radius);
  }
  if (command.blank.empty()) return settings;
  const auto ranges = parse_ranges(command.blank, command.is_inch);
  if (!ranges) return fail(ranges.error());
  settings.spindle = interpreter::axis_of(command.spindle.front());
  const auto blank = cuboid_of(*ranges, graphics::WorkFrame::of(*settings.spindle), std::nullopt);
  if (!blank) return fail(blank.error());
  settings.blank = *blank;
  return settings;
}

/// Position of a section, as a part of the shown width: the middle unless it was named.
double section_part(const AxisRanges& at, interpreter::Axis axis, double low, double high) {
  const auto& place = at.low[static_cast<std::size_t>(axis)];
  return place ? std::clamp((*place - low) / (high - low), 0.0, 1.0) : 0.5;
}

/// "X40,Y20": one place an axis; kept as ranges of no extent.
Result<AxisRanges> parse_section(const GraphicsCommand& command) {
  AxisRanges at;
  std::string_view text = command.section;
  while (!text.empty()) {
    const auto comma = text.find(',');
    const std::string part(text.substr(0, comma));
    const std::size_t axis = part.empty() ? 3 : std::string_view("XYZ").find(part.front());
    char* end = nullptr;
    const double place = axis < 3 ? std::strtod(part.c_str() + 1, &end) : 0;
    if (axis >= 3 || end == part.c_str() + 1 || *end != '\0') {
      return fail(Errc::Syntax, "--section \"{}\": expected an axis and a place, as X40", part);
    }
    at.low[axis] = place * (command.is_inch ? Length::kMillimetersPerInch : 1);
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return at;
}

Result<Picture> draw(const GraphicsCommand& command, const CuttingSimulation& simulation) {
  const HeightField& part = *simulation.part();
  if (command.view == "plan") return graphics::draw_plan(part, {command.shades});
  if (command.view == "planes") {
    const auto at = parse_section(command);
    if (!at) return fail(at.error());
    const auto& extent = part.extent();
    graphics::PlanesView view;
    view.arrangement =
        command.arrangement == "us" ? graphics::Arrangement::Us : graphics::Arrangement::Din;
    view.section_u = section_part(*at, simulation.frame().first, extent.low.u, extent.high.u);
    view.section_v = section_part(*at, simulation.frame().second, extent.low.v, extent.high.v);
    return graphics::draw_planes(part, view);
  }
  graphics::SolidView view{Angle::degrees(command.rotation), Angle::degrees(command.tilt)};
  view.width = std::clamp<std::size_t>(command.size.value_or(kUsualCells) * 3 / 2, 320, 4096);
  view.height = view.width * 3 / 4;
  return graphics::draw_solid(part, view);
}

nlohmann::ordered_json extent_json(const CuttingSimulation& simulation,
                                   const graphics::Cuboid& cuboid) {
  const graphics::WorkFrame& frame = simulation.frame();
  nlohmann::ordered_json json;
  const auto add = [&](interpreter::Axis axis, double low, double high) {
    json[std::string(1, letter(axis))] = {low, high};
  };
  add(frame.first, cuboid.low.u, cuboid.high.u);
  add(frame.second, cuboid.low.v, cuboid.high.v);
  add(frame.along, cuboid.low.w, cuboid.high.w);
  return json;
}

std::string heights_json(const CuttingSimulation& simulation) {
  const HeightField& part = *simulation.part();
  return nlohmann::ordered_json{
      {"units", "mm"},       {"extent", extent_json(simulation, part.extent())},
      {"cell", part.cell()}, {"columns", part.columns()},
      {"rows", part.rows()}, {"heights", part.heights()}}
      .dump();
}

Result<void> write_files(const GraphicsCommand& command, const interpreter::Setup& setup,
                         const CuttingSimulation& simulation) {
  if (!command.heights.empty()) {
    if (auto done = write_file(command.heights, heights_json(simulation)); !done) return done;
  }
  if (command.output.empty() && command.print.empty()) return {};
  const auto picture = draw(command, simulation);
  return picture ? write_picture(command, setup, *picture) : fail(picture.error());
}

const char* reason(graphics::Omission why) {
  switch (why) {
    case graphics::Omission::Helix:
      return "a helix; --helices draws it";
    case graphics::Omission::RotaryAxis:
      return "an axis besides X, Y and Z moves";
    case graphics::Omission::ToolAxis:
      return "the tool is not called along the axis of the blank";
    default:
      return "no tool was called, or it has no radius; --tool-radius or the setup give one";
  }
}

double removed_part(const CuttingSimulation& simulation) {
  const auto& extent = simulation.part()->extent();
  return simulation.part()->removed_volume() / (extent.width() * extent.depth() * extent.height());
}

void report(Context& context, const CuttingSimulation& simulation, const OfflineProgram& program,
            const interpreter::MemorySource& source) {
  const double removed = simulation.part()->removed_volume();
  if (context.wants_json) {
    auto omitted = nlohmann::ordered_json::array();
    for (const auto& section : simulation.omitted()) {
      omitted.push_back({{"line", section.origin.line},
                         {"moves", section.moves},
                         {"reason", reason(section.why)},
                         {"file", program.file_of(source, section.origin.program)}});
    }
    context.print(json_text({{"blank", extent_json(simulation, *simulation.blank())},
                             {"cuts", simulation.cuts()},
                             {"removed_mm3", removed},
                             {"removed_part", removed_part(simulation)},
                             {"omitted", std::move(omitted)}}));
    return;
  }
  context.print(fmt::format("{} cuts, {:.1f} cm3 removed ({:.1f} %)\n", simulation.cuts(),
                            removed / 1000, removed_part(simulation) * 100));
  for (const auto& section : simulation.omitted()) {
    print_error("dnc: PGM-SECTION CANNOT BE SHOWN: {}, {} moves: {}\n",
                program.place_of(source, section.origin.program, section.origin.line),
                section.moves, reason(section.why));
  }
}

Result<void> check_view(const GraphicsCommand& command) {
  for (const std::string_view known : {"", "solid", "plan", "planes"}) {
    if (command.view == known) return {};
  }
  return fail(Errc::Syntax, "--view {}: a milled part has solid, plan and planes", command.view);
}

/// The detail is a part of the blank, which the program alone may define: a first pass finds it.
Result<void> resolve_detail(const GraphicsCommand& command, const OfflineProgram& program,
                            graphics::SimulationSettings& settings) {
  if (command.detail.empty()) return {};
  const auto ranges = parse_ranges(command.detail, command.is_inch);
  if (!ranges) return fail(ranges.error());
  graphics::SimulationSettings coarse = settings;
  coarse.cells_along = 8;
  CuttingSimulation first(std::move(coarse));
  auto source = program.source();
  const auto run = interpreter::run_offline(program.dialect(), program.setup(), source, first);
  if (!run) return fail(run.error());
  if (!first.blank()) return {};
  const auto detail = cuboid_of(*ranges, first.frame(), first.blank());
  if (!detail) return fail(detail.error());
  settings.detail = *detail;
  return {};
}

int show_milled(Context& context, const GraphicsCommand& command, const OfflineProgram& opened) {
  const OfflineProgram* program = &opened;
  if (auto checked = check_view(command); !checked) return complain(checked.error());
  if (auto checked = check_tnc_graphics(command, *program); !checked) {
    return complain(checked.error());
  }
  auto settings = settings_of(command, program->setup());
  if (!settings) return complain(settings.error());
  if (auto done = resolve_detail(command, *program, *settings); !done)
    return complain(done.error());
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  const std::uint64_t size = program->text().size();
  std::optional<Progress> progress(std::in_place, area, clock, "cutting");
  settings->on_progress = [&](const interpreter::Origin& block) {
    progress->update(block.offset, size);
  };
  CuttingSimulation simulation(std::move(*settings));
  auto source = program->source();
  const auto outcome =
      interpreter::run_offline(program->dialect(), program->setup(), source, simulation);
  progress.reset();
  if (!outcome) return complain_offline(outcome.error());
  if (simulation.failure()) return complain(*simulation.failure());
  if (!simulation.part()) {
    // What it would have called may have its blank.
    if (outcome->alarm) {
      return complain(
          Error{Errc::NotFound,
                fmt::format("the program alarms in {}: {}; until then it defines no blank",
                            program->alarm_place(source, *outcome), outcome->alarm->text)});
    }
    return complain(Error{Errc::NotFound,
                          "the program defines no blank; give one: --blank X0:100,Y0:80,Z-20:0"});
  }
  auto written = write_files(command, program->setup(), simulation);
  if (!written) return complain(written.error());
  report(context, simulation, *program, source);
  if (!outcome->alarm) return kExitOk;
  complain(Error{Errc::Syntax,
                 fmt::format("the program alarms in {}: {}; what it cut until then is shown",
                             program->alarm_place(source, *outcome), outcome->alarm->text)});
  return kExitNo;
}

int show(Context& context, const GraphicsCommand& command) {
  const auto program = OfflineProgram::open(command.program);
  if (!program) return complain(program.error());
  const bool is_lathe = program->dialect().machine == interpreter::MachineKind::Lathe;
  return is_lathe ? show_turned(context, command, *program)
                  : show_milled(context, command, *program);
}

void add_turning_options(Command command, GraphicsCommand& options) {
  constexpr const char* kGroup = "Lathe programs";
  command
      .add_flag("--path", options.shows_path,
                "Draw the tool path over the part: feed green, rapid red, of a Centurion's G71 to "
                "G73 the finish pattern yellow")
      .group(kGroup);
  command
      .add_flag("--part-path", options.shows_part_path,
                "Draw a Centurion's part path yellow: as programmed, without nose compensation")
      .group(kGroup);
  command.add_flag("--limits", options.shows_limits, "Draw the setup's travel limits")
      .group(kGroup);
  command.add_flag("--zone", options.shows_zone, "Draw the setup's safe zone").group(kGroup);
  command
      .add_flag("--front-turret", options.has_front_turret,
                "Draw +X downwards, as a setup's front_turret does")
      .group(kGroup);
  command
      .add_option("--tool-width", options.tool_widths,
                  "Diameter of a drill, width of a grooving or parting tool, by offset, e.g. 5=10; "
                  "may be repeated")
      .group(kGroup);
  command
      .add_option("--insert", options.insert_degrees,
                  "Included angle of the insert, tool types 1 to 4 [55]")
      .check(in_range(10.0, 87.0))
      .group(kGroup);
}

void add_view_options(Command command, GraphicsCommand& options) {
  command
      .add_option("--view", options.view,
                  "Mill: solid, plan or planes (plan and two sections) [solid];\n"
                  "lathe: half (section above, outside below), full, section or path [half]")
      .check(one_of({"solid", "plan", "planes", "half", "full", "section", "path"}));
  command.add_option("--shades", options.shades, "Shades of depth in a plan: 5 or 17 [17]")
      .check(one_of_numbers({5, 17}));
  command
      .add_option("--arrangement", options.arrangement,
                  "Arrangement of planes: din (first angle) or us (third angle) [din]")
      .check(one_of({"din", "us"}));
  command.add_option("--section", options.section,
                     "Position of the section planes, e.g. X40,Y20 [middle]");
  command.add_option("--rotate", options.rotation,
                     "Rotate the solid view, degrees about the vertical [-30]");
  command.add_option("--tilt", options.tilt, "Tilt the solid view: 5 (front) to 90 (top) [35]")
      .check(in_range(5.0, 90.0));
  command.add_option("--magnify", options.detail,
                     "Draw only this part of the blank, e.g. X10:40,Y0:30");
  command.add_option("--size", options.size, "Cells along the longer side [512, lathe 1024]")
      .check(in_range(8, 4096));
}

}  // namespace

void add_graphics_command(Command app, Context& context) {
  auto command = app.add_subcommand("graphics", "Cut the blank with a program and draw the part");
  auto options = std::make_shared<GraphicsCommand>();
  add_offline_options(command, options->program);
  command.add_option("-o,--output", options->output, "Write the picture to this PNG file");
  command.add_option("--heights", options->heights,
                     "Write the surface as numbers to this JSON file");
  command.add_option("--hardcopy", options->print,
                     "Write the picture in the codes of a dot-matrix printer");
  command
      .add_option("--printer", options->printer,
                  "epson or ti-850 [that of the setup's MP 226 to 233, else epson]")
      .check(one_of({"epson", "ti-850"}));
  add_view_options(command, *options);
  add_turning_options(command, *options);
  command.add_option(
      "--blank", options->blank,
      "Blank in place of the program's own, e.g. X0:100,Y0:80,Z-20:0; on a lathe X are\n"
      "diameters, from a tube's bore or 0: X0:50,Z-80:0");
  command.add_option("--spindle", options->spindle, "Tool axis, with --blank [Z]")
      .check(one_of({"X", "Y", "Z"}));
  command
      .add_option("--tool-radius", options->tool_radius,
                  "Radius of tools that neither the program nor the setup describes")
      .check(positive_number());
  command.add_flag("--inch", options->is_inch,
                   "Read the lengths of this command as inches, not mm");
  command.add_flag("--helices", options->shows_helices,
                   "Draw helices too, which the TNC 155 leaves out");
  add_json_flag(command, context);
  command.footer(
      "No server is needed. A mill's cutter is a flat-ended cylinder, a lathe's tool has the nose "
      "and\n"
      "type of the setup's table; rapid moves cut too. A TNC whose setup names model and software\n"
      "shows what that control can show: no graphics on a TNC 151, a hardcopy from software 03.\n\n"
      "Exit status: 0 drawn, 1 the program alarms (drawn up to there), 2 usage or no blank.\n\n"
      "Example:\n  dnc graphics pocket.h -o pocket.png --view planes --section X40,Y25\n  dnc "
      "graphics shaft.nc --setup lathe.toml -o shaft.png --view half --path");
  command.callback([&context, options] { context.status = show(context, *options); });
}

}  // namespace dripline::cli
