#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// NIST Statistical Reference Datasets, univariate: the measured values of the small ones, the rule
/// of the constructed ones.
namespace dripline::statistics::strd {

/// Michelson's 1879 determinations of the speed of light, in km/s above 299,000.
inline std::vector<double> michelso() {
  constexpr std::array kAbove{
      850,  740, 900, 1070, 930, 850, 950, 980, 980, 880, 1000, 980, 930, 650, 760, 810, 1000,
      1000, 960, 960, 960,  940, 960, 940, 880, 800, 850, 880,  900, 840, 830, 790, 810, 880,
      880,  830, 800, 790,  760, 800, 880, 880, 880, 860, 720,  720, 620, 860, 970, 950, 880,
      910,  850, 870, 840,  840, 850, 840, 840, 840, 890, 810,  810, 820, 800, 770, 760, 740,
      750,  760, 910, 920,  890, 860, 880, 720, 840, 850, 850,  780, 890, 840, 780, 810, 760,
      810,  790, 810, 820,  850, 870, 870, 810, 740, 810, 940,  950, 800, 810, 870};
  std::vector<double> values;
  for (const int above : kAbove) values.push_back((299000 + above) / 1000.0);
  return values;
}

/// Mavrodineanu's transmittance of a filter with the nominal value 2, in 0.00001 above 2.
inline std::vector<double> mavro() {
  constexpr std::array kAbove{180, 170, 180, 190, 180, 170, 150, 140, 150, 150, 170, 180, 180,
                              190, 190, 210, 200, 160, 140, 130, 130, 150, 150, 160, 150, 140,
                              130, 140, 150, 140, 150, 160, 150, 160, 190, 200, 200, 210, 220,
                              230, 240, 250, 270, 260, 260, 260, 270, 260, 250, 240};
  std::vector<double> values;
  for (const int above : kAbove) values.push_back((200000 + above) / 100000.0);
  return values;
}

/// NumAcc2 to 4: one value, then pairs of a little less and a little more.
inline std::vector<double> numacc(double middle, double low, double high) {
  std::vector<double> values{middle};
  for (int i = 0; i < 500; ++i) {
    values.push_back(low);
    values.push_back(high);
  }
  return values;
}

}  // namespace dripline::statistics::strd
