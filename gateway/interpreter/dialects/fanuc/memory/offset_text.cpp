#include "gateway/interpreter/dialects/fanuc/memory/offset_text.hpp"

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <utility>

#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"
#include "gateway/interpreter/dialects/fanuc/state.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr std::string_view kLetters = "XYZABCUVW";

class Writer {
 public:
  Writer(const Setup& setup, const ControlOptions& options, const Memory& memory)
      : setup_(setup),
        options_(options),
        memory_(memory),
        is_inch_(setup.units.value_or(options.start_units) == Units::Inch) {}

  Result<std::string> write() {
    text_ = "%\n(TOOLS AND OFFSETS)\n";
    // In system A of a lathe G90 is a cycle, and X and Z are absolute.
    text_ += is_inch_ ? "G20" : "G21";
    text_ += options_.is_lathe && options_.code_system == CodeSystem::A ? "\n" : " G90\n";
    for (const OffsetRecord& offset : setup_.offsets) {
      if (auto done = write_system(offset); !done) return fail(done.error());
    }
    for (const ToolRecord& tool : setup_.tools) {
      if (auto done = options_.is_lathe ? write_turret(tool) : write_tool(tool); !done)
        return fail(done.error());
    }
    for (const VariableRecord& variable : setup_.variables) {
      if (auto done = write_variable(variable); !done) return fail(done.error());
    }
    text_ += "M30\n%\n";
    return std::move(text_);
  }

 private:
  /// With a point always: without one it would count least increments.
  std::string number(double value, int decimals) const {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    while (text.ends_with('0')) text.pop_back();
    return text == "-0." ? "0." : text;
  }
  std::string length(double mm) const {
    const int decimals = options_.decimals_mm + (is_inch_ ? 1 : 0);
    return number(is_inch_ ? mm / Length::kMillimetersPerInch : mm, decimals);
  }
  std::string coordinate(std::size_t axis, double raw) const {
    if (is_rotary(static_cast<Axis>(axis))) return number(raw, options_.decimals_mm);
    return length(axis == 0 && options_.x_is_diameter ? 2 * raw : raw);
  }

  Result<void> write_system(const OffsetRecord& offset) {
    const std::string_view name = offset.name;
    if (name == "G52" || name == "G92") {
      return fail(Errc::Unsupported,
                  "offset {}: a program sets it, the control has no number for it", name);
    }
    const bool is_more = name.starts_with("G54.1P");
    const std::string_view system = name == "EXT" ? "0" : is_more ? name.substr(6) : "";
    text_ += is_more ? "G10 L20 P" : "G10 L2 P";
    text_ += system.empty() ? std::string(1, static_cast<char>(name[2] - 3)) : std::string(system);
    for (const Axis axis : kAllAxes) {
      if (!offset.value.has(axis)) continue;
      const auto i = static_cast<std::size_t>(axis);
      text_ += fmt::format(" {}{}", kLetters[i], coordinate(i, offset.value.raw(axis)));
    }
    text_ += '\n';
    return {};
  }

  Result<void> check(int tool, double value) const {
    if (std::fabs(value) <= kMaxOffsetValue) return {};
    return fail(Errc::LimitExceeded, "tool {}: {} mm is beyond {}", tool, value, kMaxOffsetValue);
  }

  /// The four values of a tool, and the lists that set them.
  Result<void> write_tool(const ToolRecord& tool) {
    const auto n = static_cast<std::size_t>(tool.number);
    const ToolOffsets& tools = memory_.tools;
    const std::array values{
        std::pair{10, tools.length_geometry[n]}, std::pair{11, tools.length_wear[n]},
        std::pair{12, tools.radius_geometry[n]}, std::pair{13, tools.radius_wear[n]}};
    for (const auto& [list, value] : values) {
      if (auto good = check(tool.number, value); !good) return good;
    }
    if (options_.offset_memory == OffsetMemory::C) {
      for (const auto& [list, value] : values) write_value(list, tool.number, value);
      return {};
    }
    const bool has_length = values[0].second != 0 || values[1].second != 0;
    const bool has_radius = values[2].second != 0 || values[3].second != 0;
    if (has_length && has_radius) {
      return fail(Errc::Unsupported,
                  "tool {}: the control's offset memory has one number for its length and its "
                  "radius; give the radius another number",
                  tool.number);
    }
    const std::size_t first = has_radius ? 2 : 0;
    if (options_.offset_memory == OffsetMemory::B) {
      write_value(10, tool.number, values[first].second);
      write_value(11, tool.number, values[first + 1].second);
      return {};
    }
    if (values[first + 1].second != 0) {
      return fail(Errc::Unsupported,
                  "tool {}: the control's offset memory A has no wear; put it into the length or "
                  "the radius",
                  tool.number);
    }
    write_value(11, tool.number, values[first].second);
    return {};
  }

  void write_value(int list, int tool, double mm) {
    text_ += fmt::format("G10 L{} P{} R{}\n", list, tool, length(mm));
  }

  /// Geometry with the tip under P10001 on, wear under P1 on.
  Result<void> write_turret(const ToolRecord& tool) {
    const auto n = static_cast<std::size_t>(tool.number);
    const ToolOffsets& tools = memory_.tools;
    for (const double value :
         {tools.x_geometry[n], tools.length_geometry[n], tools.radius_geometry[n], tools.x_wear[n],
          tools.length_wear[n], tools.radius_wear[n]}) {
      if (auto good = check(tool.number, value); !good) return good;
    }
    text_ += fmt::format("G10 P{} X{} Z{} R{} Q{:.0f}\n", 10'000 + tool.number,
                         coordinate(0, tools.x_geometry[n]), length(tools.length_geometry[n]),
                         length(tools.radius_geometry[n]), tools.tip[n]);
    text_ += fmt::format("G10 P{} X{} Z{} R{}\n", tool.number, coordinate(0, tools.x_wear[n]),
                         length(tools.length_wear[n]), length(tools.radius_wear[n]));
    return {};
  }

  Result<void> write_variable(const VariableRecord& variable) {
    constexpr int kDecimals = 7;
    if (!variable.name.starts_with('#') || std::fabs(variable.value) >= 1e8) {
      return fail(Errc::Unsupported, "variable {} = {}: a program of the control cannot set it",
                  variable.name, variable.value);
    }
    text_ += fmt::format("{}={}\n", variable.name, number(variable.value, kDecimals));
    return {};
  }

  const Setup& setup_;
  const ControlOptions& options_;
  const Memory& memory_;
  const bool is_inch_;
  std::string text_;
};

}  // namespace

Result<std::string> write_offset_text(const Setup& setup, bool is_lathe) {
  const auto options = read_options(setup, is_lathe);
  if (!options) return fail(options.error());
  ModalState state;
  Memory memory;
  if (auto loaded = load_memory(setup, *options, state, memory); !loaded)
    return fail(loaded.error());
  return Writer(setup, *options, memory).write();
}

}  // namespace dripline::interpreter::fanuc
