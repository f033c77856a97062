// A line is fed while the database answers nothing, as long as its text is near.
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

/// Keeps everybody who asks waiting while it is closed.
class Gate {
 public:
  void close() { set(true); }
  void open() { set(false); }
  void pass() {
    std::unique_lock lock(mutex_);
    waited_ = waited_ || is_closed_;
    changed_.wait(lock, [this] { return !is_closed_; });
  }
  bool has_kept_waiting() {
    const std::lock_guard lock(mutex_);
    return waited_;
  }

 private:
  void set(bool is_closed) {
    {
      const std::lock_guard lock(mutex_);
      is_closed_ = is_closed;
    }
    changed_.notify_all();
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_closed_ = false, waited_ = false;
};

struct GatedPrograms final : test_support::ProgramStoreDecorator {
  GatedPrograms(const storage::Store& inner, Gate& g) : ProgramStoreDecorator(inner), gate(g) {}
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) override {
    gate.pass();
    return ProgramStoreDecorator::read_content(content, offset, length);
  }
  std::optional<std::vector<std::byte>> near_content(const Digest& content, std::uint64_t offset,
                                                     std::uint64_t length) override {
    auto bytes = ProgramStoreDecorator::read_content(content, offset, length);
    return bytes ? std::optional(*std::move(bytes)) : std::nullopt;
  }
  Gate& gate;
};

struct GatedRuns final : test_support::RunStoreDecorator {
  GatedRuns(const storage::Store& inner, Gate& g) : RunStoreDecorator(inner), gate(g) {}
  Result<void> update_counters(const storage::RunProgress& progress) override {
    gate.pass();
    return RunStoreDecorator::update_counters(progress);
  }
  Result<storage::Run> find(const std::string& id) override {
    gate.pass();
    return RunStoreDecorator::find(id);
  }
  Gate& gate;
};

struct GatedMachines final : test_support::MachineStoreDecorator {
  GatedMachines(const storage::Store& inner, Gate& g) : MachineStoreDecorator(inner), gate(g) {}
  Result<storage::Machine> find(const std::string& name) override {
    gate.pass();
    return MachineStoreDecorator::find(name);
  }
  Gate& gate;
};

TEST_F(PortServiceTest, IsFedWithTextThatIsNearWhileTheStoreAnswersNothing) {
  Gate gate;
  GatedPrograms programs(*store_, gate);
  GatedRuns runs(*store_, gate);
  const storage::Store with_runs = test_support::with(*store_, runs);
  const storage::Store store = test_support::with(with_runs, programs);
  start_ports(store);
  add_port(mill());
  const std::string text = blocks(2500);
  ASSERT_GT(text.size(), 48u << 10) << "more than is fetched at once";
  push("O1", text);
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  gate.close();
  EXPECT_EQ(line().read_until("N25000 G1 X2500.5 Y-2500.25\n"), text);
  EXPECT_TRUE(gate.has_kept_waiting()) << "what needs the store waits for it";
  gate.open();
  EXPECT_TRUE(wait_state(run->id, storage::RunState::Completed));
  ports_.reset();  // it uses the stores of this test
}

/// What is shown with a stop, too.
TEST_F(PortServiceTest, IsHeldAndAbortedWhileTheStoreAnswersNothing) {
  Gate gate;
  GatedRuns runs(*store_, gate);
  GatedMachines machines(*store_, gate);
  const storage::Store with_runs = test_support::with(*store_, runs);
  const storage::Store store = test_support::with(with_runs, machines);
  start_ports(store);
  add_port(mill());
  push("O1", blocks(20000));
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  line().read_until("N100 ");
  gate.close();
  EXPECT_TRUE(command(run->id, dds::CommandAction::Hold));
  auto shown = ports_->machines().machine("mill");
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->status->execution, dds::Execution::FeedHold);
  EXPECT_EQ(shown->status->run, run->id);
  EXPECT_EQ(shown->status->program, "O1");
  EXPECT_EQ(shown->machine.name, "mill");
  EXPECT_TRUE(command(run->id, dds::CommandAction::Abort));
  shown = ports_->machines().machine("mill");
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->status->execution, dds::Execution::Ready);
  gate.open();
  EXPECT_TRUE(wait_state(run->id, storage::RunState::Aborted));
  ports_.reset();  // it uses the stores of this test
}

}  // namespace
}  // namespace dripline::server_test
