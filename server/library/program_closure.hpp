#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// A place in the closure where a program calls another one.
struct CallSite {
  std::string program;  ///< that calls
  std::uint64_t revision = 0;
  std::uint64_t line = 0;
};

/// A program with all that it calls, and what those call, as the interpreter of its control reads
/// the calls in their texts.
struct Closure {
  struct Called {
    std::string name;  ///< as the control names it
    storage::Revision revision;
    std::optional<CallSite> site;  ///< absent: it was named by the caller of `closure_of`
  };
  struct Missing {
    std::string name;
    CallSite site;
  };
  storage::Revision main;
  std::vector<Called> called;  ///< each revision once, in the order in which they are found
  std::vector<Missing> missing;
  std::vector<CallSite> computed;  ///< calls whose program a run computes
  bool names_more = false;         ///< programs were named beside what the texts call
};

struct ClosureRequest {
  storage::Revision main;
  /// The newest setup of this machine binds codes to programs; empty: as a control without one.
  std::string machine = {};
  /// Programs that calls compute, or other revisions than the newest; absent revision: the newest.
  struct Named {
    std::string program;
    std::optional<std::uint64_t> revision;
  };
  std::vector<Named> named = {};
  /// Of a called program the newest released revision is taken, and the newest in force where none
  /// is; otherwise the newest in force: what a run would take now.
  bool prefers_released = false;
};

/// Reads the texts of all of them, so it takes as long as that. Errors: NotFound (a named program),
/// Conflict (a named one is held, withdrawn or for another control), LimitExceeded (more programs
/// than a decision pins), those of CallReader with the program named.
Result<Closure> closure_of(const storage::Store& store, const ClosureRequest& request);

/// Whether it can be released. Errors: Conflict, naming what is missing, or the first call that a
/// run computes while no program was named.
Result<void> check_whole(const Closure& closure);

}  // namespace dripline::library
