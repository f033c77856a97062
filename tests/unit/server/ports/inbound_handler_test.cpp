#include "protocol/measurement/cut_line.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::RunState;

constexpr const char* kCalls = R"(
reply = "O9998"
[[set]]
name = "calls"
program = "O9999"
[[set.rule]]
name = "send"
trigger = "PRG"
action = "send"
[[set.rule]]
name = "list"
trigger = "DIR"
action = "directory"
[[set.rule]]
name = "again"
trigger = "FROM"
action = "restart"
[[set.rule]]
name = "next"
trigger = "NEXT"
action = "next_job"
[[rule]]
matches = "^PROBE "
action = "report"
probe = true
)";

TEST_F(PortServiceTest, PutsPrintedLinesIntoTheReportOfTheRun) {
  start_ports();
  add_port(mill(kCalls));
  push("O1", blocks(3));
  const auto run = start("O1");
  ASSERT_TRUE(run);
  line().read_until("N30 G1 X3.5 Y-3.25\n");
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  let_pass_idle_end();
  line().write("X1.5\tY2.25\r\nPROBE Z-1.");
  line().write("125\r\n");
  ASSERT_TRUE(wait([&] { return records_of(run->id, "probe").size() == 1; }));
  const auto outputs = records_of(run->id, "output");
  ASSERT_EQ(outputs.size(), 1u);
  EXPECT_EQ(outputs[0].text, "X1.5\tY2.25");
  EXPECT_EQ(outputs[0].device, "com1");
  EXPECT_EQ(records_of(run->id, "probe")[0].text, "PROBE Z-1.125");
  EXPECT_EQ(store_->runs.find(run->id)->outputs, 1u);
}

/// 40.09 with a pause in it is no 40.0.
TEST_F(PortServiceTest, MarksALineThatSilenceEnds) {
  start_ports();
  add_port(mill(kCalls));
  let_pass_idle_end();
  line().write("D40 40.0");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 1; }));
  line().write("9\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 2; }));
  const auto records = *store_->records.machine_report("mill", {}, 100);
  EXPECT_EQ(records[0].text, "D40 40.0 \xe2\x80\xa6 (line not ended)");
  EXPECT_EQ(records[1].text, "9");
}

/// A control that pauses longer than `idle_end_ms` continues what another server has begun to take.
TEST_F(PortServiceTest, MarksWhatComesSoonAfterTheLineWasOpened) {
  start_ports();
  auto port = mill(kCalls);
  for (auto& [key, value] : port.settings)
    if (key == "rest_gap_ms") value = "10000";
  add_port(port);
  let_pass_idle_end();
  line().write("D40 40.02\nPROBE Z-1.125\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 2; }));
  let_pass_idle_end();
  line().write("D41 41.02\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 3; }));
  const auto records = *store_->records.machine_report("mill", {}, 100);
  const std::string mark = " \xe2\x80\xa6 (may be the rest of an earlier transmission)";
  EXPECT_EQ(records[0].text, "D40 40.02" + mark) << "whole, but of what?";
  EXPECT_EQ(records[1].text, "PROBE Z-1.125" + mark);
  EXPECT_EQ(records[2].text, "D41 41.02") << "after a silence it is another transmission";
}

TEST_F(PortServiceTest, AProgramSoonAfterTheLineWasOpenedIsNoRest) {
  start_ports();
  add_machine("mill");
  auto port = mill();
  for (auto& [key, value] : port.settings)
    if (key == "rest_gap_ms") value = "10000";
  add_port(port);
  let_pass_idle_end();
  line().write("N9 G0\n%\nO77\nM30\n%\n");
  ASSERT_TRUE(wait([&] { return store_->programs.revision("O77", 1).has_value(); }));
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 1; }));
  const auto records = *store_->records.machine_report("mill", {}, 100);
  EXPECT_TRUE(measurement::may_be_rest(records[0].text)) << records[0].text;
  EXPECT_EQ(measurement::printed_line(records[0].text), "N9 G0");
}

std::vector<std::string> texts_of(const std::vector<storage::Record>& records) {
  std::vector<std::string> texts;
  texts.reserve(records.size());
  for (const auto& record : records) texts.push_back(record.text);
  return texts;
}

