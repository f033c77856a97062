#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class RecordReaderTest : public ContractTest {
 protected:
  void store(const std::string& machine, std::uint64_t epoch, std::uint64_t first,
             std::uint64_t last) {
    auto batch = make_batch(first, last);
    batch.machine = machine;
    batch.epoch = epoch;
    for (auto& record : batch.records) {
      record.machine = machine;
      record.epoch = epoch;
      record.run.clear();
    }
    ASSERT_EQ(store_->records.store(batch).value_or(0), last);
  }
  /// machine/epoch: what it has < what there is
  std::string unread(const std::string& reader = "mqtt") {
    std::string text;
    const auto journals = store_->record_readers.unread(reader).value();
    for (const auto& [cursor, last] : journals)
      text += fmt::format("{}/{}:{}<{} ", cursor.machine, cursor.epoch, cursor.number, last);
    return text;
  }
};

TEST_P(RecordReaderTest, BeginsAfterWhatIsStored) {
  store("m1", 7, 1, 3);
  EXPECT_EQ(unread(), "") << "it has not begun";
  ASSERT_TRUE(store_->record_readers.begin("mqtt", clock_.now()));
  EXPECT_EQ(unread(), "");
  store("m1", 7, 4, 5);
  store("m2", 1, 1, 1);
  EXPECT_EQ(unread(), "m1/7:3<5 m2/1:0<1 ");
}

TEST_P(RecordReaderTest, ContinuesWhereItWas) {
  ASSERT_TRUE(store_->record_readers.begin("mqtt", clock_.now()));
  store("m1", 7, 1, 5);
  ASSERT_TRUE(store_->record_readers.advance("mqtt", {{"m1", 7, 2}}));
  reopen();
  ASSERT_TRUE(store_->record_readers.begin("mqtt", clock_.now()));
  EXPECT_EQ(unread(), "m1/7:2<5 ");
  ASSERT_TRUE(store_->record_readers.advance("mqtt", {{"m1", 7, 1}}));
  EXPECT_EQ(unread(), "m1/7:2<5 ") << "a cursor never goes back";
  ASSERT_TRUE(store_->record_readers.advance("mqtt", {{"m1", 7, 5}}));
  EXPECT_EQ(unread(), "");
}

TEST_P(RecordReaderTest, HasTheGrowingJournalOfAMachineLast) {
  ASSERT_TRUE(store_->record_readers.begin("mqtt", clock_.now()));
  store("m1", 9, 1, 1);
  store("m1", 4, 1, 2);
  Machine machine = store_->machines.find("m1").value();
  machine.epoch = 4;  // the gateway lost its journal
  ASSERT_TRUE(store_->machines.save(machine));
  EXPECT_EQ(unread(), "m1/9:0<1 m1/4:0<2 ");
}

TEST_P(RecordReaderTest, KnowsItsReadersAndMachines) {
  EXPECT_EQ(store_->record_readers.advance("mqtt", {{"m1", 7, 1}}).error().code, Errc::NotFound);
  ASSERT_TRUE(store_->record_readers.begin("mqtt", clock_.now()));
  EXPECT_EQ(store_->record_readers.advance("mqtt", {{"ghost", 7, 1}}).error().code, Errc::NotFound);
  store("m1", 7, 1, 1);
  ASSERT_TRUE(store_->record_readers.begin("other", clock_.now()));
  store("m1", 7, 2, 2);
  EXPECT_EQ(unread(), "m1/7:0<2 ");
  EXPECT_EQ(unread("other"), "m1/7:1<2 ");
}

ON_BOTH_ENGINES(RecordReaderTest);

}  // namespace
}  // namespace dripline::storage
