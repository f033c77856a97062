#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace dripline::api {

/// Prometheus' text format, version 0.0.4: families of samples, each after its help and type.
class MetricsText {
 public:
  using Labels = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  /// The samples that follow belong to this family. A name ends with its unit; that of a counter
  /// with `_total`.
  void gauge(std::string_view name, std::string_view help) { begin(name, help, "gauge"); }
  void counter(std::string_view name, std::string_view help) { begin(name, help, "counter"); }
  void sample(double value, Labels labels = {});
  /// A family with one sample.
  void gauge(std::string_view name, std::string_view help, double value);
  void counter(std::string_view name, std::string_view help, double value);

  /// The samples of one histogram of the family that `histogram` began. `counts` has one more
  /// than there are `bounds`: what was over the last of them.
  void histogram(std::string_view name, std::string_view help) { begin(name, help, "histogram"); }
  void distribution(std::span<const double> bounds, std::span<const std::uint64_t> counts,
                    double sum, std::string_view label, std::string_view value);

  std::string take() { return std::move(text_); }

  static constexpr const char* kContentType = "text/plain; version=0.0.4; charset=utf-8";

 private:
  void begin(std::string_view name, std::string_view help, std::string_view type);

  std::string name_;
  std::string text_;
};

}  // namespace dripline::api
