#include "server/machines/record_writer.hpp"

#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

using machines::RecordWriter;

/// Refuses with `error` while it has one.
struct RefusingRecords final : test_support::RecordStoreDecorator {
  using RecordStoreDecorator::RecordStoreDecorator;
  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    if (error) return fail(*error);
    return RecordStoreDecorator::store(batch);
  }
  std::optional<Error> error;
};

class RecordWriterTest : public ServerTest {
 protected:
  RecordWriterTest() { batch_.machine = "lathe-1"; }

  RefusingRecords records_{*store_};
  std::vector<std::string> faults_;
  RecordWriter writer_{{.store = records_,
                        .machine = "lathe-1",
                        .consequence = "the test waits",
                        .on_fault = [this](const std::string& f) { faults_.push_back(f); }}};
  storage::RecordBatch batch_;
};

TEST_F(RecordWriterTest, PausesLongerFromTryToTryWhileTheStoreRefuses) {
  records_.error = Error{Errc::Io, "disk full"};
  std::vector<std::int64_t> pauses;
  for (int i = 0; i < 7; ++i) {
    EXPECT_FALSE(writer_.store(batch_));
    pauses.push_back(writer_.pause().count());
  }
  EXPECT_EQ(pauses, (std::vector<std::int64_t>{250, 500, 1000, 2000, 4000, 5000, 5000}));
  EXPECT_EQ(faults_, std::vector<std::string>(7, "disk full"));
}

TEST_F(RecordWriterTest, ReportsOnceThatTheStoreTakesRecordsAgain) {
  records_.error = Error{Errc::Io, "disk full"};
  EXPECT_FALSE(writer_.store(batch_));
  records_.error.reset();
  EXPECT_TRUE(writer_.store(batch_));
  EXPECT_TRUE(writer_.store(batch_));
  EXPECT_EQ(writer_.pause().count(), 0);
  EXPECT_EQ(faults_, (std::vector<std::string>{"disk full", ""}));
}

TEST_F(RecordWriterTest, NeverPausesForRecordsThatCannotBeStoredAtAll) {
  records_.error = Error{Errc::Syntax, "a bad name"};
  EXPECT_FALSE(writer_.store(batch_));
  EXPECT_EQ(writer_.pause().count(), 0);
  EXPECT_TRUE(faults_.empty());
}

}  // namespace
}  // namespace dripline::server_test
