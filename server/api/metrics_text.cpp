#include "server/api/metrics_text.hpp"

#include <fmt/format.h>

namespace dripline::api {
namespace {

std::string escaped(std::string_view value) {
  std::string out;
  for (const char c : value) {
    if (c == '\\' || c == '"') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

void MetricsText::begin(std::string_view name, std::string_view help, std::string_view type) {
  name_ = name;
  text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
}

void MetricsText::sample(double value, Labels labels) {
  text_ += name_;
  char before = '{';
  for (const auto& [label, text] : labels) {
    text_ += fmt::format("{}{}=\"{}\"", before, label, escaped(text));
    before = ',';
  }
  if (labels.size() > 0) text_ += '}';
  text_ += fmt::format(" {}\n", value);
}

void MetricsText::distribution(std::span<const double> bounds,
                               std::span<const std::uint64_t> counts, double sum,
                               std::string_view label, std::string_view value) {
  const std::string labels = fmt::format("{}=\"{}\"", label, escaped(value));
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    total += counts[i];
    const std::string bound = i < bounds.size() ? fmt::format("{}", bounds[i]) : "+Inf";
    text_ += fmt::format("{}_bucket{{{},le=\"{}\"}} {}\n", name_, labels, bound, total);
  }
  text_ += fmt::format("{0}_sum{{{1}}} {2}\n{0}_count{{{1}}} {3}\n", name_, labels, sum, total);
}

void MetricsText::gauge(std::string_view name, std::string_view help, double value) {
  begin(name, help, "gauge");
  sample(value);
}

void MetricsText::counter(std::string_view name, std::string_view help, double value) {
  begin(name, help, "counter");
  sample(value);
}

}  // namespace dripline::api
