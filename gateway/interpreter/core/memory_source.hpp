#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::interpreter {

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
