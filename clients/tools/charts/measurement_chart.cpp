#include "clients/tools/charts/measurement_chart.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "clients/tools/charts/svg_canvas.hpp"
#include "clients/tools/statistics/chart_constants.hpp"

namespace dripline::charts {
namespace {

using measurement::Measurement;

std::vector<double> values_of(std::span<const Measurement> measurements) {
  std::vector<double> values;
  values.reserve(measurements.size());
  for (const Measurement& m : measurements) values.push_back(m.actual);
  return values;
}

Result<void> check_numbers(std::span<const Measurement> measurements) {
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto& of = measurements[i].characteristic;
    const std::pair<const char*, std::optional<double>> numbers[]{{"value", measurements[i].actual},
                                                                  {"nominal value", of.nominal},
                                                                  {"lower limit", of.lower},
                                                                  {"upper limit", of.upper}};
    for (const auto& [name, number] : numbers) {
      if (!number || std::abs(*number) <= kMaxMagnitude) continue;
      return check_magnitude(
          fmt::format("{} {} of {}: {}", of.name.empty() ? "measurement" : of.name, i + 1,
                      measurements.size(), name),
          *number);
    }
  }
  return {};
}

Result<void> check_one_characteristic(std::span<const Measurement> measurements) {
  if (measurements.empty()) return fail(Errc::LimitExceeded, "a chart of no measurement");
  const auto& first = measurements.front().characteristic;
  for (const Measurement& m : measurements) {
    if (m.characteristic.name != first.name) {
      return fail(Errc::Conflict, "a chart of {} and {}: choose one characteristic", first.name,
                  m.characteristic.name);
    }
    if (m.characteristic.unit != first.unit) {
      return fail(Errc::Conflict, "characteristic {} in {} and in {}", first.name, first.unit,
                  m.characteristic.unit);
    }
  }
  return check_numbers(measurements);
}

std::string day_text(UtcTime time) {
  return to_iso8601(time).substr(0, 10);
}
std::string minute_text(UtcTime time) {
  std::string text = to_iso8601(time).substr(0, 16);
  text[10] = ' ';
  return text;
}

Caption caption_of(std::span<const Measurement> measurements, const ChartRequest& request) {
  const Measurement& first = measurements.front();
  const Measurement& last = measurements.back();
  Caption caption;
  caption.unit = first.characteristic.unit;
  caption.title = request.title;
  if (caption.title.empty()) {
    caption.title =
        first.characteristic.name.empty() ? "Measured values" : first.characteristic.name;
    if (!first.machine.empty()) caption.title += " on " + first.machine;
  }
  if (last.time > UtcTime{}) {
    caption.subtitle = minute_text(first.time) + " to " + minute_text(last.time) + " UTC";
  }
  if (!first.program.empty()) {
    caption.subtitle += (caption.subtitle.empty() ? "program " : ", program ") + first.program;
  }
  return caption;
}

/// The newest limits: what the next part is judged by.
statistics::Tolerance tolerance_of(const Measurement& m) {
  return {m.characteristic.lower, m.characteristic.upper};
}

Result<statistics::Baseline> baseline_of(std::span<const Measurement> measurements,
                                         std::span<const double> values,
                                         const ChartRequest& request) {
  if (request.center || request.sigma) {
    if (request.center && request.sigma) {
      return statistics::fixed_baseline(*request.center, *request.sigma, request.limits_note);
    }
    return fail(Errc::Conflict, "fixed limits need both, a center and a sigma");
  }
  const std::size_t count =
      request.baseline == 0 ? measurements.size() : std::min(request.baseline, measurements.size());
  return statistics::estimate_baseline(values.first(count), request.settings.kind,
                                       request.settings.subgroup,
                                       source_text(measurements.first(count)));
}

Result<void> draw_control(Canvas& canvas, std::span<const Measurement> measurements,
                          const ChartRequest& request) {
  const auto values = values_of(measurements);
  const auto baseline = baseline_of(measurements, values, request);
  if (!baseline) return fail(baseline.error());
  const auto chart = statistics::make_control_chart(values, *baseline, request.settings);
  if (!chart) return fail(chart.error());
  draw_control_chart(canvas, *chart, caption_of(measurements, request));
  return {};
}

Result<void> draw_cells(Canvas& canvas, std::span<const Measurement> measurements,
                        const ChartRequest& request) {
  if (auto one = measurement::check_one_tolerance(measurements, measurement::Limits::All); !one)
    return one;
  const auto values = values_of(measurements);
  auto histogram = statistics::make_histogram(values);
  if (!histogram) return fail(histogram.error());
  HistogramPicture picture{.histogram = *std::move(histogram),
                           .summary = statistics::summarize(values),
                           .tolerance = tolerance_of(measurements.back()),
                           .nominal = measurements.back().characteristic.nominal,
                           .capability = {}};
  // Too few values, or values without variation, have a histogram all the same.
  if (const auto found = statistics::capability(values, picture.tolerance, request.capability)) {
    picture.capability = *found;
  }
  draw_histogram(canvas, picture, caption_of(measurements, request));
  return {};
}

std::vector<ToolLife> lives_of(std::span<const Measurement> measurements,
                               const std::vector<UtcTime>& changes) {
  std::vector<ToolLife> lives;
  const Measurement* before = nullptr;
  for (const Measurement& m : measurements) {
    const bool is_changed = before != nullptr && std::ranges::any_of(changes, [&](UtcTime at) {
                              return before->time < at && at <= m.time;
                            });
    if (before == nullptr || is_changed || m.tool != before->tool) {
      const std::string name = m.tool.empty() ? "tool" : m.tool;
      lives.push_back({fmt::format("{} {}", name, day_text(m.time)), {}});
    }
    auto& points = lives.back().points;
    points.push_back({static_cast<double>(points.size() + 1), m.actual});
    before = &m;
  }
  return lives;
}

void draw_lives(Canvas& canvas, std::span<const Measurement> measurements,
                const ChartRequest& request) {
  draw_trend(canvas,
             {.lives = lives_of(measurements, request.tool_changes),
              .tolerance = tolerance_of(measurements.back()),
              .nominal = measurements.back().characteristic.nominal},
             caption_of(measurements, request));
}

/// Takes texts out of a query; what is left over is not known.
class Texts {
 public:
  explicit Texts(const std::map<std::string, std::string>& texts) : left_(texts) {}
  std::optional<std::string> text(const std::string& name) {
    const auto found = left_.find(name);
    if (found == left_.end()) return std::nullopt;
    std::string value = std::move(found->second);
    left_.erase(found);
    return value;
  }
  std::optional<double> number(const std::string& name, double low, double high) {
    const auto found = text(name);
    if (!found) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(found->data(), found->data() + found->size(), value);
    if (error != std::errc() || end != found->data() + found->size() || !std::isfinite(value)) {
      note({Errc::Syntax, fmt::format("{} '{}' is no number", name, *found)});
    } else if (value < low || value > high) {
      note({Errc::LimitExceeded,
            fmt::format("{} {}: {} to {} are possible", name, value, low, high)});
    }
    return value;
  }
  template <class T>
  void take(const Result<T>& parsed, T& into) {
    if (parsed) {
      into = *parsed;
    } else {
      note(parsed.error());
    }
  }
  Result<void> finish() {
    if (!error_ && !left_.empty())
      return fail(Errc::Syntax, "a chart has no '{}'", left_.begin()->first);
    if (error_) return fail(*error_);
    return {};
  }

