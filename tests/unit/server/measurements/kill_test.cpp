#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>

#include "tests/unit/server/measurements/measurements_fixture.hpp"

namespace dripline::measurements {
namespace {

/// The server as another process, that writes a byte for each part it has judged.
class KilledMeasurements : public MeasurementsTest {
 protected:
  /// Derives until it has judged `parts` parts, and is then killed; absent: until all is done.
  void derive_in_a_process(std::optional<unsigned> parts) {
    store_.reset();
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      derive(ends[1]);
    }
    ::close(ends[1]);
    char byte = 0;
    for (unsigned n = 0; (!parts || n < *parts) && ::read(ends[0], &byte, 1) == 1; ++n) {
    }
    if (parts) ::kill(child, SIGKILL);
    ::close(ends[0]);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (!parts) {
      EXPECT_EQ(status, 0);
    }
    auto opened = storage::SqliteStore::open({.file = file()}, clock_);
    ASSERT_TRUE(opened) << opened.error().what;
    store_ = *std::move(opened);
  }
  std::filesystem::path file() const { return folder_.path() / "store.sqlite"; }

 private:
  [[noreturn]] void derive(int to) {
    auto store = storage::SqliteStore::open({.file = file()}, clock_);
    if (!store) ::_exit(1);
    Measurements measurements({.store = **store, .clock = clock_, .on_part = [to](const auto&) {
                                 if (::write(to, "p", 1) != 1) ::_exit(2);
                               }});
    measurements.begin();
    ::_exit(measurements.wait(std::chrono::seconds(120)) ? 0 : 3);
  }
};

TEST_F(KilledMeasurements, LoseAndDoubleNothing) {
  start();
  use(kBore);
  measurements_.reset();
  make_run("r1");
  constexpr int kParts = 3000;
  std::vector<std::string> lines;
  for (int part = 0; part < kParts; ++part) {
    for (const auto& line : {fmt::format("PART {}", part), std::string("D 40.001"),
                             std::string(part % 7 == 0 ? "D 40.1" : "D 40.002")})
      lines.push_back(line);
    if (lines.size() < 300) continue;
    print(lines);
    lines.clear();
  }
  lines.emplace_back("run_ended");
  print(lines);
  std::mt19937 random(20261124);
  std::uniform_int_distribution<unsigned> some(0, 700);
  for (int kill = 0; kill < 8; ++kill) derive_in_a_process(some(random));
  derive_in_a_process(std::nullopt);
  EXPECT_TRUE(store_->measurements.underived()->empty());
  std::vector<std::uint64_t> numbers;
  std::optional<storage::MeasurementPlace> place;
  for (;;) {
    const auto rows = store_->measurements.list({.run = "r1"}, place, 1000);
    ASSERT_TRUE(rows) << rows.error().what;
    for (const auto& row : *rows) numbers.push_back(row.record.number);
    if (rows->size() < 1000) break;
    place = storage::MeasurementPlace{rows->back().time, rows->back().id};
  }
  ASSERT_EQ(numbers.size(), std::size_t{2} * kParts);
  EXPECT_TRUE(std::ranges::is_sorted(numbers)) << "in order";
  EXPECT_EQ(std::unique(numbers.begin(), numbers.end()), numbers.end());
  const auto counts = store_->measurements.parts_of_run("r1")->verdicts;
  EXPECT_EQ(counts[3], 429u);
  EXPECT_EQ(counts[0], kParts - 429u);
}

}  // namespace
}  // namespace dripline::measurements
