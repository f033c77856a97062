#include "clients/cli/offline/tnc_version.hpp"

#include "clients/cli/port/port_file.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"

namespace dripline::cli {
namespace {

namespace tnc = interpreter::tnc155;
using tnc::Feature;

constexpr std::size_t kMaxSetup = 1024 * 1024;
constexpr int kDataFormat = 222;
constexpr int kUsualFormat = 168;  ///< 7 data bits

/// Older software sends a hardcopy in the data bits of MP222; it needs all eight.
Result<void> check_data_bits(const tnc::ControlVersion& version,
                             const interpreter::Options& control) {
  if (version.has(Feature::HardcopyIn8Bits)) return {};
  const auto parameters = tnc::all_machine_parameters(control);
  if (!parameters) return fail(parameters.error());
  const auto found = parameters->find(kDataFormat);
  const double format = found == parameters->end() ? kUsualFormat : found->second;
  constexpr int kEightBits = 1;
  if ((static_cast<int>(format) & kEightBits) != 0) return {};
  return fail(Errc::Unsupported,
              "--hardcopy: {}: MP222 must be 169 for it, in [control.machine_parameters] it is {}",
              version.lacks(Feature::HardcopyIn8Bits), format);
}

}  // namespace

Result<tnc::ControlVersion> tnc_version_of(const std::string& setup_file) {
  if (setup_file.empty()) return tnc::ControlVersion{};
  const auto text = read_small_file(setup_file, kMaxSetup);
  if (!text) return fail(text.error());
  const auto setup = interpreter::parse_setup(*text);
  if (!setup) return fail(setup.error().code, "{}: {}", setup_file, setup.error().what);
  auto version = tnc::version_of(setup->control);
  if (!version) return fail(version.error().code, "{}: {}", setup_file, version.error().what);
  return version;
}

Result<void> check_tnc_graphics(const GraphicsCommand& command, const OfflineProgram& program) {
  if (program.dialect().name != "tnc155") return {};
  const interpreter::Options& control = program.setup().control;
  const auto version = tnc::version_of(control);
  if (!version) return fail(version.error());
  const auto need = [&](std::string_view what, Feature feature) -> Result<void> {
    if (version->has(feature)) return {};
    return fail(Errc::Unsupported, "{}: {}", what, version->lacks(feature));
  };
  if (auto has = need("graphics", Feature::Graphics); !has) return has;
  if (command.view == "planes" && command.arrangement == "us") {
    if (auto has = need("--arrangement us", Feature::SectionProjections); !has) return has;
  }
  if (command.print.empty()) return {};
  if (auto has = need("--hardcopy", Feature::Hardcopy); !has) return has;
  return check_data_bits(*version, control);
}

}  // namespace dripline::cli
