#include "clients/cli/server/machine_watch.hpp"

#include <map>

#include "clients/cli/interrupt.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/setup/change_log.hpp"
#include "clients/cli/text/json_text.hpp"
#include "clients/cli/text/live_area.hpp"
#include "clients/lib/event_stream.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;

class MachineWatch {
 public:
  MachineWatch(Context& context, client::Client& client, std::string name)
      : context_(context), client_(client), name_(std::move(name)) {}

  int run() {
    if (auto read = refresh(); !read) return complain(read.error());
    client::EventStream stream(client_.address(), name_);
    while (!is_interrupted()) {
      auto item = stream.next(200ms);
      if (!item) continue;
      if (auto* lost = std::get_if<client::StreamLost>(&*item)) {
        if (lost->failure.kind == client::Failure::Kind::Denied) return complain(lost->failure);
        say_once(lost->failure.what + "; trying again");
      } else if (std::holds_alternative<client::StreamOpened>(*item)) {
        said_.clear();
        if (auto read = refresh(); !read) say_once(read.error().what);
      } else if (auto* machine = std::get_if<client::Machine>(&*item)) {
        take(std::move(*machine));
      }
    }
    area_.clear();
    return kExitInterrupted;
  }

 private:
  client::Reply<void> refresh() {
    if (name_.empty()) {
      auto machines = client_.machines();
      if (!machines) return client::failed(machines.error());
      for (auto& machine : *machines) take(std::move(machine));
      return {};
    }
    auto machine = client_.machine(name_);
    if (!machine) return client::failed(machine.error());
    take(std::move(*machine));
    return {};
  }

  void take(client::Machine machine) {
    if (!name_.empty() && machine.name != name_) return;
    const std::string line = status_line(machine);
    if (context_.wants_json) {
      context_.print(json_line(client::to_json_value(machine)));
      std::fflush(stdout);
    } else if (area_.is_live()) {
      lines_[machine.name] = line;
      draw();
    } else {
      print_change(machine, line);
    }
  }

  void print_change(const client::Machine& machine, const std::string& line) {
    const auto status = machine.status.value_or(client::MachineStatus{});
    const std::string key =
        fmt::format("{}|{}|{}|{}", machine.connected, status.execution, status.run, status.message);
    if (!logs_[machine.name].is_worth_a_line(key, line, clock_.steady_now())) return;
    context_.print(printable(line) + "\n");
    std::fflush(stdout);
  }

  void draw() {
    std::vector<std::string> lines;
    for (const auto& [name, line] : lines_) lines.push_back(line);
    area_.show(lines);
  }

  void say_once(const std::string& text) {
    if (said_ == text) return;
    said_ = text;
    area_.clear();
    fmt::print(stderr, "dnc: {}\n", text);
  }

  Context& context_;
  client::Client& client_;
  std::string name_;
  SystemClock clock_;
  LiveArea area_ = LiveArea::on_stderr();
  std::map<std::string, std::string> lines_;
  std::map<std::string, ChangeLog> logs_;
  std::string said_;
};

}  // namespace

int watch_machines(Context& context, const std::string& name) {
  auto client = context.connect();
  if (!client) return context.status;
  catch_interrupts();
  return MachineWatch(context, *client, name).run();
}

}  // namespace dripline::cli
