#include "gateway/interpreter/core/program_source.hpp"

#include <fmt/core.h>

namespace dripline::interpreter {

MemorySource::MemorySource(std::string_view text, Loader loader)
    : main_(text), loader_(std::move(loader)) {}

TextWindow MemorySource::fetch(ProgramIndex program, std::uint64_t offset, std::size_t) {
  TextWindow window;
  if (program > called_.size()) {
    window.state = TextWindow::State::Failed;
    window.reason = fmt::format("program {} was never opened", program);
    return window;
  }
  const std::string_view text =
      program == kMainProgram ? main_ : std::string_view(called_[program - 1]->text);
  window.state = TextWindow::State::Ready;
  window.reaches_end = true;
  if (offset < text.size()) window.text = text.substr(static_cast<std::size_t>(offset));
  return window;
}

ProgramLookup MemorySource::find(std::string_view name) {
  for (std::size_t i = 0; i < called_.size(); ++i) {
    if (called_[i]->name == name) {
      return {ProgramLookup::State::Found, static_cast<ProgramIndex>(i + 1)};
    }
  }
  std::optional<std::string> text = loader_ ? loader_(name) : std::nullopt;
  if (!text) return {ProgramLookup::State::NotFound, 0};
  auto called = std::make_unique<Called>();
  called->name = name;
  called->text = std::move(*text);
  called_.push_back(std::move(called));
  return {ProgramLookup::State::Found, static_cast<ProgramIndex>(called_.size())};
}

std::string_view MemorySource::name_of(ProgramIndex program) const {
  if (program == kMainProgram || program > called_.size()) return {};
  return called_[program - 1]->name;
}

}  // namespace dripline::interpreter
