#include <gmock/gmock.h>

#include "tests/support/fault_runs.hpp"

/// Whole transfers over lines that lose, double and change characters. Each protocol and direction
/// gets its share of fault_runs(), in parts that run side by side.
namespace dripline::wire {
namespace {

using std::chrono::milliseconds;
using test_support::FaultCase;
using test_support::FaultRun;
using test_support::LineFaults;
using Kind = LineFaults::Kind;

constexpr std::size_t kParts = 4;

LineSettings settings_of(std::string_view name) {
  const auto found = find_template(name);
  EXPECT_TRUE(found) << name;
  LineSettings settings = (*found)->settings;
  settings.hold_limit = milliseconds(5000);
  settings.answer_limit = milliseconds(3000);
  return settings;
}

struct Protocol {
  std::string name;
  LineSettings settings;
  bool host_sends = true;
};

/// The parts of a protocol's runs: from a line that is nearly good to one fault in a hundred.
struct Part {
  Protocol protocol;
  std::size_t number;
  double rate() const {
    constexpr double kRates[kParts] = {0.0001, 0.001, 0.003, 0.01};
    return kRates[number];
  }
};

void PrintTo(const Part& part, std::ostream* out) {
  *out << part.protocol.name << part.number;
}

std::string part_name(const testing::TestParamInfo<Part>& info) {
  return info.param.protocol.name + "_" + std::to_string(info.param.number);
}

std::vector<Part> parts_of(const std::vector<Protocol>& protocols) {
  std::vector<Part> parts;
  for (const Protocol& protocol : protocols) {
    for (std::size_t i = 0; i < kParts; ++i) parts.push_back({protocol, i});
  }
  return parts;
}

FaultCase case_of(const Part& part) {
  FaultCase fault_case;
  fault_case.settings = part.protocol.settings;
  fault_case.host_sends = part.protocol.host_sends;
  fault_case.faults.rate = part.rate();
  fault_case.hold_rate = 0.02;
  return fault_case;
}

/// Both directions of one protocol share its runs.
void run_part(const Part& part, const FaultCase& fault_case,
              const std::function<void(const FaultRun&)>& check) {
  const std::size_t count = std::max<std::size_t>(1, test_support::fault_runs() / kParts / 2);
  const std::uint64_t first = test_support::first_fault_seed() + part.number * count;
  run_faults(fault_case, first, count,
             [&](const FaultRun& run) { ASSERT_NO_FATAL_FAILURE(check(run)); });
}

// Lines without checks

LineSettings paced() {
  LineSettings settings = settings_of("plain");
  settings.flow = Flow::None;
  settings.line_delay = milliseconds(5);
  return settings;
}

LineSettings with_flow(Flow flow) {
  LineSettings settings = settings_of("plain");
  settings.flow = flow;
  return settings;
}

LineSettings iso() {
  LineSettings settings = settings_of("plain");
  settings.code = CharacterCode::Iso;
  return settings;
}

LineSettings with_parity(LineSettings settings) {
  EXPECT_TRUE(apply_short_form("9600e71", settings));
  return settings;
}

std::vector<Protocol> both_ways(const std::vector<Protocol>& protocols) {
  std::vector<Protocol> both;
  for (const Protocol& protocol : protocols) {
    both.push_back({protocol.name + "_feed", protocol.settings, true});
    both.push_back({protocol.name + "_punch", protocol.settings, false});
  }
  return both;
}

class UncheckedLine : public testing::TestWithParam<Part> {};

TEST_P(UncheckedLine, ReportsDetectedErrorsAndNeverHangs) {
  const FaultCase fault_case = case_of(GetParam());
  run_part(GetParam(), fault_case, [&](const FaultRun& run) {
    ASSERT_TRUE(run.has_ended()) << run.story();
    const bool is_unchanged = run.forward.silent == 0 && run.backward.silent == 0;
    if (is_unchanged) {
      ASSERT_TRUE(run.is_exact() || run.is_reported()) << run.story();
    }
    if (run.forward.faults + run.backward.faults == 0) {
      ASSERT_TRUE(run.is_exact()) << run.story();
      ASSERT_FALSE(run.is_reported()) << run.story();
    }
    const bool has_heard = run.receiver->faults.size() + run.receiver->failures.size() > 0;
    if (run.forward.reported > 0) {
      ASSERT_TRUE(has_heard) << run.story();
    }
    ASSERT_EQ(run.forward.given_after_stop, 0u) << run.story();
    ASSERT_LE(run.forward.left_after_stop, 2u) << run.story();
  });
}

INSTANTIATE_TEST_SUITE_P(
    Plain, UncheckedLine,
    testing::ValuesIn(parts_of(both_ways({{"xonxoff", settings_of("plain")},
                                          {"xonxoff_parity", with_parity(settings_of("plain"))},
                                          {"iso", iso()},
                                          {"rtscts", with_flow(Flow::RtsCts)},
                                          {"paced", paced()},
                                          {"dc_codes", settings_of("fanuc")},
                                          {"centurion", settings_of("centurion")}}))),
    part_name);

// ProtoTRAK: keeps nothing of a program with an error

class ProtoTrakLine : public testing::TestWithParam<Part> {};

TEST_P(ProtoTrakLine, KeepsAllOrReportsTheError) {
  FaultCase fault_case = case_of(GetParam());
  fault_case.hold_rate = 0;
  fault_case.expected = [](const std::string& text) { return text + "%\n"; };
  run_part(GetParam(), fault_case, [&](const FaultRun& run) {
    ASSERT_TRUE(run.has_ended()) << run.story();
    if (run.forward.reported > 0 && run.receiver->received.find('%') == std::string::npos) {
      ASSERT_FALSE(run.receiver->failures.empty()) << run.story();
    }
    if (run.forward.silent == 0) {
      ASSERT_TRUE(run.is_exact() || !run.receiver->failures.empty()) << run.story();
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Plain, ProtoTrakLine,
                         testing::ValuesIn(parts_of({{"prototrak", settings_of("prototrak")}})),
                         part_name);

// XMODEM

class XmodemLineFaults : public testing::TestWithParam<Part> {};

/// How many of so many runs may deliver something wrong: a CRC of 16 bits misses one damaged block
/// in 65,536, and most runs have none. Of the tests' own runs: none.
std::size_t wrong_at_most(const FaultCase& fault_case, std::size_t runs) {
  return runs / (fault_case.settings.xmodem_crc ? 20'000 : 2'000);
}

TEST_P(XmodemLineFaults, DeliversExactlyOrReportsTheError) {
  FaultCase fault_case = case_of(GetParam());
  // Eight bits of checksum miss one damaged block in some hundred: only for lines that are nearly
  // good.
  if (!fault_case.settings.xmodem_crc) fault_case.faults.rate /= 20;
  std::size_t runs = 0, wrong = 0;
  std::string story;
  run_part(GetParam(), fault_case, [&](const FaultRun& run) {
    ++runs;
    ASSERT_TRUE(run.has_ended()) << run.story();
    if (run.receiver->receptions == 0) {
      ASSERT_FALSE(run.receiver->failures.empty()) << run.story();
    }
    if (run.sender->sends > 0) {
      ASSERT_EQ(run.sender->accepted, run.text.size()) << run.story();
      ASSERT_EQ(run.receiver->receptions, 1u) << run.story();
    } else {
      ASSERT_FALSE(run.sender->failures.empty()) << run.story();
    }
    const bool is_whole = run.receiver->receptions == 0 || run.is_exact();
    if (is_whole && run.expected.starts_with(run.receiver->received)) return;
    if (wrong++ == 0) story = run.story();
  });
  EXPECT_LE(wrong, wrong_at_most(fault_case, runs)) << story;
}

LineSettings xmodem(bool has_crc) {
  LineSettings settings = settings_of("xmodem");
  settings.xmodem_crc = has_crc;
  return settings;
}

INSTANTIATE_TEST_SUITE_P(Xmodem, XmodemLineFaults,
                         testing::ValuesIn(parts_of(both_ways({{"crc", xmodem(true)},
                                                               {"checksum", xmodem(false)}}))),
                         part_name);

}  // namespace
}  // namespace dripline::wire
