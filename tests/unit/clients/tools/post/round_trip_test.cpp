#include <gtest/gtest.h>
#include <array>
#include <cstdlib>
#include <map>

#include "tests/golden/golden_case.hpp"
#include "tests/unit/clients/tools/post/converted.hpp"

/// Every golden program of a mill or a lathe that runs without an alarm, written for every other
/// control of that kind: it is proved to do the same, or refused with a reason.
namespace dripline::post {
namespace {

struct Tally {
  int proved = 0, refused = 0, different = 0;
  int kept = 0;  ///< of those that are proved: with compensation
};

/// DRIPLINE_LIST=1 lists what was refused, and why.
bool lists() {
  const char* list = std::getenv("DRIPLINE_LIST");
  return list != nullptr && std::string_view(list) == "1";
}

/// No tolerance below it is met.
double step_of(const Target& target) {
  return Grid(target, interpreter::Units::Millimeter).center_step();
}

void convert_all(std::string_view control, bool is_lathe, const ConversionOptions& options,
                 std::map<std::string, Tally>& tallies) {
  const auto dialect = interpreter::find_dialect(control);
  ASSERT_TRUE(dialect);
  for (const auto& golden : interpreter::golden_cases(control)) {
    if (verdict_of(golden)) continue;
    const Original original{control, golden.program(), setup_of(golden, **dialect),
                            loader_of(golden)};
    for (const Target& target : targets()) {
      if (target.is_lathe != is_lathe) continue;
      ConversionOptions own = options;
      if (own.tolerance) own.tolerance = std::max(*own.tolerance, step_of(target));
      const auto converted = convert(original, target.name, own);
      auto& tally = tallies[std::string(control) + " to " + std::string(target.name)];
      const std::string reason = converted.reason();
      if (converted.is_proved) {
        ++tally.proved;
        tally.kept += converted.written->compensation.is_used() ? 1 : 0;
      } else if (converted.refusal) {
        ++tally.refused;
        EXPECT_FALSE(reason.empty()) << golden.name;
      } else {
        ++tally.different;
      }
      if (lists() && !converted.is_proved)
        std::cout << control << '/' << golden.name << " -> " << target.name << ": " << reason
                  << '\n';
    }
  }
}

int total(const std::map<std::string, Tally>& tallies, int Tally::*member) {
  int sum = 0;
  for (const auto& [name, tally] : tallies) {
    sum += tally.*member;
    if (member == &Tally::proved)
      std::cout << name << ": " << tally.proved << " proved, " << tally.refused << " refused, "
                << tally.different << " different, " << tally.kept << " with compensation\n";
  }
  return sum;
}

constexpr std::array kMills{"fanuc",    "itnc",   "prototrak-plus",
                            "rs274ngc", "tnc155", "tektronix-1704"};
constexpr std::array kLathes{"centurion", "fanuc-t"};

/// What most golden programs need: they begin anywhere, and have inches.
ConversionOptions lenient() {
  ConversionOptions options;
  options.is_as_set_up = true;
  options.tolerance = 0.003;
  return options;
}

TEST(RoundTrip, GoldenProgramsOfMills) {
  std::map<std::string, Tally> tallies;
  for (const char* control : kMills) convert_all(control, false, lenient(), tallies);
  EXPECT_GE(total(tallies, &Tally::proved), 1950);
  EXPECT_EQ(total(tallies, &Tally::different), 0);
}

/// Different: M6 of a Centurion moves X, and the lengths of another tool within a contour
/// (nose-radius-same) are not those of the same moves.
TEST(RoundTrip, GoldenProgramsOfLathes) {
  std::map<std::string, Tally> tallies;
  for (const char* control : kLathes) convert_all(control, true, lenient(), tallies);
  EXPECT_GE(total(tallies, &Tally::proved), 195);
  EXPECT_LE(total(tallies, &Tally::different), 4);
}

/// Those that differ go around corners, up to a contour or away from it on other paths.
TEST(RoundTrip, WithCompensationKept) {
  ConversionOptions options = lenient();
  options.keeps_compensation = true;
  std::map<std::string, Tally> tallies;
  for (const char* control : kMills) convert_all(control, false, options, tallies);
  EXPECT_GE(total(tallies, &Tally::proved), 1070);
  EXPECT_GE(total(tallies, &Tally::kept), 33);
}

TEST(RoundTrip, WithoutAnyOption) {
  std::map<std::string, Tally> tallies;
  for (const char* control : kMills) convert_all(control, false, {}, tallies);
  for (const char* control : kLathes) convert_all(control, true, {}, tallies);
  EXPECT_GE(total(tallies, &Tally::proved), 1500);
}

}  // namespace
}  // namespace dripline::post
