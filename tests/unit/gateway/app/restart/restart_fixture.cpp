#include "tests/unit/gateway/app/restart/restart_fixture.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <charconv>

#include "tests/unit/gateway/app/restart/recording_motion.hpp"

namespace dripline::gateway {

using std::chrono::milliseconds;

namespace {

std::uint64_t block_of(const std::string& line) {
  std::uint64_t block = 0;
  std::from_chars(line.data(), line.data() + line.size(), block);
  return block;
}

/// Thrown in the machine's own call, so that nothing of the gateway is done after it.
struct Killed {};

bool is_end(const std::string& line) {
  return line.ends_with(" end") && !line.ends_with("program end");
}

}  // namespace

RestartFixture::RestartFixture(const interpreter::Dialect& control, interpreter::Setup its_setup,
                               const std::string& speed)
    : GatewayFixture(control, std::move(its_setup), speed), control_(control) {
  make_recording();
}

void RestartFixture::make_recording() {
  motion = [this,
            made = make_motion("simulated", control_, {.workpiece = setup.workpiece}).value()](
               machine::ExecutionSink& sink) -> std::unique_ptr<machine::MotionBackend> {
    const auto on_block = [this](std::uint64_t block) {
      if (killed_after_ != 0 && block >= killed_after_) throw Killed{};
    };
    const auto write = [this](std::string line) {
      if (path_file.empty()) return path.push_back(std::move(line));
      // One write a line: what a killed process has written stays.
      static const int kFile = ::open(path_file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
      line += '\n';
      if (::write(kFile, line.data(), line.size()) < 0) std::abort();
    };
    return std::make_unique<RecordingMotion>(made, sink, on_block, write);
  };
}

dds::CommandResult RestartFixture::start_program(const std::string& program) {
  const dds::Command start = start_command(program);
  last_run_ = start.run;
  ended_before_ = count(dds::RecordKind::RunEnded);
  return send(start);
}

/// As an operator would: cycle start after a stop, an answer to a question.
void RestartFixture::operate() {
  if (!status) return;
  const bool is_stopped = status->execution == dds::Execution::ProgramStopped ||
                          status->execution == dds::Execution::OptionalStop ||
                          status->execution == dds::Execution::Interrupted;
  if (is_stopped) (void)send(command(dds::CommandAction::Resume));
  if (status->execution == dds::Execution::Waiting && status->message.starts_with("asks:")) {
    dds::Command answer = command(dds::CommandAction::Answer);
    answer.argument = "1";
    (void)send(answer);
  }
}

bool RestartFixture::run_on(std::size_t steps) {
  const auto has_ended = [this] { return count(dds::RecordKind::RunEnded) > ended_before_; };
  if (has_ended()) return true;
  for (std::size_t i = 0; i < steps; ++i) {
    ++steps_;
    clock.steady += milliseconds(10);
    (void)run_until([] { return true; });  // one turn
    if (has_ended()) return true;
    if (i % 16 == 15) operate();
  }
  return false;
}

bool RestartFixture::run_until_killed_after(std::uint64_t block) {
  killed_after_ = block;
  bool is_killed = false;
  try {
    (void)run_on();
  } catch (const Killed&) {
    is_killed = true;
  }
  killed_after_ = 0;
  restart_gateway();
  return is_killed;
}

dds::RunEndText RestartFixture::last_end() const {
  for (auto record = records.rbegin(); record != records.rend(); ++record) {
    if (record->kind == dds::RecordKind::RunEnded) return dds::decode_run_end(record->text).value();
  }
  return {};
}

nlohmann::json RestartFixture::begin_restart(const std::string& program, const std::string& run,
                                             const std::string& at) {
  dds::Command start = start_command(program);
  start.argument = "restart=" + run + " at=" + at;
  last_run_ = start.run;
  ended_before_ = count(dds::RecordKind::RunEnded);
  start_answer = send(start);
  if (!start_answer.accepted) return {};
  const dds::Record* found = nullptr;
  (void)run_until([&] {
    for (const dds::Record& record : records) {
      if (record.run != start.run) continue;
      if (record.device == "restart" || record.kind == dds::RecordKind::RunEnded) found = &record;
      if (found != nullptr) return true;
    }
    return false;
  });
  if (found == nullptr || found->device != "restart") return {};
  return nlohmann::json::parse(found->text);
}

std::size_t length_up_to(const RestartFixture::Path& path, std::uint64_t block) {
  if (block == 0) return 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (is_end(path[i]) && block_of(path[i]) >= block) return i + 1;
  }
  return path.size();
}

std::string difference(const RestartFixture::Path& whole, const RestartFixture::Path& path,
                       std::uint64_t after) {
  constexpr std::size_t kMaxApproach = 32;
  const std::size_t begun = length_up_to(whole, after);
  const std::size_t rest = whole.size() - begun;
  if (path.size() < rest || path.size() > rest + kMaxApproach) {
    return fmt::format("{} events, expected {} after block {}", path.size(), rest, after);
  }
  const std::size_t approach = path.size() - rest;
  for (std::size_t i = 0; i < approach; ++i) {
    if (block_of(path[i]) != after) return "not of the approach: " + path[i];
  }
  for (std::size_t i = 0; i < rest; ++i) {
    if (path[approach + i] == whole[begun + i]) continue;
    return fmt::format("'{}', expected '{}'", path[approach + i], whole[begun + i]);
  }
  return {};
}

}  // namespace dripline::gateway
