#include "server/paths/text_check.hpp"

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/registry.hpp"
#include "server/machines/control_memory.hpp"
#include "server/paths/impl/interpretation.hpp"

namespace dripline::paths {
namespace {

using Verdict = Result<std::optional<std::string>>;

constexpr std::uint64_t kBlocksAtOnce = 16'384;
constexpr std::uint64_t kMaxCalled = 16 * 1024 * 1024;  ///< bytes of a program that is called

std::string in_words(const interpreter::Diagnostic& diagnostic) {
  return fmt::format("line {}: {} {}", diagnostic.line, diagnostic.id, diagnostic.text);
}

/// The text of a called program, as a run that begins now would get it.
std::optional<std::string> called_text(const machines::RunSources& sources, const storage::Run& run,
                                       std::string_view name) {
  const auto revision = machines::resolve_called_program(sources, run, std::string(name));
  if (!revision || revision->size > kMaxCalled) return std::nullopt;
  const auto bytes = sources.store.programs.read_content(revision->content, 0, revision->size);
  if (!bytes) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

/// Whether a control that keeps its programs has room for it.
Verdict check_memory(const interpreter::Dialect& dialect, const interpreter::Setup& setup,
                     interpreter::ProgramSource& source) {
  if (dialect.check_memory == nullptr) return std::optional<std::string>();
  const auto verdict = dialect.check_memory(setup, source);
  if (!verdict) return fail(verdict.error());
  if (!verdict->is_binding || verdict->refused.empty()) return std::optional<std::string>();
  return std::optional(in_words(verdict->refused.front()));
}

Verdict run_text_to_end(interpreter::OfflineRun run, const machines::RunSources& sources,
                        const ProgramText& program) {
  const auto limit = sources.clock.steady_now() + kMaxTextCheck;
  for (;;) {
    const auto is_over = run.step(kBlocksAtOnce);
    // A question without an answer, or too many blocks: the program's own doing.
    if (!is_over) return std::optional(is_over.error().what);
    if (*is_over) break;
    if (program.stop.stop_requested() || sources.clock.steady_now() >= limit)
      return fail(Errc::Timeout, "program {} is not checked in {} s", program.name,
                  kMaxTextCheck.count());
  }
  const auto outcome = run.outcome();
  if (outcome.ended) return std::optional<std::string>();
  if (!outcome.alarm) return std::optional<std::string>("it does not reach its end");
  std::string words = in_words(*outcome.alarm);
  if (outcome.alarm_program != interpreter::kMainProgram) words += " (in a program that it calls)";
  return std::optional(std::move(words));
}

}  // namespace

Verdict check_text(const machines::RunSources& sources, const ProgramText& program) {
  const auto dialect = interpreter::find_dialect(program.control);
  if (!dialect) return fail(Errc::Unsupported, "{}", dialect.error().what);
  const auto setup = interpretation_setup(sources, program.machine, **dialect);
  if (!setup) return fail(setup.error());
  storage::Revision revision;
  revision.program = program.name;
  revision.size = program.text.size();
  revision.control = program.control;
  const storage::Run run = interpreted_run(sources, revision, program.machine);
  interpreter::MemorySource source(
      program.text, [&](std::string_view name) { return called_text(sources, run, name); });
  auto fits = check_memory(**dialect, *setup, source);
  if (!fits || *fits) return fits;
  interpreter::EventSink no_sink;
  auto begun = interpreter::OfflineRun::begin(**dialect, *setup, source, no_sink, kLimits);
  if (!begun) return fail(begun.error());
  return run_text_to_end(*std::move(begun), sources, program);
}

}  // namespace dripline::paths
