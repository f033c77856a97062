#include "storage/postgresql/link.hpp"

#include <libpq-fe.h>
#include <poll.h>
#include <cerrno>
#include <charconv>
#include <optional>
#include <utility>

#include "storage/postgresql/errors.hpp"
#include "storage/postgresql/sql_text.hpp"

namespace dripline::storage::postgresql {
namespace {

/// Answers that no one reads fill the server's buffer, and then it reads no more either: far less
/// than that is in progress.
constexpr std::size_t kUnderWay = 256;

std::uint64_t changes_in(pg_result* result) {
  const std::string_view digits = PQcmdTuples(result);
  std::uint64_t changes = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), changes);
  return changes;
}

bool is_error(pg_result* result) {
  const auto status = PQresultStatus(result);
  return status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK && status != PGRES_EMPTY_QUERY;
}

}  // namespace

void ResultDeleter::operator()(pg_result* result) const {
  PQclear(result);
}

Link::Link(pg_conn* connection, Patience patience)
    : connection_(connection), patience_(std::move(patience)) {
  PQsetnonblocking(connection_, 1);  // a server that takes nothing must not hold us up either
}

Link::~Link() {
  PQfinish(connection_);
}

bool Link::is_alive() const {
  return !has_failed_ && PQstatus(connection_) == CONNECTION_OK;
}

/// False: neither can anything be sent nor has anything come, and the server answers no one.
bool Link::wait_for_bytes() {
  for (;;) {
    const int unsent = PQflush(connection_);
    pollfd socket{.fd = PQsocket(connection_), .events = POLLIN, .revents = 0};
    if (unsent < 0 || socket.fd < 0) return true;  // the result reports it
    if (unsent > 0) socket.events |= POLLOUT;
    const int ready = ::poll(&socket, 1, static_cast<int>(patience_.silence.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0 && patience_.is_answering()) continue;
    if (ready == 0) return false;
    if ((socket.revents & ~POLLOUT) == 0) continue;
    return true;
  }
}

/// Null also when the server is silent: then the connection is not alive any more.
ResultPointer Link::next_result() {
  while (!is_silent_ && PQisBusy(connection_) != 0) {
    if (!wait_for_bytes()) {
      has_failed_ = is_silent_ = true;
    } else if (PQconsumeInput(connection_) == 0) {
      break;  // the connection is lost: the result reports it
    }
  }
  return ResultPointer(is_silent_ ? nullptr : PQgetResult(connection_));
}

Error Link::refused(pg_result* result) {
  if (is_silent_) {
    last_state_.clear();
    return {Errc::Io, fmt::format("the database says nothing, for longer than {} ms, the limit",
                                  patience_.silence.count())};
  }
  last_state_ = state_of(result);
  return error_of(connection_, result);
}

void Link::set_hoarder(Hoarder* hoarder) {
  if (hoarder != nullptr) send_rows();
  hoarder_ = hoarder;
}

void Link::send_rows() {
  if (hoarder_ != nullptr) std::exchange(hoarder_, nullptr)->send_rows();
}

void Link::begin_pipeline() {
  send_rows();
  collect_left();
  if (PQpipelineStatus(connection_) == PQ_PIPELINE_OFF) PQenterPipelineMode(connection_);
}

void Link::note_sent(int is_sent, std::string_view sql) {
  if (is_sent == 0) has_failed_ = true;
  sent_.push_back(sql);
}

void Link::send(const char* sql) {
  begin_pipeline();
  note_sent(PQsendQueryParams(connection_, sql, 0, nullptr, nullptr, nullptr, nullptr, 1), sql);
}

void Link::send(const std::string& sql, const Parameters& parameters) {
  begin_pipeline();
  std::string key = sql + parameters.kinds();
  auto known = prepared_.find(key);
  if (known == prepared_.end()) {
    known = prepared_.emplace(key, fmt::format("s{}", ++names_)).first;
    fresh_.push_back(std::move(key));
    const std::string_view text = std::string_view(known->first).substr(0, sql.size());
    const auto types = parameters.types();
    note_sent(PQsendPrepare(connection_, known->second.c_str(), spelled(sql).c_str(),
                            parameters.count(), types.data()),
              text);
  }
  const auto arrays = parameters.arrays();
  note_sent(
      PQsendQueryPrepared(connection_, known->second.c_str(), parameters.count(),
                          arrays.values.data(), arrays.lengths.data(), arrays.formats.data(), 1),
      std::string_view(known->first).substr(0, sql.size()));
}

Result<ResultPointer> Link::answer() {
  send_rows();
  if (!has_left_ && (has_failed_ || PQpipelineSync(connection_) == 0)) {
    has_failed_ = true;
    return fail(refused(nullptr));
  }
  has_left_ = false;
  ResultPointer last;
  std::optional<Error> error;
  while (!sent_.empty()) {
    ResultPointer result = next_result();
    if (result == nullptr || PQstatus(connection_) != CONNECTION_OK) {
      if (!error) error = refused(nullptr);
      has_failed_ = true;
      return fail(*error);
    }
    // What follows an error up to the Sync is passed over, each with a result of its own.
    if (!error && is_error(result.get())) error = refused(result.get());
    sent_.pop_front();
    next_result();  // null: the end of this answer
    last = std::move(result);
  }
  const ResultPointer sync = next_result();
  if (sync == nullptr || PQresultStatus(sync.get()) != PGRES_PIPELINE_SYNC) has_failed_ = true;
  if (error) {
    for (const auto& key : fresh_) prepared_.erase(key);
    fresh_.clear();
    return fail(*error);
  }
  fresh_.clear();
  changes_ = last == nullptr ? 0 : changes_in(last.get());
  return last;
}

void Link::leave() {
  send_rows();
  if (sent_.empty() || has_left_) return;
  if (has_failed_ || PQpipelineSync(connection_) == 0) has_failed_ = true;
  has_left_ = true;
}

void Link::collect_left() {
  if (has_left_ && !has_failed_) static_cast<void>(answer());  // see `leave`
}

Result<void> Link::leave_some() {
  if (sent_.size() < kUnderWay) return {};
  if (auto answered = answer(); !answered) return fail(answered.error());
  return {};
}

Result<ResultPointer> Link::execute(const std::string& sql) {
  send_rows();
  if (!sent_.empty()) {
    auto answered = answer();
    if (!answered && !has_failed_) return fail(answered.error());
  }
  if (PQpipelineStatus(connection_) != PQ_PIPELINE_OFF) PQexitPipelineMode(connection_);
  ResultPointer last;
  if (PQsendQuery(connection_, sql.c_str()) != 0) {
    while (ResultPointer result = next_result()) last = std::move(result);
  }
  if (last != nullptr && !is_silent_ && !is_error(last.get())) {
    changes_ = changes_in(last.get());
    return last;
  }
  const Error error = refused(last.get());
  if (last_state_.empty()) has_failed_ = true;
  return fail(error);
}

}  // namespace dripline::storage::postgresql
