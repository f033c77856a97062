#include "clients/cli/offline/turning_graphics.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clients/cli/offline/graphics_options.hpp"
#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/graphics/turned_views.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/centurion/part_path.hpp"

namespace dripline::cli {
namespace {

using graphics::Frame;
using graphics::TurnedSection;
using graphics::TurningSimulation;
using interpreter::Axis;

constexpr std::size_t kX = 0, kZ = 2;  // of AxisRanges
constexpr std::size_t kUsualTurningCells = 1024;

/// X as diameters, as a lathe's programs have it.
Result<graphics::SectionExtent> bar_of(const AxisRanges& ranges) {
  if (!ranges.low[kX] || !ranges.low[kZ] || ranges.low[1]) {
    return fail(Errc::Syntax,
                "a bar needs X (diameters; from 0, or a tube's bore) and Z, as X0:50,Z-80:0");
  }
  return graphics::SectionExtent{*ranges.low[kZ], *ranges.high[kZ], *ranges.low[kX] / 2,
                                 *ranges.high[kX] / 2};
}

Result<std::pair<int, double>> parse_width(const std::string& text, bool is_inch) {
  const auto equals = text.find('=');
  int number = 0;
  double width = 0;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  if (equals != std::string::npos) {
    const auto left = std::from_chars(begin, begin + equals, number);
    const auto right = std::from_chars(begin + equals + 1, end, width);
    const bool is_read = left.ec == std::errc{} && left.ptr == begin + equals &&
                         right.ec == std::errc{} && right.ptr == end;
    if (is_read && number > 0 && width > 0 && std::isfinite(width))
      return std::pair(number, is_inch ? width * Length::kMillimetersPerInch : width);
  }
  return fail(Errc::Syntax, "--tool-width \"{}\": expected an offset and a width, as 5=10", text);
}

Result<graphics::TurningSettings> turning_settings_of(const GraphicsCommand& command,
                                                      const interpreter::Setup& setup) {
  graphics::TurningSettings settings;
  settings.tools = setup.tools;
  settings.start = setup.start;
  settings.cells_along = command.size.value_or(kUsualTurningCells);
  settings.insert_degrees = command.insert_degrees;
  for (const std::string& text : command.tool_widths) {
    const auto width = parse_width(text, command.is_inch);
    if (!width) return fail(width.error());
    settings.widths.insert_or_assign(width->first, width->second);
  }
  if (command.blank.empty()) return settings;
  const auto ranges = parse_ranges(command.blank, command.is_inch);
  if (!ranges) return fail(ranges.error());
  const auto bar = bar_of(*ranges);
  if (!bar) return fail(bar.error());
  settings.bar = *bar;
  return settings;
}

/// Two corners of the setup as a frame about the spindle's axis. Nothing when both are the same.
Result<std::optional<Frame>> frame_of(const interpreter::Options& options, std::string_view low,
                                      std::string_view high, double axis_x) {
  const auto from = options.position(low), to = options.position(high);
  if (!from) return fail(from.error());
  if (!to) return fail(to.error());
  const auto stored = options.choice("stored_x", {"radius", "diameter"}, 0);
  if (!stored) return fail(stored.error());
  const double scale = *stored == 1 ? 0.5 : 1;
  const auto corner = [&](const interpreter::Position& place) {
    return graphics::SectionPoint{place.linear(Axis::Z).mm(),
                                  place.linear(Axis::X).mm() * scale - axis_x};
  };
  const Frame frame{corner(*from), corner(*to)};
  const bool is_empty = frame.low.z == frame.high.z && frame.low.x == frame.high.x;
  return is_empty ? std::optional<Frame>() : std::optional<Frame>(frame);
}

Result<std::optional<Frame>> window_of(const GraphicsCommand& command, const TurnedSection* part) {
  if (command.detail.empty()) return std::optional<Frame>();
  const auto ranges = parse_ranges(command.detail, command.is_inch);
  if (!ranges) return fail(ranges.error());
  Frame frame;
  if (part != nullptr)
    frame = {{part->bar().z_low, -part->bar().x_high}, {part->bar().z_high, part->bar().x_high}};
  if (ranges->low[kZ])
    std::tie(frame.low.z, frame.high.z) = std::pair(*ranges->low[kZ], *ranges->high[kZ]);
  if (ranges->low[kX])
    std::tie(frame.low.x, frame.high.x) = std::pair(*ranges->low[kX] / 2, *ranges->high[kX] / 2);
  return std::optional<Frame>(frame);
}

/// `[control.machine] front_turret`, as true or 1.
bool is_front_turret(const interpreter::Options& options) {
  const auto* machine = options.find("machine");
  const auto* rows =
      machine == nullptr ? nullptr : std::get_if<interpreter::OptionTable>(&machine->value);
  if (rows == nullptr) return false;
  return std::any_of(rows->begin(), rows->end(), [](const interpreter::OptionEntry& row) {
    const auto* flag = std::get_if<bool>(&row.value.value);
    const auto* whole = std::get_if<std::int64_t>(&row.value.value);
    return row.key == "front_turret" && ((flag && *flag) || (whole && *whole != 0));
  });
}

Result<graphics::TurnedView> view_of(const GraphicsCommand& command,
                                     const interpreter::Setup& setup,
                                     const TurningSimulation& simulation) {
  using graphics::TurnedSide;
  graphics::TurnedView view;
  if (command.view == "full") view.above = TurnedSide::Outside;
  if (command.view == "section") view.below = TurnedSide::Section;
  if (command.view == "path") view.above = view.below = TurnedSide::Nothing;
  view.shows_part_path = command.shows_part_path;
  view.shows_path = command.shows_path || (command.view == "path" && !command.shows_part_path);
  view.has_front_turret = command.has_front_turret || is_front_turret(setup.control);
  view.width = std::clamp<std::size_t>(command.size.value_or(kUsualTurningCells), 320, 4096);
  const auto window = window_of(command, simulation.part() ? &*simulation.part() : nullptr);
  if (!window) return fail(window.error());
  view.window = *window;
  if (command.shows_limits) {
    const auto limits =
        frame_of(setup.control, "negative_limit", "positive_limit", simulation.axis_x());
    if (!limits) return fail(limits.error());
    view.limits = *limits;
  }
  if (command.shows_zone) {
    const auto zone =
        frame_of(setup.control, "negative_zone", "positive_zone", simulation.axis_x());
    if (!zone) return fail(zone.error());
    view.zone = *zone;
  }
  return view;
}

/// The contour as numbers: for each column of the section, its outer and inner radius.
std::string contour_json(const TurnedSection& part) {
  auto outer = nlohmann::ordered_json::array(), inner = nlohmann::ordered_json::array();
  for (std::size_t column = 0; column < part.columns(); ++column) {
    outer.push_back(part.outer(column));
    inner.push_back(part.inner(column));
  }
  return nlohmann::ordered_json{{"units", "mm"},
                                {"cell", part.cell()},
                                {"z", {part.bar().z_low, part.bar().z_high}},
                                {"outer_radius", std::move(outer)},
                                {"inner_radius", std::move(inner)}}
      .dump();
}

struct Drawing {
  const TurningSimulation& simulation;
  std::vector<graphics::PathPiece> part_path;
};

bool is_roughing(std::string_view cycle) {
  return cycle == "rough turning" || cycle == "rough facing" || cycle == "pattern repeat";
}

/// Interprets the program again, as its control draws the part path. Errors: as run_offline.
Result<std::vector<graphics::PathPiece>> part_path_of(const OfflineProgram& program,
                                                      graphics::TurningSettings settings) {
  const interpreter::Dialect dialect = interpreter::centurion::part_path_dialect();
  const interpreter::Interpreter* control = nullptr;
  settings.follows_pattern = [&control] { return is_roughing(control->modes().cycle); };
  settings.on_progress = nullptr;
  TurningSimulation simulation(std::move(settings));
  auto source = program.source();
  auto run = interpreter::OfflineRun::begin(dialect, program.setup(), source, simulation);
  if (!run) return fail(run.error());
  control = &run->interpreter();
  for (;;) {
    constexpr std::uint64_t kBlocks = 1'000'000;
    const auto is_over = run->step(kBlocks);
    if (!is_over) return fail(is_over.error());
    if (*is_over) return simulation.path();
  }
}

Result<void> write_turning_files(const GraphicsCommand& command, const interpreter::Setup& setup,
                                 const Drawing& drawing) {
  const TurningSimulation& simulation = drawing.simulation;
  const TurnedSection* part = simulation.part() ? &*simulation.part() : nullptr;
  if (!command.heights.empty()) {
    if (part == nullptr) return fail(Errc::NotFound, "without a bar there is no contour");
    if (auto done = write_file(command.heights, contour_json(*part)); !done) return done;
  }
  if (command.output.empty() && command.print.empty()) return {};
  const auto view = view_of(command, setup, simulation);
  if (!view) return fail(view.error());
  std::vector<graphics::PathPiece> path = simulation.path();
  path.insert(path.end(), drawing.part_path.begin(), drawing.part_path.end());
  const auto picture = graphics::draw_turned(part, path, *view);
  return picture ? write_picture(command, setup, *picture) : fail(picture.error());
}

void report(Context& context, const Drawing& drawing) {
  const TurningSimulation& simulation = drawing.simulation;
  const auto& part = simulation.part();
  const double left = part ? part->volume() : 0;
  const double removed = simulation.bar_volume() - left;
  if (context.wants_json) {
    nlohmann::ordered_json bar;
    if (part) {
      bar = {{"Z", {part->bar().z_low, part->bar().z_high}},
             {"diameter", {2 * part->bar().x_low, 2 * part->bar().x_high}}};
    }
    context.print(json_text({{"bar", std::move(bar)},
                             {"cuts", simulation.cuts()},
                             {"moves", simulation.path().size() + simulation.left_out()},
                             {"part_moves", drawing.part_path.size()},
                             {"removed_mm3", removed},
                             {"volume_mm3", left}}));
  } else if (part) {
    context.print(fmt::format("{} cuts, {:.1f} cm3 removed ({:.1f} %)\n", simulation.cuts(),
                              removed / 1000, removed / simulation.bar_volume() * 100));
  } else {
    context.print(fmt::format("{} moves, no bar\n", simulation.path().size()));
  }
  if (!context.wants_json && !drawing.part_path.empty())
    context.print(fmt::format("{} pieces of the part path\n", drawing.part_path.size()));
  if (simulation.left_out() > 0) {
    print_error("dnc: the last {} moves are not in the picture: at most {}\n",
                simulation.left_out(), TurningSimulation::kMaxPieces);
  }
}

Result<void> check_turning_view(const GraphicsCommand& command) {
  for (const std::string_view known : {"", "half", "full", "section", "path"}) {
    if (command.view == known) return {};
  }
  return fail(Errc::Syntax, "--view {}: a turned part has half, full, section and path",
              command.view);
}

}  // namespace

int show_turned(Context& context, const GraphicsCommand& command, const OfflineProgram& program) {
  if (auto checked = check_turning_view(command); !checked) return complain(checked.error());
  const bool has_part_path = program.dialect().name == interpreter::kCenturionDialect.name;
  if (command.shows_part_path && !has_part_path)
    return complain(Error{Errc::Unsupported, "--part-path: only a Centurion draws one"});
  auto settings = turning_settings_of(command, program.setup());
  if (!settings) return complain(settings.error());
  const graphics::TurningSettings part_settings = *settings;
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  const std::uint64_t size = program.text().size();
  std::optional<Progress> progress(std::in_place, area, clock, "turning");
  settings->on_progress = [&](const interpreter::Origin& block) {
    progress->update(block.offset, size);
  };
  TurningSimulation simulation(std::move(*settings));
  auto source = program.source();
  const auto outcome =
      interpreter::run_offline(program.dialect(), program.setup(), source, simulation);
  progress.reset();
  if (!outcome) return complain_offline(outcome.error());
  if (simulation.failure()) return complain(*simulation.failure());
  if (!simulation.part() && command.view != "path") {
    return complain(Error{Errc::NotFound,
                          "the program defines no bar (P156 its length, P157 its diameter); give "
                          "one: --blank X0:50,Z-80:0, or draw --view path"});
  }
  simulation.finish();
  Drawing drawing{simulation, {}};
  if (has_part_path && (command.shows_part_path || command.shows_path || command.view == "path")) {
    auto part_path = part_path_of(program, part_settings);
    if (!part_path) return complain_offline(part_path.error());
    drawing.part_path = std::move(*part_path);
  }
  if (auto written = write_turning_files(command, program.setup(), drawing); !written)
    return complain(written.error());
  report(context, drawing);
  if (!outcome->alarm) return kExitOk;
  complain(Error{Errc::Syntax,
                 fmt::format("the program alarms in {}: {}; what it cut until then is shown",
                             program.alarm_place(source, *outcome), outcome->alarm->text)});
  return kExitNo;
}

}  // namespace dripline::cli