TEST_F(PortServiceTest, KeepsWhatIsPrintedWithoutARunAsTheMachinesReport) {
  start_ports();
  add_port(mill(kCalls));
  let_pass_idle_end();
  line().write("B 2\nPROBE Z-1.125\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 2; }));
  EXPECT_EQ(texts_of(*store_->records.machine_report("mill", {}, 100)),
            (std::vector<std::string>{"B 2", "PROBE Z-1.125"}));
  ports_.reset();  // the server stops, and starts again
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  let_pass_idle_end();
  line().write("B 3\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 3; }));
  EXPECT_EQ(store_->records.machine_report("mill", {}, 100)->back().text, "B 3");
  EXPECT_EQ(store_->records.machine_reports()->at(0).lines, 3u);
}

TEST_F(PortServiceTest, KeepsWhatAFanucPrintsFromItsOwnMemory) {
  start_ports();
  add_machine("mill", "fanuc");
  auto port = mill();
  port.line_template = "fanuc";
  port.settings = {{"baud", "115200"}};
  add_port(port);
  line().write(
      "\x12"
      "B 2\n\x14\x12"
      "B 3\n\x14");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 2; }));
  EXPECT_EQ(ports_->port("com1")->fault, "") << "nothing is wrong with it";
}

TEST_F(PortServiceTest, KeepsWhatAFanucPrintsWhileItIsFed) {
  start_ports();
  add_machine("mill", "fanuc");
  auto port = mill();
  port.line_template = "fanuc";
  port.settings = {{"baud", "115200"}};
  add_port(port);
  const std::string text = blocks(40);
  push("O1", text, "fanuc");
  line().write("\x11");
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  std::string came = line().read_until("N50 ");
  line().write("\x13");
  came += line().read_for(std::chrono::milliseconds(50));
  line().write("\x12PROBE 3.14\n\x14");
  ASSERT_TRUE(wait([&] { return records_of(run->id, "output").size() == 1; }));
  EXPECT_EQ(records_of(run->id, "output")[0].text, "PROBE 3.14");
  line().write("\x11");
  came += line().read_until("-40.25\n%");
  EXPECT_EQ(came, "%\n" + text + "%");
  line().write("\x13");
  EXPECT_TRUE(wait_state(run->id, RunState::Completed));
}

TEST_F(PortServiceTest, BeginsARunInSpiteOfStrayCharacters) {
  start_ports();
  add_machine("mill", "fanuc");
  auto port = mill();
  port.line_template = "fanuc";
  port.settings = {{"baud", "115200"}, {"answer_limit_ms", "none"}};
  add_port(port);
  push("O1", "O1\nM30\n", "fanuc");
  line().write("\x12");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->line.is_stray; }));
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  line().write("\x11");
  EXPECT_EQ(line().read_until("M30\n%"), "%\nO1\nM30\n%");
}

TEST_F(PortServiceTest, HoldsTheProgramThatAProtoTrakSends) {  // PT-04
  start_ports();
  add_machine("mill", "prototrak-plus");
  auto port = mill();
  port.line_template = "prototrak";
  port.settings = {{"baud", "115200"}};
  add_port(port);
  line().write("PN7 G20 ;\r\nN1 G100 X1. Y1. ;\r\n%");
  ASSERT_TRUE(wait([&] { return store_->programs.revision("PN7", 1).has_value(); }));
  EXPECT_TRUE(store_->programs.revision("PN7", 1)->is_held);
  EXPECT_EQ(store_->programs.revision("PN7", 1)->content,
            sha256("PN7 G20 ;\nN1 G100 X1. Y1. ;\n%\n"));
  line().write("N5 G100 X1. Y1. ;\r\n%");  // one without a header is a program too
  ASSERT_TRUE(wait([&] { return store_->programs.revision("mill-punched", 1).has_value(); }));
  EXPECT_TRUE(store_->records.machine_reports()->empty());
}

TEST_F(PortServiceTest, NumbersItsRecordsAfterAllBeforeThemWhateverTheClockShows) {
  storage::Machine machine;
  machine.name = "mill";
  machine.first_seen = machine.last_seen = system_clock_.now();
  machine.epoch = static_cast<std::uint64_t>(
      (system_clock_.now() + std::chrono::hours(1)).time_since_epoch().count());
  ASSERT_TRUE(store_->machines.save(machine));
  start_ports();
  add_port(mill());
  add_port(mill());  // changed: the same epoch
  line().write("B 2\n");
  ASSERT_TRUE(wait([&] { return store_->records.machine_report("mill", {}, 100)->size() == 1; }));
  EXPECT_EQ(store_->records.machine_report("mill", {}, 100)->at(0).epoch, machine.epoch + 1);
}

