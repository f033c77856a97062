#include "gateway/interpreter/core/program_calls.hpp"

#include <utility>

namespace dripline::interpreter {

void CallCollector::add(ProgramCall call) {
  if (found_.calls.size() > kMaxCalls || !names_.insert(call.name).second) return;
  found_.calls.push_back(std::move(call));
}

Result<ProgramCalls> CallCollector::take() {
  if (found_.calls.size() > kMaxCalls)
    return fail(Errc::LimitExceeded, "it calls more than {} different programs", kMaxCalls);
  return std::move(found_);
}

namespace {

constexpr LineRules kWholeLines{.max_bytes = ProgramSource::kMaxWindow - 2, .skip_percent = false};

}  // namespace

CallLines::CallLines(ProgramSource& source, ProgramIndex program) : reader_(source, kWholeLines) {
  TextPlace start;
  start.program = program;
  reader_.seek(start);
}

Result<bool> CallLines::next() {
  SourceLine line;
  switch (reader_.next(line)) {
    case LineState::Ready:
      line_.assign(line.text);
      line_ += '\n';
      number_ = line.place.line;
      return true;
    case LineState::End:
      return false;
    case LineState::NotYet:
      return fail(Errc::Unsupported, "the text after line {} is not here", number_);
    case LineState::TooLong:
      return fail(Errc::LimitExceeded, "line {} has more than {} bytes", number_ + 1,
                  kWholeLines.max_bytes);
    default:
      return fail(Errc::Io, "{}", reader_.reason());
  }
}

}  // namespace dripline::interpreter
