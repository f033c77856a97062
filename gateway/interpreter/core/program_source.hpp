#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::interpreter {

/// A text of a run: 0 is the program that was started, others were opened by `find`.
using ProgramIndex = std::uint32_t;
inline constexpr ProgramIndex kMainProgram = 0;

/// The answer to `ProgramSource::fetch`.
struct TextWindow {
  enum class State {
    Ready,   ///< `text` begins at the offset asked for
    NotYet,  ///< not here yet (a drip feed); ask again in the next step
    Failed,  ///< will never come; `reason` states why
  };
  State state = State::NotYet;
  std::string_view
      text;  ///< valid until the next call on the source; empty only at the end of the program
  bool reaches_end = false;  ///< the program ends where `text` ends
  std::string reason;
};

struct ProgramLookup {
  enum class State { Found, NotYet, NotFound };
  State state = State::NotYet;
  ProgramIndex program = 0;
};

/// Gives the interpreter program text at any byte offset, so that jumps, loops and calls work on a
/// program of any size in bounded memory. Called only from the thread that steps the interpreter.
/// Implementations never block.
class ProgramSource {
 public:
  virtual ~ProgramSource() = default;

  /// Text of `program` from byte `offset`: at least `min_bytes` contiguous bytes, or fewer when the
  /// program ends first. `min_bytes` is at most kMaxWindow. An offset at the end of the program
  /// gives an empty, Ready, reaches_end window.
  virtual TextWindow fetch(ProgramIndex program, std::uint64_t offset, std::size_t min_bytes) = 0;

  /// Looks up a program that the running one calls, by the name its control would use ("O0002").
  virtual ProgramLookup find(std::string_view name) = 0;

  static constexpr std::size_t kMaxWindow = 64 * 1024;
};

/// A whole program in memory (or a mapped file): for offline use and tests. Called programs come
/// from `loader`.
class MemorySource final : public ProgramSource {
 public:
  /// Text of a called program, or nullopt when there is none of that name.
  using Loader = std::function<std::optional<std::string>(std::string_view name)>;

  /// `text` must outlive the source.
  explicit MemorySource(std::string_view text, Loader loader = {});

  TextWindow fetch(ProgramIndex program, std::uint64_t offset, std::size_t min_bytes) override;
  ProgramLookup find(std::string_view name) override;
  /// The name under which a called program was opened; empty for the main program and for others.
  std::string_view name_of(ProgramIndex program) const;

 private:
  struct Called {
    std::string name;
    std::string text;
  };
  std::string_view main_;
  Loader loader_;
  std::vector<std::unique_ptr<Called>> called_;
};

}  // namespace dripline::interpreter
