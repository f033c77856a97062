// Measurements as CSV or JSON Lines. Properties: they are read or refused with a reason; what was
// read can be written in both forms and comes back, value for value.
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "clients/tools/measurement_files/text_files.hpp"

namespace {

using namespace dripline;
using Measurements = std::vector<measurement::Measurement>;

Result<Measurements> read(std::string_view text) {
  Measurements all;
  auto done = measurement_files::read_measurements(text, [&](const auto& m) -> Result<void> {
    all.push_back(m);
    return {};
  });
  if (!done) return fail(done.error());
  return all;
}

class Source final : public measurement_files::MeasurementSource {
 public:
  explicit Source(const Measurements& all) : all_(all) {}
  Result<void> each(const measurement_files::Visitor& visit) override {
    for (const auto& m : all_) {
      if (auto done = visit(m); !done) return done;
    }
    return {};
  }

 private:
  const Measurements& all_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto first = read({reinterpret_cast<const char*>(data), size});
  if (!first) {
    if (first.error().what.empty()) std::abort();
    return 0;
  }
  Source source(*first);
  for (const auto write : {measurement_files::write_csv, measurement_files::write_json_lines}) {
    std::string text;
    const auto written = write(source, [&](std::string_view bytes) -> Result<void> {
      text += bytes;
      return {};
    });
    const auto again = read(text);
    if (!written || !again || again->size() != first->size()) std::abort();
    for (std::size_t i = 0; i < first->size(); ++i) {
      if ((*again)[i].actual != (*first)[i].actual || (*again)[i].time != (*first)[i].time)
        std::abort();
    }
  }
  return 0;
}
