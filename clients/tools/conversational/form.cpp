#include "clients/tools/conversational/form.hpp"

#include <algorithm>

namespace dripline::conversational {
namespace {

constexpr double kMaxInch = 99999.9999, kMaxMillimeter = 99999.999;

Limits range_of(Quantity quantity, bool is_metric) {
  const double length = is_metric ? kMaxMillimeter : kMaxInch;
  const int decimals = is_metric ? 3 : 4;
  switch (quantity) {
    case Quantity::Feed:
      return {0.0001, is_metric ? 99999.99 : 999.9999, 4};
    case Quantity::Lead:  // a pitch such as 1/13 runs through the whole thread
      return {0.000001, is_metric ? 9999.9999 : 999.9999, 6};
    case Quantity::Angle:
      return {-360, 360, 3};
    case Quantity::Speed:
      return {1, 9999, 3};
    case Quantity::Seconds:
      return {0.01, 9999.99, 2};
    case Quantity::Factor:
      return {-9999.9999, 9999.9999, 4};
    case Quantity::Count:
      return {0, 9999, 0};
    default:
      return {-length, length, decimals};
  }
}

}  // namespace

Limits limits_of(const Field& field, UnitSystem units) {
  Limits limits = range_of(field.quantity, units == UnitSystem::Metric);
  limits.min = std::max(limits.min, field.min);
  limits.max = std::min(limits.max, field.max);
  return limits;
}

}  // namespace dripline::conversational
