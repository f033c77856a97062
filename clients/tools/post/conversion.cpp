#include "clients/tools/post/conversion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/post/adapted_source.hpp"
#include "clients/tools/post/compensation_reader.hpp"

namespace dripline::post {
namespace {

using interpreter::Origin;
using interpreter::Setup;
using interpreter::Units;

constexpr std::uint64_t kStepBlocks = 1024;

auto refused(Errc code, std::string what, std::optional<Origin> origin = {}) {
  return tl::make_unexpected(NotConverted{code, std::move(what), origin});
}
auto refused(const Error& error) {
  return refused(error.code, error.what);
}

/// What a program says of itself before it does anything.
struct HeaderReader final : interpreter::EventSink {
  std::optional<interpreter::ProgramHeader> header;
  std::string name;
  void on_program(const interpreter::ProgramHeader& event) override {
    if (event.name) name = *event.name;
    header = event;
  }
};

Result<HeaderReader> read_header(const SourceProgram& source, const Setup& setup) {
  HeaderReader reader;
  auto run = interpreter::OfflineRun::begin(source.dialect, setup, source.source, reader);
  if (!run) return fail(run.error());
  while (!reader.header) {
    const auto is_over = run->step(1);
    if (!is_over) return fail(is_over.error());
    if (*is_over) break;
  }
  return reader;
}

/// The digits of a program's name, as far as the target takes them.
std::int64_t number_of(std::string_view name, std::int64_t max) {
  std::int64_t number = 0;
  for (const char c : name) {
    if (c >= '0' && c <= '9') number = number * 10 + (c - '0');
    if (number > max) return 1;
  }
  return number == 0 ? 1 : number;
}

/// A tape control counts in the unit that it was built for.
Result<Units> units_of_target(const Target& target, const ConversionOptions& options,
                              Units source) {
  if (target.form != Form::Tape) return options.units.value_or(source);
  const auto built = options.target_setup.control.text("units", "inch");
  if (!built) return fail(built.error());
  if (*built != "inch" && *built != "metric") {
    return fail(Errc::Unsupported, "{} with units = {}: programs are written for inch and metric",
                target.name, *built);
  }
  const Units units = *built == "inch" ? Units::Inch : Units::Millimeter;
  if (options.units && *options.units != units)
    return fail(Errc::Unsupported, "{} counts in {} (units of its setup)", target.name, *built);
  return units;
}

/// The program coordinate of the machine's zero, after the head of a program: the work offset of
/// the target's setup. Errors: Unsupported, where it is not only a shift.
Result<Grid::Values> shift_of(const Target& target, const interpreter::Dialect& dialect,
                              const Setup& setup, const ProgramHead& head) {
  Grid::Values shift{};
  std::string text;
  make_writer(target, setup)->head(text, head);
  interpreter::MemorySource source(text);
  interpreter::EventSink nothing;
  auto control = dialect.make(setup, source, nothing);
  if (!control) return fail(control.error());
  constexpr std::uint64_t kHeadBlocks = 64;
  (void)(*control)->step(kHeadBlocks);
  const auto frame = (*control)->frame();
  if (!frame) {
    if (setup.offsets.empty()) return shift;
    return fail(Errc::Unsupported, "work offsets in the setup of {}: it does not show its frame",
                target.name);
  }
  shift = frame->to_program({});
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr double kFar = 1000, kNoise = 1e-9;
    Grid::Values far{};
    far[i] = kFar;
    const auto there = frame->to_program(far);
    for (std::size_t k = 0; k < there.size(); ++k) {
      if (std::fabs(there[k] - shift[k] - far[k]) > kNoise) {
        return fail(Errc::Unsupported, "the setup of {} rotates, scales or mirrors coordinates",
                    target.name);
      }
    }
  }
  return shift;
}

Result<void> check_kind(const SourceProgram& source, const Target& target) {
  const bool is_lathe = source.dialect.machine == interpreter::MachineKind::Lathe;
  if (is_lathe == target.is_lathe) return {};
  return fail(Errc::Unsupported, "a program of {}, a {}: {} is a {}", source.dialect.name,
              is_lathe ? "lathe" : "mill", target.name, target.is_lathe ? "lathe" : "mill");
}

/// Profile linuxcnc is a target of its own, and an option of the control.
Result<Setup> setup_of(const Target& target, Setup setup) {
  if (target.dialect != "rs274ngc") return setup;
  const std::string wanted = target.name == "linuxcnc" ? "linuxcnc" : "nist";
  const auto profile = setup.control.text("profile", wanted);
  if (!profile) return fail(profile.error());
  if (*profile != wanted) {
    return fail(Errc::Unsupported, "the setup has profile = {}: {} is profile = {}", *profile,
                target.name, wanted);
  }
  setup.control.set("profile", {wanted});
  return setup;
}

/// How the rotary axes of a setup turn its tables and heads.
struct RotaryMachine {
  std::string kind, axes;
  std::vector<interpreter::Position> centers;
};

/// Errors: Syntax.
Result<RotaryMachine> rotary_machine_of(const Setup& setup) {
  RotaryMachine machine;
  for (const std::string_view key : {"kinematics", "rotary_master", "rotary_slave"}) {
    const auto word = setup.control.text(key, "");
    if (!word) return fail(word.error());
    (key == "kinematics" ? machine.kind : machine.axes) += *word;
  }
  for (const std::string_view key : {"table_centers", "head_centers"}) {
    const auto points = setup.control.positions(key);
    if (!points) return fail(points.error());
    machine.centers.insert(machine.centers.end(), points->begin(), points->end());
  }
  return machine;
}

/// Why moves of rotary axes do not lead the tool where they led it: both machines are known, and
/// differ. Empty: nothing is known against them. Errors: Syntax.
Result<std::string> difference_of_machines(const Setup& source, const Setup& target) {
  const auto first = rotary_machine_of(source);
  const auto second = rotary_machine_of(target);
  if (!first) return fail(first.error());
  if (!second) return fail(second.error());
  const auto is_known = [](const RotaryMachine& machine) {
    return !machine.kind.empty() && machine.kind != "none";
  };
  if (!is_known(*first) || !is_known(*second)) return std::string();
  if (first->kind != second->kind || first->axes != second->axes) {
    return fmt::format("the machine of the source is {} {}, that of the target {} {}", first->kind,
                       first->axes, second->kind, second->axes);
  }
  const auto is_same = [](const interpreter::Position& a, const interpreter::Position& b) {
    return a.same_point(b);
  };
  if (std::ranges::equal(first->centers, second->centers, is_same)) return std::string();
  return std::string("the centers of tables or heads of the two machines differ");
}

tl::expected<void, NotConverted> run_source(const SourceProgram& source, const Setup& setup,
                                            const Target& target, AdaptedSource& adapted,
                                            PostProcessor& post, const ConversionOptions& options) {
  auto run = interpreter::OfflineRun::begin(source.dialect, setup, source.source, adapted);
  if (!run) return refused(run.error());
  adapted.adaptation().watch(run->interpreter(), tools_at(target, options.target_setup, setup));
  for (bool is_over = false; !is_over;) {
    if (options.is_to_stop && options.is_to_stop()) return refused(Errc::Timeout, "interrupted");
    const auto stepped = run->step(kStepBlocks);
    if (adapted.refusal())
      return refused(Errc::Unsupported, adapted.refusal()->what, adapted.refusal()->origin);
    if (post.refusal())
      return refused(Errc::Unsupported, post.refusal()->what, post.refusal()->origin);
    if (post.error()) return refused(*post.error());
    if (!stepped) return refused(stepped.error());
    is_over = *stepped;
  }
  const auto outcome = run->outcome();
  if (outcome.ended) return {};
  if (!outcome.alarm) return refused(Errc::Syntax, "the program does not reach its end");
  Origin origin;
  origin.line = outcome.alarm->line;
  origin.program = outcome.alarm_program;
  return refused(Errc::Syntax, fmt::format("alarm {}: {}", outcome.alarm->id, outcome.alarm->text),
                 origin);
}

}  // namespace

