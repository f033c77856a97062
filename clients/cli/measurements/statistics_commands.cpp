#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/measurements/measurement_input.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/statistics/capability.hpp"
#include "clients/tools/statistics/gauge_study.hpp"
#include "clients/tools/statistics/normality.hpp"

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

ordered_json index_json(const std::optional<statistics::Index>& index) {
  if (!index) return nullptr;
  ordered_json json{{"value", index->value}, {"low", nullptr}, {"high", nullptr}};
  if (index->interval) {
    json["low"] = index->interval->low;
    json["high"] = index->interval->high;
  }
  return json;
}

/// The capability of the values, and whether they may be normal.
struct Study {
  Capability capability;
  std::optional<statistics::AndersonDarling> normality;  ///< absent: too few values
};

ordered_json study_json(const Study& study) {
  const Capability& c = study.capability;
  ordered_json json{{"count", c.summary.count},
                    {"mean", c.summary.mean},
                    {"standard_deviation", c.summary.standard_deviation},
                    {"minimum", c.summary.minimum},
                    {"maximum", c.summary.maximum},
                    {"shape", to_string(c.shape)},
                    {"sigma_within", c.sigma_within},
                    {"within_by", c.within_by},
                    {"confidence", c.confidence},
                    {"cp", index_json(c.cp)},
                    {"cpk", index_json(c.cpk)},
                    {"pp", index_json(c.pp)},
                    {"ppk", index_json(c.ppk)},
                    {"below", c.below},
                    {"above", c.above},
                    {"expected_outside_ppm", c.expected_outside},
                    {"percentiles", {c.percentiles.low, c.percentiles.median, c.percentiles.high}},
                    {"percentiles_reached", c.is_percentile_reached},
                    {"anderson_darling", nullptr}};
  if (const auto& test = study.normality) {
    json["anderson_darling"] = {
        {"statistic", test->statistic}, {"adjusted", test->adjusted}, {"p_value", test->p_value}};
  }
  return json;
}

void print_study(const Context& context, const Study& study) {
  const Capability& c = study.capability;
  Details details;
  details.add("values", fmt::format("{}, mean {:.6g}, standard deviation {:.4g}", c.summary.count,
                                    c.summary.mean, c.summary.standard_deviation));
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

Result<Study> study(const std::vector<Measurement>& all, const CapabilityCommand& command) {
  if (all.empty()) return fail(Errc::NotFound, "nothing was measured");
  std::vector<double> values;
  for (const Measurement& m : all) {
    if (m.characteristic.name != all.front().characteristic.name) {
      return fail(Errc::Conflict, "capability of {} and {}: choose one characteristic",
                  all.front().characteristic.name, m.characteristic.name);
    }
    values.push_back(m.actual);
  }
  const auto shape = statistics::parse_shape(command.shape);
  if (!shape) return fail(shape.error());
  const auto& of = all.back().characteristic;
  const statistics::Tolerance tolerance{command.lower ? command.lower : of.lower,
                                        command.upper ? command.upper : of.upper};
  const auto found =
      statistics::capability(values, tolerance, {command.subgroup, command.confidence, *shape});
  if (!found) return fail(found.error());
  Study result{*found, {}};
  if (const auto test = statistics::anderson_darling(values)) result.normality = *test;
  return result;
}

int show_capability(Context& context, const CapabilityCommand& command) {
  const auto source = open_measurements(context, command.choice);
  if (!source) return context.status;
  const auto all = all_measurements(*source);
  if (!all) return complain(all.error());
  const auto found = study(*all, command);
  if (!found) return complain(found.error());
  if (context.wants_json) {
    context.print(json_text(study_json(*found)));
  } else {
    print_study(context, *found);
  }
  return kExitOk;
}

Result<GaugeResult> judge_gauge(const std::vector<Measurement>& all, const GaugeCommand& command) {
  std::vector<statistics::GaugeReading> readings;
  readings.reserve(all.size());
  for (const Measurement& m : all) {
    readings.push_back({m.machine,
                        m.serial.empty() ? std::string_view(m.part) : std::string_view(m.serial),
                        m.actual});
  }
  const auto made = statistics::make_gauge_study(readings);
  if (!made) return fail(made.error());
  return command.method == "anova" ? statistics::gauge_anova(*made, command.tolerance)
                                   : statistics::average_and_range(*made, command.tolerance);
}

ordered_json gauge_json(const GaugeResult& result) {
  ordered_json json;
  const auto add = [&](const char* name, const statistics::Component& of) {
    json[name] = {{"deviation", of.deviation},
                  {"study_percent", of.study_percent},
                  {"contribution_percent", of.contribution_percent}};
  };
  add("repeatability", result.repeatability);
  add("reproducibility", result.reproducibility);
  add("gauge", result.gauge);
  add("parts", result.parts);
  json["total"] = result.total;
  json["distinct_categories"] = result.distinct_categories;
  json["tolerance_percent"] =
      result.tolerance_percent ? ordered_json(*result.tolerance_percent) : ordered_json(nullptr);
  json["interaction_kept"] = result.is_interaction_kept;
  return json;
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
  const auto result = judge_gauge(*all, command);
  if (!result) return complain(result.error());
  if (context.wants_json) {
    context.print(json_text(gauge_json(*result)));
  } else {
    print_gauge(context, *result);
  }
  return kExitOk;
}

}  // namespace

void add_statistics_commands(Command group, Context& context) {
  auto command =
      group.add_subcommand("capability", "Cp, Cpk, Pp, Ppk of measured values, with intervals");
  auto options = std::make_shared<CapabilityCommand>();
  command.add_option("FILE", options->choice.file,
                     "Measurements as CSV, JSON Lines or .dfq [the server's]");
  add_measurement_choice(command, options->choice);
  command.add_option("--lower", options->lower, "Lower limit [as stored]");
  command.add_option("--upper", options->upper, "Upper limit [as stored]");
  command
      .add_option("--subgroup", options->subgroup,
                  "Values measured together; sigma within is theirs [1]")
      .check(in_range(1, 100));
  command.add_option("--confidence", options->confidence, "Of the intervals [0.95]")
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

  auto gauge = group.add_subcommand("gauge", "Repeatability and reproducibility of a gauge (AIAG)");
  auto gauge_options = std::make_shared<GaugeCommand>();
  gauge.add_option("FILE", gauge_options->choice.file,
                   "CSV with the columns appraiser (or machine), part and value [the server's]");
  add_measurement_choice(gauge, gauge_options->choice);
  gauge.add_option("--method", gauge_options->method, "anova or ranges (average and range) [anova]")
      .check(one_of({"anova", "ranges"}));
  gauge.add_option("--tolerance", gauge_options->tolerance, "Full width of the tolerance")
      .check(positive_number());
  add_json_flag(gauge, context);
  gauge.footer(
      "Each appraiser measures each part equally often.\n\nExample:\n  dnc report gauge study.csv "
      "--tolerance 0.04");
  gauge.callback(
      [&context, gauge_options] { context.status = show_gauge(context, *gauge_options); });
}

}  // namespace dripline::cli
