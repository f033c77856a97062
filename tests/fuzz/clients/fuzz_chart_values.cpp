// Any doubles as measured values and limits. Properties: a chart is refused with a reason, or is
// well-formed SVG with finite coordinates and labels that can be read; what the statistics answer
// is finite.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>

#include "clients/tools/charts/measurement_chart.hpp"
#include "tests/support/svg_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  constexpr const char* kKinds[]{"individuals", "xbar-r",    "xbar-s", "ewma",
                                 "cusum",       "histogram", "trend"};
  constexpr const char* kShapes[]{"normal", "lognormal", "empirical"};
  if (size < 2) return 0;
  const std::uint8_t kind = data[0], limits = data[1];
  std::vector<double> numbers;
  for (std::size_t at = 2; at + sizeof(double) <= size && numbers.size() < 200;
       at += sizeof(double))
    std::memcpy(&numbers.emplace_back(), data + at, sizeof(double));
  std::vector<measurement::Measurement> all;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    measurement::Measurement& one = all.emplace_back();
    one.characteristic.name = "D";
    one.actual = numbers[i];
    one.tool = i % 7 < 4 ? "T1" : "T2";
    if ((limits & 1) != 0) one.characteristic.lower = numbers[0];
    if ((limits & 2) != 0) one.characteristic.upper = numbers[i / 2];
    if ((limits & 4) != 0) one.characteristic.nominal = numbers[i / 3];
  }
  const auto request = charts::parse_chart_request({{"kind", kKinds[kind % std::size(kKinds)]},
                                                    {"shape", kShapes[limits / 8 % 3]},
                                                    {"rules", "nelson"}});
  if (!request) std::abort();
  const auto svg = charts::measurements_svg(all, *request);
  if (!svg && svg.error().what.empty()) std::abort();
  if (svg && !test::SvgCheck::fault_of(*svg).empty()) std::abort();
  return 0;
}
