#include "server/serial/call_desk.hpp"

#include <spdlog/spdlog.h>
#include <algorithm>
#include <array>

#include "protocol/base/random.hpp"
#include "server/feeds/called_programs.hpp"
#include "server/feeds/start_point.hpp"
#include "server/library/control_words.hpp"
#include "server/serial/answer_text.hpp"
#include "server/serial/program_head.hpp"
#include "server/serial/program_stream.hpp"

namespace dripline::ports {
namespace {

constexpr const char* kAuthor = "call from the control";
constexpr std::uint64_t kMostPrograms = 10'000;

bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// The most literal first: `15` may be stored as 15, 15.h, O15, O0015 ...
std::vector<std::string> candidates(const std::string& name) {
  std::vector<std::string> names = feeds::library_names(name);
  names.push_back(name + ".h");
  names.push_back(name + ".H");
  if (!is_number(name)) return names;
  std::array<char, 16> padded{};
  fmt::format_to_n(padded.data(), padded.size() - 1, "O{:0>4}", name);
  for (const auto& numbered : feeds::library_names(padded.data())) names.push_back(numbered);
  return names;
}

}  // namespace

std::string CallDesk::control() const {
  const auto machine = parts_.store.machine(parts_.machine);
  return machine ? machine->control : std::string();
}

Result<std::string> CallDesk::find_program(const std::string& name) const {
  const std::string control = this->control();
  for (const auto& candidate : candidates(name)) {
    const auto revision = parts_.store.revision(candidate, std::nullopt);
    if (!revision) continue;
    if (control.empty() || revision->control.empty() || revision->control == control) {
      return candidate;
    }
  }
  return fail(Errc::NotFound, "program {} is not in the library", name);
}

void CallDesk::carry_out(RuleAction action, const std::string& argument) {
  spdlog::info("call from the control machine={} action={} argument={}", parts_.machine,
               to_string(action), argument);
  if (action == RuleAction::Send) send(argument, false);
  if (action == RuleAction::Directory) send_listing(false);
  if (action == RuleAction::Restart) restart(argument);
}

void CallDesk::answer(const wire::TransferRequest& request) {
  using Kind = wire::TransferRequest::Kind;
  if (request.kind == Kind::Directory) return send_listing(true);
  if (request.kind == Kind::SendProgram && request.name.empty()) return send_next();
  offered_.clear();
  if (request.kind == Kind::SendProgram) return send(request.name, true);
  if (const auto line = parts_.directory.line_of(parts_.machine)) {
    line->accept_receive(request.name);
  }
}

SerialFeed::Started CallDesk::on_started(bool is_request) const {
  return [desk = *this, is_request](const Result<storage::Run>& run) {
    if (!run) desk.say_no(run.error().what, is_request);
  };
}

void CallDesk::send(const std::string& name, bool is_request) {
  if (name.empty()) return say_no("no program is named", is_request);
  const auto program = find_program(name);
  if (!program) {
    return say_no(program.error().what, is_request, library::Refusal::NoSuchProgram);
  }
  parts_.feed.start_later(
      {.machine = parts_.machine, .program = *program, .revision = {}, .author = kAuthor},
      on_started(is_request), is_request ? name : "");
}

void CallDesk::restart(const std::string& block) {
  const auto point = feeds::parse_start_point(block);
  if (!point) return say_no(point.error().what, false);
  const auto last =
      parts_.store.runs({.machine = parts_.machine, .program = {}, .state = {}}, {.limit = 1});
  if (!last || last->empty()) return say_no("there was no run to begin again", false);
  parts_.feed.start_later({.machine = parts_.machine,
                           .program = last->front().program,
                           .revision = last->front().revision,
                           .author = kAuthor,
                           .from = *point},
                          on_started(false));
}

void CallDesk::send_listing(bool is_request) {
  const auto programs = parts_.store.programs({.limit = kMostPrograms});
  if (!programs) return say_no(programs.error().what, is_request);
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
  const std::string& name = parts_.rules->reply();
  send_answer(name, comment_program(name.empty() ? "O9998" : name, lines));
}

/// A control that names none gets all that have a number, one a request, and then "no more": so it
/// lists them, or takes those it wants. They are no runs.
void CallDesk::send_next() {
  const SteadyTime now = parts_.clock.steady_now();
  const bool is_forgotten = now - std::exchange(offered_at_, now) > kOfferLife;
  if (offered_.empty() || is_forgotten) {
    const auto programs = parts_.store.programs({.limit = kMostPrograms});
    if (!programs) return say_no(programs.error().what, true);
    offered_ = numbered_programs(*programs, control());
    next_offered_ = 0;
  }
  const auto line = parts_.directory.line_of(parts_.machine);
  if (!line) return;
  if (next_offered_ >= offered_.size()) {
    offered_.clear();
    return line->refuse("");
  }
  const auto& revision = offered_[next_offered_++];
  SendJob job;
  job.name = program_number(revision.program);
  job.stream = std::make_shared<ProgramStream>(ProgramStream::of(revision.content, revision.size));
  job.size = revision.size;
  put_on_line(std::move(job));
}

void CallDesk::say_no(const std::string& why, bool is_request, library::Refusal refusal) const {
  spdlog::warn("call from the control refused machine={}: {}", parts_.machine, why);
  const auto line = parts_.directory.line_of(parts_.machine);
  if (!line) return;
  line->note("refused: " + why);
  if (is_request) return line->refuse(why);
  report({why, library::control_words(control(), refusal)});
}

void CallDesk::report(const std::vector<std::string>& words) const {
  if (parts_.rules->reply().empty()) return;
  std::vector<std::string> lines;
  for (const auto& word : words) {
    for (auto& line : comment_lines(word)) lines.push_back(std::move(line));
  }
  send_answer(parts_.rules->reply(), comment_program(parts_.rules->reply(), lines));
}

void CallDesk::send_answer(std::string name, std::string text) const {
  SendJob job;
  job.name = std::move(name);
  job.size = text.size();
  job.text = std::move(text);
  put_on_line(std::move(job));
}

void CallDesk::put_on_line(SendJob job) const {
  const auto line = parts_.directory.line_of(parts_.machine);
  if (!line) return;
  job.id = fmt::format("{}-{}", kAnswerPrefix, random_hex(4));
  line->begin(std::move(job), [machine = parts_.machine](const Result<void>& begun) {
    if (!begun) spdlog::warn("answer not sent machine={}: {}", machine, begun.error().what);
  });
}

}  // namespace dripline::ports
