// Q-DAS ASCII. Properties: it is read or refused with a reason; what was read can be written and
// comes back with the same values.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "clients/tools/measurement_files/aqdef.hpp"

namespace {

using namespace dripline;

class Source final : public measurement_files::MeasurementSource {
 public:
  explicit Source(const std::vector<measurement::Measurement>& all) : all_(all) {}
  Result<void> each(const measurement_files::Visitor& visit) override {
    for (const auto& m : all_) {
      if (auto done = visit(m); !done) return done;
    }
    return {};
  }

 private:
  const std::vector<measurement::Measurement>& all_;
};

std::vector<double> values(const std::vector<measurement::Measurement>& all) {
  std::vector<double> actual;
  for (const auto& m : all) actual.push_back(m.actual);
  std::ranges::sort(actual);
  return actual;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto first = measurement_files::read_aqdef({reinterpret_cast<const char*>(data), size}, {});
  if (!first) {
    if (first.error().what.empty()) std::abort();
    return 0;
  }
  Source source(*first);
  std::string text;
  const auto written =
      measurement_files::write_dfq(source, {}, [&](std::string_view bytes) -> Result<void> {
        text += bytes;
        return {};
      });
  if (!written) return 0;  // too many characteristics
  const auto again = measurement_files::read_aqdef(text, {});
  if (!again || values(*again) != values(*first)) std::abort();
  return 0;
}
