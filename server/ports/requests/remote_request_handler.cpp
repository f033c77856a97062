#include "server/ports/requests/remote_request_handler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gateway/interpreter/core/called_program_names.hpp"
#include "gateway/line/inbound/comment_program.hpp"
#include "gateway/line/inbound/program_head.hpp"
#include "gateway/line/line_words.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/job_queue.hpp"
#include "server/machines/start_point.hpp"
#include "server/machines/stop_order.hpp"
#include "server/ports/programs/broken_program.hpp"
#include "server/ports/programs/program_stream.hpp"
#include "storage/store.hpp"

namespace dripline::ports {
namespace {

constexpr std::size_t kMaxListed = 200;

bool is_offered(const storage::ProgramSummary& program, const std::string& control) {
  const auto& latest = program.latest;
  if (program.is_removed || latest.is_held) return false;
  return control.empty() || latest.control.empty() || latest.control == control;
}

/// One line for each program that can be sent to a machine with that control (empty: any), at most
/// kMaxListed, and a last line with the number of the rest.
std::vector<std::string> listing(std::span<const storage::ProgramSummary> programs,
                                 const std::string& control) {
  std::vector<std::string> lines;
  std::size_t more = 0;
  for (const auto& program : programs) {
    if (!is_offered(program, control)) continue;
    if (lines.size() >= kMaxListed) {
      ++more;
      continue;
    }
    const auto& latest = program.latest;
    lines.push_back(fmt::format("{} {}{}{}", latest.program, latest.size,
                                latest.comment.empty() ? "" : " ", latest.comment.substr(0, 30)));
  }
  if (more > 0) lines.push_back(fmt::format("AND {} MORE", more));
  return lines;
}

/// Those of them that a protocol with numbered programs can name and that are known to be for
/// `control`, in order of their numbers.
std::vector<storage::Revision> numbered_programs(std::span<const storage::ProgramSummary> programs,
                                                 const std::string& control) {
  std::map<std::pair<std::size_t, std::string>, storage::Revision> in_order;
  for (const auto& program : programs) {
    const std::string number = line::program_number(program.latest.program);
    const bool is_for_it = !control.empty() && program.latest.control == control;
    if (number.empty() || !is_for_it || !is_offered(program, control)) continue;
    in_order.emplace(std::pair(number.size(), number), program.latest);
  }
  std::vector<storage::Revision> revisions;
  revisions.reserve(in_order.size());
  for (auto& [number, revision] : in_order) revisions.push_back(std::move(revision));
  return revisions;
}

constexpr std::uint64_t kMaxPrograms = 10'000;

SendJob answer_job() {
  SendJob job;
  job.kind = JobKind::Answer;
  job.id = fmt::format("answer-{}", random_hex(4));
  return job;
}

}  // namespace

std::string RemoteRequestHandler::control() const {
  const auto machine = parts_.store.machines.find(parts_.machine);
  return machine ? machine->control : std::string();
}

Result<std::string> RemoteRequestHandler::find_program(const std::string& name) const {
  const std::string control = this->control();
  for (const auto& candidate : interpreter::called_program_names(name)) {
    const auto revision = parts_.store.programs.revision(candidate, std::nullopt);
    if (!revision) continue;
    if (control.empty() || revision->control.empty() || revision->control == control) {
      return candidate;
    }
  }
  return fail(Errc::NotFound, "program {} is not in the library", name);
}

Result<std::string> RemoteRequestHandler::find_offered(const std::string& name) const {
  auto program = find_program(name);
  if (!program) return program;
  const auto revision = parts_.store.programs.revision(*program, std::nullopt);
  if (!revision) return fail(revision.error());
  const std::string control = this->control();
  if (!control.empty() && revision->control == control) return program;
  return fail(Errc::Unsupported, "program {} is not known to be for the control of this machine",
              name);
}

/// Whoever asked may not be at the control any more.
Result<void> RemoteRequestHandler::check_age() const {
  if (!asked_) return {};
  return machines::check_age(parts_.machine, dds::CommandAction::Start, *asked_,
                             parts_.clock.steady_now());
}

void RemoteRequestHandler::carry_out(line::RuleAction action, const std::string& argument,
                                     SteadyTime asked) {
  asked_ = asked;
  process::log_info("request from the control machine={} action={} argument={}", parts_.machine,
                    to_string(action), argument);
  if (auto soon = check_age(); !soon) return refuse(soon.error().what, false);
  if (action == line::RuleAction::Send) send(argument, false);
  if (action == line::RuleAction::Directory) send_listing(false);
  if (action == line::RuleAction::Restart) restart(argument);
  if (action == line::RuleAction::NextJob) start_next_job();
}

void RemoteRequestHandler::answer(const wire::TransferRequest& request) {
  using Kind = wire::TransferRequest::Kind;
  asked_.reset();
  if (request.kind == Kind::TakeProgram) {
    offers_.reset();
    return parts_.line->accept_receive(request.name);
  }
  if (parts_.offer == wire::Offer::Repeat) {
    const bool asks_again = request.kind == Kind::SendProgram && request.name.empty();
    return asks_again ? repeat() : leave(request);
  }
  const bool names_one = request.kind == Kind::SendProgram && !request.name.empty();
  const auto needed = names_one ? wire::Offer::Named : wire::Offer::All;
  if (parts_.offer < needed) return leave(request);
  if (request.kind == Kind::Directory) return send_listing(true);
  if (!names_one) return send_next();
  offers_.reset();
  send(request.name, true);
}

/// Nothing is sent that was not commanded: the request waits for the run that is started next.
void RemoteRequestHandler::leave(const wire::TransferRequest& request) const {
  const line::PortRequest asked{.since = {}, .program = request.name, .answer = {}};
  process::log_info("machine={}: {}", parts_.machine, request_words(asked));
  parts_.line->note(request_words(asked));
  if (parts_.refuses) parts_.line->refuse("NO RUN WAITS");
}

RequestedLine::Started RemoteRequestHandler::on_started(bool is_request) const {
  return [handler = *this, is_request](const Result<storage::Run>& run) {
    if (!run) handler.refuse(run.error().what, is_request);
  };
}

Result<void> RemoteRequestHandler::note(std::string action, std::string subject,
                                        std::string detail) const {
  return parts_.store.audit.add({.time = parts_.clock.now(),
                                 .who = {kRequestAuthor, "", ""},
                                 .action = std::move(action),
                                 .subject = std::move(subject),
                                 .detail = std::move(detail)});
}

std::function<Result<void>(const storage::Run&)> RemoteRequestHandler::note_start(
    std::string action) const {
  return [handler = *this, action = std::move(action)](const storage::Run& run) {
    return handler.note(
        action, run.id,
        fmt::format("{} revision {} on {}", run.program, run.revision, run.machine));
  };
}

void RemoteRequestHandler::send(const std::string& name, bool is_request) {
  if (name.empty()) return refuse("no program is named", is_request);
  const auto program = is_request ? find_offered(name) : find_program(name);
  if (!program) {
    return refuse(program.error().what, is_request, library::Refusal::NoSuchProgram);
  }
  parts_.line->start_later({.machine = parts_.machine,
                            .program = *program,
                            .revision = {},
                            .author = kRequestAuthor,
                            .given = asked_,
                            .before = note_start("run.start")},
                           on_started(is_request), is_request ? name : "");
}

void RemoteRequestHandler::restart(const std::string& block) {
  const auto blank = block.find(' ');
  const auto point = machines::parse_start_point(block.substr(0, blank));
  if (!point) return refuse(point.error().what, false);
  const std::string choice = blank == std::string::npos ? "" : block.substr(blank + 1);
  if (!choice.empty() && choice != "HEAD" && choice != "SET") {
    return refuse("after the block comes HEAD or SET, not " + choice, false);
  }
  const auto last =
      parts_.store.runs.list({.machine = parts_.machine, .program = {}, .state = {}}, {.limit = 1});
  if (!last || last->empty()) return refuse("there was no run to begin again", false);
  parts_.line->start_later({.machine = parts_.machine,
                            .program = last->front().program,
                            .revision = last->front().revision,
                            .author = kRequestAuthor,
                            .from = *point,
                            .head = choice == "HEAD"  ? machines::StartHead::Send
                                    : choice == "SET" ? machines::StartHead::Set
                                                      : machines::StartHead::Ask,
                            .given = asked_,
                            .before = note_start("run.restart")},
                           on_started(false), "");
}

/// The tape of the last run is still in the reader. One that was broken off is not read on.
void RemoteRequestHandler::repeat() {
  const auto last =
      parts_.store.runs.list({.machine = parts_.machine, .program = {}, .state = {}}, {.limit = 1});
  if (!last) return refuse(last.error().what, true);
  if (last->empty()) return refuse("there was no run to repeat", true);
  const storage::Run& run = last->front();
  if (run.state == storage::RunState::Active || run.state == storage::RunState::Ordered) {
    waits_for_end_ = true;
    return;
  }
  if (run.state != storage::RunState::Completed) {
    return refuse(fmt::format("run {} of program {} was not completed: it is not repeated", run.id,
                              run.program),
                  true);
  }
  parts_.line->start_later({.machine = parts_.machine,
                            .program = run.program,
                            .revision = run.revision,
                            .author = kRequestAuthor,
                            .before = note_start("run.start")},
                           on_started(true), "");
}

/// The operator is at the control: what is sent waits there for his cycle start.
void RemoteRequestHandler::start_next_job() {
  const auto job = library::take_job(parts_.store.jobs, parts_.machine, std::nullopt);
  if (!job) return refuse(job.error().what, false, library::Refusal::NothingToSelect);
  parts_.line->start_later({.machine = parts_.machine,
                            .program = job->program,
                            .revision = job->revision,
                            .author = kRequestAuthor,
                            .given = asked_,
                            .job = job->id,
                            .before = note_start("run.start")},
                           on_started(false), "");
}

void RemoteRequestHandler::send_listing(bool is_request) {
  const auto programs = this->programs();
  if (!programs) return refuse(programs.error().what, is_request);
  const std::string control = this->control();
  auto lines = listing(*programs, control);
  if (lines.empty() && !is_request) {
    lines.push_back(library::control_words(control, library::Refusal::NothingToSelect));
  }
  if (is_request) {  // the protocol knows that it is a list
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    return send_answer("", text);
  }
  const std::string& name = parts_.reply;
  send_answer(name, line::comment_program(name.empty() ? "O9998" : name, lines));
}

/// A control that names none gets all that have a number, one a request, and then "no more": so it
/// lists them, or takes those it wants. They are no runs.
void RemoteRequestHandler::send_next() {
  if (auto sound = check_last_program(); !sound) return refuse(sound.error().what, true);
  if (auto sound = check_last_offer(); !sound) return refuse(sound.error().what, true);
  if (auto listed = list_offers(); !listed) return refuse(listed.error().what, true);
  if (next_offer_ >= offers_->size()) {
    if (!std::exchange(is_end_told_, true)) {
      parts_.line->note(
          fmt::format("the control has been offered {} programs: none is left", next_offer_));
    }
    return parts_.line->refuse("");
  }
  const auto& revision = (*offers_)[next_offer_++];
  // It may have been withdrawn since the list was made.
  const auto admitted = parts_.releases.admit(
      {.machine = parts_.machine, .program = revision.program, .revision = revision.number});
  if (!admitted) return refuse(admitted.error().what, true);
  const std::string what = fmt::format("{} revision {}", revision.program, revision.number);
  SendJob job = answer_job();
  if (auto noted = offered_.begin(job.id, what); !noted) return refuse(noted.error().what, true);
  parts_.line->note(fmt::format("the control asked: program {} is offered", what));
  job.name = line::program_number(revision.program);
  job.source = source_of(ProgramStream::of(revision.content, revision.size), parts_.store.programs);
  job.size = revision.size;
  parts_.line->send(std::move(job));
}

/// The same of an offered program, which may be another server's offer. A control whose protocol
/// has words for it gets them once, and asks again; any other may ask for the rest.
Result<void> RemoteRequestHandler::check_last_offer() {
  // A heading begins a transfer: it asks for no rest.
  if (!parts_.follows_answers || parts_.refuses) return {};
  const auto broken = offered_.broken();
  if (!broken) return fail(broken.error());
  if (!*broken) return {};
  const std::string program = **broken;
  offers_.reset();  // it begins with the first one again
  if (parts_.tells_aborts) offered_.close("the control knows that it was broken off");
  return fail(Errc::Conflict,
              "program {} was broken off while the control read it, and it may be asking for the "
              "rest: {}",
              program,
              parts_.tells_aborts
                  ? "ask again at the control"
                  : "nothing is offered until a run or dnc port send has gone through");
}

/// A control in the middle of a program that was broken off asks for the rest of it with the same
/// words. Another program's text would be executed there.
Result<void> RemoteRequestHandler::check_last_program() const {
  if (is_sent_since_) return {};
  const auto broken = broken_program(
      parts_.store,
      {.machine = parts_.machine, .port = parts_.port, .are_aborts_told = parts_.tells_aborts});
  if (!broken) return fail(broken.error());
  if (!*broken) return {};
  return fail(Errc::Conflict,
              "{} was broken off, and the control may be asking for its rest: nothing is offered "
              "until a run or dnc port send has gone through",
              (*broken)->what);
}

Result<std::vector<storage::ProgramSummary>> RemoteRequestHandler::programs() const {
  auto all = parts_.store.programs.list({.limit = kMaxPrograms});
  if (!all) return all;
  std::vector<storage::ProgramSummary> offered;
  for (auto& program : *all) {
    auto revision = parts_.releases.offered(program, parts_.machine);
    if (!revision) continue;
    program.latest = *std::move(revision);
    offered.push_back(std::move(program));
  }
  return offered;
}

/// Those of this asking sequence. Errors: those of the store, Unsupported (no control is known).
Result<void> RemoteRequestHandler::list_offers() {
  const SteadyTime now = parts_.clock.steady_now();
  const auto silence = now - std::exchange(asked_at_, now);
  const bool is_over = is_end_told_ ? silence > kOfferLife : silence > kOfferPause;
  if (offers_ && !is_over) return {};
  const std::string control = this->control();
  if (control.empty()) {
    return fail(Errc::Unsupported, "machine '{}' has no control: no program can be offered to it",
                parts_.machine);
  }
  const auto programs = this->programs();
  if (!programs) return fail(programs.error());
  offers_ = numbered_programs(*programs, control);
  next_offer_ = 0;
  is_end_told_ = false;
  return {};
}

void RemoteRequestHandler::refuse(const std::string& why, bool is_request,
                                  library::Refusal refusal) const {
  process::log_warning("request from the control refused machine={}: {}", parts_.machine, why);
  parts_.line->note("refused: " + why);
  if (is_request) return parts_.line->refuse(why);
  // No text goes to a control that expects none, or may be in the middle of another.
  if (!check_age() || !parts_.line->check_reset()) return;
  report({why, library::control_words(control(), refusal)});
}

void RemoteRequestHandler::report(const std::vector<std::string>& words) const {
  if (parts_.reply.empty()) return;
  std::vector<std::string> lines;
  for (const auto& word : words) {
    for (auto& line : line::comment_lines(word)) lines.push_back(std::move(line));
  }
  send_answer(parts_.reply, line::comment_program(parts_.reply, lines));
}

void RemoteRequestHandler::send_answer(std::string name, std::string text) const {
  SendJob job = answer_job();
  job.name = std::move(name);
  job.size = text.size();
  job.text = std::move(text);
  parts_.line->send(std::move(job));
}

}  // namespace dripline::ports
