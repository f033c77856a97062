#include "gateway/interpreter/dialects/centurion/codes/modes.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

namespace dripline::interpreter::centurion {
namespace {

struct Request {
  int first = 0;
  int count = 0;
  std::uint32_t file = 0;
};

/// A whole number from 0 to `maximum`, `fallback` where the block has no such word.
bool read_word(Run& run, Address address, int fallback, int maximum, int& value) {
  const Words& words = run.block.words;
  value = fallback;
  if (!words.has(address)) return true;
  const double number = words[address];
  if (!(number >= 0 && number <= maximum) || number != std::trunc(number)) {
    return run.fail(ErrorCode::ParameterOutOfRange, words.column(address),
                    fmt::format("{}{} is not a whole number from 0 to {}", to_string(address),
                                number, maximum));
  }
  value = static_cast<int>(number);
  return true;
}

bool read_request(Run& run, Request& request) {
  constexpr int kHighestFile = 9999;
  int file = 0;
  if (!read_word(run, Address::P, 0, kUserParameters - 1, request.first)) return false;
  if (!read_word(run, Address::L, 10, kUserParameters - request.first, request.count)) return false;
  if (!read_word(run, Address::Q, 0, kHighestFile, file)) return false;
  if (request.first + request.count > kUserParameters) {
    return run.fail(ErrorCode::ParameterOutOfRange, run.block.words.column(Address::P),
                    fmt::format("{} parameters from P{}", request.count, request.first));
  }
  request.file = static_cast<std::uint32_t>(file);
  return true;
}

ParameterFile* find_file(ModalState& state, std::uint32_t number) {
  const auto file = std::find_if(state.files.begin(), state.files.end(),
                                 [number](const auto& each) { return each.number == number; });
  return file == state.files.end() ? nullptr : &*file;
}

}  // namespace

bool save_parameters(Run& run, const GRow&) {
  Request request;
  if (!read_request(run, request)) return false;
  ParameterFile* file = find_file(run.state, request.file);
  if (file == nullptr) {
    if (run.state.files.size() == kMaxParameterFiles) {
      return run.fail(ErrorCode::DiskFull, 0, fmt::format("{} files", kMaxParameterFiles));
    }
    file = &run.state.files.emplace_back();
    file->number = request.file;
  }
  file->values.clear();
  for (int i = 0; i < request.count; ++i) {
    run.start.note_read(request.first + i);
    file->values.push_back(run.parameters[request.first + i]);
  }
  return true;
}

bool load_parameters(Run& run, const GRow&) {
  Request request;
  if (!read_request(run, request)) return false;
  const ParameterFile* file = find_file(run.state, request.file);
  if (file == nullptr || file->values.size() < static_cast<std::size_t>(request.count)) {
    return run.fail(ErrorCode::FileNotFound, 0, fmt::format("Q{:04}", request.file));
  }
  for (int i = 0; i < request.count; ++i) {
    run.start.note_set(request.first + i);
    run.parameters[request.first + i] = file->values[static_cast<std::size_t>(i)];
  }
  return true;
}

}  // namespace dripline::interpreter::centurion