tl::expected<WrittenProgram, NotConverted> write_program(const SourceProgram& source,
                                                         const Target& target,
                                                         const ConversionOptions& options,
                                                         const PostProcessor::Output& output) {
  if (auto kind = check_kind(source, target); !kind) return refused(kind.error());
  const auto dialect = interpreter::find_dialect(target.dialect);
  if (!dialect) return refused(dialect.error());
  auto target_setup = setup_of(target, options.target_setup);
  if (!target_setup) return refused(target_setup.error());
  Setup source_setup = source.setup;
  source_setup.switches.optional_stop = true;
  const auto header = read_header(source, source_setup);
  if (!header) return refused(header.error());
  const Units source_units = header->header ? header->header->units : source.dialect.units;
  const auto units = units_of_target(target, options, source_units);
  if (!units) return refused(units.error());
  ProgramHead head{options.name.value_or(number_of(header->name, target.max_name)), *units};
  if (options.name && (*options.name < 1 || *options.name > target.max_name)) {
    return refused(Errc::LimitExceeded, fmt::format("program number {}: {} takes 1 to {}",
                                                    *options.name, target.name, target.max_name));
  }
  target_setup->start = source_setup.start;
  const auto shift = shift_of(target, **dialect, *target_setup, head);
  if (!shift) return refused(shift.error());
  WrittenProgram result{
      Grid(target, *units, *shift), {}, source_setup, *target_setup, head, {}, {}, 0};
  result.tolerance = options.tolerance.value_or(result.grid.center_step());
  result.adaptation.tolerance = result.tolerance;
  result.adaptation.chord = options.chord;
  auto difference = difference_of_machines(source_setup, *target_setup);
  if (!difference) return refused(difference.error());
  result.adaptation.rotary_refusal = *std::move(difference);
  // What depends on the start then differs from what was written.
  const Setup run_setup =
      options.is_as_set_up
          ? source_setup
          : comparison::started_beside(source_setup, comparison::kStartShift, axes_of(target));
  std::optional<CompensationSource> programmed;
  if (options.keeps_compensation) {
    auto prepared = as_programmed(source, run_setup, target, *target_setup);
    if (!prepared) return refused(prepared.error());
    programmed.emplace(*std::move(prepared));
    auto kept = read_compensation(source, run_setup, *programmed, target, options);
    if (!kept) return tl::make_unexpected(std::move(kept.error()));
    result.compensation = *std::move(kept);
    result.head.radii = result.compensation.radii;
  }
  auto adaptation_options = result.adaptation;
  adaptation_options.passes_messages = true;
  const auto writer = make_writer(target, *target_setup);
  const bool has_program = programmed && programmed->program;
  const SourceProgram ran_source{
      source.dialect, source.setup,
      has_program ? static_cast<interpreter::ProgramSource&>(*programmed->program) : source.source,
      has_program ? programmed->program->text() : source.text};
  PostProcessor post({result.grid, *writer, result.head, run_setup.start, result.tolerance,
                      CarriedComments(source.dialect.name, ran_source.text), output,
                      &result.compensation});
  AdaptedSource adapted(post, result.grid, adaptation_options, run_setup.start);
  if (auto ran = run_source(ran_source, programmed ? programmed->setup : run_setup, target, adapted,
                            post, options);
      !ran)
    return tl::make_unexpected(ran.error());
  if (auto finished = post.finish(); !finished) return refused(finished.error());
  result.written = post.counts();
  result.tools = post.tools();
  result.adapted = adapted.counts();
  return result;
}

}  // namespace dripline::post
