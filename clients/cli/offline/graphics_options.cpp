#include "clients/cli/offline/graphics_options.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "clients/cli/port/port_file.hpp"
#include "clients/tools/graphics/picture.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"

namespace dripline::cli {

namespace {

using interpreter::Axis;

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<void> parse_range(std::string_view part, double scale, AxisRanges& ranges) {
  const auto colon = part.find(':');
  const std::size_t axis = part.empty() ? 3 : std::string_view("XYZ").find(part.front());
  if (axis < 3 && colon != std::string_view::npos) {
    const auto low = number_of(part.substr(1, colon - 1));
    const auto high = number_of(part.substr(colon + 1));
    if (low && high && *low < *high) {
      ranges.low[axis] = *low * scale;
      ranges.high[axis] = *high * scale;
      return {};
    }
  }
  return fail(Errc::Syntax, "\"{}\": expected an axis and its range, lower end first, as X0:100",
              part);
}

std::size_t index_of(Axis axis) {
  return static_cast<std::size_t>(axis);
}

}  // namespace

Result<AxisRanges> parse_ranges(std::string_view text, bool is_inch) {
  AxisRanges ranges;
  const double scale = is_inch ? Length::kMillimetersPerInch : 1;
  while (true) {
    const auto comma = text.find(',');
    if (auto part = parse_range(text.substr(0, comma), scale, ranges); !part)
      return fail(part.error());
    if (comma == std::string_view::npos) return ranges;
    text.remove_prefix(comma + 1);
  }
}

Result<graphics::Cuboid> cuboid_of(const AxisRanges& ranges, const graphics::WorkFrame& frame,
                                   const std::optional<graphics::Cuboid>& whole) {
  graphics::Cuboid cuboid = whole.value_or(graphics::Cuboid{});
  const auto take = [&](Axis axis, double& low, double& high) {
    const std::size_t i = index_of(axis);
    if (ranges.low[i]) {
      low = *ranges.low[i];
      high = *ranges.high[i];
    }
    return ranges.low[i] || whole;
  };
  for (const auto& [axis, low, high] : {std::tuple{frame.first, &cuboid.low.u, &cuboid.high.u},
                                        std::tuple{frame.second, &cuboid.low.v, &cuboid.high.v},
                                        std::tuple{frame.along, &cuboid.low.w, &cuboid.high.w}}) {
    if (!take(axis, *low, *high)) {
      return fail(Errc::Syntax, "a blank needs X, Y and Z; {} is missing", letter(axis));
    }
  }
  return cuboid;
}

namespace {

/// The printer of the control's parameters; absent: the setup has none of the eight.
Result<std::optional<graphics::Printer>> printer_of(const interpreter::Setup& setup) {
  constexpr int kFirst = 226;
  constexpr double kMaxWord = 65'535;
  const auto parameters = interpreter::tnc155::all_machine_parameters(setup.control);
  if (!parameters) return fail(parameters.error());
  std::array<std::uint16_t, 8> words{};
  bool is_there = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const int number = kFirst + static_cast<int>(i);
    const auto found = parameters->find(number);
    if (found == parameters->end()) continue;
    const double value = found->second;
    if (value < 0 || value > kMaxWord || value != std::floor(value)) {
      return fail(Errc::LimitExceeded, "MP{} = {:g}: expected a whole number from 0 to {:g}",
                  number, value, kMaxWord);
    }
    words[i] = static_cast<std::uint16_t>(value);
    is_there = true;
  }
  if (!is_there) return std::optional<graphics::Printer>();
  auto printer = graphics::printer_of_parameters(words);
  if (!printer) return fail(printer.error());
  return std::optional(std::move(*printer));
}

Result<graphics::Printer> choose_printer(const std::string& name, const interpreter::Setup& setup) {
  if (!name.empty()) return graphics::find_printer(name);
  auto own = printer_of(setup);
  if (!own) return fail(own.error());
  if (*own) return std::move(**own);
  return graphics::find_printer("epson");
}

}  // namespace

Result<void> write_picture(const GraphicsCommand& command, const interpreter::Setup& setup,
                           const graphics::Picture& picture) {
  std::optional<graphics::Printer> printer;
  if (!command.print.empty()) {
    auto chosen = choose_printer(command.printer, setup);
    if (!chosen) return fail(chosen.error());
    printer = std::move(*chosen);
  }
  if (!command.output.empty()) {
    const auto bytes = picture.png();
    if (!bytes) return fail(bytes.error());
    if (auto done = write_file(command.output, *bytes); !done) return done;
  }
  return printer ? write_file(command.print, graphics::hardcopy(picture, *printer))
                 : Result<void>();
}

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
