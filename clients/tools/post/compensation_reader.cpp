#include "clients/tools/post/compensation_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "clients/tools/offline/offline_run.hpp"

namespace dripline::post {
namespace {

using interpreter::CompensationSide;
using interpreter::Origin;
using interpreter::Setup;

/// Controls whose compensation can be read, and where their radii are.
struct SourceRow {
  std::string_view dialect;
  RadiusOf radius;
  bool defines_radii;  ///< in its text, too
};
constexpr std::array kSources{
    SourceRow{"fanuc", RadiusOf::Offset, false}, SourceRow{"itnc", RadiusOf::Tool, true},
    SourceRow{"rs274ngc", RadiusOf::Offset, false}, SourceRow{"tnc155", RadiusOf::Tool, true}};

auto cannot_keep(std::string what, const Origin& origin) {
  return tl::make_unexpected(
      NotConverted{Errc::Unsupported, "compensation cannot be kept: " + std::move(what), origin});
}

struct ToolReader final : interpreter::EventSink {
  int tool = 0;
  void on_tool(const interpreter::ToolChange& event) override {
    if (!event.is_preselection) tool = event.number;
  }
};

/// What a block has in force.
struct BlockState {
  Origin origin;
  CompensationSide side = CompensationSide::Off;
  double radius = 0;
  int tool = 0;
};

/// Calls `take` with the state of each block, until it returns false.
template <class Take>
tl::expected<void, NotConverted> each_block(const SourceProgram& source, const Setup& setup,
                                            interpreter::ProgramSource& text,
                                            const ConversionOptions& options, Take take) {
  ToolReader reader;
  auto run = interpreter::OfflineRun::begin(source.dialect, setup, text, reader);
  if (!run) return tl::make_unexpected(NotConverted{run.error().code, run.error().what, {}});
  for (bool is_over = false; !is_over;) {
    if (options.is_to_stop && options.is_to_stop())
      return tl::make_unexpected(NotConverted{Errc::Timeout, "interrupted", {}});
    const auto stepped = run->step(1);
    if (!stepped)
      return tl::make_unexpected(NotConverted{stepped.error().code, stepped.error().what, {}});
    is_over = *stepped;
    const auto modes = run->interpreter().modes();
    if (!take(BlockState{run->interpreter().origin(), modes.compensation, modes.tool_radius.mm(),
                         reader.tool}))
      break;
  }
  return {};
}

/// The radius of each block that has another one than that before.
using Radii = std::vector<std::pair<std::uint64_t, double>>;

double radius_at(const Radii& radii, std::uint64_t block) {
  const auto next = std::ranges::upper_bound(radii, block, {}, &Radii::value_type::first);
  return next == radii.begin() ? 0 : std::prev(next)->second;
}

}  // namespace

bool defines_radii(const interpreter::Dialect& dialect) {
  const auto row = std::ranges::find(kSources, dialect.name, &SourceRow::dialect);
  return row != kSources.end() && row->defines_radii;
}

Result<CompensationSource> as_programmed(const SourceProgram& source, const Setup& setup,
                                         const Target& target, const Setup& target_setup) {
  const auto row = std::ranges::find(kSources, source.dialect.name, &SourceRow::dialect);
  if (row == kSources.end()) {
    return fail(Errc::Unsupported, "the compensation of a program of {} cannot be kept",
                source.dialect.name);
  }
  if (!target.radius) {
    return fail(Errc::Unsupported, "{} has no cutter compensation that programs are written with",
                target.name);
  }
  for (const Setup* of_machine : {&setup, &target_setup}) {
    const auto has_diameters = of_machine->control.flag("diameter_offset", false);
    if (!has_diameters) return fail(has_diameters.error());
    if (*has_diameters) {
      return fail(Errc::Unsupported,
                  "compensation cannot be kept with diameter_offset: radii are compared");
    }
  }
  CompensationSource programmed{row->radius == RadiusOf::Offset, {}, {}};
  if (row->radius == RadiusOf::Offset) {
    programmed.setup = marked_radii(setup);
  } else {
    programmed.setup = scaled_radii(setup, 0);
  }
  if (row->defines_radii) {
    programmed.program =
        std::make_unique<ReplacedSource>(source.source, scaled_definitions(source.text, 0));
  }
  return programmed;
}

tl::expected<KeptCompensation, NotConverted> read_compensation(const SourceProgram& source,
                                                               const Setup& setup,
                                                               const CompensationSource& programmed,
                                                               const Target& target,
                                                               const ConversionOptions& options) {
  Radii radii;
  auto read = each_block(source, setup, source.source, options, [&](const BlockState& at) {
    if (radii.empty() || radii.back().second != at.radius)
      radii.emplace_back(at.origin.block, at.radius);
    return true;
  });
  if (!read) return tl::make_unexpected(read.error());
  KeptCompensation kept;
  std::optional<NotConverted> refusal;
  const auto refuse = [&](const Origin& origin, std::string what) {
    refusal = cannot_keep(std::move(what), origin).value();
    return false;
  };
  const auto take = [&](const BlockState& at) {
    KeptCompensation::State state{at.origin.block, at.side, 0};
    if (at.side != CompensationSide::Off) {
      state.number = programmed.is_of_offsets ? number_of_mark(at.radius) : at.tool;
      const bool is_known = programmed.is_of_offsets ? state.number != 0 : at.radius == 0;
      if (!is_known)
        return refuse(at.origin,
                      "its radius is not one above 0 of a tool of the setup or of TOOL DEF");
      if (target.radius == RadiusOf::Tool && state.number != at.tool) {
        return refuse(at.origin, fmt::format("radius {} with tool {}: {} has that of the tool",
                                             state.number, at.tool, target.name));
      }
      const double radius = radius_at(radii, at.origin.block);
      if (!(radius > 0))
        return refuse(at.origin, fmt::format("the radius of tool {} is {:g} mm: there is nothing "
                                             "to compare",
                                             state.number, radius));
      const auto [known, is_new] = kept.radii.emplace(state.number, radius);
      if (!is_new && known->second != radius) {
        return refuse(at.origin, fmt::format("tool {} has a radius of {:g} mm, and of {:g} mm "
                                             "before",
                                             state.number, radius, known->second));
      }
    }
    const auto last = kept.states.empty() ? KeptCompensation::State{} : kept.states.back();
    if (last.side != state.side || last.number != state.number) kept.states.push_back(state);
    return true;
  };
  interpreter::ProgramSource& text =
      programmed.program ? static_cast<interpreter::ProgramSource&>(*programmed.program)
                         : source.source;
  read = each_block(source, programmed.setup, text, options, take);
  if (refusal) return tl::make_unexpected(*std::move(refusal));
  if (!read) return tl::make_unexpected(read.error());
  return kept;
}

}  // namespace dripline::post
