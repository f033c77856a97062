#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/measurement/measurement.hpp"

/// Measurements in the files of others: quality systems, drawing programs, paper.
namespace dripline::measurement_files {

/// Takes one measurement; an error ends the pass.
using Visitor = std::function<Result<void>(const measurement::Measurement&)>;

/// Measurements that can be gone through as often as a format needs it (twice where its head names
/// what follows), each time the same ones in the same order. Those of one part are neighbors.
class MeasurementSource {
 public:
  virtual ~MeasurementSource() = default;
  virtual Result<void> each(const Visitor& visit) = 0;
};

/// Measurements in memory.
class ListSource : public MeasurementSource {
 public:
  explicit ListSource(std::vector<measurement::Measurement> all) : all_(std::move(all)) {}
  Result<void> each(const Visitor& visit) override {
    for (const auto& one : all_) {
      if (auto done = visit(one); !done) return done;
    }
    return {};
  }

 private:
  const std::vector<measurement::Measurement> all_;
};

/// Takes the next bytes of a file. Errors end the writing.
using Sink = std::function<Result<void>(std::string_view)>;

/// The shortest decimals that give `value` again, `decimals` at least; never an exponent. "nan" and
/// "inf" do not occur: a measurement that is not finite is refused by who writes it.
std::string decimal_text(double value, unsigned decimals);
/// The whole of `text`, as std::from_chars reads it; nullopt: it is none or not finite.
std::optional<double> parse_finite(std::string_view text);
/// Takes the text up to `end` off, and `end` with it; without one all that is left.
std::string_view take_until(std::string_view& text, char end);
/// Without a line end or a control character, which most formats cannot hold in one field: they
/// become spaces.
std::string one_line(std::string_view text);
/// A character that code page does not have becomes a question mark.
std::string to_windows_1252(std::string_view utf8);
/// How many those would be.
std::size_t count_outside_windows_1252(std::string_view utf8);
std::string from_windows_1252(std::string_view bytes);

/// What belongs together as a workpiece.
bool is_same_part(const measurement::Measurement& a, const measurement::Measurement& b);
/// The measurements of one workpiece after the other, never none.
Result<void> each_part(
    MeasurementSource& source,
    const std::function<Result<void>(const std::vector<measurement::Measurement>&)>& visit);

}  // namespace dripline::measurement_files