 private:
  void note(Error error) {
    if (!error_) error_ = std::move(error);
  }
  std::map<std::string, std::string> left_;
  std::optional<Error> error_;
};

void read_settings(Texts& texts, ChartRequest& request) {
  auto& settings = request.settings;
  if (const auto rules = texts.text("rules"))
    texts.take(statistics::parse_rule_set(*rules), settings.rules);
  const double usual_subgroup = statistics::is_mean_chart(settings.kind) ? 5 : 1;
  settings.subgroup = static_cast<std::size_t>(
      texts.number("subgroup", 1, statistics::kMaxSubgroup).value_or(usual_subgroup));
  settings.ewma_weight = texts.number("lambda", 0.001, 1).value_or(settings.ewma_weight);
  settings.cusum_slack = texts.number("slack", 0, 10).value_or(settings.cusum_slack);
  settings.cusum_decision = texts.number("decision", 0.1, 100).value_or(settings.cusum_decision);
}

}  // namespace

Result<ChartRequest> parse_chart_request(const std::map<std::string, std::string>& given) {
  Texts texts(given);
  ChartRequest request;
  request.kind = texts.text("kind").value_or("individuals");
  if (request.kind != "histogram" && request.kind != "trend") {
    const auto kind = statistics::parse_chart_kind(request.kind);
    if (!kind) {
      return fail(Errc::Syntax,
                  "chart '{}': individuals, xbar-r, xbar-s, ewma, cusum, histogram or trend",
                  request.kind);
    }
    request.settings.kind = *kind;
  }
  read_settings(texts, request);
  request.center = texts.number("center", -kMaxMagnitude, kMaxMagnitude);
  request.sigma = texts.number("sigma", 0, kMaxMagnitude);
  request.limits_note = texts.text("limits_note").value_or("");
  request.baseline = static_cast<std::size_t>(texts.number("baseline", 0, 1e9).value_or(0));
  if (const auto shape = texts.text("shape"))
    texts.take(statistics::parse_shape(*shape), request.capability.shape);
  request.capability.subgroup = request.settings.subgroup;
  request.capability.confidence = texts.number("confidence", 0.5, 0.9999).value_or(0.95);
  request.title = texts.text("title").value_or("");
  request.width = texts.number("width", kMinWidth, kMaxSide).value_or(request.width);
  request.height = texts.number("height", kMinHeight, kMaxSide).value_or(request.height);
  if (auto good = texts.finish(); !good) return fail(good.error());
  return request;
}

