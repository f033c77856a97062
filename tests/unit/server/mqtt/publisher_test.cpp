#include "server/mqtt/publisher.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/server_fixture.hpp"
#include "tests/unit/server/mqtt/fake_link.hpp"

namespace dripline::mqtt {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;

class PublisherTest : public server_test::ServerTest {
 protected:
  void make(const std::string& more = "") {
    publisher_.reset();
    const auto settings = read_mqtt("[mqtt]\nbroker='mqtt://127.0.0.1'\nprefix='shop'\n" + more);
    ASSERT_TRUE(settings) << settings.error().what;
    publisher_ = std::make_unique<Publisher>(
        Publisher::Parts{.store = *store_,
                         .link = link_,
                         .clock = system_,
                         .server = "db",
                         .version = "1",
                         .machines = [this] { return std::vector{view("a", "first")}; },
                         .status_json =
                             [](const auto& machine) {
                               return Json{{"text", machine.machine.description}};
                             },
                         .record_json =
                             [](const auto& record) {
                               return Json{{"text", record.text}};
                             },
                         .on_fault =
                             [this](const std::string&, const std::string& fault) {
                               const std::lock_guard lock(mutex_);
                               fault_ = fault;
                               faults_ += fault + "\n";
                             }},
        *settings, options_);
    publisher_->begin();
  }
  static machines::MachineView view(const std::string& name, const std::string& text) {
    machines::MachineView made;
    made.machine.name = name;
    made.machine.description = text;
    return made;
  }
  void store(std::uint64_t last, const std::string& text = "X1",
             const std::string& kind = "output") {
    storage::RecordBatch batch;
    batch.machine = "a";
    batch.epoch = 7;
    while (stored_ < last) {
      storage::Record record;
      record.machine = "a";
      record.epoch = 7;
      record.number = ++stored_;
      record.kind = kind;
      record.text = text;
      batch.records.push_back(record);
    }
    ASSERT_TRUE(store_->records.store(batch));
    publisher_->note_record();
  }
  bool gets(const std::string& part, std::size_t number) {
    return test_support::eventually([&] { return link_.received(part).size() >= number; });
  }
  std::vector<std::string> ids() {
    std::vector<std::string> all;
    for (const auto& message : link_.received("/records/"))
      all.push_back(Json::parse(message.payload)["id"]);
    return all;
  }
  bool is_waiting(std::uint64_t number) {
    return test_support::eventually([&] { return publisher_->state()->waiting == number; });
  }
  /// Also one that has ended.
  bool had_fault(const std::string& part) {
    const std::lock_guard lock(mutex_);
    return faults_.find(part) != std::string::npos;
  }
  std::string fault() {
    const std::lock_guard lock(mutex_);
    return fault_;
  }

