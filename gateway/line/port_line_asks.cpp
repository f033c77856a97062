// What is asked of a line in use: it is done on the line's thread, and answered as a task.
#include <utility>

#include "gateway/line/once_answer.hpp"
#include "gateway/line/port_line.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/process/log.hpp"

namespace dripline::line {

Result<void> PortLine::drop_answer() {
  const auto progress = this->progress();
  if (!progress || progress->kind != JobKind::Answer) return {};
  if (sends_at_once(parts_.settings)) {
    return fail(Errc::Busy, "port {} is busy: its control reads what it asked for",
                parts_.names.name);
  }
  abort(progress->id, "a run takes its place", [](const Result<void>&) {});
  return {};
}

void PortLine::ask(Ask work, Answer answer) {
  ask_and_answer(std::move(work), std::move(answer), parts_.post);
}

/// A stop is answered while the store is away.
void PortLine::ask_near(Ask work, Answer answer) {
  ask_and_answer(std::move(work), std::move(answer),
                 parts_.post_near ? parts_.post_near : parts_.post);
}

void PortLine::ask_and_answer(Ask work, Answer answer, const PostTask& post) {
  const auto once = std::make_shared<OnceAnswer>(post, std::move(answer));
  with_line([this, work = std::move(work), once](wire::Discipline& line, wire::LineTime now) {
    auto result = work(line, now);
    refresh();
    once->give(std::move(result));
  });
}

void PortLine::begin(SendJob job, Answer answer) {
  const auto shared = std::make_shared<SendJob>(std::move(job));
  ask(
      [this, shared](wire::Discipline& line, wire::LineTime now) {
        if (session_.progress())  // it refuses, and what it sends stays shown
          return session_.begin(std::move(*shared), line, now);
        auto before = show_transfer(*shared);
        auto begun = keep_memory();
        if (begun) begun = session_.begin(std::move(*shared), line, now);
        if (begun) {
          answer_request();
        } else {
          take_back(std::move(before));
          (void)keep_memory();  // at worst the next life asks for a reset that was not needed
        }
        return begun;
      },
      std::move(answer));
}

void PortLine::begin_receive(Answer answer) {
  ask([this](wire::Discipline& line,
             wire::LineTime now) { return session_.begin_receive(line, now); },
      std::move(answer));
}

void PortLine::stop_receiving(const std::string& reason, Answer answer) {
  ask_near(
      [this, reason](wire::Discipline& line, wire::LineTime now) -> Result<void> {
        if (session_.stop_receiving(reason, line, now)) return {};
        return fail(Errc::Conflict, "nothing comes in that could be stopped");
      },
      std::move(answer));
}

namespace {

Result<void> unless_over(bool is_done, const std::string& id) {
  if (is_done) return {};
  return fail(Errc::Conflict, "{} is not on the line any more", id);
}

}  // namespace

void PortLine::hold(const std::string& id, Answer answer) {
  ask_near(
      [this, id](wire::Discipline&, wire::LineTime) { return unless_over(session_.hold(id), id); },
      std::move(answer));
}

void PortLine::resume(const std::string& id, Answer answer) {
  ask_near(
      [this, id](wire::Discipline& line, wire::LineTime now) {
        return unless_over(session_.resume(id, line, now), id);
      },
      std::move(answer));
}

void PortLine::abort(const std::string& id, const std::string& reason, Answer answer) {
  ask_near(
      [this, id, reason](wire::Discipline& line, wire::LineTime now) {
        return unless_over(session_.abort(id, reason, line, now), id);
      },
      std::move(answer));
}

void PortLine::abort_any(const std::string& reason, Answer answer) {
  ask_near(
      [this, reason](wire::Discipline& line, wire::LineTime now) -> Result<void> {
        const auto progress = session_.progress();
        if (progress && session_.abort(progress->id, reason, line, now)) return {};
        return fail(Errc::Conflict, "nothing is sent that could be aborted");
      },
      std::move(answer));
}

void PortLine::refuse(const std::string& reason) {
  {
    const std::lock_guard lock(mutex_);
    if (request_) request_->answer = reason.empty() ? "no program is left" : reason;
  }
  with_line([reason](wire::Discipline& line, wire::LineTime now) {
    if (auto refused = line.refuse(reason, now); !refused) {
      process::log_warning("refusal not sent: {}", refused.error().what);
    }
  });
}

void PortLine::accept_receive(const std::string& name) {
  with_line([this, name](wire::Discipline& line, wire::LineTime now) {
    if (auto begun = line.begin_receive(name, now); !begun) on_fault(begun.error());
  });
}

}  // namespace dripline::line
