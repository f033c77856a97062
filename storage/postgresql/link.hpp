#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "protocol/base/result.hpp"
#include "storage/postgresql/values.hpp"

struct pg_conn;
struct pg_result;

namespace dripline::storage::postgresql {

struct ResultDeleter {
  void operator()(pg_result* result) const;
};
using ResultPointer = std::unique_ptr<pg_result, ResultDeleter>;

/// The conversation with one server process. Everything goes through libpq's pipeline: what is sent
/// is answered in its order, and only who needs an answer waits, for all that was sent before too.
/// One thread at a time.
class Link {
 public:
  /// Who keeps rows back, to send them together: it is asked for them before anything else is sent.
  class Hoarder {
   public:
    virtual ~Hoarder() = default;
    virtual void send_rows() = 0;
  };
  /// Null: no one any more.
  void set_hoarder(Hoarder* hoarder);
  Hoarder* hoarder() const { return hoarder_; }

  /// How long a server may be silent, and whether it answers others then: a statement may take
  /// long, but a frozen server is given up.
  struct Patience {
    std::chrono::milliseconds silence;
    std::function<bool()> is_answering;
  };
  Link(pg_conn* connection, Patience patience);  ///< takes the connection
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  ~Link();

  /// Sends SQL without parameters, a single statement; it is kept until it is answered.
  void send(const char* sql);
  /// Sends a prepared statement; it is prepared when it was not.
  void send(const std::string& sql, const Parameters& parameters);
  /// Waits for the answers to all that was sent. The last one's, or the first error.
  Result<ResultPointer> answer();
  /// The answers are read when something is sent the next time; errors of theirs are lost.
  void leave();
  /// As `leave`, but only so many are in progress at once.
  Result<void> leave_some();
  /// Runs one or several statements, and waits.
  Result<ResultPointer> execute(const std::string& sql);

  bool is_alive() const;
  /// The last error's five characters; empty: none, or the connection was lost.
  const std::string& last_state() const { return last_state_; }
  void clear_state() { last_state_.clear(); }
  /// Of the last answer.
  std::uint64_t changes() const { return changes_; }

 private:
  void begin_pipeline();
  ResultPointer next_result();
  bool wait_for_bytes();
  void send_rows();
  void note_sent(int is_sent, std::string_view sql);
  Error refused(pg_result* result);
  void collect_left();

  pg_conn* connection_;
  const Patience patience_;
  Hoarder* hoarder_ = nullptr;
  std::unordered_map<std::string, std::string> prepared_;  ///< SQL and kinds: name
  std::vector<std::string> fresh_;     ///< of those: prepared since the last answer
  std::deque<std::string_view> sent_;  ///< SQL that is not answered yet
  bool has_left_ = false;              ///< `sent_` is followed by a Sync, and no one waits
  bool has_failed_ = false;            ///< something could not be sent, or no answer came
  bool is_silent_ = false;             ///< of `has_failed_`: the server says nothing
  std::uint64_t names_ = 0, changes_ = 0;
  std::string last_state_;
};

}  // namespace dripline::storage::postgresql
