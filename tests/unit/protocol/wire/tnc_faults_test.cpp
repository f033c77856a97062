#include <fmt/format.h>
#include <gmock/gmock.h>

#include "protocol/wire/tape_code.hpp"
#include "tests/support/fault_runs.hpp"

/// The TNC's protocols and tape readers on lines that lose, double and change characters: each gets
/// fault_runs() transfers, in parts that run side by side.
namespace dripline::wire {
namespace {

using std::chrono::seconds;
using test_support::FaultCase;
using test_support::FaultRun;
using Kind = test_support::LineFaults::Kind;

constexpr double kRates[] = {0.0001, 0.001, 0.003, 0.01};

struct Part {
  std::string name;
  FaultCase fault_case;
  std::size_t number = 0, count = 0;
};

void PrintTo(const Part& part, std::ostream* out) {
  *out << part.name;
}

std::vector<Part> parts_of(const std::string& name, FaultCase fault_case) {
  constexpr std::size_t kDirections = 2, kParts = std::size(kRates);
  const std::size_t count = test_support::fault_runs() / kParts / kDirections + 1;
  std::vector<Part> parts;
  for (std::size_t i = 0; i < kParts; ++i) {
    fault_case.faults.rate = kRates[i];
    parts.push_back({name + "_" + std::to_string(i), fault_case, i, count});
  }
  return parts;
}

std::string random_tnc_program(test_support::FaultDice& dice, std::size_t blocks) {
  std::string text = "0 BEGIN PGM 7 MM\n";
  for (std::size_t i = 1; i <= blocks; ++i) {
    text += fmt::format("{} L X{},{} Y-{} R0 F{}\n", i, dice.below(1000), dice.below(100),
                        dice.below(100), dice.below(900) + 1);
  }
  return text + fmt::format("{} END PGM 7 MM\n", blocks + 1);
}

FaultCase case_of(std::string_view name, bool host_sends) {
  FaultCase fault_case;
  fault_case.settings = find_template(name).value()->settings;
  fault_case.settings.answer_limit = seconds(3);
  fault_case.settings.hold_limit = seconds(20);
  fault_case.settings.start_limit = seconds(20);
  fault_case.settings.leader = fault_case.settings.trailer = 5;
  fault_case.host_sends = host_sends;
  fault_case.hold_rate = 0.01;
  if (name.starts_with("tnc")) fault_case.program = random_tnc_program;
  return fault_case;
}

std::vector<Part> both_ways(const std::string& name, std::string_view line_template,
                            bool repeats = false) {
  auto feed = case_of(line_template, true), punch = case_of(line_template, false);
  feed.settings.heidenhain.repeats_unanswered = repeats;
  auto parts = parts_of(name + "_feed", feed);
  for (auto& part : parts_of(name + "_punch", punch)) parts.push_back(std::move(part));
  return parts;
}

void run_part(const Part& part, const std::function<void(const FaultRun&)>& check) {
  const std::uint64_t first = test_support::first_fault_seed() + part.number * part.count;
  run_faults(part.fault_case, first, part.count,
             [&](const FaultRun& run) { ASSERT_NO_FATAL_FAILURE(check(run)); });
}

std::string part_name(const testing::TestParamInfo<Part>& info) {
  return info.param.name;
}

/// An exclusive or does not see two characters of a block that are lost, or come twice, when they
/// are alike: whether that is all that is wrong with `received`.
bool is_blind_spot(std::string_view sent, std::string_view received) {
  const auto check = [](std::string_view line) {
    char sum = 0;
    for (const char c : line) sum = static_cast<char>(sum ^ c);
    return sum;
  };
  while (!sent.empty() && !received.empty()) {
    const auto line = sent.substr(0, sent.find('\n')),
               got = received.substr(0, received.find('\n'));
    if (line != got && check(line) != check(got)) return false;
    sent.remove_prefix(std::min(sent.size(), line.size() + 1));
    received.remove_prefix(std::min(received.size(), got.size() + 1));
  }
  return received.empty();
}

class TncBlockwiseFaults : public testing::TestWithParam<Part> {};

TEST_P(TncBlockwiseFaults, DeliversExactlyOrReportsTheError) {
  run_part(GetParam(), [](const FaultRun& run) {
    ASSERT_TRUE(run.has_ended()) << run.story();
    const bool is_prefix = run.text.starts_with(run.receiver->received);
    ASSERT_TRUE(is_prefix || is_blind_spot(run.text, run.receiver->received)) << run.story();
    if (run.receiver->receptions == 0) {
      ASSERT_TRUE(run.is_reported()) << run.story();
    }
    if (run.receiver->receptions > 0 && run.receiver->received != run.text) {
      ASSERT_TRUE(is_blind_spot(run.text, run.receiver->received)) << run.story();
    }
    if (run.sender->sends > 0) {  // a control gets no answer to its ETX and EOT
      ASSERT_TRUE(run.receiver->receptions == 1 || !run.receiver->failures.empty()) << run.story();
    }
    ASSERT_LE(run.sender->accepted, run.text.size()) << run.story();
    if (run.forward.faults + run.backward.faults == 0) {
      ASSERT_TRUE(run.is_exact() && !run.is_reported()) << run.story();
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Waiting, TncBlockwiseFaults,
                         testing::ValuesIn(both_ways("bcc", "tnc155-bcc")), part_name);
INSTANTIATE_TEST_SUITE_P(Repeating, TncBlockwiseFaults,
                         testing::ValuesIn(both_ways("bcc", "tnc155-bcc", true)), part_name);

class TncStandardFaults : public testing::TestWithParam<Part> {};

TEST_P(TncStandardFaults, ReportsDetectedErrorsAndNeverHangs) {
  run_part(GetParam(), [](const FaultRun& run) {
    ASSERT_TRUE(run.has_ended()) << run.story();
    if (run.forward.silent == 0 && run.backward.silent == 0) {
      ASSERT_TRUE(run.is_exact() || run.is_reported()) << run.story();
    }
    if (run.forward.faults + run.backward.faults == 0) {
      ASSERT_TRUE(run.is_exact() && !run.is_reported()) << run.story();
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Tnc, TncStandardFaults, testing::ValuesIn(both_ways("standard", "tnc155")),
                         part_name);
// HD-220
INSTANTIATE_TEST_SUITE_P(TncRts, TncStandardFaults,
                         testing::ValuesIn(both_ways("rts", "tnc155-rts")), part_name);

class TapeFaults : public testing::TestWithParam<Part> {};

TEST_P(TapeFaults, AreSeenByTheParityOfTheCode) {
  run_part(GetParam(), [](const FaultRun& run) {
    ASSERT_TRUE(run.has_ended()) << run.story();
    ASSERT_TRUE(run.is_exact() || run.is_reported()) << run.story();
    if (run.forward.faults + run.backward.faults == 0) {
      ASSERT_TRUE(run.is_exact()) << run.story();
    }
  });
}

class TapeLineFaults : public testing::TestWithParam<Part> {};

TEST_P(TapeLineFaults, NeverHangTheReader) {
  run_part(GetParam(), [](const FaultRun& run) {
    ASSERT_TRUE(run.has_ended()) << run.story();
    if (run.forward.faults + run.backward.faults == 0) {
      ASSERT_TRUE(run.is_exact()) << run.story();
    }
  });
}

std::vector<Part> tapes(const std::vector<Kind>& kinds) {
  std::vector<Part> parts;
  for (const auto& [name, line_template] :
       {std::pair{"eia", "tektronix1704"}, std::pair{"iso", "tektronix1704-iso"}}) {
    auto fault_case = case_of(line_template, true);
    if (!kinds.empty()) fault_case.faults.kinds = kinds;
    fault_case.settings.reader.characters_per_second = 500;
    fault_case.expected = [](const std::string& text) { return "%\n" + text; };
    for (auto& part : parts_of(name, fault_case)) parts.push_back(std::move(part));
  }
  return parts;
}

INSTANTIATE_TEST_SUITE_P(Tape, TapeFaults, testing::ValuesIn(tapes({Kind::Flip})), part_name);
INSTANTIATE_TEST_SUITE_P(Tape, TapeLineFaults, testing::ValuesIn(tapes({})), part_name);

}  // namespace
}  // namespace dripline::wire