TEST_F(PortServiceTest, HoldsAPunchedProgramForAcceptance) {  // CEN-200
  start_ports();
  add_machine("mill");
  add_port(mill());
  line().write("%\r\nO0042(POCKET)\r\nG0 X0\r\nM30\r\n%\r\n");
  ASSERT_TRUE(wait([&] { return store_->programs.revision("O0042", 1).has_value(); }));
  const auto revision = store_->programs.revision("O0042", 1);
  EXPECT_TRUE(revision->is_held);
  const auto bytes = store_->programs.read_content(revision->content, 0, 1000);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()),
            "%\nO0042(POCKET)\nG0 X0\nM30\n%\n");
  // Once the control has been silent long enough for the line to be free.
  EXPECT_TRUE(wait([&] { return start("O0042").error().code == Errc::Conflict; }));
  ASSERT_TRUE(store_->programs.accept("O0042", 1, "cam"));
  EXPECT_TRUE(wait([&] { return start("O0042").has_value(); }));
}

TEST_F(PortServiceTest, KeepsAPunchedProgramOfAnySize) {
  start_ports();
  add_machine("mill");
  auto port = mill();
  port.settings[0].second = "4000000";
  add_port(port);
  const std::string text = "%\nO0043\n" + blocks(15000) + "%\n";
  line().write(text);
  ASSERT_TRUE(wait([&] { return store_->programs.revision("O0043", 1).has_value(); }));
  EXPECT_EQ(store_->programs.revision("O0043", 1)->content, sha256(text));
}

TEST_F(PortServiceTest, StoresNothingOfAProgramThatIsCutOff) {
  start_ports();
  add_machine("mill");
  add_port(mill());
  line().write("%\nO0044\nG0 X");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->received > 8; }));
  line().pull();
  ASSERT_TRUE(wait([&] {
    for (const auto& entry : recording()) {
      if (entry.text.find("cut off") != std::string::npos) return true;
    }
    return false;
  }));
  EXPECT_FALSE(store_->programs.revision("O0044", 1));
}

TEST_F(PortServiceTest, MarksADamagedProgram) {
  start_ports();
  add_machine("mill");
  add_port(mill());
  line().write("%\nO0045\nG0 X");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->received > 10; }));
  line().fault(wire::LineFault::Parity);
  line().write("1\nM30\n%\n");
  ASSERT_TRUE(wait([&] { return store_->programs.revision("O0045", 1).has_value(); }));
  const auto revision = store_->programs.revision("O0045", 1);
  EXPECT_NE(revision->comment.find("DAMAGED"), std::string::npos) << revision->comment;
  EXPECT_TRUE(revision->is_held);
}

TEST_F(PortServiceTest, SendsWhatIsCalledFromTheControl) {
  start_ports();
  add_machine("mill");
  add_port(mill(kCalls));
  push("O1234", "N1 G0 X1\n");
  line().write("%\nO9999\n(PRG=1234)\nM30\n%\n");
  EXPECT_EQ(line().read_until("X1\n"), "N1 G0 X1\n");
  const auto runs = store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {});
  ASSERT_EQ(runs->size(), 1u);
  EXPECT_EQ(runs->front().program, "O1234");
  EXPECT_EQ(runs->front().author, "request from the control");
  ASSERT_TRUE(wait_state(runs->front().id, RunState::Completed));
  line().write("%\nO9999\n(FROM=N1)\nM30\n%\n");
  EXPECT_EQ(line().read_until("X1\n"), "N1 G0 X1\n");
}

TEST_F(PortServiceTest, TheControlTakesTheNextJob) {
  start_ports();
  add_machine("mill");
  add_port(mill(kCalls));
  push("O1234", "N1 G0 X1\n");
  line().write("%\nO9999\n(NEXT)\nM30\n%\n");
  EXPECT_NE(line().read_until("M30\n%\n").find("NO JOB WAITS"), std::string::npos);
  storage::Job job;
  job.machine = "mill";
  job.program = "O1234";
  const auto added = store_->jobs.add(job, "anna", {});
  ASSERT_TRUE(added) << added.error().what;
  ASSERT_TRUE(store_->jobs.hold({"mill", "anna", "bore is wide", clock_.now()}, "anna"));
  line().write("%\nO9999\n(NEXT)\nM30\n%\n");
  EXPECT_NE(line().read_until("M30\n%\n").find("BORE IS WIDE"), std::string::npos);
  ASSERT_TRUE(store_->jobs.release("mill", "anna", clock_.now()));
  line().write("%\nO9999\n(NEXT)\nM30\n%\n");
  EXPECT_EQ(line().read_until("X1\n"), "N1 G0 X1\n");
  const auto runs = store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {});
  ASSERT_EQ(runs->size(), 1u);
  EXPECT_EQ(runs->front().job, added->id);
  ASSERT_TRUE(wait_state(runs->front().id, RunState::Completed));
  EXPECT_EQ(store_->jobs.find(added->id)->state, storage::JobState::Done);
}

