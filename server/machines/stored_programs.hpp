#pragma once

#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "server/machines/run_sources.hpp"

namespace dripline::machines {

/// A run's program and those it calls, as the library has them: for the server's own looks at a
/// program. Memory is one window, whatever the size of the program; reads the store in `fetch`, so
/// it belongs to a thread that may wait. The run must outlive it.
class StoredPrograms final : public interpreter::ProgramSource {
 public:
  StoredPrograms(const RunSources& sources, const storage::Run& run);

  interpreter::TextWindow fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                                std::size_t min_bytes) override;
  interpreter::ProgramLookup find(std::string_view name) override;
  /// As it was called; empty for the run's own.
  const std::string& name_of(interpreter::ProgramIndex program) const {
    return texts_.at(program).name;
  }

 private:
  struct Text {
    std::string name;
    Digest content;
    std::uint64_t size = 0;
  };

  const RunSources sources_;
  const storage::Run& run_;
  std::vector<Text> texts_;
  std::vector<std::byte> window_;
};

}  // namespace dripline::machines
