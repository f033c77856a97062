#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/measurements/measurement_input.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/studies/capability_study.hpp"
#include "clients/tools/studies/gauge_study_of.hpp"

namespace dripline::cli {
namespace {

using measurement::Measurement;
using nlohmann::ordered_json;
using statistics::Capability;
using statistics::GaugeResult;

struct CapabilityCommand {
  MeasurementChoice choice;
  std::optional<double> lower, upper;
  std::uint64_t subgroup = 1;
  double confidence = 0.95;
  std::string shape = "normal";
};

struct GaugeCommand {
  MeasurementChoice choice;
  std::string method = "anova";
  std::optional<double> tolerance;
};

std::string index_text(const std::optional<statistics::Index>& index) {
  if (!index) return "-";
  if (!index->interval) return fmt::format("{:.3f}", index->value);
  return fmt::format("{:.3f}  ({:.3f} to {:.3f})", index->value, index->interval->low,
                     index->interval->high);
}

void print_study(const Context& context, const studies::CapabilityStudy& study) {
  const Capability& c = study.capability;
  Details details;
  details.add("values", fmt::format("{}, mean {:.6g}, standard deviation {:.4g}", c.summary.count,
                                    c.summary.mean, c.summary.standard_deviation));
  const auto limit = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.10g}", *value) : std::string("none");
  };
  details.add("limits", fmt::format("{} to {} {}", limit(study.tolerance.lower),
                                    limit(study.tolerance.upper), printable(study.unit)));
  details.add("range", fmt::format("{:.6g} to {:.6g}", c.summary.minimum, c.summary.maximum));
  if (c.shape == statistics::Shape::Normal) {
    details.add("sigma within", fmt::format("{:.4g}, by {}", c.sigma_within, c.within_by));
    details.add("Cp", index_text(c.cp));
    details.add("Cpk", index_text(c.cpk));
  } else {
    details.add("percentiles", fmt::format("{:.6g}, {:.6g}, {:.6g}  (0.135 %, 50 %, 99.865 %, {})",
                                           c.percentiles.low, c.percentiles.median,
                                           c.percentiles.high, to_string(c.shape)));
  }
  details.add("Pp", index_text(c.pp));
  details.add("Ppk", index_text(c.ppk));
  details.add("outside", fmt::format("{} below, {} above; {:.3g} ppm expected", c.below, c.above,
                                     c.expected_outside));
  if (const auto& test = study.normality) {
    details.add("normal", fmt::format("Anderson-Darling A2 {:.3f}, p {:.3g}: {}", test->adjusted,
                                      test->p_value,
                                      test->p_value < 0.05 ? "not likely; see --shape" : "may be"));
  }
  if (!c.is_percentile_reached)
    details.add("note", "fewer than 741 values: the outer percentiles are the extremes");
  context.print(details);
}

int show_capability(Context& context, const CapabilityCommand& command) {
  const auto source = open_measurements(context, command.choice);
  if (!source) return context.status;
  const auto all = all_measurements(*source);
  if (!all) return complain(all.error());
  const auto shape = statistics::parse_shape(command.shape);
  if (!shape) return complain(shape.error());
  const auto found = studies::study_capability(
      *all, {command.lower, command.upper, {command.subgroup, command.confidence, *shape}});
  if (!found) return complain(found.error());
  if (context.wants_json) {
    context.print(json_text(studies::to_json(*found)));
  } else {
    print_study(context, *found);
  }
  return kExitOk;
}

void print_gauge(const Context& context, const GaugeResult& result) {
  Table table({"SOURCE", right("DEVIATION"), right("% STUDY"), right("% CONTRIBUTION")});
  const auto add = [&](const char* name, const statistics::Component& of) {
    table.add({name, fmt::format("{:.5f}", of.deviation), fmt::format("{:.2f}", of.study_percent),
               fmt::format("{:.2f}", of.contribution_percent)});
  };
  add("repeatability (EV)", result.repeatability);
  add("reproducibility (AV)", result.reproducibility);
  add("gauge R&R", result.gauge);
  add("parts (PV)", result.parts);
  context.print(table);
  context.print(fmt::format(
      "\nTotal {:.5f}; {} distinct categories{}\n", result.total, result.distinct_categories,
      result.tolerance_percent
          ? fmt::format("; R&R is {:.2f} % of the tolerance", *result.tolerance_percent)
          : ""));
}

int show_gauge(Context& context, const GaugeCommand& command) {
  const auto source = open_measurements(context, command.choice);
  if (!source) return context.status;
  const auto all = all_measurements(*source);
  if (!all) return complain(all.error());
  const auto method = studies::parse_gauge_method(command.method);
  if (!method) return complain(method.error());
  const auto result = studies::study_gauge(*all, *method, command.tolerance);
  if (!result) return complain(result.error());
  if (context.wants_json) {
    context.print(json_text(studies::to_json(*result)));
  } else {
    print_gauge(context, *result);
  }
  return kExitOk;
}

}  // namespace

void add_statistics_commands(Command group, Context& context) {
  auto command =
      group.add_subcommand("capability", "Compute Cp, Cpk, Pp and Ppk of measured values");
  auto options = std::make_shared<CapabilityCommand>();
  command.add_option("FILE", options->choice.file,
                     "Measurements as CSV, JSON Lines, .dfq or an archive [the server's]");
  add_measurement_choice(command, options->choice);
  command.add_option("--lower", options->lower, "Lower limit [as measured]");
  command.add_option("--upper", options->upper, "Upper limit [as measured]");
  command
      .add_option("--subgroup", options->subgroup,
                  "Values in a subgroup; sigma within is that of the subgroups [1: moving range]")
      .check(in_range(1, 100));
  command.add_option("--confidence", options->confidence, "Confidence of the intervals [0.95]")
      .check(in_range(0.5, 0.9999));
  command
      .add_option("--shape", options->shape,
                  "normal, lognormal or empirical (percentiles, ISO 22514-2) [normal]")
      .check(one_of({"normal", "lognormal", "empirical"}));
  add_json_flag(command, context);
  command.footer(
      "Intervals: Cp and Pp by chi-squared, Cpk and Ppk by Bissell.\n\nExample:\n"
      "  dnc report capability --machine lathe-1 --characteristic D40 --since 2026-11-01");
  command.callback([&context, options] { context.status = show_capability(context, *options); });

  auto gauge =
      group.add_subcommand("gauge", "Compute gauge R&R: repeatability and reproducibility (AIAG)");
  auto gauge_options = std::make_shared<GaugeCommand>();
  gauge.add_option("FILE", gauge_options->choice.file,
                   "CSV with the columns appraiser (or machine), part and value [the server's]");
  add_measurement_choice(gauge, gauge_options->choice);
  gauge.add_option("--method", gauge_options->method, "anova or ranges (average and range) [anova]")
      .check(one_of({"anova", "ranges"}));
  gauge
      .add_option("--tolerance", gauge_options->tolerance,
                  "Full width of the tolerance, upper minus lower limit")
      .check(positive_number());
  add_json_flag(gauge, context);
  gauge.footer(
      "Each appraiser measures each part the same number of times.\n\nExample:\n  dnc report gauge "
      "study.csv "
      "--tolerance 0.04");
  gauge.callback(
      [&context, gauge_options] { context.status = show_gauge(context, *gauge_options); });
}

}  // namespace dripline::cli
