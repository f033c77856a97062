#include <map>
#include <memory>
#include <optional>

#include "clients/cli/measurements/measurement_input.hpp"
#include "clients/cli/measurements/picture_output.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "clients/tools/charts/measurement_chart.hpp"
#include "clients/tools/measurement_files/points.hpp"

namespace dripline::cli {
namespace {

constexpr const char* kUsualAxes = "XZ";
constexpr const char* kUsualX = "radius";

struct ReportChartCommand {
  std::string kind, nominal;
  MeasurementChoice choice;
  PictureOutput output;
  /// As parse_chart_request takes them; empty: not given.
  std::map<std::string, std::string> texts;
  std::vector<std::string> tool_changes;
  std::optional<double> lower, upper, magnification;
  std::string axes = kUsualAxes, x = kUsualX;
};

/// `axes`: two letters, of the first coordinate and of the second; diameters become radii.
Result<std::vector<charts::ContourPoint>> read_contour(const std::string& path,
                                                       const std::string& axes, bool is_diameter) {
  const auto file = MappedFile::open(path);
  if (!file) return fail(file.error());
  const auto points = measurement_files::read_points(file->text());
  if (!points) return fail(points.error().code, "{}: {}", path, points.error().what);
  const double first = is_diameter && axes[0] == 'X' ? 0.5 : 1;
  const double second = is_diameter && axes[1] == 'X' ? 0.5 : 1;
  std::vector<charts::ContourPoint> contour;
  for (const auto& point : *points) contour.push_back({point.x * first, point.y * second});
  return contour;
}

Result<charts::ProfilePicture> profile_of(const ReportChartCommand& command) {
  if (command.choice.file.empty() || command.nominal.empty()) {
    return fail(Errc::Syntax, "a profile needs a FILE of points and --nominal");
  }
  if (command.axes.size() != 2)
    return fail(Errc::Syntax, "--axes {}: two letters, as XZ", command.axes);
  const bool is_diameter = command.x == "diameter";
  if (is_diameter && command.axes.find('X') == std::string::npos)
    return fail(Errc::Syntax, "--x diameter: none of the axes {} is X", command.axes);
  auto actual = read_contour(command.choice.file, command.axes, is_diameter);
  if (!actual) return fail(actual.error());
  auto nominal = read_contour(command.nominal, command.axes, is_diameter);
  if (!nominal) return fail(nominal.error());
  return charts::ProfilePicture{.nominal = *std::move(nominal),
                                .actual = *std::move(actual),
                                .first_axis = command.axes.substr(0, 1),
                                .second_axis = command.axes.substr(1),
                                .lower = command.lower,
                                .upper = command.upper,
                                .magnification = command.magnification};
}

int draw_profile(const ReportChartCommand& command, const charts::ChartRequest& request) {
  const auto picture = profile_of(command);
  if (!picture) return complain(picture.error());
  const charts::Caption caption{request.title.empty() ? "Profile" : request.title, "", "mm"};
  return write_picture(command.output, request, [&](charts::Canvas& canvas) {
    return charts::draw_profile(canvas, *picture, caption);
  });
}

Result<void> add_tool_changes(const ReportChartCommand& command, charts::ChartRequest& request) {
  for (const std::string& text : command.tool_changes) {
    const auto time = parse_iso8601(text);
    if (!time) return fail(time.error());
    request.tool_changes.push_back(*time);
  }
  return {};
}

/// An option that a kind does not use is refused by its name.
Result<void> check_kind_options(const ReportChartCommand& command) {
  const auto is_given = [&](const char* name) { return !command.texts.at(name).empty(); };
  const auto& choice = command.choice;
  const bool is_chosen = !choice.query.characteristic.empty() || !choice.query.machine.empty() ||
                         !choice.query.run.empty() || !choice.tool.empty() ||
                         !choice.query.since.empty() || !choice.query.until.empty();
  constexpr const char* kControl = "individuals, xbar-r, xbar-s, ewma, cusum";
  struct Row {
    const char* option;
    bool is_given;
    const char* kinds;
  };
  for (const Row& row :
       {Row{"--nominal", !command.nominal.empty(), "profile"},
        Row{"--magnify", command.magnification.has_value(), "profile"},
        Row{"--axes", command.axes != kUsualAxes, "profile"},
        Row{"--x", command.x != kUsualX, "profile"},
        Row{"--tool-change", !command.tool_changes.empty(), "trend"},
        Row{"--shape", is_given("shape"), "histogram"},
        Row{"--confidence", is_given("confidence"), "histogram"},
        Row{"--lambda", is_given("lambda"), "ewma"}, Row{"--slack", is_given("slack"), "cusum"},
        Row{"--decision", is_given("decision"), "cusum"},
        Row{"--rules", is_given("rules"), kControl},
        Row{"--baseline", is_given("baseline"), kControl},
        Row{"--center", is_given("center"), kControl}, Row{"--sigma", is_given("sigma"), kControl},
        Row{"--limits-note", is_given("limits_note"), kControl}}) {
    const std::string_view kinds = row.kinds;
    if (!row.is_given || kinds.find(command.kind) != std::string_view::npos) continue;
    return fail(Errc::Syntax, "{} is for {}, not for {}", row.option, kinds, command.kind);
  }
  if (command.kind != "profile" || !is_chosen) return {};
  return fail(Errc::Syntax,
              "a profile has all points of its FILE: it takes no --machine, --since ...");
}

int draw_chart(Context& context, const ReportChartCommand& command) {
  if (const auto good = check_kind_options(command); !good) {
    complain(good.error());
    return kExitUsage;
  }
  std::map<std::string, std::string> texts;
  for (const auto& [name, text] : command.texts) {
    if (!text.empty()) texts[name] = text;
  }
  const bool is_profile = command.kind == "profile";
  if (!is_profile) texts["kind"] = command.kind;
  auto request = charts::parse_chart_request(texts);
  if (!request) return complain(request.error());
  if (is_profile) return draw_profile(command, *request);
  if (auto added = add_tool_changes(command, *request); !added) return complain(added.error());
  const auto source = open_measurements(context, command.choice);
  if (!source) return context.status;
  auto all = all_measurements(*source);
  if (!all) return complain(all.error());
  for (auto& m : *all) {
    if (command.lower) m.characteristic.lower = command.lower;
    if (command.upper) m.characteristic.upper = command.upper;
  }
  return write_picture(command.output, *request, [&](charts::Canvas& canvas) {
    return charts::draw_measurements(canvas, *all, *request);
  });
}

void add_limit_options(Command command, ReportChartCommand& options) {
  constexpr const char* kGroup = "Control charts";
  const auto add = [&](const char* option, const char* name, const char* help) {
    command.add_option(option, options.texts[name], help).group(kGroup);
  };
  add("--subgroup", "subgroup", "Values in a subgroup, which makes one point [1; X-bar: 5]");
  add("--rules", "rules", "limits, western_electric or nelson [limits]");
  add("--baseline", "baseline", "Compute the limits from the first so many values [all]");
  add("--center", "center", "Fix the center line; with --sigma");
  add("--sigma", "sigma", "Fix sigma of single values; with --center");
  add("--limits-note", "limits_note",
      "State who fixed the limits and why; it is part of the picture");
  add("--lambda", "lambda", "Weight lambda of the EWMA [0.2]");
  add("--slack", "slack", "Reference value k of the CUSUM, in sigma [0.5]");
  add("--decision", "decision", "Decision interval h of the CUSUM, in sigma [5]");
}

}  // namespace

void add_report_chart_command(Command group, Context& context) {
  auto command = group.add_subcommand(
      "chart", "Draw measured values: control chart, histogram, trend, profile");
  auto options = std::make_shared<ReportChartCommand>();
  command
      .add_option(
          "KIND", options->kind,
          "individuals, xbar-r, xbar-s, ewma, cusum, histogram, trend (by tool life) or profile")
      .required()
      .check(one_of(
          {"individuals", "xbar-r", "xbar-s", "ewma", "cusum", "histogram", "trend", "profile"}));
  command.add_option(
      "FILE", options->choice.file,
      "Measurements as CSV, JSON Lines, .dfq or an archive; points of a profile [the "
      "server's]");
  add_measurement_choice(command, options->choice);
  add_picture_output(command, options->output);
  command.add_option("--width", options->texts["width"], "Width, pixels [960]");
  command.add_option("--height", options->texts["height"], "Height, pixels [600]");
  command.add_option("--title", options->texts["title"], "Title [characteristic and machine]");
  command.add_option("--lower", options->lower,
                     "Lower limit; profile: of the deviation [as measured]");
  command.add_option("--upper", options->upper,
                     "Upper limit; profile: of the deviation [as measured]");
  add_limit_options(command, *options);
  command.add_option("--shape", options->texts["shape"],
                     "Histogram: normal, lognormal or empirical [normal]");
  command.add_option("--confidence", options->texts["confidence"],
                     "Histogram: confidence of the intervals [0.95]");
  command.add_option("--tool-change", options->tool_changes,
                     "Trend: a tool was changed at this time, UTC; may be repeated");
  command.add_option("--nominal", options->nominal,
                     "Profile: file with the points of the nominal contour");
  command.add_option("--magnify", options->magnification,
                     "Profile: magnify deviations so many times [a round number]");
  command.add_option("--axes", options->axes, "Profile: names of its two axes [XZ]");
  command
      .add_option("--x", options->x,
                  "Profile: what X is in both files, radius or diameter; deviations are those of "
                  "radii [radius]")
      .check(one_of({"radius", "diameter"}));
  command.footer(
      "A deviation of a profile is above 0 to the left of the nominal contour's "
      "direction.\n\nExamples:\n"
      "  dnc report chart individuals --machine lathe-1 --characteristic D40 --rules nelson -o "
      "d40.svg\n"
      "  dnc report chart histogram d40.csv -o d40.png --scale 2\n"
      "  dnc report chart profile points.csv --nominal contour.csv --lower -0.02 --upper 0.02 -o "
      "p.svg");
  command.callback([&context, options] { context.status = draw_chart(context, *options); });
}

}  // namespace dripline::cli
