#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/dds/record_text.hpp"
#include "server/machines/machine_service.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/fake_server_endpoint.hpp"
#include "tests/support/patience.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {

/// The feed service on a real store, with a fake network: the test plays the gateway `lathe-1`.
class MachineServiceTest : public ServerTest {
 protected:
  static constexpr std::uint64_t kEpoch = 7;
  static constexpr std::uint64_t kSession = 70;
  static constexpr std::chrono::microseconds kSteadyAhead{-1'000'000'000};

  void start_service(const storage::Store& store) {
    machines::MachineService::Options options;
    options.workers = 3;
    options.commands = {.expiry = std::chrono::milliseconds(200),
                        .grace = std::chrono::milliseconds(50)};
    machines::MachineListener listener{
        .on_machine = [this](const machines::MachineView& view) { keep(machines_, view); },
        .on_run = [this](const storage::Run& run) { keep(runs_, run); },
        .on_record = [this](const storage::Record& record) { keep(records_, record); }};
    service_ = std::make_unique<machines::MachineService>(
        machines::RunSources{.store = store, .releases = *releases_, .clock = clock_}, options,
        std::move(listener));
    network_ = service_->handlers();
    auto begun = service_->begin(std::make_unique<test_support::FakeServerEndpoint>(written_));
    ASSERT_TRUE(begun) << begun.error().what;
  }
  void start_service() { start_service(*store_); }

  /// Returns when the machine is stored, and so is shown.
  void announce(const std::string& machine = "lathe-1") {
    announce_at_once(machine);
    EXPECT_TRUE(test_support::eventually([&] { return service_->machine(machine).has_value(); }));
  }
  void announce_at_once(const std::string& machine) {
    dds::Announce announce;
    announce.machine = machine;
    announce.control = "centurion";
    announce.version = "1";
    announce.epoch = kEpoch;
    announce.session = kSession;
    announce.protocol = protocol_;
    network_.on_announce(announce);
    heartbeat(machine);
  }
  /// What a gateway without a run writes once a second.
  void heartbeat(const std::string& machine = "lathe-1") {
    dds::Status status;
    status.machine = machine;
    status.session = kSession;
    status.time = clock_.now() + gateway_ahead_;
    status.steady = gateway_steady();
    network_.on_status(status);
  }
  std::chrono::microseconds gateway_steady() const {
    return kSteadyAhead + std::chrono::duration_cast<std::chrono::microseconds>(
                              clock_.steady_now().time_since_epoch());
  }
  /// The gateway answers every command as soon as it comes.
  void answer_commands(bool accepted, const std::string& reason = "") {
    written_->on_command = [this, accepted, reason](const dds::Command& command) {
      network_.on_command_result(
          {.machine = command.machine, .id = command.id, .accepted = accepted, .reason = reason});
    };
  }
  Result<Run> start(const std::string& program) {
    return service_->start(
        {.machine = "lathe-1", .program = program, .revision = {}, .author = "cam"});
  }
  void request(const std::string& run, std::uint64_t offset, std::uint32_t length,
               const std::string& program = "") {
    network_.on_request({.machine = "lathe-1",
                         .session = kSession,
                         .run = run,
                         .program = program,
                         .offset = offset,
                         .length = length});
  }
  void record(std::uint64_t number, const std::string& run, dds::RecordKind kind,
              const std::string& text) {
    dds::Record record;
    record.machine = "lathe-1";
    record.epoch = kEpoch;
    record.number = number;
    record.time = clock_.now() + gateway_ahead_;
    record.run = run;
    record.kind = kind;
    record.text = text;
    network_.on_record(std::move(record));
  }
  static std::string completed(const std::string& content, std::uint64_t blocks) {
    dds::RunEndText text;
    text.outcome = dds::RunOutcome::Completed;
    text.sent = content.size();
    text.accepted = text.executed = blocks;
    text.line = blocks;
    text.content_sha256 = sha256(content).hex();
    text.content_length = content.size();
    return dds::encode(text);
  }
  bool wait_ack(std::uint64_t number) {
    return written_->wait(
        [&] { return !written_->acks.empty() && written_->acks.back().number >= number; });
  }
  /// The bytes of the first `count` answers, which must all be good and contiguous.
  std::string fed(std::size_t count) {
    EXPECT_TRUE(written_->wait([&] { return written_->blocks.size() >= count; }));
    const std::lock_guard lock(written_->mutex);
    std::string text;
    for (const auto& block : written_->blocks) {
      EXPECT_EQ(block.status, dds::BlockStatus::Ok) << block.reason;
      EXPECT_LE(block.bytes.size(), dds::kMaxBlockBytes);
      text.append(reinterpret_cast<const char*>(block.bytes.data()), block.bytes.size());
    }
    return text;
  }
  dds::BlockData first_block() {
    EXPECT_TRUE(written_->wait([&] { return !written_->blocks.empty(); }));
    const std::lock_guard lock(written_->mutex);
    return written_->blocks.empty() ? dds::BlockData{} : written_->blocks.front();
  }
  /// Waits for something the listener received.
  template <class Thing, class Matches>
  bool wait_notified(const std::vector<Thing>& things, const Matches& matches) {
    std::unique_lock lock(notified_mutex_);
    return notified_.wait_for(lock, test_support::kPatience,
                              [&] { return std::any_of(things.begin(), things.end(), matches); });
  }

  std::shared_ptr<test_support::WrittenMessages> written_ =
      std::make_shared<test_support::WrittenMessages>();
  dds::ServerHandlers network_;
  std::chrono::microseconds gateway_ahead_{0};  ///< its time of day
  std::uint32_t protocol_ = dds::kProtocolVersion;
  std::vector<machines::MachineView> machines_;
  std::vector<storage::Run> runs_;
  std::vector<storage::Record> records_;

 private:
  template <class Thing>
  void keep(std::vector<Thing>& things, const Thing& thing) {
    {
      const std::lock_guard lock(notified_mutex_);
      things.push_back(thing);
    }
    notified_.notify_all();
  }
  std::mutex notified_mutex_;
  std::condition_variable notified_;

 protected:
  std::unique_ptr<machines::MachineService> service_;  // last: it ends before what its threads use
};

/// Runs of that service, among them some of a former life of the server.
class MachineRuns : public MachineServiceTest {
 protected:
  void status(const std::string& run, std::uint32_t outbox = 0) {
    dds::Status status;
    status.machine = "lathe-1";
    status.time = clock_.now();
    status.run = run;
    status.outbox = outbox;
    network_.on_status(status);
  }
  /// An Ordered run of a former life of the server.
  std::string stored_run() {
    const auto revision = push("O0100", "M30\n");
    add_machine("lathe-1");
    const Run run = run_of(revision, "old-run");
    EXPECT_TRUE(store_->runs.create(run));
    return run.id;
  }
  /// Waits until the stored run is in this state; the service compares every two seconds.
  bool wait_state(const std::string& run, storage::RunState state) {
    return wait_notified(runs_, [&](const Run& r) { return r.id == run && r.state == state; });
  }
};

}  // namespace dripline::server_test