std::string source_text(std::span<const Measurement> measurements) {
  if (measurements.empty()) return {};
  const auto short_run = [](const Measurement& m) { return m.run.substr(0, 8); };
  const Measurement& first = measurements.front();
  const Measurement& last = measurements.back();
  std::string text;
  if (!first.run.empty() || !last.run.empty()) {
    text = first.run == last.run ? "run " + short_run(first)
                                 : "runs " + short_run(first) + " to " + short_run(last);
  }
  if (last.time > UtcTime{}) {
    const std::string days = day_text(first.time) == day_text(last.time)
                                 ? day_text(first.time)
                                 : day_text(first.time) + " to " + day_text(last.time);
    text += (text.empty() ? "" : ", ") + days;
  }
  return text;
}

Result<void> draw_measurements(Canvas& canvas, std::span<const Measurement> measurements,
                               const ChartRequest& request) {
  if (auto good = check_one_characteristic(measurements); !good) return good;
  if (request.kind == "histogram") return draw_cells(canvas, measurements, request);
  if (request.kind != "trend") return draw_control(canvas, measurements, request);
  draw_lives(canvas, measurements, request);
  return {};
}

Result<std::string> measurements_svg(std::span<const Measurement> measurements,
                                     const ChartRequest& request) {
  if (auto good = check_one_characteristic(measurements); !good) return fail(good.error());
  SvgCanvas canvas(request.width, request.height, caption_of(measurements, request).title);
  if (auto drawn = draw_measurements(canvas, measurements, request); !drawn)
    return fail(drawn.error());
  return std::move(canvas).finish();
}

}  // namespace dripline::charts