TEST_F(PortServiceTest, ReportsARefusalAsAProgramOfComments) {
  start_ports();
  add_machine("mill");
  add_port(mill(kCalls));
  line().write("%\nO9999\n(PRG=77)\nM30\n%\n");
  const std::string answer = line().read_until("M30\n%\n");
  EXPECT_NE(answer.find("O9998\n(PROGRAM 77 IS NOT IN THE LIBRARY)\n"), std::string::npos)
      << answer;
}

TEST_F(PortServiceTest, ListsProgramsForTheControl) {
  start_ports();
  add_machine("mill");
  add_port(mill(kCalls));
  push("O7", "G0\n");
  push("part.h", "0 BEGIN PGM 1 MM\n", "tnc155");
  line().write("%\nO9999\n(DIR)\nM30\n%\n");
  EXPECT_EQ(line().read_until("M30\n%\n"), "%\nO9998\n(O7 3)\nM30\n%\n");
}

/// Commits, and then says that it did not know.
class ForgetfulRecords final : public test_support::RecordStoreDecorator {
 public:
  using RecordStoreDecorator::RecordStoreDecorator;
  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    auto stored = RecordStoreDecorator::store(batch);
    if (!batch.records.empty() && failures_ > 0) {
      --failures_;
      return fail(Errc::Io, "power fails after the commit");
    }
    return stored;
  }
  std::atomic<int> failures_{0};
};

TEST_F(PortServiceTest, StoresEveryLineOnceWhateverTheStoreAnswers) {
  ForgetfulRecords records(*store_);
  storage::Store store = test_support::with(*store_, records);
  start_ports(store);
  add_port(mill());
  push("O1", blocks(1));
  const auto run = start("O1");
  ASSERT_TRUE(run);
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  records.failures_ = 2;
  let_pass_idle_end();
  line().write("LINE 1\nLINE 2\n");
  ASSERT_TRUE(wait([&] { return records.failures_ < 2; }));
  line().write("LINE 3\n");
  ASSERT_TRUE(wait([&] { return records_of(run->id, "output").size() == 3; }));
  ASSERT_TRUE(wait([&] { return records.failures_ == 0; }));
  const auto outputs = records_of(run->id, "output");
  ASSERT_EQ(outputs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(outputs[i].text, fmt::format("LINE {}", i + 1));
}

/// A store whose disk is full.
class FullDisk final : public test_support::RecordStoreDecorator {
 public:
  using RecordStoreDecorator::RecordStoreDecorator;
  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    if (is_full_ && !batch.records.empty()) return fail(Errc::Io, "the disk is full");
    return RecordStoreDecorator::store(batch);
  }
  std::atomic<bool> is_full_{false};
};

TEST_F(PortServiceTest, HoldsTheControlWhileNothingCanBeStored) {
  FullDisk records(*store_);
  storage::Store store = test_support::with(*store_, records);
  start_ports(store);
  add_port(mill());
  records.is_full_ = true;
  std::string text;
  for (int i = 0; i < 200; ++i) text += fmt::format("POINT {}\n", i);
  line().write(text);
  EXPECT_NE(line().read_until("\x13").find('\x13'), std::string::npos);
  EXPECT_TRUE(wait([&] {
    return ports_->port("com1")->fault == "what comes in cannot be stored: the disk is full";
  }));
  records.is_full_ = false;
  EXPECT_NE(line().read_until("\x11").find('\x11'), std::string::npos);
  ASSERT_TRUE(wait([&] {
    const std::lock_guard lock(notified_mutex_);
    return records_.size() == 200;
  }));
  EXPECT_TRUE(wait([&] { return ports_->port("com1")->fault.empty(); }));
  ports_.reset();  // before the store
  EXPECT_EQ(faults_.front(), "mill: the disk is full");
  EXPECT_EQ(faults_.back(), "mill: ") << "taken back";
}

/// A control that prints without end must not keep programs from its line.
TEST_F(PortServiceTest, BeginsARunWhileTheControlPrints) {
  start_ports();
  auto port = mill();
  port.settings = {{"baud", "115200"}, {"idle_end_ms", "60000"}, {"eob", "lf"}};
  add_port(port);
  push("O1", blocks(1));
  line().write("LINE 1\nLINE 2\nLI");
  ASSERT_TRUE(wait([&] {
    const std::lock_guard lock(notified_mutex_);
    return records_.size() == 2;
  }));
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  line().write("NE 3\nO7\n");
  ASSERT_TRUE(wait([&] { return records_of(run->id, "output").size() == 1; }));
  ASSERT_TRUE(wait([&] { return !start("O1").has_value(); })) << "a program is coming in";
}

}  // namespace
}  // namespace dripline::server_test
