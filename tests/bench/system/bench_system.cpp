// Whole-system figures on real processes: a program of 1 GiB pushed, fed and pulled; first-block
// time; peak memory; records a second. Prints one JSON object per figure. `--bytes N` makes the
// program smaller for a quick look.
#include <gtest/gtest.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace {

using dripline::integration::program_path;
using dripline::integration::System;
using dripline::test_support::eventually;
using dripline::test_support::run_to_end;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::minutes kLimit{10};
constexpr double kMebi = 1 << 20;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void figure(const char* name, double value, const char* unit) {
  std::printf("{\"figure\":\"%s\",\"value\":%.6g,\"unit\":\"%s\"}\n", name, value, unit);
  std::fflush(stdout);
}

std::uint64_t wanted_bytes = 1ull << 30;

class Bench : public testing::Test {
 protected:
  void SetUp() override {
    system.start_server();
    system.start_gateway();
    system.wait_connected();
  }
  /// Runs `dnc` against the server and returns how long it took.
  double dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system.server_state()});
    const auto start = Clock::now();
    const auto done = run_to_end(arguments, system.folder() / "dnc.out", kLimit);
    EXPECT_EQ(done.status, 0) << done.output;
    return seconds_since(start);
  }
  System system;
};

TEST_F(Bench, AVeryLargeProgram) {
  const auto file = system.folder() / "large.nc";
  {
    std::ofstream out(file, std::ios::binary);
    dripline::test_support::write_contour_of_size(wanted_bytes, [&](std::string_view text) {
      out.write(text.data(), static_cast<std::streamsize>(text.size()));
    });
  }
  const double mebibytes = static_cast<double>(std::filesystem::file_size(file)) / kMebi;
  const double push = dnc({"program", "push", file, "--name", "O0200", "--control", "centurion"});
  figure("push", push, "s");
  figure("push rate", mebibytes / push, "MiB/s");
  const double pull = dnc({"program", "pull", "O0200", "-o", system.folder() / "pulled.nc"});
  figure("pull", pull, "s");
  figure("pull rate", mebibytes / pull, "MiB/s");

  const auto start = Clock::now();
  const std::string id = system.start_run("O0200");
  EXPECT_TRUE(eventually([&] { return system.execution_probe().blocks_done > 0; }));
  figure("first block executed after start", seconds_since(start), "s");
  const auto run = system.wait_ended(id, kLimit);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  figure("feed and execute", seconds_since(start), "s");
  figure("feed and execute rate", mebibytes / seconds_since(start), "MiB/s");
  figure("blocks executed", run.value("executed", 0.0), "blocks");
  figure("peak memory dncd", static_cast<double>(system.server().peak_memory()) / kMebi, "MiB");
  figure("peak memory dncgw", static_cast<double>(system.gateway().peak_memory()) / kMebi, "MiB");
}

/// Cut off at 90 %: how long until the operator sees what a restart will do, and how much memory
/// that takes.
TEST_F(Bench, ARestartOfAVeryLargeProgram) {
  const auto file = system.folder() / "large.nc";
  std::uint64_t blocks = 0;
  {
    std::ofstream out(file, std::ios::binary);
    dripline::test_support::write_contour_of_size(wanted_bytes, [&](std::string_view text) {
      blocks += static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
      out.write(text.data(), static_cast<std::streamsize>(text.size()));
    });
  }
  dnc({"program", "push", file, "--name", "O0200", "--control", "centurion"});
  const std::string id = system.start_run("O0200");
  EXPECT_TRUE(
      eventually([&] { return system.execution_probe().blocks_done > blocks / 10 * 9; }, kLimit));
  system.gateway().kill();
  system.start_gateway();
  system.wait_connected();
  const auto cut = system.wait_ended(id);
  figure("cut off after", cut.value("executed", 0.0), "blocks");
  figure("restart where it was cut off", dnc({"run", "restart", id}), "s");
  dnc({"run", "abort", "latest"});
  const std::uint64_t place = std::min<std::uint64_t>(10'000'000, blocks / 2);
  figure("restart place", static_cast<double>(place), "blocks");
  figure("restart at that place",
         dnc({"run", "restart", id, "--at", "block=" + std::to_string(place)}), "s");
  figure("peak memory dncgw in restarts",
         static_cast<double>(system.gateway().peak_memory()) / kMebi, "MiB");
  dnc({"run", "abort", "latest"});
}

TEST_F(Bench, RecordsFromTheGatewayToCommittedRows) {
  constexpr std::uint64_t kLines = 50'000;
  std::string text;
  dripline::test_support::write_report_program(kLines, 0,
                                               [&](std::string_view piece) { text += piece; });
  system.push("O0300", text);
  const auto start = Clock::now();
  const std::string id = system.start_run("O0300");
  EXPECT_EQ(system.wait_ended(id, kLimit).value("outputs", 0u), kLines);
  figure("records committed", static_cast<double>(kLines) / seconds_since(start), "records/s");
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::UnitTest::GetInstance()->listeners().Release(
      testing::UnitTest::GetInstance()->listeners().default_result_printer());
  if (argc == 3 && std::string(argv[1]) == "--bytes") wanted_bytes = std::stoull(argv[2]);
  const int failed = RUN_ALL_TESTS();
  if (failed != 0)
    std::fprintf(stderr, "bench_system: a step failed; run it as a test to see which\n");
  return failed;
}
