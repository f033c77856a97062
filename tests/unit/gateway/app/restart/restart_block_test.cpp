// A gateway that is killed in the instant after a block was executed, for each control: what is
// left of the program is done, and nothing twice. After the last block only the program's end is
// left.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "gateway/interpreter/registry.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"
#include "tests/unit/gateway/app/restart/restart_parts.hpp"

namespace dripline::gateway {
namespace {

class RestartAfterBlock : public testing::TestWithParam<Part> {
 protected:
  std::unique_ptr<RestartFixture> shop() const {
    const auto control = interpreter::find_dialect(GetParam().control).value();
    auto setup = interpreter::parse_setup(GetParam().setup, control->units).value();
    auto made = std::make_unique<RestartFixture>(*control, std::move(setup), "300x");
    made->set_checkpoint_interval(std::chrono::milliseconds(200));
    made->push("P", GetParam().program);
    made->restart_gateway();
    made->path.clear();
    return made;
  }
  RestartFixture::Path run_whole(std::uint64_t& blocks) const {
    const auto undisturbed = shop();
    EXPECT_TRUE(undisturbed->start_program("P").accepted);
    EXPECT_TRUE(undisturbed->run_on());
    EXPECT_EQ(undisturbed->last_end().outcome, dds::RunOutcome::Completed)
        << undisturbed->last_end().reason;
    blocks = undisturbed->last_end().executed;
    return undisturbed->path;
  }
  /// The report of a restart after a kill in the instant after that block. `executed`: a block that
  /// reported something is executed when its records are on disk, which came too late.
  nlohmann::json kill_after(RestartFixture& cut, std::uint64_t block,
                            std::uint64_t& executed) const {
    EXPECT_TRUE(cut.start_program("P").accepted);
    const std::string run = cut.last_run();
    EXPECT_TRUE(cut.run_until_killed_after(block));
    EXPECT_TRUE(cut.run_until([&] { return cut.count(dds::RecordKind::RunEnded) == 1; }));
    executed = cut.last_end().executed;
    EXPECT_LE(executed, block);
    cut.path.clear();
    write_seed(cut, run, block);
    return cut.begin_restart("P", run);
  }
  /// For the fuzz target of checkpoints, which adds the seal itself: with DRIPLINE_CHECKPOINT_SEEDS
  /// the content of the newest checkpoint becomes a file in that folder (tests/fuzz/seeds add).
  void write_seed(const RestartFixture& cut, const std::string& run, std::uint64_t block) const {
    const char* to = std::getenv("DRIPLINE_CHECKPOINT_SEEDS");
    if (to == nullptr) return;
    auto database = storage::sqlite::Database::open(cut.folder() / "outbox.sqlite").value();
    const auto kept = report::CheckpointStore::list(database, run).value();
    const auto bytes = report::CheckpointStore::read(database, run, kept.back().block)->bytes;
    std::ofstream out(std::filesystem::path(to) / fmt::format("{}-{}", GetParam().control, block),
                      std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size() - Digest::kSize));
  }
};

TEST_P(RestartAfterBlock, DoesTheRestOfTheProgram) {
  std::uint64_t blocks = 0;
  const auto whole = run_whole(blocks);
  ASSERT_GT(blocks, 10u);
  std::set<std::uint64_t> cuts{1, blocks - 1};
  for (std::uint64_t at = 1; at <= 4; ++at) cuts.insert(blocks * at / 5);
  for (const std::uint64_t block : cuts) {
    SCOPED_TRACE(block);
    const auto cut = shop();
    std::uint64_t executed = 0;
    const auto report = kill_after(*cut, block, executed);
    ASSERT_TRUE(report.is_object()) << cut->start_answer.reason << cut->last_end().reason;
    EXPECT_EQ(report["after"]["block"], executed);
    ASSERT_TRUE(cut->cycle_start());
    ASSERT_TRUE(cut->run_on(2000));
    EXPECT_EQ(cut->last_end().outcome, dds::RunOutcome::Completed) << cut->last_end().reason;
    EXPECT_EQ(difference(whole, cut->path, executed), "");
  }
}

// The counter is complete before the end of the run is on disk.
TEST_P(RestartAfterBlock, EndsAProgramThatWasExecutedToItsEnd) {
  std::uint64_t blocks = 0, executed = 0;
  (void)run_whole(blocks);
  const auto cut = shop();
  const auto report = kill_after(*cut, blocks, executed);
  ASSERT_TRUE(report.is_object()) << cut->start_answer.reason << cut->last_end().reason;
  const std::string_view control = GetParam().control;
  if (control == "prototrak-plus") {
    ASSERT_LT(executed, blocks) << "its last block is a stop: on disk together with the end";
    return;
  }
  ASSERT_EQ(executed, blocks);
  EXPECT_EQ(report["proof"]["path"], "equal");
  EXPECT_EQ(report["program_has_ended"], true);
  EXPECT_TRUE(report["approach"].empty()) << report["approach"].dump();
  EXPECT_EQ(report["switched_on"]["spindle"], "off");
  ASSERT_TRUE(cut->cycle_start());
  ASSERT_TRUE(cut->run_on(2000));
  EXPECT_EQ(cut->last_end().outcome, dds::RunOutcome::Completed) << cut->last_end().reason;
  EXPECT_EQ(cut->last_end().executed, blocks);
  EXPECT_EQ(cut->path, RestartFixture::Path{fmt::format("{} program end", blocks)});
}

INSTANTIATE_TEST_SUITE_P(, RestartAfterBlock, testing::ValuesIn(kParts), [](const auto& i) {
  std::string name = i.param.control;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dripline::gateway
