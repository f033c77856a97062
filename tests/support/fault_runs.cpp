#include "tests/support/fault_runs.hpp"

#include <fmt/core.h>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "protocol/base/invariant.hpp"

namespace dripline::test_support {
namespace {

constexpr std::size_t kRunsOfOneProtocol = 10'000;

std::uint64_t environment_number(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  if (value == nullptr) return otherwise;
  std::uint64_t number = 0;
  const char* const end = value + std::strlen(value);
  const auto [rest, error] = std::from_chars(value, end, number);
  invariant(error == std::errc{} && rest == end, "DRIPLINE_FAULT_... is a number");
  return number;
}

std::unique_ptr<wire::Discipline> make(const wire::LineSettings& settings, wire::Role role) {
  auto made = wire::make_discipline(settings, role);
  invariant(made.has_value(), "a fault case's settings exclude each other");
  return std::move(*made);
}

bool may_stay(const LineEnd& end) {
  const wire::LineState state = end.line->state();
  return state.phase == wire::Phase::Idle || state.may_wait_without_limit;
}

std::string end_story(const LineEnd& end) {
  std::string story = fmt::format("receptions {} sends {} received '{}'\n", end.receptions,
                                  end.sends, end.received);
  for (const Error& error : end.failures) story += "  failed: " + error.what + '\n';
  for (const Error& error : end.faults) story += "  fault: " + error.what + '\n';
  return story;
}

}  // namespace

std::size_t fault_runs() {
  return static_cast<std::size_t>(environment_number("DRIPLINE_FAULT_RUNS", kRunsOfOneProtocol));
}

std::uint64_t first_fault_seed() {
  return environment_number("DRIPLINE_FAULT_SEED", 1);
}

std::string FaultRun::story() const {
  return fmt::format(
      "seed {}, outcome {}, faults {} ({} reported, {} silent) and {} back\nsent '{}'\nsender: "
      "{}receiver: {}",
      seed, static_cast<int>(outcome), forward.faults, forward.reported, forward.silent,
      backward.faults, text, end_story(*sender), end_story(*receiver));
}

bool FaultRun::is_reported() const {
  return !sender->failures.empty() || !sender->faults.empty() || !receiver->failures.empty() ||
         !receiver->faults.empty();
}

bool FaultRun::has_ended() const {
  const bool is_over =
      outcome == LineSimulator::Outcome::Idle || outcome == LineSimulator::Outcome::Waiting;
  return is_over && may_stay(*sender) && may_stay(*receiver);
}

std::string random_program(FaultDice& dice, std::size_t blocks) {
  std::string text;
  for (std::size_t i = 0; i < blocks; ++i) {
    text += fmt::format("N{} G{} X{}.{} Y-{} F{}\n", i + 1, dice.below(4), dice.below(1000),
                        dice.below(100), dice.below(100), dice.below(900) + 1);
  }
  return text + "M30\n";
}

void run_faults(const FaultCase& fault_case, std::uint64_t first, std::size_t count,
                const std::function<void(const FaultRun&)>& check) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    FaultDice dice(seed ^ 0x5eed);
    FaultRun run;
    run.seed = seed;
    const std::size_t blocks = 1 + dice.below(8);
    run.text = fault_case.program ? fault_case.program(dice, blocks) : random_program(dice, blocks);
    run.expected = fault_case.expected ? fault_case.expected(run.text) : run.text;

    LineSimulator line({fault_case.settings, make(fault_case.settings, wire::Role::Host),
                        make(fault_case.settings, wire::Role::Control), fault_case.faults, seed});
    run.sender = fault_case.host_sends ? &line.host() : &line.control();
    run.receiver = fault_case.host_sends ? &line.control() : &line.host();
    run.receiver->hold_rate = fault_case.hold_rate;
    run.receiver->hold_time = fault_case.hold_time;
    run.sender->offer_at_most = 1 + dice.below(100);

    const auto receiving = run.receiver->line->begin_receive("", line.now());
    invariant(receiving.has_value(), "a fault run's receiver can begin");
    const auto sending = run.sender->send(run.text, line.now());
    invariant(sending.has_value(), "a fault run's sender can begin");
    run.outcome = line.run(fault_case.limit);
    run.forward = fault_case.host_sends ? line.from_host() : line.from_control();
    run.backward = fault_case.host_sends ? line.from_control() : line.from_host();
    check(run);
  }
}

}  // namespace dripline::test_support
