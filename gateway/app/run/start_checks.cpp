#include "gateway/app/run/start_checks.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::gateway {
namespace {

constexpr std::uint64_t kMaxProgramBytes = 1ULL << 40;

Result<void> check_units(const machine::ProgramReader& reader, const interpreter::Dialect& dialect,
                         const interpreter::Setup& setup) {
  const auto stated = setup.units.value_or(dialect.units);
  if (stated == reader.units) return {};
  const auto name = [](interpreter::Units units) {
    return interpreter::shown_unit(interpreter::Axis::X, units);
  };
  return fail(
      Errc::Conflict,
      "the machine's unit is {0}, that of the setup {1}: programs without G20 and G21 would "
      "be read in {1}. Set units = \"{0}\" in the setup",
      name(reader.units), name(stated));
}

constexpr std::string_view kStartupCode = "startup_code";

/// The state in which a program begins.
Result<std::vector<std::byte>> beginning(const interpreter::Dialect& dialect,
                                         const interpreter::Setup& setup) {
  interpreter::MemorySource source("");
  interpreter::EventSink sink;
  auto made = dialect.make(setup, source, sink);
  if (!made) return fail(made.error());
  return (*made)->snapshot().bytes;
}

/// By what the codes do: many do no more than name the modes of power on.
Result<void> check_startup_code(const std::string& code, const interpreter::Dialect& dialect,
                                const interpreter::Setup& setup) {
  const interpreter::OptionValue* const stated = setup.control.find(kStartupCode);
  if (stated == nullptr && code.empty()) return {};
  const auto ours = beginning(dialect, setup);
  if (!ours) return {};  // the start itself reports the setup's error
  interpreter::Setup as_there = setup;
  as_there.control.set(kStartupCode, {code, 0});
  const auto theirs = beginning(dialect, as_there);
  if (!theirs)
    return fail(Errc::Unsupported, "programs here cannot begin as at the machine: {}",
                one_line(theirs.error().what));
  if (*ours == *theirs) return {};
  if (code.empty())
    return fail(Errc::Conflict,
                "the setup has a startup_code, the machine none: programs would begin with other "
                "modes. Take it out of the setup");
  return fail(Errc::Conflict,
              "the machine's programs begin after its startup code, those of the setup with other "
              "modes. Set startup_code = \"{}\" in [control] of the setup",
              one_line(code));
}

}  // namespace

Result<void> check_reader(const std::optional<machine::ProgramReader>& reader,
                          const interpreter::Dialect& dialect, const interpreter::Setup& setup) {
  if (!reader || reader->control != dialect.name) return {};
  if (auto done = check_units(*reader, dialect, setup); !done) return done;
  if (!reader->settings.empty())
    return fail(Errc::Unsupported,
                "programs here are not read as at the machine, which has {}: take it out there",
                one_line(reader->settings));
  return check_startup_code(reader->startup_code, dialect, setup);
}

std::optional<Reply> refusal_of_program(const dds::Command& start, const GatewayOptions& options) {
  if (start.control != options.control)
    return refuse(fmt::format("this machine's control is {}, the program is for '{}'",
                              options.control, start.control));
  if (const auto name = check_program_name(start.program); !name) return refuse(name.error().what);
  if (const auto digest = parse_digest(start.revision); !digest)
    return refuse(fmt::format("revision: {}", digest.error().what));
  if (start.size == 0 || start.size > kMaxProgramBytes)
    return refuse(
        fmt::format("a program of {} bytes, expected 1 to {}", start.size, kMaxProgramBytes));
  return std::nullopt;
}

}  // namespace dripline::gateway
