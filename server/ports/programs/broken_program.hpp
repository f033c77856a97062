#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"
#include "server/ports/line_types.hpp"
#include "storage/store.hpp"

/// A control that reads a program from its line stays in the middle of it when the program is
/// broken off there, and takes the next text for its rest. The same holds for an answer.
namespace dripline::ports {

/// What was sent to a control last, and did not go through.
struct BrokenProgram {
  std::string id;          ///< of the run, the transfer or the answer
  std::string what;        ///< "run r-1 of program O1", "O1 revision 2": for people
  bool is_active = false;  ///< its end is not stored
};

struct SentTo {
  std::string machine;
  std::string port;  ///< of this server; empty: a gateway's, whose transfers are not in the store
  /// The control knows of an aborted program by its protocol.
  bool are_aborts_told = false;
};

/// A run that is still active counts: ask for an idle line. Errors: the store's.
Result<std::optional<BrokenProgram>> broken_program(const storage::Store& store, const SentTo& to);

/// Of a line whose control does not ask for its programs: after a program was broken off nothing is
/// sent until a person has confirmed that the control was reset. Any thread.
class ResetGate {
 public:
  explicit ResetGate(const storage::Store& store) : store_(store) {}
  /// Before a run or programs are sent. Errors: Conflict (a reset is to be confirmed), Busy (the
  /// end of the last run is not stored yet), the store's.
  Result<void> check(const LineView& port, const std::string& stored_port) const;
  /// Returns what was broken off. Holds until the next program, and while this server has the
  /// library. Errors: Unsupported (the control asks for its programs), Busy, Conflict (nothing was
  /// broken off), the store's.
  Result<std::string> confirm(const LineView& port, const std::string& stored_port);

  /// What a gateway was sending when it was lost, until it is here again and says so itself.
  void note_lost(const std::string& machine, BrokenProgram program);

 private:
  /// What is not confirmed of this.
  Result<std::vector<BrokenProgram>> open_of(const LineView& port,
                                             const std::string& stored_port) const;

  const storage::Store& store_;
  mutable std::mutex mutex_;
  std::map<std::string, std::set<std::string>> confirmed_;  ///< of each machine, BrokenProgram::id
  std::map<std::string, BrokenProgram> lost_;               ///< of each machine, the last
};

}  // namespace dripline::ports
