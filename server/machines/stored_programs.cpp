#include "server/machines/stored_programs.hpp"

#include <algorithm>

#include "server/machines/control_memory.hpp"

namespace dripline::machines {

using interpreter::ProgramIndex;
using interpreter::ProgramLookup;
using interpreter::TextWindow;

namespace {

ProgramLookup found_at(std::size_t index) {
  return {ProgramLookup::State::Found, static_cast<ProgramIndex>(index)};
}

}  // namespace

StoredPrograms::StoredPrograms(const RunSources& sources, const storage::Run& run)
    : sources_(sources), run_(run) {
  texts_.push_back({{}, run.content, run.size});
}

TextWindow StoredPrograms::fetch(ProgramIndex program, std::uint64_t offset,
                                 std::size_t min_bytes) {
  const Text& text = texts_.at(program);
  TextWindow window;
  window.state = TextWindow::State::Ready;
  window_.clear();
  if (offset < text.size) {
    auto bytes =
        sources_.store.programs.read_content(text.content, offset, std::max(min_bytes, kMaxWindow));
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

ProgramLookup StoredPrograms::find(std::string_view name) {
  for (std::size_t i = 1; i < texts_.size(); ++i) {
    if (texts_[i].name == name) return found_at(i);
  }
  const auto revision = resolve_called_program(sources_, run_, std::string(name));
  if (!revision) return {ProgramLookup::State::NotFound, 0};
  texts_.push_back({std::string(name), revision->content, revision->size});
  return found_at(texts_.size() - 1);
}

}  // namespace dripline::machines
