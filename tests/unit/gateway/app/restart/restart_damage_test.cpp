// A restart from a file that was damaged: what is not proved moves nothing. DRIPLINE_RESTART_FLIPS
// changes how often.
#include <cstdlib>
#include <fstream>
#include <random>

#include "tests/unit/gateway/app/restart/restart_faults.hpp"

namespace dripline::gateway {
namespace {

using testing::HasSubstr;

int flips() {
  const char* wanted = std::getenv("DRIPLINE_RESTART_FLIPS");
  return wanted != nullptr ? std::atoi(wanted) : 60;
}

class DamagedFile : public RestartFaults {
 protected:
  void SetUp() override {
    abort_at_stop();
    executed = shop.last_end().executed;
    shop.restart_gateway();  // the simulated axes are at their start again
    const auto report = restart();
    ASSERT_TRUE(report.is_object()) << reason();
    ASSERT_TRUE(shop.cycle_start());
    ASSERT_TRUE(shop.run_on());
    right = shop.path;
    // The same again, up to where the restart began: `run` is the run that was cut off.
    abort_at_stop();
    shop.close_gateway();
    std::ifstream in(file(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
    records = shop.records;
  }
  std::filesystem::path file() const { return shop.folder() / "outbox.sqlite"; }
  /// Nothing reaches the machine, or what is right.
  void restart_from(const std::string& damaged) {
    shop.close_gateway();
    for (const char* suffix : {"-wal", "-shm"}) std::filesystem::remove(file().string() + suffix);
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << damaged;
    shop.records = records;
    try {
      shop.restart_gateway();
    } catch (const std::exception&) {
      ++unopened;  // dncgw ends with the fault in its log
      return;
    }
    nlohmann::json report;
    try {
      report = restart();
    } catch (const std::out_of_range&) {
      // No answer at all: whether the command was carried out before cannot be looked up.
    }
    if (!report.is_object()) {
      ++refused;
      // A report that cannot be kept is none that the operator has seen.
      if (!shop.path.empty()) {
        EXPECT_THAT(shop.panel("cycle-start"), HasSubstr("reports cannot be kept"));
        EXPECT_FALSE(shop.cycle_start());
      }
      EXPECT_EQ(shop.status->executed, 0u);
      return;
    }
    if (report["after"]["block"] != executed || report["proof"]["path"] != "equal") {
      ADD_FAILURE() << report.dump();
      return;
    }
    ASSERT_TRUE(shop.cycle_start());
    (void)shop.run_until([&] { return shop.path.size() >= right.size(); });
    EXPECT_EQ(shop.path, right);
    ++completed;
  }

  std::uint64_t executed = 0;
  RestartFixture::Path right;
  std::string bytes;
  std::vector<dds::Record> records;
  int unopened = 0, refused = 0, completed = 0;
};

TEST_F(DamagedFile, AFlippedBitMovesNothingThatWasNotProved) {
  std::mt19937 random{20261123};
  for (int i = 0; i < flips() && !HasFailure(); ++i) {
    std::string damaged = bytes;
    auto at = std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random);
    while (bytes[at] == 0) at = (at + 1) % bytes.size();  // most of the file is empty
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
    SCOPED_TRACE(at);
    restart_from(damaged);
  }
  std::printf("%zu bytes: %d not opened, %d refused, %d completed\n", bytes.size(), unopened,
              refused, completed);
}

TEST_F(DamagedFile, ATruncatedFileMovesNothing) {
  for (std::size_t part = 1; part < 8 && !HasFailure(); ++part) {
    SCOPED_TRACE(part);
    restart_from(bytes.substr(0, bytes.size() * part / 8));
  }
  EXPECT_EQ(completed, 0);
}

}  // namespace
}  // namespace dripline::gateway
