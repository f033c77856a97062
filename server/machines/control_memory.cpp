#include "server/machines/control_memory.hpp"

#include <algorithm>
#include <vector>

#include "gateway/interpreter/core/called_program_names.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/base/names.hpp"

namespace dripline::machines {

namespace {

using interpreter::ProgramIndex;
using interpreter::ProgramLookup;
using interpreter::TextWindow;

/// A run's program and those it calls, as the library has them.
class StoredPrograms final : public interpreter::ProgramSource {
 public:
  StoredPrograms(const storage::Store& store, const storage::Run& run) : store_(store), run_(run) {
    texts_.push_back({{}, run.content, run.size});
  }

  TextWindow fetch(ProgramIndex program, std::uint64_t offset, std::size_t min_bytes) override {
    const Text& text = texts_.at(program);
    TextWindow window;
    window.state = TextWindow::State::Ready;
    window_.clear();
    if (offset < text.size) {
      auto bytes =
          store_.programs.read_content(text.content, offset, std::max(min_bytes, kMaxWindow));
      if (!bytes) {
        window.state = TextWindow::State::Failed;
        window.reason = bytes.error().what;
        return window;
      }
      window_ = *std::move(bytes);
    }
    window.text = {reinterpret_cast<const char*>(window_.data()), window_.size()};
    window.reaches_end = offset + window_.size() >= text.size;
    return window;
  }

  ProgramLookup find(std::string_view name) override {
    for (std::size_t i = 1; i < texts_.size(); ++i) {
      if (texts_[i].name == name) return found(i);
    }
    const auto revision = resolve_called_program(store_.programs, run_, std::string(name));
    if (!revision) return {ProgramLookup::State::NotFound, 0};
    texts_.push_back({std::string(name), revision->content, revision->size});
    return found(texts_.size() - 1);
  }

 private:
  struct Text {
    std::string name;
    Digest content;
    std::uint64_t size = 0;
  };
  static ProgramLookup found(std::size_t index) {
    return {ProgramLookup::State::Found, static_cast<ProgramIndex>(index)};
  }

  const storage::Store& store_;
  const storage::Run& run_;
  std::vector<Text> texts_;
  std::vector<std::byte> window_;
};

}  // namespace

Result<void> check_control_memory(const storage::Store& store, const storage::Run& run) {
  const auto dialect = interpreter::find_dialect(run.control);
  if (!dialect || (*dialect)->check_memory == nullptr) return {};
  const auto stored = store.setups.find(run.machine, std::nullopt);
  if (!stored) return {};  // its gateway has its own setup
  const auto setup = interpreter::parse_control_data(stored->text, (*dialect)->units);
  if (!setup) return fail(setup.error());
  StoredPrograms source(store, run);
  const auto verdict = (*dialect)->check_memory(*setup, source);
  if (!verdict) return fail(verdict.error());
  if (!verdict->is_binding || verdict->refused.empty()) return {};
  const auto& refused = verdict->refused.front();
  return fail(Errc::LimitExceeded, "machine '{}' cannot keep program '{}': line {}: {}",
              run.machine, run.program, refused.line, refused.text);
}

Result<storage::Revision> resolve_called_program(storage::ProgramStore& store,
                                                 const storage::Run& run, const std::string& name) {
  if (auto good = check_program_name(name); !good)
    return fail(Errc::NotFound, "{}", good.error().what);
  for (const auto& candidate : interpreter::called_program_names(name)) {
    auto revisions = store.revisions(candidate);
    if (!revisions) {
      if (revisions.error().code == Errc::NotFound) continue;
      return fail(revisions.error());
    }
    const storage::Revision* pinned = nullptr;
    for (const auto& revision : *revisions) {
      const bool fits = revision.control.empty() || revision.control == run.control;
      if (revision.is_held || revision.in_force_since() > run.created || !fits) continue;
      if (pinned == nullptr || revision.number > pinned->number) pinned = &revision;
    }
    if (pinned != nullptr) return *pinned;
  }
  return fail(
      Errc::NotFound,
      "program '{}' called by '{}' was not in the library for control {} when the run began", name,
      run.program, run.control);
}

}  // namespace dripline::machines