  Publisher::Options options_{.look = milliseconds(20),
                              .gather = milliseconds(1),
                              .commit_after = milliseconds(5),
                              .answer_limit = milliseconds(300),
                              .farewell = milliseconds(100),
                              .state = {.first_retry = milliseconds(5),
                                        .longest_retry = milliseconds(20),
                                        .long_fault = milliseconds(0)}};
  SystemClock system_;
  FakeLink link_;
  std::mutex mutex_;
  std::string fault_ = "none yet", faults_;
  std::uint64_t stored_ = 0;
  std::unique_ptr<Publisher> publisher_;
};

TEST_F(PublisherTest, PublishesRecordsWithTheirIds) {
  make();
  ASSERT_TRUE(gets("shop/online", 1));
  store(3, "X\xff");
  ASSERT_TRUE(gets("/records/", 3));
  EXPECT_EQ(ids(), (std::vector<std::string>{"a-7-1", "a-7-2", "a-7-3"}));
  const auto message = link_.received("/records/").front();
  EXPECT_EQ(message.topic, "shop/a/records/output");
  EXPECT_EQ(message.qos, 2);
  EXPECT_FALSE(message.is_retained);
  EXPECT_EQ(Json::parse(message.payload)["text"], "X\xef\xbf\xbd")
      << "what is no text, is replaced";
  EXPECT_TRUE(is_waiting(0));
  EXPECT_EQ(publisher_->state()->records, 3u);
}

TEST_F(PublisherTest, SaysWhetherItIsThere) {
  make();
  ASSERT_TRUE(gets("shop/online", 1));
  EXPECT_EQ(link_.will().topic, "shop/online");
  EXPECT_TRUE(link_.will().is_retained);
  EXPECT_EQ(Json::parse(link_.will().payload)["online"], false);
  publisher_.reset();
  const auto messages = link_.received("shop/online");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_TRUE(messages[0].is_retained);
  EXPECT_EQ(Json::parse(messages[0].payload)["online"], true);
  EXPECT_EQ(Json::parse(messages[1].payload)["online"], false);
}

TEST_F(PublisherTest, PublishesTheStatesOfAllMachinesAndThenTheirChanges) {
  make("status_interval_ms = 100\n");
  ASSERT_TRUE(gets("/status", 1));
  EXPECT_EQ(link_.received("/status").front().topic, "shop/a/status");
  EXPECT_TRUE(link_.received("/status").front().is_retained);
  for (int i = 0; i < 500; ++i) publisher_->note(view("a", std::to_string(i)));
  ASSERT_TRUE(test_support::eventually(
      [&] { return Json::parse(link_.received("/status").back().payload)["text"] == "499"; }));
  EXPECT_LE(link_.received("/status").size(), 3u) << "at most one in each interval";
}

TEST_F(PublisherTest, LosesNothingOverAnOutage) {
  make();
  ASSERT_TRUE(gets("shop/online", 1));
  store(5);
  ASSERT_TRUE(gets("/records/", 5));
  link_.set(&FakeLink::is_down, true);
  ASSERT_TRUE(test_support::eventually([&] { return !publisher_->state()->is_connected; }));
  store(400);
  ASSERT_TRUE(test_support::eventually([&] { return fault() != "" && fault() != "none yet"; }));
  EXPECT_TRUE(
      test_support::eventually([&] { return publisher_->state()->fault == "nothing there"; }));
  EXPECT_FALSE(publisher_->state()->is_connected);
  EXPECT_GE(publisher_->state()->waiting, 395u);
  link_.set(&FakeLink::is_down, false);
  ASSERT_TRUE(is_waiting(0));
  std::set<std::string> distinct;
  for (const auto& id : ids()) {
    if (!distinct.insert(id).second) continue;  // a repeat
    EXPECT_EQ(id, "a-7-" + std::to_string(distinct.size())) << "in order";
  }
  EXPECT_EQ(distinct.size(), 400u);
  EXPECT_TRUE(test_support::eventually([&] { return fault().empty(); }));
  EXPECT_EQ(publisher_->state()->fault, "");
  EXPECT_LE(link_.most_pending, options_.window + 2);
}

TEST_F(PublisherTest, MovesNoCursorWithoutAnAcknowledgment) {
  link_.is_silent = true;
  make();
  store(250);
  ASSERT_TRUE(test_support::eventually([&] { return link_.opened >= 2; }))
      << "a broker that acknowledges nothing is given up";
  EXPECT_GE(link_.dropped, 1) << "so that the broker reports us as gone";
  EXPECT_EQ(link_.closed, 0);
  EXPECT_EQ(publisher_->state()->waiting, 250u);
  EXPECT_LE(link_.most_pending, options_.window + 2) << "bounded";
  EXPECT_NE(publisher_->state()->fault.find("nothing acknowledged"), std::string::npos)
      << publisher_->state()->fault;
  link_.set(&FakeLink::is_silent, false);
  EXPECT_TRUE(is_waiting(0));
}

TEST_F(PublisherTest, NoticesThatRecordsAreNotAcknowledgedWhileStatesAre) {
  link_.kept = "/records/";
  make("status_interval_ms = 100\n");
  ASSERT_TRUE(gets("shop/online", 1));
  store(1);
  int states = 0;
  ASSERT_TRUE(test_support::eventually([&] {
    publisher_->note(view("a", std::to_string(++states)));
    return had_fault("records: nothing acknowledged");
  }));
  EXPECT_EQ(publisher_->state()->waiting, 1u);
}

TEST_F(PublisherTest, NoticesThatStatesAreNotAcknowledgedWhileRecordsAre) {
  link_.kept = "/status";
  make();
  EXPECT_TRUE(test_support::eventually([&] {
    store(stored_ + 1);
    return had_fault("states: nothing acknowledged");
  }));
}

TEST_F(PublisherTest, NoticesOneRecordThatIsNotAcknowledgedWhileOthersAre) {
  link_.kept = "/records/probe";
  make();
  store(1, "X1", "probe");
  auto next = std::chrono::steady_clock::now();
  ASSERT_TRUE(test_support::eventually([&] {
    if (std::chrono::steady_clock::now() >= next) {
      store(stored_ + 1);
      next += milliseconds(50);
    }
    return link_.opened >= 2;
  }));
  EXPECT_LT(link_.most_pending, options_.window - 10) << "not only when the window is full";
}

TEST_F(PublisherTest, PassesOverNothingThatIsRefused) {
  link_.refused = "/records/";
  make();
  store(3);
  ASSERT_TRUE(test_support::eventually(
      [&] { return publisher_->state()->fault.find("not authorized") != std::string::npos; }));
  EXPECT_EQ(publisher_->state()->waiting, 3u);
  EXPECT_TRUE(test_support::eventually([&] {  // it follows the state
    return fault().find("refuses a message for shop/") != std::string::npos;
  })) << fault();
}

TEST_F(PublisherTest, ContinuesAfterARestart) {
  make();
  store(3);
  ASSERT_TRUE(is_waiting(0));
  publisher_.reset();
  const auto before = ids().size();
  make();
  store(5);
  ASSERT_TRUE(is_waiting(0));
  const auto all = ids();
  EXPECT_EQ(std::vector(all.begin() + static_cast<std::ptrdiff_t>(before), all.end()),
            (std::vector<std::string>{"a-7-4", "a-7-5"}));
}

TEST_F(PublisherTest, CanLeaveOutRecordsOrStates) {
  make("kinds = []\n");
  ASSERT_TRUE(gets("/status", 1));
  store(3);
  EXPECT_EQ(publisher_->state()->waiting, 0u);
  publisher_.reset();
  EXPECT_TRUE(link_.received("/records/").empty());
  make("status = false\n");
  store(4);
  const auto before = link_.received("/status").size();
  ASSERT_TRUE(gets("/records/", 1));
  publisher_->note(view("a", "x"));
  publisher_.reset();
  EXPECT_EQ(link_.received("/status").size(), before);
}

TEST_F(PublisherTest, EndsSoonWhateverTheBrokerDoes) {
  link_.is_silent = true;
  make();
  store(10);
  ASSERT_TRUE(test_support::eventually([&] { return link_.most_pending > 5; }));
  const auto begun = std::chrono::steady_clock::now();
  publisher_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(2));
}

}  // namespace
}  // namespace dripline::mqtt
