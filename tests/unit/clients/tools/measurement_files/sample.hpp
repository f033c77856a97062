#pragma once

#include <string>
#include <vector>

#include "clients/tools/measurement_files/source.hpp"

namespace dripline::measurement_files {

/// Counts how often the measurements are gone through.
class CountingSource final : public ListSource {
 public:
  using ListSource::ListSource;
  Result<void> each(const Visitor& visit) override {
    ++passes;
    return ListSource::each(visit);
  }
  int passes = 0;
};

/// Two workpieces of two characteristics, the second one's length not measured; texts with all that
/// needs quoting.
inline std::vector<measurement::Measurement> sample() {
  measurement::Measurement m;
  m.machine = "lathe-1";
  m.run = "1f3a09c2";
  m.program = "O0100";
  m.revision = 3;
  m.part = "7";
  m.serial = "S-0007 <\"\xC3\x9C\">, \xE2\x82\xAC";
  m.tool = "T3";
  m.time = UtcTime(std::chrono::seconds(1795500000));
  m.characteristic = {
      "Diameter \xC3\x98"
      "40",
      40.0,
      39.98,
      40.02,
      "mm",
      3};
  m.actual = 40.0125;
  m.record = {1, 17};
  m.verdict = measurement::Verdict::Good;
  std::vector<measurement::Measurement> all{m};
  m.characteristic = {"Length", 25.0, std::nullopt, 25.1, "mm", 2};
  m.actual = 25.3;
  m.record.number = 18;
  m.item = 1;
  m.verdict = measurement::Verdict::Rework;
  all.push_back(m);
  m = all.front();
  m.part = "8";
  m.serial = "S-0008";
  m.actual = -0.0000001;
  m.record.number = 19;
  m.time += std::chrono::minutes(2);
  m.verdict = measurement::Verdict::Scrap;
  all.push_back(m);
  return all;
}

template <class Write>
std::string written(Write write) {
  std::string text;
  const Sink sink = [&](std::string_view bytes) -> Result<void> {
    text += bytes;
    return {};
  };
  const Result<void> done = write(sink);
  return done ? text : "error: " + done.error().what;
}

}  // namespace dripline::measurement_files
