#pragma once

#include <chrono>
#include <memory>

namespace dripline::cli {

/// The keys that come from standard input, which a terminal repeats while one is held down. The
/// terminal shows none of them and passes each at once while this lives. Ctrl-C is the end of them.
class KeyRepeats {
 public:
  KeyRepeats();
  ~KeyRepeats();
  KeyRepeats(const KeyRepeats&) = delete;
  KeyRepeats& operator=(const KeyRepeats&) = delete;

  enum class Heard { Key, Nothing, End };
  /// Waits for a key as long as that. All that have come meanwhile are one.
  Heard wait(std::chrono::milliseconds limit);

 private:
  struct Terminal;
  std::unique_ptr<Terminal> terminal_;  ///< null: standard input is none
};

}  // namespace dripline::cli
