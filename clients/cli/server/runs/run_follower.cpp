#include "clients/cli/server/runs/run_follower.hpp"

#include <unistd.h>

#include "clients/cli/context.hpp"
#include "clients/cli/server/display_text.hpp"
#include "clients/cli/server/kept_memory.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/setup/change_log.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/event_stream.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;

/// Asked again after this much silence: an event can be lost when the server sheds a slow client.
constexpr auto kAskAfter = 2s;
/// A server that stays away this long is given up; the run continues without us.
constexpr auto kGiveUpAfter = 60s;

/// Texts the operator must see even when the next status replaces them.
bool is_for_people(const client::Record& record) {
  // For dnc memory and dnc run restart.
  if (record.device == "memory" || record.device == "restart") return false;
  return record.kind == "message" || record.kind == "stop" || record.kind == "warning" ||
         record.kind == "alarm";
}

class RunFollower {
 public:
  RunFollower(Context& context, client::Client& client, client::Run run, WatchStyle style)
      : context_(context), client_(client), run_(std::move(run)), style_(style) {}

  int watch(std::optional<std::chrono::seconds> timeout) {
    const SteadyTime begun = clock_.steady_now();
    client::EventStream stream(client_.servers(), run_.machine);
    last_heard_ = last_asked_ = clock_.steady_now();
    show();
    while (!has_ended(run_)) {
      if (is_interrupted()) return leave();
      if (timeout && clock_.steady_now() - begun >= *timeout) return end_wait(*timeout);
      if (auto item = stream.next(200ms)) take(*item);
      if (!failure_ && clock_.steady_now() - last_asked_ >= kAskAfter) refresh();
      if (failure_) return give_up();
    }
    return finish();
  }

 private:
  void take(client::StreamItem& item) {
    if (auto* lost = std::get_if<client::StreamLost>(&item)) return on_lost(lost->failure);
    last_heard_ = clock_.steady_now();
    if (std::holds_alternative<client::StreamOpened>(item)) return refresh();
    if (auto* run = std::get_if<client::Run>(&item); run != nullptr && run->id == run_.id) {
      last_asked_ = last_heard_;
      run_ = std::move(*run);
      show();
    } else if (auto* machine = std::get_if<client::Machine>(&item)) {
      take_status(*machine);
    } else if (auto* record = std::get_if<client::Record>(&item)) {
      if (record->run == run_.id && is_for_people(*record)) tell(*record);
    }
  }

  void take_status(const client::Machine& machine) {
    if (machine.name != run_.machine) return;
    status_.reset();
    if (machine.status) status_ = status_of(machine);
    display_ = display_of(machine);
    show();
  }

  void on_lost(const client::Failure& failure) {
    if (failure.kind == client::Failure::Kind::Denied) failure_ = failure;
    if (is_lost_) return;
    is_lost_ = true;
    note(failure.what + "; trying again, the run continues");
  }

  /// The present state, asked for; a server that is away is only given up after a while.
  void refresh() {
    last_asked_ = clock_.steady_now();
    auto run = client_.run(run_.id);
    if (!run) {
      const bool is_away = run.error().kind == client::Failure::Kind::Unreachable;
      if (!is_away || clock_.steady_now() - last_heard_ >= kGiveUpAfter) failure_ = run.error();
      return;
    }
    last_heard_ = clock_.steady_now();
    is_lost_ = false;
    run_ = std::move(*run);
    if (auto machine = client_.machine(run_.machine)) return take_status(*machine);
    show();
  }

  const client::MachineStatus* status_of_run() const {
    return status_ && status_->run == run_.id ? &*status_ : nullptr;
  }

  void show() {
    const auto* status = status_of_run();
    if (style_ == WatchStyle::Silent) return tell_what_it_waits_for(status);
    if (context_.wants_json) return show_json();
    if (area_.is_live()) return area_.show(run_lines(run_, status, display_));
    const std::string line = run_line(run_, status, display_);
    const std::string key = run_.state + (status ? status->execution + status->message : "");
    if (!log_.is_worth_a_line(key, line, clock_.steady_now())) return;
    print(printable(line));
  }

  /// Notifies a user who waits for the end without watching, once each time an operator must act.
  void tell_what_it_waits_for(const client::MachineStatus* status) {
    std::string line = status != nullptr ? waiting_line(run_, *status) : std::string();
    if (line == told_) return;
    told_ = std::move(line);
    if (!told_.empty()) note(printable(told_));
  }

  void show_json() {
    nlohmann::ordered_json json{{"run", client::to_json_value(run_)}, {"status", nullptr}};
    if (const auto* status = status_of_run()) json["status"] = client::to_json_value(*status);
    context_.print(json_line(json));
    std::fflush(stdout);
  }

  void print(const std::string& line) {
    area_.clear();
    context_.print(line + "\n");
    std::fflush(stdout);
  }

  void note(const std::string& text) {
    area_.clear();
    print_error("dnc: {}\n", text);
  }

  void tell(const client::Record& record) {
    if (style_ == WatchStyle::Silent || context_.wants_json) return;
    print(printable(record_line(record)));
    show();
  }

  int finish() {
    area_.clear();
    const bool is_good = run_.state == "completed" || run_.state == "tested";
    if (context_.wants_json) {
      if (style_ == WatchStyle::Silent) context_.print(json_text(run_));
    } else {
      const Style look = is_good ? Style::Good : Style::Bad;
      print(styled(outcome_line(run_), look, context_.has_color()));
    }
    return is_good ? kExitOk : kExitNo;
  }

  int leave() {
    area_.clear();
    note(
        fmt::format("watching ended, run {} continues; dnc run watch {} follows it again, dnc run "
                    "abort {} ends it",
                    short_id(run_.id), short_id(run_.id), short_id(run_.id)));
    return kExitInterrupted;
  }

  int end_wait(std::chrono::seconds timeout) {
    area_.clear();
    const std::string id = short_id(run_.id);
    note(fmt::format(
        "run {} has not ended in {} s and continues{}; dnc run watch {} follows it, dnc run abort "
        "{} ends it",
        id, timeout.count(), told_.empty() ? "" : " (" + printable(told_) + ")", id, id));
    return kExitTimeout;
  }

  int give_up() {
    area_.clear();
    note(fmt::format("the further course of run {} is not known here", short_id(run_.id)));
    return complain(*failure_);
  }

  Context& context_;
  client::Client& client_;
  client::Run run_;
  WatchStyle style_;
  SystemClock clock_;
  LiveArea area_ = LiveArea::on_stderr();
  ChangeLog log_;
  std::optional<client::MachineStatus> status_;
  client::Display display_;
  std::optional<client::Failure> failure_;
  SteadyTime last_heard_{}, last_asked_{};
  bool is_lost_ = false;
  std::string told_;  ///< of what it waits for
};

}  // namespace

int watch_run(Context& context, client::Client& client, client::Run run, WatchStyle style,
              std::optional<std::chrono::seconds> timeout) {
  catch_interrupts();
  return RunFollower(context, client, std::move(run), style).watch(timeout);
}

}  // namespace dripline::cli
